//! Registry: all integrators by name, and the options of one. Only the registry and an integrator's own file
//! name the integrator.

use std::fmt;

use rasray_options::{OptionRow, OptionValues, Value};
use rasray_scene::needs::Workload;

use crate::{Integrator, IntegratorDesc, IntegratorError};

mod ambient_occlusion;
mod cube_map;
mod layers;
mod path;
mod photons;
mod raycast;
mod sample_map;
mod whitted;

pub use ambient_occlusion::AmbientOcclusion;
pub use cube_map::{CUBE_MAP_LIMIT, CubeMap, CubeMapOptions};
pub use layers::Layers;
pub use path::{BOUNCE_LIMIT, Fetching, GlassShadows, Path, PathOptions, SpecularLobe};
pub use photons::{PhotonKind, PhotonMap, PhotonOptions, Photons};
pub use raycast::Raycast;
pub use whitted::{RAY_DEPTH_LIMIT, Select, Shadows, Whitted, WhittedOptions};

/// All integrators; the first is the default.
pub static INTEGRATORS: &[IntegratorRow] = &[
    path::ROW,
    whitted::ROW,
    photons::ROW,
    cube_map::ROW,
    ambient_occlusion::ROW,
    raycast::ROW,
    layers::ROW,
];

/// Purpose of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// Ray from the eye; drawing may answer it ([`Visibility`](crate::Visibility)).
    Camera,
    /// Ray from a surface to its nearest hit.
    Scattered,
    /// Ray from a surface that tests for occlusion.
    Shadow,
}

impl RayKind {
    /// Name on pages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Scattered => "scattered",
            Self::Shadow => "shadow",
        }
    }
}

/// Row of the registry. This row and the integrator's own file hold all that is known of an integrator by
/// name; the naive one in `rasray_reference::integrators` has the same name.
#[derive(Clone, Copy)]
pub struct IntegratorRow {
    /// Name, on the command line and in reports.
    pub name: &'static str,
    /// Description: one line of help without a full stop.
    pub doc: &'static str,
    /// Options of the integrator, in the order of help.
    pub options: &'static [&'static OptionRow],
    /// Kinds of rays that the integrator traces.
    pub rays: &'static [RayKind],
    /// Data of a scene that the integrator observes.
    workload: fn(&IntegratorSpec) -> Workload,
    /// Function that makes the integrator.
    make: Make,
}

/// Function that makes an integrator with its options.
type Make = fn(&IntegratorDesc<'_>, &IntegratorSpec) -> Result<Box<dyn Integrator>, IntegratorError>;

impl IntegratorRow {
    /// Returns the integrator of that name.
    pub fn named(name: &str) -> Option<&'static Self> {
        INTEGRATORS.iter().find(|row| row.name == name)
    }

    /// Returns the option of that name, if the integrator has it.
    pub fn option(&self, name: &str) -> Option<&'static OptionRow> {
        self.options.iter().copied().find(|row| row.name == name)
    }
}

impl PartialEq for IntegratorRow {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for IntegratorRow {}

impl fmt::Debug for IntegratorRow {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name)
    }
}

/// Returns every option of any integrator, each once.
pub fn integrator_options() -> Vec<&'static OptionRow> {
    let mut rows: Vec<&OptionRow> = Vec::new();
    for row in INTEGRATORS.iter().flat_map(|integrator| integrator.options) {
        if rows.iter().all(|known| known.name != row.name) {
            rows.push(row);
        }
    }
    rows
}

/// Integrator with its options.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegratorSpec {
    row: &'static IntegratorRow,
    /// Option values that differ from the defaults.
    options: OptionValues,
}

impl From<&'static IntegratorRow> for IntegratorSpec {
    /// Returns the integrator with every option at its default.
    fn from(row: &'static IntegratorRow) -> Self {
        Self { row, options: OptionValues::default() }
    }
}

