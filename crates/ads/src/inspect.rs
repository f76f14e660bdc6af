//! Pools of structures on the host, for tests and tools.

use rasray_gpu::{Device, GpuError};

use crate::{AdsError, ListCounts};

/// A structure whose pools can be read and written from the host
/// ([`Structure::inspect`](crate::Structure::inspect)). Everything here submits and waits.
pub trait Inspect {
    /// Header and pools as words, by name, the header first.
    ///
    /// # Errors
    /// The device failed, or it is a structure in parts, whose pools are those of its parts.
    fn download_pools(&self, device: &Device) -> Result<Vec<(&'static str, Vec<u32>)>, GpuError>;

    /// Writes back pools that [`Inspect::download_pools`] returned, changed or not. Traces end within their
    /// bounds whatever the pools behind the header say.
    ///
    /// # Safety
    /// Capacities and addresses in the header are those that were downloaded from this structure since its
    /// last resize.
    ///
    /// # Errors
    /// There is no such pool, one is larger than what was allocated, the device failed, or it is a structure
    /// in parts.
    unsafe fn upload_pools(
        &self,
        device: &Device,
        pools: &[(&'static str, Vec<u32>)],
    ) -> Result<(), GpuError>;

    /// The first fault that is found in the lists or nodes on the device; absent where they are whole.
    ///
    /// # Errors
    /// The device failed.
    fn fault(&self, device: &Device) -> Result<Option<String>, GpuError>;

    /// Counts of the lists of its cells, view by view; empty where it has no lists.
    ///
    /// # Errors
    /// The device failed, or the lists are damaged: the last build is not complete.
    fn list_counts(&self, device: &Device) -> Result<Vec<ListCounts>, AdsError>;
}
