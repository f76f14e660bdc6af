//! Number of rays in one submission.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use rasray_ads::Structure;

/// Rays of the first submission to a structure that has not been timed yet.
const FIRST: u32 = 1024;

/// Minimum number of rays per submission, unless fewer are left.
const LEAST: u32 = 64;

/// Maximum duration of one submission in seconds: far below what any driver or timeout allows.
const SECONDS: f64 = 1.0;

/// Maximum ratio of a submission to the one before.
const GROWTH: u32 = 8;

/// Maximum number of rays of a submission per structure, adapted to the time of the last one: a million
/// triangles tested one by one take a million times as long as one, and a submission that takes a minute is
/// ended by a driver or a timeout.
#[derive(Debug, Default)]
pub(crate) struct Shares(Mutex<HashMap<Contestant, u32>>);

/// A structure, identified by its address: two of one kind may have different scenes and options. A later
/// value at the same address starts from its predecessor's share and corrects it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Contestant(usize);

impl From<&dyn Structure> for Contestant {
    fn from(structure: &dyn Structure) -> Self {
        Self(std::ptr::from_ref(structure).cast::<()>().addr())
    }
}

impl Shares {
    /// Rays of the next submission to that structure.
    pub(crate) fn of(&self, structure: Contestant, capacity: u32) -> u32 {
        let shares = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        shares.get(&structure).copied().unwrap_or(FIRST).min(capacity)
    }

    /// Records the time of a submission.
    pub(crate) fn learn(&self, structure: Contestant, rays: u32, seconds: f64) {
        let mut shares = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let share = shares.entry(structure).or_insert(FIRST);
        *share = next(*share, rays, seconds);
    }
}

/// The share after a submission of `rays`, at most `share`, with this duration.
fn next(share: u32, rays: u32, seconds: f64) -> u32 {
    // The conversion saturates.
    let fitting = (f64::from(rays) * SECONDS / seconds.max(1e-6)) as u32;
    // The time of a small rest does not predict that of larger submissions, unless it was too long.
    let most = if rays < share { share } else { share.saturating_mul(GROWTH) };
    let least = if rays < share { share.min(fitting) } else { LEAST };
    fitting.clamp(least.max(LEAST).min(most), most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_follow_the_time_that_rays_take() {
        // The share grows step by step after fast submissions and shrinks at once after slow ones.
        assert_eq!(next(1024, 1024, 0.001), 8192);
        assert_eq!(next(1024, 1024, 0.5), 2048);
        assert_eq!(next(1024, 1024, 1.0), 1024);
        assert_eq!(next(1024, 1024, 8.0), 128);
        assert_eq!(next(1024, 1024, 1e6), LEAST);
        assert_eq!(next(u32::MAX, u32::MAX, 0.0), u32::MAX);
        // A small rest does not raise the share.
        assert_eq!(next(1024, 10, 0.0), 1024);
        assert_eq!(next(1024, 100, 1.0), 100);
        assert_eq!(next(LEAST, 1, 60.0), LEAST);
    }

    #[test]
    fn structures_are_told_apart() {
        let shares = Shares::default();
        let (slow, other) = (Contestant(1), Contestant(2));
        shares.learn(slow, FIRST, 16.0);
        assert_eq!(shares.of(slow, 65_536), LEAST);
        assert_eq!(shares.of(other, 65_536), FIRST);
        assert_eq!(shares.of(other, 10), 10);
    }
}
