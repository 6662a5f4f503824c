//! How much memory a run will take, before it takes it.

use crate::code::Code;
use crate::nodes::ENTITY_BYTES;
use crate::parameters::Problem;
use crate::process::Declaration;

/// Bytes a node that building a run takes besides the fields: buffers of doubles to fill one.
const BUILD_BYTES: usize = 24;

/// Bytes a node of a run with these declarations on a lattice of so many directions.
pub(super) fn bytes_per_node(
    fields: usize,
    declarations: &[Declaration],
    directions: usize,
) -> usize {
    let edges: usize = declarations.iter().flat_map(|uses| &uses.edges).map(|e| e.bytes).sum();
    let groups: usize = declarations.iter().flat_map(|uses| &uses.groups).map(|g| g.bytes).sum();
    let scratch = declarations.iter().map(|uses| uses.scratch).max().unwrap_or(0);
    ENTITY_BYTES + BUILD_BYTES + fields + edges * directions + groups + scratch
}

/// Refuses a run of `nodes` nodes that would not fit into `limit` bytes.
pub(super) fn check(nodes: u128, bytes_per_node: usize, limit: u64) -> Result<(), Problem> {
    let needed = nodes.saturating_mul(bytes_per_node as u128);
    if needed <= u128::from(limit) {
        return Ok(());
    }
    let gib = |bytes: u128| bytes as f64 / (1_u64 << 30) as f64;
    let affordable = u128::from(limit) / bytes_per_node as u128;
    let side = (affordable as f64).sqrt() as u64;
    Err(Problem::new(
        "domain",
        format!(
            "{nodes} nodes need about {:.1} GiB ({bytes_per_node} bytes a node) and {:.1} GiB may be used",
            gib(needed),
            gib(u128::from(limit)),
        ),
        format!("at most {affordable} nodes, {side} x {side} say"),
    )
    .code(Code::Memory)
    .help("make the domain smaller or raise the limit with --memory-limit-gib"))
}
