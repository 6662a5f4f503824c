// Image coasts (thesis, appendix B.1) in whole numbers: the formulas of ../numbers.rs.

struct Settings {
    size: vec2<u32>,
    tile: vec2<u32>,
    tiles: u32,
    side: u32,
    force: u32,
    attenuation: u32,
    weakening: u32,
    iteration: u32,
}

// A pixel is a word: its resistance in the lower half, its land (1, at sea 0) above.
// `pieces` has straight and corner-cutting pieces of shore of every tile, at iterations of even and
// of odd number in turn. `fallen` has for every iteration of a batch where the pixels end that fell
// until then, and after BATCH of these numbers the pixels.
@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<storage, read> before: array<u32>;
@group(0) @binding(2) var<storage, read_write> after: array<u32>;
@group(0) @binding(3) var<storage, read_write> pieces: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> fallen: array<atomic<u32>>;

const BATCH: u32 = 64u;
const LONGEST: u32 = 8388607u;
const CORNER: u32 = 46341u;

fn land(x: u32, y: u32) -> u32 {
    return before[y * settings.size.x + x] >> 16u;
}

// Where the pieces of all tiles are counted, at an iteration.
fn slots(iteration: u32) -> u32 {
    return (iteration & 1u) * 2u * settings.tiles * settings.tiles;
}

// Where the pieces of a tile are counted.
fn slot(column: u32, row: u32) -> u32 {
    return slots(settings.iteration) + 2u * (row * settings.tiles + column);
}

@compute @workgroup_size(16, 16)
fn measure(@builtin(global_invocation_id) id: vec3<u32>) {
    let now = settings.iteration;
    if id.x == 0u && id.y == 0u && now > 0u {
        atomicStore(&fallen[now], atomicLoad(&fallen[now - 1u]));
    }
    if id.x + 1u >= settings.size.x || id.y + 1u >= settings.size.y {
        return;
    }
    let nw = land(id.x, id.y);
    let ne = land(id.x + 1u, id.y);
    let sw = land(id.x, id.y + 1u);
    let se = land(id.x + 1u, id.y + 1u);
    let count = nw + ne + sw + se;
    if count == 0u || count == 4u {
        return;
    }
    let tile = slot(id.x / settings.tile.x, id.y / settings.tile.y);
    if count == 2u && nw != se {
        atomicAdd(&pieces[tile], 1u);
    } else {
        atomicAdd(&pieces[tile + 1u], select(1u, 2u, count == 2u));
    }
}

fn over_side(count: u32, length: u32) -> u32 {
    let side = settings.side;
    return count / side * length + count % side * length / side;
}

fn tile_length(column: u32, row: u32) -> u32 {
    let last = settings.tiles - 1u;
    let tile = slot(min(column, last), min(row, last));
    let straight = atomicLoad(&pieces[tile]);
    let corners = atomicLoad(&pieces[tile + 1u]);
    return min(over_side(straight, 65536u) + over_side(corners, CORNER), LONGEST);
}

fn between_tiles(place: u32, side: u32) -> vec2<u32> {
    let past = 2u * place + 1u;
    if past < side {
        return vec2<u32>(0u, 0u);
    }
    let tile = (past - side) / (2u * side);
    let way = (past - side) % (2u * side);
    if tile + 1u < settings.tiles {
        return vec2<u32>(tile, way * 128u / side);
    }
    return vec2<u32>(settings.tiles - 1u, 0u);
}

fn blend(first: u32, second: u32, way: u32) -> u32 {
    return (first * (256u - way) + second * way) >> 8u;
}

fn force_at(x: u32, y: u32) -> u32 {
    let east = between_tiles(x, settings.tile.x);
    let south = between_tiles(y, settings.tile.y);
    let north_length = blend(tile_length(east.x, south.x), tile_length(east.x + 1u, south.x), east.y);
    let south_length =
        blend(tile_length(east.x, south.x + 1u), tile_length(east.x + 1u, south.x + 1u), east.y);
    let length = blend(north_length, south_length, south.y);
    let g = settings.attenuation;
    return settings.force / (4096u + g * (length >> 16u) + ((g * (length & 0xffffu)) >> 16u));
}

fn strength(u: u32, exposed: u32) -> u32 {
    if settings.weakening == 0u {
        return 8u * u;
    }
    if settings.weakening == 1u {
        return 2u * u * (4u - exposed);
    }
    var power = u;
    for (var k = 1u; k < exposed; k++) {
        power = (power * u) >> 16u;
    }
    return 8u * power;
}

@compute @workgroup_size(16, 16)
fn erode(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = settings.size;
    if id.x >= size.x || id.y >= size.y {
        return;
    }
    let at = id.y * size.x + id.x;
    if at < settings.tiles * settings.tiles {
        // Nobody looks at these pieces before the next iteration counts them.
        let next = slots(settings.iteration + 1u) + 2u * at;
        atomicStore(&pieces[next], 0u);
        atomicStore(&pieces[next + 1u], 0u);
    }
    var cell = before[at];
    if cell > 0xffffu {
        let west = land(max(id.x, 1u) - 1u, id.y);
        let east = land(min(id.x + 1u, size.x - 1u), id.y);
        let north = land(id.x, max(id.y, 1u) - 1u);
        let south = land(id.x, min(id.y + 1u, size.y - 1u));
        let exposed = 4u - (west + east + north + south);
        let rock = cell & 0xffffu;
        if exposed > 0u && strength(rock, exposed) < force_at(id.x, id.y) {
            cell = rock;
            let place = atomicAdd(&fallen[settings.iteration], 1u);
            atomicStore(&fallen[BATCH + place], at);
        }
    }
    after[at] = cell;
}
