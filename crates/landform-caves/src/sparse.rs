//! Fields that are nothing nearly everywhere.

/// Voxels of a page: passages are about as long along a row.
const PAGE: usize = 16;

/// A value a voxel, kept in pages that are made when one of their voxels is first written. Everywhere
/// else it is the default.
///
/// Takes a quarter of a byte a voxel, and the pages.
#[derive(Clone, Debug)]
pub(crate) struct Sparse<T> {
    /// Number of the page of each run of voxels; page 0 is that of nothing.
    page_of: Vec<u32>,
    pages: Vec<[T; PAGE]>,
}

impl<T: Copy + Default> Sparse<T> {
    /// Nothing for so many voxels.
    pub(crate) fn new(voxels: usize) -> Self {
        let page_of = vec![0; voxels.div_ceil(PAGE)];
        Self { page_of, pages: vec![[T::default(); PAGE]] }
    }

    /// The value of a voxel.
    #[inline]
    pub(crate) fn get(&self, node: usize) -> T {
        self.pages[self.page_of[node / PAGE] as usize][node % PAGE]
    }

    /// The value of a voxel, to be changed.
    #[inline]
    pub(crate) fn get_mut(&mut self, node: usize) -> &mut T {
        let page = &mut self.page_of[node / PAGE];
        if *page == 0 {
            *page = self.pages.len() as u32;
            self.pages.push([T::default(); PAGE]);
        }
        &mut self.pages[*page as usize][node % PAGE]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_read_and_the_rest_is_nothing() {
        let mut field = Sparse::<u32>::new(1000);
        let mut expected = vec![0; 1000];
        for turn in 0..60_usize {
            let node = turn * turn * 7 % 1000;
            *field.get_mut(node) += turn as u32;
            expected[node] += turn as u32;
        }
        assert!((0..1000).all(|node| field.get(node) == expected[node]));
        assert!(field.pages.len() < 50, "{} pages", field.pages.len());
    }
}
