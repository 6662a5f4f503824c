//! Sets of voxels, a bit each.

/// A set of the voxels of a block.
///
/// What lies outside the block is not in the set. Rows of bits lie inside an empty frame one voxel
/// wide, so that whole words of neighbours can be had without asking for borders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VoxelSet {
    size: [usize; 3],
    /// Words of a framed row; the last one has room for a column beyond the frame.
    words_a_row: usize,
    words: Vec<u64>,
}

impl VoxelSet {
    /// The empty set of a block of `size` columns, rows and layers.
    pub fn empty(size: [usize; 3]) -> Self {
        let [width, height, layers] = size;
        let words_a_row = (width + 3).div_ceil(64);
        let rows = (height + 2) * (layers + 2);
        Self { size, words_a_row, words: vec![0; words_a_row * rows] }
    }

    /// The voxels for which `is_member` holds, asked for column, row and layer.
    pub fn new(size: [usize; 3], is_member: impl Fn([usize; 3]) -> bool) -> Self {
        let mut set = Self::empty(size);
        let [width, height, layers] = size;
        for layer in 0..layers {
            for row in 0..height {
                for column in 0..width {
                    if is_member([column, row, layer]) {
                        set.insert([column, row, layer]);
                    }
                }
            }
        }
        set
    }

    /// The voxels of a field, one value a voxel in node order, that are at least `threshold`; of
    /// fewer values than voxels, the rest are not in the set.
    pub fn at_least(size: [usize; 3], values: &[f64], threshold: f64) -> Self {
        let [width, height, _] = size;
        Self::new(size, |[column, row, layer]| {
            let value = values.get(column + width * (row + height * layer));
            value.is_some_and(|&value| value >= threshold)
        })
    }

    /// Columns, rows and layers of the block.
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Number of voxels in the set.
    pub fn len(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether no voxel is in the set.
    pub fn is_empty(&self) -> bool {
        self.words.iter().all(|&word| word == 0)
    }

    /// Whether a voxel of the block is in the set.
    ///
    /// # Panics
    /// If it lies outside the block.
    pub fn contains(&self, voxel: [usize; 3]) -> bool {
        let (word, bit) = self.place(voxel);
        self.words[word] >> bit & 1 == 1
    }

    /// Whether a voxel, which may lie outside the block, is in the set.
    pub fn holds(&self, voxel: [isize; 3]) -> bool {
        let inside = (0..3).all(|axis| (0..self.size[axis] as isize).contains(&voxel[axis]));
        inside && self.contains(voxel.map(|at| at as usize))
    }

    /// Puts a voxel of the block into the set.
    ///
    /// # Panics
    /// If it lies outside the block.
    pub fn insert(&mut self, voxel: [usize; 3]) {
        let (word, bit) = self.place(voxel);
        self.words[word] |= 1 << bit;
    }

    /// Takes a voxel of the block out of the set.
    ///
    /// # Panics
    /// If it lies outside the block.
    pub fn remove(&mut self, voxel: [usize; 3]) {
        let (word, bit) = self.place(voxel);
        self.words[word] &= !(1 << bit);
    }

    /// The voxels of the set in node order.
    pub fn iter(&self) -> impl Iterator<Item = [usize; 3]> {
        let [_, height, layers] = self.size;
        let rows = (0..layers).flat_map(move |layer| (0..height).map(move |row| (row, layer)));
        rows.flat_map(move |(row, layer)| {
            let words = self.row([row + 1, layer + 1]);
            bits_of(words).map(move |column| [column - 1, row, layer])
        })
    }

    /// Index of the word and the bit of a voxel.
    fn place(&self, voxel: [usize; 3]) -> (usize, usize) {
        let inside = (0..3).all(|axis| voxel[axis] < self.size[axis]);
        assert!(inside, "voxel {voxel:?} of a block of {:?}", self.size);
        let [column, row, layer] = voxel.map(|at| at + 1);
        (self.first_word([row, layer]) + column / 64, column % 64)
    }

    fn first_word(&self, [row, layer]: [usize; 2]) -> usize {
        (row + (self.size[1] + 2) * layer) * self.words_a_row
    }

    /// The words of a framed row and layer.
    pub(super) fn row(&self, place: [usize; 2]) -> &[u64] {
        &self.words[self.first_word(place)..][..self.words_a_row]
    }

    /// The 27 bits of a voxel of the block and what lies around it; see [`super::simple`].
    #[inline]
    pub(super) fn around(&self, [column, row, layer]: [usize; 3]) -> u32 {
        // In framed counting the voxel is at column + 1, so its surroundings begin at `column`.
        let (word, bit) = (column / 64, column % 64);
        let mut bits = 0;
        for place in (0..9).rev() {
            let first = self.first_word([row + place % 3, layer + place / 3]) + word;
            let low = self.words[first] >> bit;
            // Three bits may reach into the next word.
            let three = if bit > 61 { low | self.words[first + 1] << (64 - bit) } else { low };
            bits = bits << 3 | (three & 0b111) as u32;
        }
        bits
    }
}

/// The numbers of the bits that are set, from the lowest.
pub(super) fn bits_of(words: &[u64]) -> impl Iterator<Item = usize> {
    words.iter().enumerate().flat_map(|(index, &word)| {
        let mut rest = word;
        std::iter::from_fn(move || {
            let bit = (rest != 0).then(|| rest.trailing_zeros() as usize)?;
            rest &= rest - 1;
            Some(index * 64 + bit)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surroundings_hold_what_lies_around_across_words_and_borders() {
        let size = [131, 3, 2];
        let set = VoxelSet::new(size, |[x, y, z]| (x * 7 + y * 5 + z * 3) % 11 < 5);
        for z in 0..2 {
            for y in 0..3 {
                for x in 0..131 {
                    let mut expected = 0;
                    for place in 0..27 {
                        let step = [place % 3, place / 3 % 3, place / 9].map(|at| at as isize - 1);
                        let at = [x as isize + step[0], y as isize + step[1], z as isize + step[2]];
                        expected |= u32::from(set.holds(at)) << place;
                    }
                    assert_eq!(set.around([x, y, z]), expected, "{x} {y} {z}");
                }
            }
        }
    }

    #[test]
    fn voxels_come_in_node_order_and_are_counted() {
        let mut set = VoxelSet::empty([70, 2, 2]);
        let voxels = [[0, 0, 0], [69, 0, 0], [3, 1, 0], [64, 1, 1]];
        voxels.iter().for_each(|&voxel| set.insert(voxel));
        assert_eq!(set.iter().collect::<Vec<_>>(), voxels);
        assert_eq!(set.len(), 4);
        set.remove([3, 1, 0]);
        assert!(!set.contains([3, 1, 0]) && set.len() == 3 && !set.is_empty());
        let values = [0.1, 0.5, 0.9];
        let at_least = VoxelSet::at_least([3, 1, 1], &values, 0.5);
        assert_eq!(at_least.iter().collect::<Vec<_>>(), [[1, 0, 0], [2, 0, 0]]);
    }
}