impl IntegratorSpec {
    /// Sets options of an integrator over its defaults.
    ///
    /// # Errors
    /// An error for an option or a value that the integrator does not have.
    pub fn new(row: &'static IntegratorRow, options: &OptionValues) -> Result<Self, IntegratorError> {
        let mut spec = Self::from(row);
        for (name, value) in options.iter() {
            let unknown = || IntegratorError::UnknownOption { integrator: row.name, option: name };
            let option = row.option(name).ok_or_else(unknown)?;
            let value = option.check(value)?;
            if option.default != Some(value) {
                spec.options.set(option.name, value);
            }
        }
        Ok(spec)
    }

    /// Adds a value for one more option.
    ///
    /// # Errors
    /// Errors of [`IntegratorSpec::new`].
    pub fn with(&self, option: &'static str, value: impl Into<Value>) -> Result<Self, IntegratorError> {
        Self::new(self.row, &self.options.clone().with(option, value))
    }

    /// Returns the row of the registry.
    pub fn row(&self) -> &'static IntegratorRow {
        self.row
    }

    /// Returns the name of the integrator.
    pub fn name(&self) -> &'static str {
        self.row.name
    }

    /// Returns the options whose values differ from the defaults.
    pub fn options(&self) -> &OptionValues {
        &self.options
    }

    /// Returns the value of an option, given or default; `None` if it has none or the integrator lacks the
    /// option.
    pub fn get(&self, option: &str) -> Option<Value> {
        self.options.get(option).or_else(|| self.row.option(option)?.default)
    }

    /// Returns the value of every option that has one.
    pub fn values(&self) -> OptionValues {
        self.row.options.iter().filter_map(|row| Some((row.name, self.get(row.name)?))).collect()
    }

    /// Returns the element of `all` that the value of an option names; the first if it names none.
    fn choice<T: Copy + Default>(&self, option: &OptionRow, all: &[T], name: fn(T) -> &'static str) -> T {
        let word = self.get(option.name).and_then(Value::word);
        all.iter().copied().find(|value| Some(name(*value)) == word).unwrap_or_default()
    }

    /// Returns the data of a scene that the integrator observes.
    pub fn workload(&self) -> Workload {
        (self.row.workload)(self)
    }

    /// Makes the integrator.
    ///
    /// # Errors
    /// An error for sizes that do not fit, out of memory, or if the device refuses a pipeline.
    pub fn make(&self, desc: &IntegratorDesc<'_>) -> Result<Box<dyn Integrator>, IntegratorError> {
        (self.row.make)(desc, self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_options_of_one_name_are_one_option() {
        for (place, row) in INTEGRATORS.iter().enumerate() {
            assert!(INTEGRATORS[..place].iter().all(|other| other.name != row.name), "{} twice", row.name);
            assert_eq!(row.rays.first(), Some(&RayKind::Camera), "{}", row.name);
            for option in row.options {
                let known = integrator_options().into_iter().find(|known| known.name == option.name);
                assert_eq!(known, Some(*option), "{}", row.name);
                assert!(!option.tried().is_empty(), "no value of --{} is tried", option.name);
                assert!(option.default.is_none_or(|value| option.check(value).is_ok()), "--{}", option.name);
            }
        }
    }

    #[test]
    fn every_value_that_is_tried_is_taken_and_one_that_is_the_default_is_as_none() {
        for row in INTEGRATORS {
            let plain = IntegratorSpec::from(row);
            for option in row.options {
                for text in option.tried() {
                    let value = option.parse(text).expect("a value that is tried");
                    let spec = plain.with(option.name, value).expect("an option that it has");
                    assert_eq!(spec.get(option.name), Some(value));
                    assert_eq!(spec == plain, option.default == Some(value), "--{} {text}", option.name);
                    assert_eq!(spec.values().get(option.name), Some(value));
                }
            }
        }
    }

    #[test]
    fn what_an_integrator_lacks_is_refused_by_name() {
        let ao = IntegratorSpec::from(IntegratorRow::named("ao").expect("registered"));
        let message =
            |result: Result<IntegratorSpec, IntegratorError>| result.expect_err("refused").to_string();
        assert!(message(ao.with("bounces", 2)).contains("bounces"));
        assert!(message(ao.with("ao-distance", 0.0)).contains("above 0"));
        assert!(message(ao.with("ao-distance", "far")).contains("ao-distance far"));
        assert!(IntegratorRow::named("radiosity").is_none());
    }
}
