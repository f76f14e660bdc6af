//! Number of rays per submission.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use rasray_ads::Structure;

/// Number of rays in the first submission to a structure that has not been timed yet.
const FIRST: u32 = 1024;

/// Minimum number of rays per submission, unless fewer are left.
const LEAST: u32 = 64;

/// Maximum duration of one submission in seconds: far below what any driver or timeout allows.
const SECONDS: f64 = 1.0;

/// Maximum ratio of the number of rays in a submission to that of the one before.
const GROWTH: u32 = 8;

/// Maximum number of rays per submission for each structure, adapted to the duration of its last submission.
/// A million triangles tested one by one take a million times as long as one triangle, and a driver or a
/// timeout ends a submission that takes a minute.
#[derive(Debug, Default)]
pub(crate) struct Shares(Mutex<HashMap<Contestant, u32>>);

/// Identity of a structure: its address, because two structures of one kind may have different scenes and
/// options. A new structure at the address of an earlier one starts from that one's share and corrects it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Contestant(usize);

impl From<&dyn Structure> for Contestant {
    fn from(structure: &dyn Structure) -> Self {
        Self(std::ptr::from_ref(structure).cast::<()>().addr())
    }
}

impl Shares {
    /// Returns the number of rays in the next submission to a structure, at most `capacity`.
    pub(crate) fn of(&self, structure: Contestant, capacity: u32) -> u32 {
        let shares = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        shares.get(&structure).copied().unwrap_or(FIRST).min(capacity)
    }

    /// Takes the duration of a submission into account.
    pub(crate) fn learn(&self, structure: Contestant, rays: u32, seconds: f64) {
        let mut shares = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let share = shares.entry(structure).or_insert(FIRST);
        *share = next(*share, rays, seconds);
    }
}

/// Returns the share after a submission of `rays` rays, at most `share`, that took `seconds`.
fn next(share: u32, rays: u32, seconds: f64) -> u32 {
    // The conversion to `u32` saturates.
    let fitting = (f64::from(rays) * SECONDS / seconds.max(1e-6)) as u32;
    // The duration of a small remainder does not predict that of larger submissions, unless it was too long.
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
        // A small remainder does not raise the share.
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
