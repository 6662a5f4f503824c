// Image coasts (thesis, appendix B.1) in whole numbers: the formulas of numbers.rs.

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

// Land is 1, sea 0. `pieces` has straight and corner-cutting pieces of shore of every tile, for
// each iteration of a batch; `fallen` the pixels that fell in it.
@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<storage, read> resistance: array<u32>;
@group(0) @binding(2) var<storage, read> before: array<u32>;
@group(0) @binding(3) var<storage, read_write> after: array<u32>;
@group(0) @binding(4) var<storage, read_write> pieces: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> fallen: array<atomic<u32>>;

const LONGEST: u32 = 8388607u;
const CORNER: u32 = 46341u;

fn pixel(x: u32, y: u32) -> u32 {
    return before[y * settings.size.x + x];
}

// Where the pieces of a tile are counted.
fn slot(column: u32, row: u32) -> u32 {
    return 2u * ((settings.iteration * settings.tiles + row) * settings.tiles + column);
}

@compute @workgroup_size(16, 16)
fn measure(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x + 1u >= settings.size.x || id.y + 1u >= settings.size.y {
        return;
    }
    let nw = pixel(id.x, id.y);
    let ne = pixel(id.x + 1u, id.y);
    let sw = pixel(id.x, id.y + 1u);
    let se = pixel(id.x + 1u, id.y + 1u);
    let land = nw + ne + sw + se;
    if land == 0u || land == 4u {
        return;
    }
    let tile = slot(id.x / settings.tile.x, id.y / settings.tile.y);
    if land == 2u && nw != se {
        atomicAdd(&pieces[tile], 1u);
    } else {
        atomicAdd(&pieces[tile + 1u], select(1u, 2u, land == 2u));
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
    let here = pixel(id.x, id.y);
    let west = pixel(max(id.x, 1u) - 1u, id.y);
    let east = pixel(min(id.x + 1u, size.x - 1u), id.y);
    let north = pixel(id.x, max(id.y, 1u) - 1u);
    let south = pixel(id.x, min(id.y + 1u, size.y - 1u));
    let exposed = 4u - (west + east + north + south);
    var left = here;
    let at = id.y * size.x + id.x;
    if here == 1u && exposed > 0u && strength(resistance[at], exposed) < force_at(id.x, id.y) {
        left = 0u;
        atomicAdd(&fallen[settings.iteration], 1u);
    }
    after[at] = left;
}
