use rasray_ads::StructureKind;

/// What an option may do to hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// No value changes a bit of any hit.
    Same,
    /// Values change hits, by the structure's law.
    MayChange,
    /// It says how much room there is, not what is stored: too little is grown, so no hit changes.
    Room,
}

/// An option with the values that tests try; a system is tried with those that it takes.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    /// Name on the command line.
    pub option: &'static str,
    /// For structures that find triangles.
    pub primitive: Value,
    /// For structures that store fragments.
    pub fragment: Value,
    /// What is tried.
    pub values: &'static [&'static str],
}

const fn same(option: &'static str, values: &'static [&'static str]) -> Law {
    Law { option, primitive: Value::Same, fragment: Value::Same, values }
}

const fn same_for_primitives(option: &'static str, values: &'static [&'static str]) -> Law {
    Law { option, primitive: Value::Same, fragment: Value::MayChange, values }
}

/// Every option of every system.
pub const LAWS: &[Law] = &[
    same("addressing", &["descriptor", "address"]),
    same("builder", &["raster", "binning", "sah", "lbvh"]),
    same("block", &["1", "4", "64"]),
    same("buckets", &["1", "2", "8", "32"]),
    same("corners", &["on", "off"]),
    same("inline", &["on", "off"]),
    same("leaf", &["1", "16"]),
    same("build", &["single", "peel"]),
    same("layers", &["256", "1024"]),
    same("levels", &["1", "2"]),
    same("occupancy", &["bounds", "slices"]),
    same("page", &["1", "2", "4", "8"]),
    same("skip", &["on", "off"]),
    same("sort", &["on", "off"]),
    same("storage", &["ll", "dll", "llb", "dllb", "sb", "paged", "lists", "bricks"]),
    same_for_primitives("coverage", &["exact", "hardware", "conservative"]),
    same_for_primitives("grid", &["8", "24"]),
    same_for_primitives("camera-resolution", &["12", "37"]),
    same_for_primitives("resolution", &["12", "37"]),
    same_for_primitives("slices", &["8", "64"]),
    same_for_primitives("tile", &["1", "2", "4", "8"]),
    same_for_primitives("axes", &["all", "voxel", "triangle"]),
    same_for_primitives("views", &["cube", "cube+camera", "camera", "axes"]),
    // What decides whether a fragment is a hit, or what it stands for.
    Law {
        option: "accept",
        primitive: Value::MayChange,
        fragment: Value::MayChange,
        values: &["interval", "slope", "plane", "parity"],
    },
    Law { option: "depth", primitive: Value::MayChange, fragment: Value::MayChange, values: &["16", "32"] },
    Law {
        option: "march",
        primitive: Value::MayChange,
        fragment: Value::MayChange,
        values: &["samples", "dda", "exact"],
    },
    Law { option: "payload", primitive: Value::Same, fragment: Value::MayChange, values: &["index"] },
    Law { option: "samples", primitive: Value::MayChange, fragment: Value::MayChange, values: &["5"] },
    Law { option: "thickness", primitive: Value::MayChange, fragment: Value::MayChange, values: &["0.5"] },
    Law { option: "tolerance", primitive: Value::MayChange, fragment: Value::MayChange, values: &["0.01"] },
    Law { option: "capacity", primitive: Value::Room, fragment: Value::Room, values: &["0", "1", "1000"] },
];

/// The row of an option.
pub fn law(option: &str) -> Option<&'static Law> {
    LAWS.iter().find(|law| law.option == option)
}

impl Law {
    /// What the option may do to hits of a kind of structure.
    pub fn of(&self, kind: StructureKind) -> Value {
        match kind {
            StructureKind::Primitive => self.primitive,
            StructureKind::Fragment => self.fragment,
        }
    }
}
