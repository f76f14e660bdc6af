//! Outcome of a build, and the action to take then.

use std::fmt;

use crate::{AdsError, Sizes};

/// Demand and capacity of one pool in a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PoolStatus {
    /// Name of the pool.
    pub name: &'static str,
    /// Number of elements that the build needs; exact even beyond the capacity. For pages it is the number
    /// that this build began or would have begun, which varies slightly with the order of threads; `check`
    /// adds a margin for it.
    pub demand: u64,
    /// Number of elements that the pool holds.
    pub capacity: u64,
}

impl PoolStatus {
    /// Returns the number of elements that the capacity lacks; 0 if it suffices.
    pub fn lacking(&self) -> u64 {
        self.demand.saturating_sub(self.capacity)
    }
}

/// Writes name and numbers, for messages.
impl fmt::Display for PoolStatus {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} holds {} and takes {}", self.name, self.capacity, self.demand)
    }
}

/// The outcome of a build, read by the caller after its own wait.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuildStatus {
    /// True if traces through the present structure answer.
    pub complete: bool,
    /// True if traces that were recorded directly after the build have answers. It differs from `complete` if
    /// pools, triangles or a scene that builds read were replaced since.
    pub was_complete: bool,
    /// Pools whose demand the build counted.
    pub pools: Vec<PoolStatus>,
    /// Number of lists too long to be sorted; traces search them in full.
    pub unsorted: u64,
    /// Number of triangles with a corner outside of the bounds that their geometry states, with a vertex that
    /// does not exist, or beyond the maximum number; the build is not complete if there are any.
    pub outside: u32,
    /// Number of list entries with an invalid index that the build found; anything but 0 is a fault. Entries
    /// that traces find are counted in [`crate::QueueCounters::corrupted`].
    pub corrupted: u64,
    /// Outcomes of the parts of a [`Combined`](crate::Combined) structure; empty for all others.
    pub parts: Vec<Self>,
}

impl BuildStatus {
    /// Returns the demand for the pool with that name; absent if there is none.
    pub fn demand(&self, name: &str) -> Option<u64> {
        self.pools.iter().find(|pool| pool.name == name).map(|pool| pool.demand)
    }

    /// Returns the pool, of the structure or of its parts, that lacks most elements; absent if all pools
    /// suffice.
    pub fn shortest_pool(&self) -> Option<PoolStatus> {
        let of_parts = self.parts.iter().filter_map(Self::shortest_pool);
        let all = self.pools.iter().copied().chain(of_parts);
        all.filter(|pool| pool.lacking() > 0).max_by_key(PoolStatus::lacking)
    }
}

/// Action that a caller takes after a build.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Check {
    /// No action: the build stored everything.
    Complete,
    /// Resize to these sizes and build again.
    Grow(Sizes),
}

impl BuildStatus {
    /// Returns the result of [`Structure::check`](crate::Structure::check): `plan` computes the sizes for
    /// demands with the given growth.
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
        // Less headroom, or none, is better than no sizes.
        let mut percent = headroom;
        loop {
            match plan(Growth { percent }) {
                Err(_) if percent > 0 => percent /= 2,
                planned => return planned.map(Check::Grow),
            }
        }
    }
}

/// Growth of a pool beyond its demand, in percent of the demand.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    percent: u32,
}

impl Growth {
    /// Returns the number of elements for a pool with this demand and capacity: never less than the capacity.
    pub fn of(self, demand: u64, capacity: u64) -> u64 {
        if demand <= capacity {
            return capacity;
        }
        demand.saturating_add(demand.saturating_mul(self.percent.into()) / 100)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;

    #[test]
    fn headroom_is_halved_until_sizes_can_be_planned() {
        let with_room_for = |most: u32| {
            let tried = RefCell::new(Vec::new());
            let plan = |growth: Growth| {
                tried.borrow_mut().push(growth.percent);
                let limit = most.into();
                let too_large =
                    AdsError::PoolTooLarge { structure: "s", pool: "p", elements: limit + 1, limit };
                if growth.percent > most { Err(too_large) } else { Ok(Sizes::default()) }
            };
            let checked = BuildStatus::default().check(50, plan);
            (checked.is_ok(), tried.take())
        };
        assert_eq!(with_room_for(50), (true, vec![50]));
        assert_eq!(with_room_for(20), (true, vec![50, 25, 12]));
        assert_eq!(with_room_for(0), (true, vec![50, 25, 12, 6, 3, 1, 0]));
    }

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
