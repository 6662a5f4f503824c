//! Numbers at nodes, kept together as they lie on the map.

/// Columns of a block.
pub(super) const BLOCK: usize = 16;

/// Rows whose blocks lie one after the other in memory: with 4 bytes a number, a page.
const ROWS: usize = 64;

/// Numbers at the nodes of a map, stored in blocks of columns: what lies close together on the
/// map lies in few pages of memory, however wide the map is.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    width: usize,
    /// Blocks in a row.
    across: usize,
    blocks: Vec<[i32; BLOCK]>,
}

impl Blocks {
    /// Zeros.
    pub(super) fn new([width, height]: [usize; 2]) -> Self {
        let across = width.div_ceil(BLOCK);
        let blocks = vec![[0; BLOCK]; across * height.next_multiple_of(ROWS)];
        Self { width, across, blocks }
    }

    fn index(&self, block: usize, y: usize) -> usize {
        (y / ROWS * self.across + block) * ROWS + y % ROWS
    }

    /// The number at a node.
    #[inline]
    pub(super) fn get(&self, node: usize) -> i32 {
        let (x, y) = (node % self.width, node / self.width);
        self.blocks[self.index(x / BLOCK, y)][x % BLOCK]
    }

    /// The number at a node, to be changed.
    #[inline]
    pub(super) fn get_mut(&mut self, node: usize) -> &mut i32 {
        let (x, y) = (node % self.width, node / self.width);
        let index = self.index(x / BLOCK, y);
        &mut self.blocks[index][x % BLOCK]
    }

    /// A row.
    pub(super) fn row(&mut self, y: usize) -> RowOfBlocks<'_> {
        let first = self.index(0, y);
        RowOfBlocks(&mut self.blocks[first..])
    }
}

/// A row of numbers in blocks.
#[derive(Debug)]
pub(super) struct RowOfBlocks<'a>(&'a mut [[i32; BLOCK]]);

impl RowOfBlocks<'_> {
    /// A block of its columns.
    #[inline]
    pub(super) fn block(&mut self, block: usize) -> &mut [i32; BLOCK] {
        &mut self.0[block * ROWS]
    }
}
