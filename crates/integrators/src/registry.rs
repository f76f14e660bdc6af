//! The registry: every integrator, found by name, and one with its options. This is all that names an
//! integrator outside of its own file.

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

/// Every integrator; the first is the default.
pub static INTEGRATORS: &[IntegratorRow] = &[
    path::ROW,
    whitted::ROW,
    photons::ROW,
    cube_map::ROW,
    ambient_occlusion::ROW,
    raycast::ROW,
    layers::ROW,
];

/// Why a ray is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the eye; may be answered by drawing ([`Visibility`](crate::Visibility)).
    Camera,
    /// From a surface, to its nearest hit.
    Scattered,
    /// From a surface, to what occludes something.
    Shadow,
}

impl RayKind {
    /// Its name on pages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Scattered => "scattered",
            Self::Shadow => "shadow",
        }
    }
}

/// A row of the registry. Everything that is known of an integrator by name is here and in its own file; the
/// naive one of `rasray_reference::integrators` has the same name.
#[derive(Clone, Copy)]
pub struct IntegratorRow {
    /// Name, on the command line and in reports.
    pub name: &'static str,
    /// Description, one line of help without a full stop.
    pub doc: &'static str,
    /// Options that it has, in the order of help.
    pub options: &'static [&'static OptionRow],
    /// Rays that it traces.
    pub rays: &'static [RayKind],
    /// Data of a scene that it looks at.
    workload: fn(&IntegratorSpec) -> Workload,
    /// Makes it.
    make: Make,
}

/// Makes an integrator with its options.
type Make = fn(&IntegratorDesc<'_>, &IntegratorSpec) -> Result<Box<dyn Integrator>, IntegratorError>;

impl IntegratorRow {
    /// The integrator of that name.
    pub fn named(name: &str) -> Option<&'static Self> {
        INTEGRATORS.iter().find(|row| row.name == name)
    }

    /// The option of that name, where it has it.
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

/// Every option that an integrator has, each once.
pub fn integrator_options() -> Vec<&'static OptionRow> {
    let mut rows: Vec<&OptionRow> = Vec::new();
    for row in INTEGRATORS.iter().flat_map(|integrator| integrator.options) {
        if rows.iter().all(|known| known.name != row.name) {
            rows.push(row);
        }
    }
    rows
}

/// An integrator with its options.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegratorSpec {
    row: &'static IntegratorRow,
    /// Values that are not the default.
    options: OptionValues,
}

impl From<&'static IntegratorRow> for IntegratorSpec {
    /// With every option at its default.
    fn from(row: &'static IntegratorRow) -> Self {
        Self { row, options: OptionValues::default() }
    }
}

impl IntegratorSpec {
    /// An integrator with options over its defaults.
    ///
    /// # Errors
    /// An option or a value that it does not have.
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
    /// As [`IntegratorSpec::new`].
    pub fn with(&self, option: &'static str, value: impl Into<Value>) -> Result<Self, IntegratorError> {
        Self::new(self.row, &self.options.clone().with(option, value))
    }

    /// The registry's row.
    pub fn row(&self) -> &'static IntegratorRow {
        self.row
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.row.name
    }

    /// Options whose values are not the default.
    pub fn options(&self) -> &OptionValues {
        &self.options
    }

    /// The value of an option, given or by default; absent where it has none or the integrator lacks the
    /// option.
    pub fn get(&self, option: &str) -> Option<Value> {
        self.options.get(option).or_else(|| self.row.option(option)?.default)
    }

    /// The value of every option that has one.
    pub fn values(&self) -> OptionValues {
        self.row.options.iter().filter_map(|row| Some((row.name, self.get(row.name)?))).collect()
    }

    /// The one of these that the value of an option names; the first where it names none.
    fn choice<T: Copy + Default>(&self, option: &OptionRow, all: &[T], name: fn(T) -> &'static str) -> T {
        let word = self.get(option.name).and_then(Value::word);
        all.iter().copied().find(|value| Some(name(*value)) == word).unwrap_or_default()
    }

    /// Data of a scene that it looks at.
    pub fn workload(&self) -> Workload {
        (self.row.workload)(self)
    }

    /// Makes the integrator.
    ///
    /// # Errors
    /// Sizes that do not fit, out of memory, or the device refuses a pipeline.
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
