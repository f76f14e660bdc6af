//! Row of the registry, and a system with everything that was chosen for it.

use rasray_ads::{Counters, Geometry, RecordLayout, SceneBinding, Structure, StructureKind};
use rasray_gpu::{Device, Feature, Requirements};
use rasray_options::{OptionRow, OptionValues, Value};

use crate::SystemsError;
use crate::options::{OPTIONS, option};
use crate::structure_option::{Group, StructureOption};

/// Version of a system, by how closely it follows its paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Preset {
    /// Structure of the paper with its errors repaired.
    Robust,
    /// Structure of the paper with its approximations.
    Published,
}

impl Preset {
    /// All presets.
    pub const ALL: [Self; 2] = [Self::Robust, Self::Published];

    /// Returns the preset with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// Returns the description for help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Robust => "The paper's structure with its errors repaired",
            Self::Published => "The paper's approximations included",
        }
    }

    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Robust => "robust",
            Self::Published => "published",
        }
    }
}

/// Frame with which a paper's pictures are made, and options of the structure that follow from the frame, in
/// words of the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PaperFrame {
    /// Name of the integrator.
    pub integrator: &'static str,
    /// Options of the integrator that differ from its defaults, as name and value.
    pub options: &'static [(&'static str, &'static str)],
    /// Source of first hits.
    pub primary: &'static str,
    /// Occluder of shadow rays.
    pub occluder: &'static str,
    /// Value of the published preset's `payload` for renders that ask for occlusion alone; `None` if the
    /// paper has no payload for them.
    pub occlusion_payload: Option<&'static str>,
    /// Value of `views` with a perspective camera, whose view then has one cell per pixel
    /// (`camera-resolution`): for the published preset, and for any preset from which first hits are taken.
    /// `None` if the paper draws no view of the camera.
    pub camera_views: Option<&'static str>,
}

impl PaperFrame {
    /// Returns the frame of an integrator with these options: first hits are drawn, shadow rays go through
    /// the structure, and no option of the structure follows from the frame.
    pub(crate) const fn of(
        integrator: &'static str,
        options: &'static [(&'static str, &'static str)],
    ) -> Self {
        let (primary, occluder) = ("raster", "structure");
        Self { integrator, options, primary, occluder, occlusion_payload: None, camera_views: None }
    }
}

/// Row of the registry: everything that is known of a system by name.
#[derive(Clone, Copy, Debug)]
pub struct System {
    /// Name on the command line.
    pub name: &'static str,
    /// Presets of the system.
    pub presets: &'static [Preset],
    /// Description for help.
    pub doc: &'static str,
    /// Frame for pictures of the published preset, if no integrator is asked for; `None` if no paper has
    /// pictures of the system.
    pub frame: Option<PaperFrame>,
    /// Options with which the published preset needs no scene. By default its fragments carry data of a
    /// scene's materials.
    pub without_scene: &'static [(&'static str, &'static str)],
    /// Name of the structure that the system traces.
    pub structure: &'static str,
    /// Records that the structure shares with its shaders, the header first.
    pub records: &'static [RecordLayout],
    /// Options over the robust preset with which a pool is larger than the 128 MiB that a binding of small
    /// devices holds, for any number of triangles. Empty if pools grow with the triangles alone.
    pub large_pools: &'static [(&'static str, &'static str)],
    /// Function that returns the names of the system's options.
    pub(crate) options: fn() -> Vec<&'static str>,
    /// Function that returns the required and optional features of a device for a spec. It also checks the
    /// values of the spec.
    pub(crate) requirements: fn(&Spec) -> Result<Requirements, SystemsError>,
    /// Function that returns the kind of the hits of a spec.
    pub(crate) kind: fn(&Spec) -> Result<StructureKind, SystemsError>,
    /// Function that makes the structure of a spec.
    pub(crate) create: Create,
}

