//! Builds a grid in a plain ash program with its own device, on a queue that only computes, traces it, and
//! compares its hits with those of brute force.

use rasray_ads::BruteForce;
use rasray_gpu::Device;
use rasray_grid::{Config, Grid};

#[path = "../../ads/examples/host/mod.rs"]
mod host;

use host::hits::hits;
use host::{Host, Result, staircase};

/// Runs the program; returns an error where hits differ or the validation layer complains.
pub fn main() -> Result<()> {
    let config = Config::new();
    let enabled = Grid::requirements_of(&config).required;
    let host = Host::new(&enabled)?;
    // SAFETY: the host made the device with these features, and the host is dropped last.
    let device = unsafe { Device::from_raw(host.raw_device(&enabled)) }?;
    let mesh = staircase(500);
    let geometry = host.geometry(&device, &mesh, host.buffer(&mesh.positions)?)?;
    let found = hits(&host, &device, &mut Grid::new(&device, config, &geometry, None)?)?;
    let expected = hits(&host, &device, &mut BruteForce::new(&device, &geometry, None, false)?)?;
    host.compare(&found, &expected)
}
