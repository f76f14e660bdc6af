//! Sizes of the pools: plain arithmetic, no device.

use rasray_ads::{AdsError, Sizes};
use rasray_gpu::DRIVER_BOX_BYTES;

use crate::{Config, Pool};

/// The demand of a build.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Triangles of the geometry: a box each.
    pub triangles: u64,
}

/// Sizes of the pools for boxes of `demand`. Memory of the tree itself is for the driver to say.
///
/// # Errors
/// An option is out of range, or there are more boxes than 32-bit indices can address.
pub fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
    config.validate()?;
    Sizes::of("driver", [(Pool::Boxes, demand.triangles, DRIVER_BOX_BYTES)])
}

/// The page's formula for header and boxes. It shares nothing with [`plan`], so that the two check each
/// other.
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