impl PartialEq for System {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for System {}

impl System {
    /// Returns the system's options, in the order of help.
    pub fn options(&self) -> Vec<&'static StructureOption> {
        let names = (self.options)();
        OPTIONS.iter().filter(|option| names.contains(&option.row.name)).collect()
    }

    /// Returns the row of an option.
    ///
    /// # Errors
    /// The system has no such option.
    pub fn option(&self, name: &str) -> Result<&'static OptionRow, SystemsError> {
        let known = option(name).filter(|option| self.has(option.row.name)).map(|option| &option.row);
        known.ok_or_else(|| SystemsError::UnknownOption { system: self.name, option: name.to_owned() })
    }

    /// Reads options by name, and returns their values.
    ///
    /// # Errors
    /// An option or a value that the system does not have.
    pub(crate) fn read(
        &self,
        options: impl IntoIterator<Item = (String, String)>,
    ) -> Result<Vec<(&'static str, Value)>, SystemsError> {
        let read = |(name, text): (String, String)| {
            let row = self.option(&name)?;
            let value =
                row.parse(&text).map_err(|source| SystemsError::Value { system: self.name, source })?;
            Ok((row.name, value))
        };
        options.into_iter().map(read).collect()
    }

    /// Returns true if the system has an option.
    pub fn has(&self, option: &str) -> bool {
        (self.options)().contains(&option)
    }

    /// Returns the name of the option for the number of cells along a side, or `None` if the structure has no
    /// cells.
    pub fn size_option(&self) -> Option<&'static str> {
        self.options().into_iter().find(|option| option.group == Group::Size).map(|option| option.row.name)
    }
}

/// Function that makes the structure of a spec for triangles, with a scene if surfaces or alpha are wanted.
pub(crate) type Create =
    fn(&Spec, &Device, &Geometry, Option<&SceneBinding>) -> Result<Box<dyn Structure>, SystemsError>;

/// System with a preset and the options given over the preset.
#[derive(Clone, Debug)]
pub struct Spec {
    system: &'static System,
    preset: Preset,
    options: OptionValues,
    counters: Counters,
    work_budget: Option<u32>,
}

impl Spec {
    /// Returns a spec of a system with options, each of which the system must have.
    ///
    /// # Errors
    /// A preset, an option or a value that the system does not have.
    pub fn of(system: &'static System, preset: Preset, options: OptionValues) -> Result<Self, SystemsError> {
        if !system.presets.contains(&preset) {
            return Err(SystemsError::UnknownPreset {
                system: system.name,
                preset: preset.name().to_owned(),
            });
        }
        for (name, value) in options.iter() {
            let row = system.option(name)?;
            row.check(value).map_err(|source| SystemsError::Value { system: system.name, source })?;
        }
        let spec = Self { system, preset, options, counters: Counters::Off, work_budget: None };
        spec.requirements()?;
        Ok(spec)
    }

    /// Sets the detail in which rays record their work.
    #[must_use]
    pub fn with_counters(self, counters: impl Into<Counters>) -> Self {
        Self { counters: counters.into(), ..self }
    }

    /// Sets the units of work, 2 or more, that a ray may spend in a dispatch before it waits for the next.
    /// Changes no hit; rays that need more dispatches than they are given count as unfinished. Brute force
    /// keeps the default that all structures share.
    #[must_use]
    pub fn with_work_budget(self, units: u32) -> Self {
        Self { work_budget: Some(units), ..self }
    }

    /// Adds one more option over the preset.
    ///
    /// # Errors
    /// The system has no such option or value.
    pub fn with_option(&self, option: &str, value: &str) -> Result<Self, SystemsError> {
        self.with_options([(option.to_owned(), value.to_owned())])
    }

    /// Adds more options over the preset, and checks all at once, since some options are valid only with
    /// others.
    ///
    /// # Errors
    /// The system has no such option or value.
    pub fn with_options(
        &self,
        options: impl IntoIterator<Item = (String, String)>,
    ) -> Result<Self, SystemsError> {
        let given = self.options.iter().chain(self.system.read(options)?).collect();
        let spec = Self::of(self.system, self.preset, given)?;
        Ok(Self { counters: self.counters, work_budget: self.work_budget, ..spec })
    }

