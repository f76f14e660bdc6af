//! Layout of the one pool of words that is shared by scanning, binning and sorting.

use crate::kit::PoolName;
use crate::{Builder, Sizes};

/// Contents of the scratch pool of a configuration: the sums of a scan, and behind them what passes use one
/// after the other, the large-triangle queue while triangles are binned, and two words of each long list once
/// they are sorted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scratch<P> {
    /// The pool.
    pub pool: P,
    /// Words for the sums of the scan; 0 where nothing is scanned.
    pub sums: u64,
    /// Builder; there is a large-triangle queue only where triangles are binned.
    pub builder: Builder,
    /// True if lists are sorted.
    pub sorts: bool,
}

impl<P: PoolName> Scratch<P> {
    /// Words for so many triangles with many cells, and so many long lists.
    pub fn words(&self, large: u64, long_lists: u64) -> u64 {
        let large = if self.builder == Builder::Binning { large } else { 0 };
        self.sums + if self.sorts { large.max(2 * long_lists) } else { large }
    }

    /// Words that pools of these sizes have behind the sums.
    pub fn words_behind_sums(&self, sizes: &Sizes) -> u64 {
        sizes.elements_of(self.pool).saturating_sub(self.sums)
    }

    /// Capacity of such pools for triangles with many cells.
    pub fn large_capacity(&self, sizes: &Sizes) -> u64 {
        if self.builder == Builder::Binning { self.words_behind_sums(sizes) } else { 0 }
    }

    /// Capacity of such pools for long lists.
    pub fn long_capacity(&self, sizes: &Sizes) -> u64 {
        if self.sorts { self.words_behind_sums(sizes) / 2 } else { 0 }
    }
}
