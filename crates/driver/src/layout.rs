//! Sizes of the pools, by plain arithmetic without a device.

use rasray_ads::{AdsError, Sizes};
use rasray_gpu::DRIVER_BOX_BYTES;

use crate::{Config, Pool};

/// Demand of a build: the number of elements that it needs in the pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Number of triangles of the geometry, with one box each.
    pub triangles: u64,
}

/// Returns the sizes of the pools for the boxes of `demand`. Only the driver knows the memory of the tree
/// itself.
///
/// # Errors
/// An option is out of range, or there are more boxes than 32-bit indices can address.
pub fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
    config.validate()?;
    Sizes::of("driver", [(Pool::Boxes, demand.triangles, DRIVER_BOX_BYTES)])
}

/// Computes the bytes of the header and the boxes by the formula of `docs/systems/driver-rt.md`. It shares no
/// code with [`plan`], so that the two check each other.
pub fn formula_bytes(demand: &Demand) -> u64 {
    88 + 24 * demand.triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_equals_formula() {
        for triangles in [0, 1, 12_345] {
            let demand = Demand { triangles };
            let sizes = plan(&Config::new(), &demand).expect("options are in range");
            assert_eq!(sizes.bytes(), formula_bytes(&demand));
        }
    }

    #[test]
    fn out_of_range_options_are_named() {
        let message = |config: &Config, triangles| {
            plan(config, &Demand { triangles }).expect_err("it is refused").to_string()
        };
        let idle = Config { work_budget: Some(0), ..Config::new() };
        assert!(message(&idle, 1).contains("work budget is 0"));
        assert!(message(&Config::new(), 1 << 32).contains("boxes"));
    }
}
