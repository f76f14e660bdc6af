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
    /// For those that find triangles by rules that lose some.
    pub lossy: Value,
    /// For structures that store fragments.
    pub fragment: Value,
    /// What is tried.
    pub values: &'static [&'static str],
}

const fn same(option: &'static str, values: &'static [&'static str]) -> Law {
    Law { option, primitive: Value::Same, lossy: Value::Same, fragment: Value::Same, values }
}

/// What decides how a ray meets lists matters where rules lose hits.
const fn same_without_loss(option: &'static str, values: &'static [&'static str]) -> Law {
    Law { lossy: Value::MayChange, ..same(option, values) }
}

const fn same_for_primitives(option: &'static str, values: &'static [&'static str]) -> Law {
    Law { fragment: Value::MayChange, ..same_without_loss(option, values) }
}

const fn may_change(option: &'static str, values: &'static [&'static str]) -> Law {
    Law { primitive: Value::MayChange, ..same_for_primitives(option, values) }
}

/// Every option of every system.
pub const LAWS: &[Law] = &[
    same("addressing", &["descriptor", "address"]),
    same("builder", &["raster", "binning", "sah", "lbvh"]),
    same("block", &["1", "4", "64"]),
    same_without_loss("buckets", &["1", "2", "8", "12", "32", "64"]),
    same("corners", &["on", "off"]),
    same("inline", &["on", "off"]),
    same("leaf", &["1", "16"]),
    same("build", &["single", "peel"]),
    same("layers", &["256", "1024"]),
    same("levels", &["1", "2"]),
    same("occupancy", &["bounds", "slices"]),
    same("page", &["1", "2", "4", "8"]),
    same_without_loss("centre", &["eye", "scene"]),
    same_without_loss("pyramid", &["on", "off"]),
    same_without_loss("skip", &["on", "off"]),
    same("sort", &["on", "off"]),
    same("storage", &["ll", "dll", "llb", "dllb", "sb", "paged", "bricks"]),
    same_for_primitives("grid", &["8", "24"]),
    same_for_primitives("camera-resolution", &["12", "37"]),
    same_for_primitives("resolution", &["12", "37"]),
    same_for_primitives("slices", &["8", "64"]),
    same_for_primitives("tile", &["1", "2", "4", "8"]),
    same_for_primitives("axes", &["all", "voxel", "triangle"]),
    same_for_primitives("voxels", &["fragments", "triangles"]),
    // A camera's view needs a camera, which these scenes lack.
    same_for_primitives("views", &["cube", "axes"]),
    // What decides whether something is a hit, or what a fragment stands for.
    may_change("accept", &["interval", "thickness", "tolerance", "slope", "plane", "parity", "t", "tile"]),
    may_change("coverage", &["exact", "hardware", "conservative", "edge-on"]),
    may_change("depth", &["16", "32"]),
    may_change("depths", &["clipped", "corners"]),
    // What a hit names; `payloads::published` holds that it changes nothing else.
    may_change("ids", &["on", "off"]),
    may_change("march", &["samples", "dda", "exact", "pyramid", "jump"]),
    same_for_primitives("payload", &["index", "plane"]),
    may_change("jitter", &["on", "off"]),
    may_change("samples", &["5"]),
    may_change("single-layer", &["on", "off"]),
    may_change("stop", &["best", "bucket"]),
    may_change("thickness", &["0.5"]),
    may_change("tolerance", &["0.01"]),
    Law {
        option: "capacity",
        primitive: Value::Room,
        lossy: Value::Room,
        fragment: Value::Room,
        values: &["0", "1", "1000"],
    },
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
            StructureKind::LossyPrimitive => self.lossy,
            StructureKind::Fragment => self.fragment,
        }
    }
}
