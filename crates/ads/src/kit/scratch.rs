//! Layout of the pool of words that scanning, binning and sorting share.

use crate::kit::PoolName;
use crate::{Builder, Sizes};

/// Contents of the scratch pool of a configuration: the sums of a scan, and behind them data of passes that
/// run one after the other. That data is the large-triangle queue while triangles are binned, and two words
/// of each long list when they are sorted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scratch<P> {
    /// Pool that holds the scratch words.
    pub pool: P,
    /// Number of words for the sums of the scan; 0 if nothing is scanned.
    pub sums: u64,
    /// Builder; the large-triangle queue exists only with binning.
    pub builder: Builder,
    /// True if the build sorts lists.
    pub sorts: bool,
}

impl<P: PoolName> Scratch<P> {
    /// Returns the number of words for `large` triangles with many cells and `long_lists` long lists.
    pub fn words(&self, large: u64, long_lists: u64) -> u64 {
        let large = if self.builder == Builder::Binning { large } else { 0 };
        self.sums + if self.sorts { large.max(2 * long_lists) } else { large }
    }

    /// Returns the number of words behind the sums in pools of these sizes.
    pub fn words_behind_sums(&self, sizes: &Sizes) -> u64 {
        sizes.elements_of(self.pool).saturating_sub(self.sums)
    }

    /// Returns the capacity of pools of these sizes for triangles with many cells.
    pub fn large_capacity(&self, sizes: &Sizes) -> u64 {
        if self.builder == Builder::Binning { self.words_behind_sums(sizes) } else { 0 }
    }

    /// Returns the capacity of pools of these sizes for long lists.
    pub fn long_capacity(&self, sizes: &Sizes) -> u64 {
        if self.sorts { self.words_behind_sums(sizes) / 2 } else { 0 }
    }
}
