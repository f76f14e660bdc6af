//! Sizes of the pools that a structure allocates.

use rasray_shaders_glsl::constants::ads::PAGE_LIMIT;

use crate::AdsError;
use crate::kit::{HEADER_POOL, PoolName};

/// Size of one pool of a structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PoolSize {
    /// Name of the pool, as the structure's page uses it.
    pub name: &'static str,
    /// Capacity of the pool, in elements.
    pub elements: u64,
    /// Bytes of one element.
    pub element_bytes: u64,
}

impl PoolSize {
    /// Returns the bytes of all elements.
    pub fn bytes(&self) -> u64 {
        self.elements * self.element_bytes
    }
}

/// Sizes of the pools of a structure: the result of planning, which is plain arithmetic.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Sizes of all pools, in the structure's order.
    pub pools: Vec<PoolSize>,
}

impl Sizes {
    /// Returns the sizes of the pools of a structure: the header, then the other pools with their numbers of
    /// elements and the bytes of an element, in the order of their bindings.
    ///
    /// # Errors
    /// A pool has more words than 32-bit indices can address with one value reserved for "none" or "more".
    pub fn of<P: PoolName>(
        structure: &'static str,
        pools: impl IntoIterator<Item = (P, u64, u64)>,
    ) -> Result<Self, AdsError> {
        let header =
            PoolSize { name: HEADER_POOL, elements: 1, element_bytes: size_of::<P::Header>() as u64 };
        let named = |(pool, elements, element_bytes): (P, u64, u64)| PoolSize {
            name: pool.name(),
            elements,
            element_bytes,
        };
        let pools: Vec<_> = [header].into_iter().chain(pools.into_iter().map(named)).collect();
        // Words have numbers below the largest, which means "none" or "more".
        let limit = |pool: &PoolSize| u64::from(u32::MAX - 1) / pool.element_bytes.div_ceil(4).max(1);
        match pools.iter().find(|pool| pool.elements > limit(pool)) {
            Some(pool) => Err(AdsError::PoolTooLarge {
                structure,
                pool: pool.name,
                elements: pool.elements,
                limit: limit(pool),
            }),
            None => Ok(Self { pools }),
        }
    }

    /// Checks a pool of pages in these sizes, and returns the sizes. Pages have a lower limit than elements
    /// of other pools, because a link to a page also holds a mark.
    ///
    /// # Errors
    /// There are more pages than [`PAGE_LIMIT`].
    pub fn of_pages(self, structure: &'static str, pool: impl PoolName) -> Result<Self, AdsError> {
        let elements = self.elements_of(pool);
        let limit = PAGE_LIMIT.into();
        if elements > limit {
            return Err(AdsError::PoolTooLarge { structure, pool: pool.name(), elements, limit });
        }
        Ok(self)
    }

    /// Returns true if a pool is larger than the pool with the same name in `other`, or has none there.
    pub fn exceed(&self, other: &Self) -> bool {
        self.pools
            .iter()
            .any(|pool| other.elements(pool.name).is_none_or(|elements| pool.elements > elements))
    }

    /// Refuses sizes of other pools than these, which are those of `structure`.
    pub(crate) fn check_pools(&self, structure: &'static str, sizes: &Self) -> Result<(), AdsError> {
        let kinds = |sizes: &Self| -> Vec<_> {
            sizes.pools.iter().map(|pool| (pool.name, pool.element_bytes)).collect()
        };
        if kinds(self) == kinds(sizes) {
            return Ok(());
        }
        let names: Vec<&str> = self.pools.iter().map(|pool| pool.name).collect();
        Err(AdsError::OtherPools { structure, pools: names.join(", ") })
    }

    /// Returns the number of elements of a pool of the structure that these sizes are of; 0 if they are of
    /// another.
    pub fn elements_of(&self, pool: impl PoolName) -> u64 {
        self.elements(pool.name()).unwrap_or(0)
    }

    /// Returns the sum over all pools, bytes.
    pub fn bytes(&self) -> u64 {
        self.pools.iter().map(PoolSize::bytes).sum()
    }

    /// Returns the size of the pool with that name; absent if there is none.
    pub fn pool(&self, name: &str) -> Option<&PoolSize> {
        self.pools.iter().find(|pool| pool.name == name)
    }

    /// Returns the number of elements of the pool with that name; absent if there is none.
    pub fn elements(&self, name: &str) -> Option<u64> {
        self.pool(name).map(|pool| pool.elements)
    }
}
