//! Automatic choice of the structure for a job that names none: the exact one that is fastest for the job, as
//! measured in docs/measurements/speed.md.

use rasray_options::OptionValues;
use rasray_systems::{Preset, System};

use crate::error::ExperimentError;
use crate::selection::one_system;
use crate::system_config::SystemConfig;

/// Exact systems that may be chosen, in order: the fastest to trace comes first.
const CANDIDATES: [&str; 2] = ["bvh", "bricks"];

/// Reason for the choice of the first candidate.
const FASTEST: &str = "the fastest exact structure";

/// Number of rays per triangle and build at which a tree by surface area repays its build, where each frame
/// builds one.
const RAYS_PER_TRIANGLE: u64 = 1000;

/// System that is named by the user, or left to the job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SystemRequest {
    /// The fastest exact system for the job.
    Automatic,
    /// The system with this name.
    Named(&'static System),
}

impl SystemRequest {
    /// Word on the command line for [`SystemRequest::Automatic`].
    pub const AUTOMATIC: &str = "auto";

    /// Makes the configuration of the system with a preset and options. If the choice is left to the job, it
    /// is the fastest system that has all of these options, and the configuration holds the reason
    /// ([`SystemConfig::chosen`]).
    ///
    /// # Errors
    /// As for [`one_system`].
    pub fn config(self, preset: Preset, options: &OptionValues) -> Result<SystemConfig, ExperimentError> {
        let system = match self {
            Self::Named(system) => return one_system(system, preset, options),
            Self::Automatic => {
                let candidates = || CANDIDATES.iter().filter_map(|name| System::named(name));
                let suits = |system: &&'static System| {
                    system.presets.contains(&preset) && options.iter().all(|(option, _)| system.has(option))
                };
                candidates().find(suits).or_else(|| candidates().next()).expect("candidates are registered")
            }
        };
        let mut config = one_system(system, preset, options)?;
        let with = if is_fastest(system) { "" } else { " with these options" };
        config.chosen = Some(format!("{FASTEST}{with}"));
        Ok(config)
    }
}

fn is_fastest(system: &System) -> bool {
    system.name == CANDIDATES[0]
}

impl SystemConfig {
    /// Adapts a structure that the job chose to frames, each of which builds it for at most `rays` rays: a
    /// tree that later frames keep while it stays good, or with many rays per triangle the tree that is the
    /// fastest to trace. The choice does not depend on the device, so that all shares of a job agree.
    #[must_use]
    pub fn rebuilt_for(mut self, rays: u64, triangles: u64) -> Self {
        let is_free = self.chosen.is_some()
            && ["builder", "leaf", "children"].iter().all(|o| self.options.get(o).is_none());
        if is_free && is_fastest(self.system) {
            let limit = format!("{RAYS_PER_TRIANGLE} rays per triangle");
            let reason = if rays < RAYS_PER_TRIANGLE.saturating_mul(triangles) {
                self.options.set("builder", "refit");
                format!(
                    "a tree of the device that is kept while it stays good, for frames of fewer than {limit}"
                )
            } else {
                format!("frames of {limit} and more repay a tree by surface area")
            };
            self.chosen = Some(format!("{FASTEST}; {reason}"));
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(options: &OptionValues) -> SystemConfig {
        SystemRequest::Automatic.config(Preset::Robust, options).expect("an exact system has them")
    }

    #[test]
    fn the_fastest_that_has_the_options_is_taken() {
        let of = |option: &'static str, word: &'static str| OptionValues::default().with(option, word);
        for (options, system) in
            [(OptionValues::default(), "bvh"), (of("builder", "sah"), "bvh"), (of("corners", "on"), "bricks")]
        {
            let config = chosen(&options);
            assert_eq!((config.system.name, &config.options), (system, &options));
            assert!(config.chosen.is_some());
        }
        let error = SystemRequest::Automatic
            .config(Preset::Robust, &of("storage", "dll"))
            .expect_err("no exact one has it");
        assert!(error.to_string().contains("storage"), "{error}");
        SystemRequest::Automatic
            .config(Preset::Published, &OptionValues::default())
            .expect_err("no paper's preset is exact");
        let named = System::named("hu").expect("registered");
        let config = SystemRequest::Named(named)
            .config(Preset::Published, &OptionValues::default())
            .expect("it has it");
        assert_eq!((config.system.name, config.chosen), ("hu", None));
    }

    #[test]
    fn frames_of_few_rays_build_quickly() {
        let builder = |config: SystemConfig| config.options.text("builder");
        let free = chosen(&OptionValues::default());
        assert_eq!(builder(free.clone()), None);
        assert_eq!(builder(free.clone().rebuilt_for(999_999, 1000)).as_deref(), Some("refit"));
        assert_eq!(builder(free.clone().rebuilt_for(1_000_000, 1000)), None);
        assert_eq!(builder(free.clone().rebuilt_for(u64::MAX, u64::MAX)), None);
        assert_eq!(builder(free.clone().rebuilt_for(100, 1000)).as_deref(), Some("refit"));
        assert_eq!(builder(free.rebuilt_for(0, 1000)).as_deref(), Some("refit"));
        let given = chosen(&OptionValues::default().with("builder", "sah"));
        assert_eq!(builder(given.rebuilt_for(1, 1000)).as_deref(), Some("sah"));
        let bricks = chosen(&OptionValues::default().with("corners", "on"));
        assert_eq!(builder(bricks.rebuilt_for(1, 1000)), None);
    }
}
