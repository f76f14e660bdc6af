use rasray_ads::{Geometry, Hit, Ray, Structure, StructureKind};
use rasray_systems::{Preset, SYSTEMS, Spec, System};

use crate::harness::{Bench, is_offered};
use crate::shapes::Triangle;
use crate::tier::{in_turn, is_full};

/// Row: a system, a preset, and options that override it, by name and value.
pub type Row = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

/// Number of cells along a side of views.
const CELLS: &str = "24";

/// Options of presets in addition to the number of cells and to the options that avoid the need for a scene.
const BESIDE: &[Row] = &[
    ("mmrt", "robust", &[("capacity", "40000")]),
    ("mmrt", "published", &[("capacity", "40000")]),
    ("selective", "robust", &[("grid", "12"), ("storage", "paged")]),
];

/// Presets with options that make another structure, or a structure in which other options decide.
const MORE: &[Row] = &[
    ("bricks", "robust", &[("views", "cube"), ("grid", "24")]),
    ("mmrt", "robust", &[("coverage", "exact"), ("resolution", "24"), ("capacity", "40000")]),
];

/// More such presets, in the full tier only.
const LARGE: &[Row] = &[
    ("ldc", "robust", &[("accept", "plane"), ("resolution", "16")]),
    ("hu", "robust", &[("coverage", "exact"), ("resolution", "16")]),
    ("mmrt", "robust", &[("single-layer", "on"), ("resolution", "24"), ("capacity", "40000")]),
    ("mmrt", "robust", &[("payload", "plane"), ("resolution", "24"), ("capacity", "40000")]),
];

/// Returns the rows in addition to the presets of the registry.
fn more() -> impl Iterator<Item = &'static Row> {
    MORE.iter().chain(if is_full() { LARGE } else { &[] })
}

/// Subject: a preset of a system with its options for tests.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Specification of the structure.
    pub spec: Spec,
    /// Kind of the structure's hits.
    pub kind: StructureKind,
}

/// Answers to all rays, bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// Bits of t, of the primitive, and of the barycentrics if hits are on triangles.
    pub closest: Vec<[u32; 4]>,
    /// Flags of the rays, true for each ray that hits anything.
    pub occluded: Vec<bool>,
}

impl Subject {
    /// Returns every preset of every system of the registry, and presets with options that make another
    /// structure of them. Subjects that the device of the tests cannot have are left out, which is reported.
    ///
    /// # Panics
    /// If a name is not that of a preset.
    pub fn all() -> Vec<Self> {
        let presets =
            SYSTEMS.iter().flat_map(|system| system.presets.iter().map(move |preset| (system, preset)));
        let presets = presets.map(|(system, preset)| {
            let size = system.size_option().map(|option| (option, CELLS));
            let scene = if *preset == Preset::Published { system.without_scene } else { &[] };
            let own = BESIDE.iter().find(|row| row.0 == system.name && row.1 == preset.name());
            let own = own.map_or(&[][..], |row| row.2);
            let given = size.into_iter().chain(scene.iter().copied()).chain(own.iter().copied());
            (system.name, preset.name(), given.collect::<Vec<_>>())
        });
        let more = more().map(|(system, preset, given)| (*system, *preset, given.to_vec()));
        presets
            .chain(more)
            .map(|(system, preset, given)| {
                let options = given.iter().map(|(option, value)| ((*option).to_owned(), (*value).to_owned()));
                let spec = Spec::new(system, preset, options).expect("the options are the system's");
                let kind = spec.kind().expect("the options are valid");
                Self { spec, kind }
            })
            .filter(|subject| is_offered(&subject.spec))
            .collect()
    }

    /// Returns subjects as [`all`](Self::all), but in the quick tier one of each system, by turns: for tests
    /// whose kernels no other test has.
    pub fn by_turns() -> Vec<Self> {
        let all = Self::all();
        let of_system = |system: &System| {
            let own = all.iter().filter(|subject| subject.spec.system().name == system.name);
            own.cloned().collect::<Vec<_>>()
        };
        let own: Vec<_> = SYSTEMS.iter().map(of_system).filter(|own| !own.is_empty()).collect();
        own.iter().enumerate().flat_map(|(turn, own)| in_turn(own, turn).to_vec()).collect()
    }

    /// Returns `system preset`, with the options that distinguish it from others of that name.
    pub fn name(&self) -> String {
        let (system, preset) = (self.spec.system().name, self.spec.preset().name());
        let given = |(_, _, options): &&Row| {
            options.iter().all(|(name, value)| self.spec.options().text(name).as_deref() == Some(*value))
        };
        let more = more().filter(|row| row.0 == system && row.1 == preset).find(given);
        more.map_or_else(
            || format!("{system} {preset}"),
            |(_, _, options)| format!("{system} {preset} with {}={}", options[0].0, options[0].1),
        )
    }

    /// Returns this subject with other values of options; `None` if the system does not accept them.
    pub fn with(&self, options: &[(&str, &str)]) -> Option<Self> {
        let given = options.iter().map(|(option, value)| ((*option).to_owned(), (*value).to_owned()));
        let spec = self.spec.with_options(given).ok()?;
        Some(Self { spec, kind: self.kind })
    }

    /// Builds and traces.
    ///
    /// # Panics
    /// If the device fails, rays do not finish, or the build finds its own lists corrupted.
    pub fn answers(&self, bench: &Bench, eye: [f32; 3], triangles: &[Triangle], rays: &[Ray]) -> Answers {
        let mut structure = self.structure(bench, &bench.geometry(triangles));
        self.answers_of(bench, eye, structure.as_mut(), rays)
    }

    /// Makes the structure over a geometry, without a build.
    ///
    /// # Panics
    /// If the device fails.
    pub fn structure(&self, bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
        self.spec.create(bench.device(), geometry, None).expect("the options are valid")
    }

    /// Builds and traces a structure that was made from the subject.
    ///
    /// # Panics
    /// As [`Subject::answers`].
    pub fn answers_of(
        &self,
        bench: &Bench,
        eye: [f32; 3],
        structure: &mut dyn Structure,
        rays: &[Ray],
    ) -> Answers {
        let closest = bench.build_and_trace(structure, eye, rays);
        let occluded = bench.occluded(structure, rays);
        assert_eq!(structure.status(0).expect("the status is readable").corrupted, 0, "{}", self.name());
        let key = |hit: &Hit| match self.kind {
            StructureKind::Primitive | StructureKind::LossyPrimitive => {
                [hit.t.to_bits(), hit.primitive, hit.a.to_bits(), hit.b.to_bits()]
            }
            // The barycentrics a and b tell the place of a fragment, which is not part of the answer.
            StructureKind::Fragment => [hit.t.to_bits(), hit.primitive, 0, 0],
        };
        Answers { closest: closest.iter().map(key).collect(), occluded }
    }
}

/// Returns the index of the first ray whose answers differ.
pub fn first_difference(left: &Answers, right: &Answers) -> Option<usize> {
    assert_eq!((left.closest.len(), left.occluded.len()), (right.closest.len(), right.occluded.len()));
    let closest = left.closest.iter().zip(&right.closest).position(|(left, right)| left != right);
    let occluded = left.occluded.iter().zip(&right.occluded).position(|(left, right)| left != right);
    closest.into_iter().chain(occluded).min()
}
