//! Options and methods that the configurations and contents of all structures share.

use std::ops::RangeInclusive;

use crate::{Addressing, AdsError, Counters};

/// Options that every configuration has.
#[derive(Clone, Copy, Debug)]
pub struct Common {
    /// Addressing of the pools by shaders.
    pub addressing: Addressing,
    /// Counters of their work that rays record.
    pub counters: Counters,
    /// Work units per dispatch; if absent, [`default_work_budget`](crate::kit::default_work_budget).
    pub work_budget: Option<u32>,
}

/// A configuration of a structure; the macro [`configured!`](crate::configured) implements it for a struct.
pub trait Configured {
    /// Returns the options that every configuration has.
    fn common(&self) -> Common;
}

/// Checks that the value of an option is in a range, which `expected` states in words.
///
/// # Errors
/// [`AdsError::Option`]: the value is outside the range.
pub fn check_range(
    option: &'static str,
    value: u32,
    range: RangeInclusive<u32>,
    expected: &'static str,
) -> Result<(), AdsError> {
    if range.contains(&value) {
        return Ok(());
    }
    Err(AdsError::Option { option, value: value.to_string(), expected })
}

/// Checks that a work budget lets every dispatch make progress: the budget has at least one unit, or two if a
/// dispatch that resumes a search counts the cell again before it reads an entry (`counts_cells_again`).
///
/// # Errors
/// [`AdsError::Option`]: the budget is too small.
pub fn check_work_budget(work_budget: Option<u32>, counts_cells_again: bool) -> Result<(), AdsError> {
    let (least, expected) = match counts_cells_again {
        false => (1, "1 unit or more per dispatch, or rays make no progress"),
        true => (2, "2 units or more per dispatch, or rays make no progress"),
    };
    check_range("work budget", work_budget.unwrap_or(least), least..=u32::MAX, expected)
}

/// Implements [`Configured`] for a struct that has the fields of [`Common`].
#[macro_export]
macro_rules! configured {
    ($config:ty) => {
        impl $crate::kit::Configured for $config {
            fn common(&self) -> $crate::kit::Common {
                let Self { addressing, counters, work_budget, .. } = *self;
                $crate::kit::Common { addressing, counters, work_budget }
            }
        }
    };
}