    /// Returns the row of the system.
    pub fn system(&self) -> &'static System {
        self.system
    }

    /// Returns the name of the structure that the system traces.
    pub fn structure(&self) -> &'static str {
        self.system.structure
    }

    /// Returns the preset.
    pub fn preset(&self) -> Preset {
        self.preset
    }

    /// Returns the options over the preset.
    pub fn options(&self) -> &OptionValues {
        &self.options
    }

    /// Returns the detail in which rays record their work.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// Returns the units of work that a ray may spend per dispatch, or `None` for the default that all
    /// structures share.
    pub fn work_budget(&self) -> Option<u32> {
        self.work_budget
    }

    /// Returns the required and optional features of a device.
    ///
    /// # Errors
    /// An option has an impossible value.
    pub fn requirements(&self) -> Result<Requirements, SystemsError> {
        (self.system.requirements)(self)
    }

    /// Returns the given option, as name and value, without which the structure would not require this
    /// feature of a device, or `None` if no single option is the reason.
    pub fn option_that_requires(&self, feature: Feature) -> Option<(&'static str, Value)> {
        self.options.iter().find(|(option, _)| {
            let others = self.options.iter().filter(|(other, _)| other != option).collect();
            let without = Self::of(self.system, self.preset, others).and_then(|spec| spec.requirements());
            without.is_ok_and(|requirements| !requirements.required.contains(&feature))
        })
    }

    /// Returns the kind of the structure's hits, without a device.
    ///
    /// # Errors
    /// An option has an impossible value.
    pub fn kind(&self) -> Result<StructureKind, SystemsError> {
        (self.system.kind)(self)
    }

    /// Makes the structure of this spec.
    ///
    /// # Errors
    /// An option has an impossible value, or the device refuses.
    pub fn create(
        &self,
        device: &Device,
        geometry: &Geometry,
        scene: Option<&SceneBinding>,
    ) -> Result<Box<dyn Structure>, SystemsError> {
        (self.system.create)(self, device, geometry, scene)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{SYSTEMS, dirt, hu, ldc, mmrt, selective};

    fn spec(system: &str, preset: &str, options: &[(&str, &str)]) -> Result<Spec, SystemsError> {
        Spec::new(
            system,
            preset,
            options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())),
        )
    }

    #[test]
    fn every_preset_of_every_system_resolves() {
        for system in SYSTEMS {
            for preset in system.presets {
                let spec = spec(system.name, preset.name(), &[]).expect("a registered preset");
                assert!(!spec.requirements().expect("valid").required.is_empty());
            }
        }
    }

    #[test]
    fn every_option_has_a_row_and_every_row_a_system() {
        for system in SYSTEMS {
            assert_eq!(system.options().len(), (system.options)().len(), "{}", system.name);
        }
        for (place, StructureOption { row, .. }) in OPTIONS.iter().enumerate() {
            assert!(SYSTEMS.iter().any(|system| system.has(row.name)), "no system has --{}", row.name);
            assert!(OPTIONS[..place].iter().all(|other| other.row.name != row.name), "--{} twice", row.name);
            assert!(!row.tried().is_empty(), "no value of --{} is tried", row.name);
        }
    }

    #[test]
    fn sizes_are_set_by_one_option() {
        for system in SYSTEMS {
            let size = ["resolution", "grid"].into_iter().find(|option| system.has(option));
            assert_eq!(system.size_option(), size, "{}", system.name);
            // Systems with cells have pools that grow with the number of cells.
            assert_eq!(size.is_some(), !system.large_pools.is_empty(), "{}", system.name);
        }
        let size = |name| System::named(name).and_then(System::size_option);
        assert_eq!(["mmrt", "bricks", "bvh"].map(size), [Some("resolution"), Some("grid"), None]);
    }

    #[test]
    fn published_has_the_papers_sizes() {
        // Number of cells along a side of a view, and of voxels along a side if the structure has voxels.
        let sizes = |spec: &Spec| match spec.system().name {
            "mmrt" => mmrt::config(spec).map(|config| (config.resolution, None)),
            "dirt" => dirt::config(spec).map(|config| (config.resolution, None)),
            "hu" => hu::config(spec).map(|config| (config.resolution, Some(config.grid()))),
            "selective" => selective::config(spec).map(|config| (config.resolution, Some(config.grid()))),
            "ldc" => ldc::config(spec).map(|config| (config.resolution, None)),
            other => panic!("{other}: a published preset whose sizes are not in this table"),
        };
        // The number of voxels follows a resolution that is not the paper's.
        let papers = [
            ("mmrt", (512, None), None),
            ("dirt", (512, None), None),
            ("hu", (1280, Some(64)), Some(39)),
            ("selective", (1024, Some(64)), Some(39)),
            ("ldc", (1024, None), None),
        ];
        let mut seen = Vec::new();
        for system in SYSTEMS.iter().filter(|system| system.presets.contains(&Preset::Published)) {
            let of = |options: &[(&str, &str)]| {
                let spec = spec(system.name, "published", options).expect("the options are valid");
                sizes(&spec).expect("the options are valid")
            };
            seen.push((system.name, of(&[]), of(&[("resolution", "512")])));
        }
        assert_eq!(seen, papers.map(|(name, paper, grid)| (name, paper, (512, grid))));
    }

    #[test]
    fn what_rays_record_and_spend_stays_with_more_options() {
        let given = spec("mmrt", "robust", &[("resolution", "24")]).expect("it is valid");
        let given = given.with_counters(Counters::PerRay).with_work_budget(40);
        let more = given.with_option("buckets", "2").expect("it is valid");
        assert_eq!((more.counters(), more.work_budget()), (Counters::PerRay, Some(40)));
        assert_eq!(more.options().len(), 2);
    }

    #[test]
    fn an_option_is_named_that_requires_a_feature() {
        let given = [("tile", "1"), ("coverage", "conservative-extension")];
        let named = |preset, feature| {
            let spec = spec("dirt", preset, &given).expect("the options are valid");
            assert!(
                spec.requirements().expect("the options are valid").required.contains(&feature),
                "{feature}"
            );
            spec.option_that_requires(feature).map(|(option, value)| format!("{option} {value}"))
        };
        for preset in ["robust", "published"] {
            let extension = named(preset, Feature::ConservativeRasterization);
            assert_eq!(extension.as_deref(), Some("coverage conservative-extension"));
        }
        // The robust preset draws only with some coverages, the published preset with all.
        let drawing = named("robust", Feature::FragmentStoresAndAtomics);
        assert_eq!(drawing.as_deref(), Some("coverage conservative-extension"));
        assert_eq!(named("published", Feature::FragmentStoresAndAtomics), None);
    }

    #[test]
    fn what_is_not_registered_is_refused_by_name() {
        let message = |result: Result<Spec, SystemsError>| result.expect_err("refused").to_string();
        let known = message(spec("nobody", "robust", &[]));
        assert!(SYSTEMS.iter().all(|system| known.contains(system.name)), "{known}");
        assert!(message(spec("brute-force", "published", &[])).contains("no preset"));
        assert!(message(spec("mmrt", "robust", &[("colour", "red")])).contains("colour"));
        assert!(
            message(spec("mmrt", "robust", &[("storage", "heap")])).contains("ll, dll, llb, dllb, sb, paged")
        );
        assert!(message(spec("mmrt", "robust", &[("buckets", "many")])).contains("buckets"));
        assert!(message(spec("mmrt", "published", &[("accept", "plane")])).contains("payload"));
    }
}
