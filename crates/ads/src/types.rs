//! The records that shaders and Rust share. Tests hold each against SPIR-V reflection.

use bytemuck::{Pod, Zeroable};

/// A ray in metres relative to the frame origin. Hits count for `t_min < t < t_max`, t in units of
/// the direction's length.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Ray {
    /// Metres.
    pub origin: [f32; 3],
    /// Hits at or before this t do not count.
    pub t_min: f32,
    /// Need not be unit; finite and not zero.
    pub direction: [f32; 3],
    /// May be infinite. Negative: the ray asks nothing.
    pub t_max: f32,
    /// Never hit; `PRIMITIVE_NONE` excludes nothing.
    pub exclude_primitive: u32,
    /// 0: kept for what a ray may ask beyond this, none so far.
    pub flags: u32,
    /// Width of the ray cone at the origin, metres.
    pub cone_width: f32,
    /// Growth of the cone, radians.
    pub cone_spread: f32,
}

impl Ray {
    /// A ray without limits, exclusion or cone.
    pub fn new(origin: [f32; 3], direction: [f32; 3]) -> Self {
        Self {
            origin,
            t_min: 0.0,
            direction,
            t_max: f32::INFINITY,
            exclude_primitive: crate::PRIMITIVE_NONE,
            flags: 0,
            cone_width: 0.0,
            cone_spread: 0.0,
        }
    }
}

/// What a ray met. A miss has `PRIMITIVE_NONE`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Hit {
    /// In units of the ray direction's length.
    pub t: f32,
    /// Global triangle id; `PRIMITIVE_UNKNOWN` of a fragment that does not keep it.
    pub primitive: u32,
    /// The structure's; weight of vertex 1 where hits are primitives.
    pub a: f32,
    /// The structure's; weight of vertex 2 where hits are primitives, and the bits `HIT_STORED` where a
    /// fragment without them names its triangle for diagnostics.
    pub b: f32,
}

impl Hit {
    /// Whether anything was met.
    pub fn is_hit(&self) -> bool {
        self.primitive != crate::PRIMITIVE_NONE
    }
}

/// Where a traversal stands between two rounds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct TraceState {
    /// Best hit so far.
    pub best: Hit,
    /// The structure's.
    pub cursor: [u32; 8],
    /// Cells stepped.
    pub cells: u32,
    /// List entries read.
    pub entries: u32,
    /// Primitives tested.
    pub tests: u32,
    /// Rounds begun.
    pub rounds: u32,
}

/// What a ray has spent, where work is counted per ray.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct RayWork {
    /// Cells stepped.
    pub cells: u32,
    /// List entries read.
    pub entries: u32,
    /// Primitives tested.
    pub tests: u32,
    /// Dispatches the ray took part in.
    pub rounds: u32,
}

/// One step of a logged traversal, as the device writes it; [`TraceStep::kind`] and the others read it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TraceStep {
    /// A `STEP_*` number; it says what the words after `round` mean.
    pub kind: u32,
    /// The dispatch it was taken in, from 0.
    pub round: u32,
    /// The kind's.
    pub a: u32,
    /// The kind's.
    pub b: u32,
    /// The kind's.
    pub c: u32,
    /// The kind's.
    pub t_low: f32,
    /// The kind's.
    pub t_high: f32,
}

/// What is shaded: metres relative to the frame origin, linear Rec. 709, W/(sr m^2).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Surface {
    /// Where the surface is.
    pub position: [f32; 3],
    /// Bound of the error of each coordinate, metres.
    pub position_error: f32,
    /// Unit, faces the ray.
    pub geometric_normal: [f32; 3],
    /// Global triangle id, `PRIMITIVE_UNKNOWN` or `PRIMITIVE_NONE`.
    pub primitive: u32,
    /// Unit shading normal.
    pub normal: [f32; 3],
    /// `SURFACE_*` bits of what the structure knows; 0 is a miss.
    pub valid: u32,
    /// Linear.
    pub base_color: [f32; 3],
    /// In [0, 1].
    pub metallic: f32,
    /// Radiance.
    pub emission: [f32; 3],
    /// Perceptual, in [0, 1].
    pub roughness: f32,
    /// In [0, 1].
    pub transmission: f32,
    /// Index of refraction.
    pub ior: f32,
    /// In [0, 1].
    pub opacity: f32,
    /// Metres; 0 is a thin wall.
    pub thickness: f32,
    /// Colour of white light after `attenuation_distance`.
    pub attenuation_color: [f32; 3],
    /// Metres.
    pub attenuation_distance: f32,
    /// Strength of dielectric reflection.
    pub specular: f32,
    /// 1 if the ray came from the front.
    pub side: u32,
    /// Of the hit.
    pub t: f32,
    /// Material index or `PRIMITIVE_NONE`.
    pub material: u32,
}

/// One run of triangles of one instance.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Draw {
    /// Global id of the first triangle.
    pub first_triangle: u32,
    /// Number of triangles.
    pub triangle_count: u32,
    /// Index of the instance.
    pub instance: u32,
    /// `DRAW_*` bits.
    pub flags: u32,
    /// Index of its first triangle's first vertex, counted from the first index handed in; read with
    /// [`crate::Indexing::PerDraw`] alone.
    pub first_index: u32,
    /// Added to each of its indices; read with [`crate::Indexing::PerDraw`] alone.
    pub base_vertex: i32,
}

/// Counts and bounds of a [`crate::Geometry`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct GeometryHeader {
    /// Vertices.
    pub vertex_count: u32,
    /// Triangles.
    pub triangle_count: u32,
    /// Draws.
    pub draw_count: u32,
    /// Triangles that the last check found outside of the bounds, with a vertex that there is not, or beyond the maximum.
    pub outside: u32,
    /// Lower corner of all positions, metres.
    pub lower: [f32; 3],
    /// Upper corner, metres.
    pub upper: [f32; 3],
    /// Word of the first position in its binding.
    pub position_word: u32,
    /// Words from one position to the next.
    pub position_words: u32,
    /// Word of the first index in its binding.
    pub index_word: u32,
}

/// Book-keeping of a [`crate::RayQueue`].
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct QueueHeader {
    /// Indirect dispatch of the next round.
    pub groups_x: u32,
    /// Always 1.
    pub groups_y: u32,
    /// Always 1.
    pub groups_z: u32,
    /// Slots.
    pub capacity: u32,
    /// Rounds begun for the rays now in the queue.
    pub round: u32,
    /// Rays of this round.
    pub listed: u32,
    /// Rays that paused in this round.
    pub paused: u32,
    /// Rays that were given up, over all traces since the reset.
    pub unfinished: u32,
    /// Rays that met an incomplete structure, over all traces since the reset.
    pub not_ready: u32,
    /// Slots selected for the passes after the next [`crate::RayQueue::record_take`].
    pub selecting: u32,
    /// Cells stepped, low word.
    pub cells_low: u32,
    /// Cells stepped, high word.
    pub cells_high: u32,
    /// List entries read, low word.
    pub entries_low: u32,
    /// List entries read, high word.
    pub entries_high: u32,
    /// Primitives tested, low word.
    pub tests_low: u32,
    /// Primitives tested, high word.
    pub tests_high: u32,
    /// Indirect dispatch over the slots selected.
    pub selected_x: u32,
    /// Always 1.
    pub selected_y: u32,
    /// Always 1.
    pub selected_z: u32,
    /// Slots selected when they were last taken.
    pub selected: u32,
    /// Times they were taken.
    pub takes: u32,
    /// List entries that named nothing, in the structure last traced since it was built.
    pub corrupted: u32,
}
