//! The structure of a job that names none: the one that is exact and fastest for it, as measured in
//! docs/measurements/speed.md.

use rasray_options::OptionValues;
use rasray_systems::{Preset, System};

use crate::error::ExperimentError;
use crate::selection::one_system;
use crate::system_config::SystemConfig;

/// Exact systems, the one first that traces fastest.
const CANDIDATES: [&str; 2] = ["bvh", "bricks"];

/// Why the first of them is taken.
const FASTEST: &str = "the fastest exact structure";

/// Rays per triangle and build from which a tree by surface area repays its build, where each frame builds
/// one.
const RAYS_PER_TRIANGLE: u64 = 1000;

/// A system that is named, or left to the job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SystemRequest {
    /// The fastest exact one for the job.
    Automatic,
    /// This one.
    Named(&'static System),
}

impl SystemRequest {
    /// The word of [`SystemRequest::Automatic`].
    pub const AUTOMATIC: &str = "auto";

    /// The system with a preset and options. Where it is left to the job, the fastest one that has all of
    /// them, and the reason with it ([`SystemConfig::chosen`]).
    ///
    /// # Errors
    /// As of [`one_system`].
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
    /// Fits a structure that the job chose to frames, each of which builds it for so many rays at most: a
    /// tree whose build is quick, unless there are so many rays that they repay a better one. The device has
    /// no say, so that shares of a job are alike.
    #[must_use]
    pub fn rebuilt_for(mut self, rays: u64, triangles: u64) -> Self {
        let is_free = self.chosen.is_some()
            && ["builder", "leaf", "children"].iter().all(|o| self.options.get(o).is_none());
        if is_free && is_fastest(self.system) {
            let limit = format!("{RAYS_PER_TRIANGLE} rays per triangle");
            let reason = if rays < RAYS_PER_TRIANGLE.saturating_mul(triangles) {
                self.options.set("builder", "ploc");
                format!("a tree built on the device, for frames of fewer than {limit}")
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
        assert_eq!(builder(free.clone().rebuilt_for(999_999, 1000)).as_deref(), Some("ploc"));
        assert_eq!(builder(free.clone().rebuilt_for(1_000_000, 1000)), None);
        assert_eq!(builder(free.rebuilt_for(u64::MAX, u64::MAX)), None);
        let given = chosen(&OptionValues::default().with("builder", "sah"));
        assert_eq!(builder(given.rebuilt_for(1, 1000)).as_deref(), Some("sah"));
        let bricks = chosen(&OptionValues::default().with("corners", "on"));
        assert_eq!(builder(bricks.rebuilt_for(1, 1000)), None);
    }
}
