//! A set of nodes as one bit a node.

/// A set of nodes that is read in node order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NodeSet {
    words: Vec<u64>,
    count: usize,
}

impl NodeSet {
    /// An empty set over `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        Self { words: vec![0; nodes.div_ceil(64)], count: 0 }
    }

    /// Number of nodes in the set.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether the set is empty.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether `node` is in the set; nodes beyond the lattice never are.
    #[inline]
    pub fn contains(&self, node: usize) -> bool {
        self.words.get(node / 64).is_some_and(|word| word >> (node % 64) & 1 == 1)
    }

    /// Adds `node`; `false` when it was there already.
    #[inline]
    pub fn insert(&mut self, node: usize) -> bool {
        let bit = 1 << (node % 64);
        let added = self.words[node / 64] & bit == 0;
        self.words[node / 64] |= bit;
        self.count += usize::from(added);
        added
    }

    /// Removes `node`; `false` when it was not there.
    #[inline]
    pub fn remove(&mut self, node: usize) -> bool {
        let bit = 1 << (node % 64);
        let removed = self.words[node / 64] & bit != 0;
        self.words[node / 64] &= !bit;
        self.count -= usize::from(removed);
        removed
    }

    /// The nodes of the set in node order.
    pub fn iter(&self) -> NodesOfSet<'_> {
        NodesOfSet { words: self.words.iter(), word: 0, next: 0 }
    }

    /// Number of words of 64 nodes, for visits that change other parts of the group.
    pub(super) fn word_count(&self) -> usize {
        self.words.len()
    }

    /// The nodes of one word of 64, in node order.
    pub(super) fn word(&self, index: usize) -> impl Iterator<Item = usize> + use<> {
        bits(index, self.words[index])
    }
}

/// The set bits of word `index` as node numbers.
fn bits(index: usize, mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros() as usize;
        word &= word.checked_sub(1)?;
        Some(index * 64 + bit)
    })
}

/// The nodes of a set in node order: see [`NodeSet::iter`].
#[derive(Clone, Debug)]
pub struct NodesOfSet<'a> {
    words: std::slice::Iter<'a, u64>,
    /// Bits that are left of the word before `next`.
    word: u64,
    /// Number of the first node of the next word.
    next: usize,
}

impl Iterator for NodesOfSet<'_> {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        while self.word == 0 {
            self.word = *self.words.next()?;
            self.next += 64;
        }
        let bit = self.word.trailing_zeros() as usize;
        self.word &= self.word - 1;
        Some(self.next - 64 + bit)
    }
}
