//! Outcome of a build, and what to do then.

use std::fmt;

use crate::{AdsError, Sizes};

/// Demand and capacity of a pool in a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PoolStatus {
    /// Name of the pool.
    pub name: &'static str,
    /// Elements the build needs; exact also beyond the capacity. For pages it is the number that this build
    /// began or would have begun, which varies slightly with the order of threads; `check` adds a margin for
    /// it.
    pub demand: u64,
    /// Elements the pool holds.
    pub capacity: u64,
}

impl PoolStatus {
    /// Elements that the capacity lacks; 0 where it suffices.
    pub fn lacking(&self) -> u64 {
        self.demand.saturating_sub(self.capacity)
    }
}

/// Name and numbers, for messages.
impl fmt::Display for PoolStatus {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} holds {} and takes {}", self.name, self.capacity, self.demand)
    }
}

/// The outcome of a build, read by the caller after its own wait.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuildStatus {
    /// True if traces will answer.
    pub complete: bool,
    /// True if traces that were recorded after the build have answers. Differs from `complete` where pools,
    /// triangles or a scene that builds read were replaced since.
    pub was_complete: bool,
    /// Pools whose demand the build counted.
    pub pools: Vec<PoolStatus>,
    /// Lists too long to be sorted; they are searched in full.
    pub unsorted: u64,
    /// Triangles with a corner outside of the bounds that their geometry states, with a vertex that it does
    /// not have, or beyond its maximum; with any of them the build is not complete.
    pub outside: u32,
    /// List entries with an invalid index that the build found; anything but 0 is a fault. Those that traces
    /// find are in [`crate::QueueCounters::corrupted`].
    pub corrupted: u64,
    /// Outcomes of the parts of a [`Combined`](crate::Combined) structure; empty for all others.
    pub parts: Vec<Self>,
}

impl BuildStatus {
    /// The demand for a pool; absent where none has that name.
    pub fn demand(&self, name: &str) -> Option<u64> {
        self.pools.iter().find(|pool| pool.name == name).map(|pool| pool.demand)
    }

    /// The pool of the structure or of its parts that lacks most elements; absent where all suffice.
    pub fn shortest_pool(&self) -> Option<PoolStatus> {
        let of_parts = self.parts.iter().filter_map(Self::shortest_pool);
        let all = self.pools.iter().copied().chain(of_parts);
        all.filter(|pool| pool.lacking() > 0).max_by_key(PoolStatus::lacking)
    }
}

/// Action after a build.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Check {
    /// Everything was stored.
    Complete,
    /// Resize to this and build again.
    Grow(Sizes),
}

impl BuildStatus {
    /// The result of [`Structure::check`](crate::Structure::check): `plan` computes the sizes for demands
    /// with the given growth.
    ///
    /// # Errors
    /// As [`Structure::check`](crate::Structure::check).
    pub fn check(
        &self,
        headroom: u32,
        plan: impl Fn(Growth) -> Result<Sizes, AdsError>,
    ) -> Result<Check, AdsError> {
        if self.outside > 0 {
            return Err(AdsError::OutsideBounds { triangles: self.outside });
        }
        if self.was_complete {
            return Ok(Check::Complete);
        }
        // Without headroom is better than not at all.
        plan(Growth { percent: headroom }).or_else(|_| plan(Growth { percent: 0 })).map(Check::Grow)
    }
}

/// Growth of a pool beyond its demand, in percent of it.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    percent: u32,
}

impl Growth {
    /// Elements for a pool of this demand and capacity: never less than its capacity.
    pub fn of(self, demand: u64, capacity: u64) -> u64 {
        if demand <= capacity {
            return capacity;
        }
        demand.saturating_add(demand.saturating_mul(self.percent.into()) / 100)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pool_that_lacks_most_is_found_in_all_parts() {
        let pool = |name, demand, capacity| PoolStatus { name, demand, capacity };
        let of = |pools: &[PoolStatus]| BuildStatus { pools: pools.to_vec(), ..BuildStatus::default() };
        assert_eq!(of(&[]).shortest_pool(), None);
        assert_eq!(of(&[pool("nodes", 5, 5), pool("near", 0, 9)]).shortest_pool(), None);
        let most = pool("near", 70, 9);
        let still = of(&[pool("nodes", 900, 899), most]);
        assert_eq!(still.shortest_pool(), Some(most));
        let whole = BuildStatus { parts: vec![of(&[pool("nodes", 9, 2)]), still], ..BuildStatus::default() };
        assert_eq!(whole.shortest_pool(), Some(most));
        assert_eq!(most.to_string(), "near holds 9 and takes 70");
    }
}
