//! Access to the pools of structures from the host, for tests and tools.

use rasray_gpu::{Device, GpuError};

use crate::{AdsError, ListCounts};

/// A structure whose pools can be read and written from the host
/// ([`Structure::inspect`](crate::Structure::inspect)). All functions submit and wait.
pub trait Inspect {
    /// Downloads the header and the pools as words, by name, the header first.
    ///
    /// # Errors
    /// The device failed, or the structure is in parts, each of which has its own pools.
    fn download_pools(&self, device: &Device) -> Result<Vec<(&'static str, Vec<u32>)>, GpuError>;

    /// Writes back pools that [`Inspect::download_pools`] returned, changed or not. Traces stay within their
    /// bounds whatever the pools other than the header contain.
    ///
    /// # Safety
    /// Capacities and addresses in the header are those that were downloaded from this structure since its
    /// last resize.
    ///
    /// # Errors
    /// A pool does not exist, a pool is larger than its allocation, the device failed, or the structure is in
    /// parts.
    unsafe fn upload_pools(
        &self,
        device: &Device,
        pools: &[(&'static str, Vec<u32>)],
    ) -> Result<(), GpuError>;

    /// Returns the first fault found in the lists or nodes on the device; absent if there is none.
    ///
    /// # Errors
    /// The device failed.
    fn fault(&self, device: &Device) -> Result<Option<String>, GpuError>;

    /// Returns the counts of the lists of its cells, view by view; empty if the structure has no lists.
    ///
    /// # Errors
    /// The device failed, or the lists are damaged: the last build is not complete.
    fn list_counts(&self, device: &Device) -> Result<Vec<ListCounts>, AdsError>;
}
