//! Table by which lights are chosen.

/// Emissive triangles, lights without extent and kinds of light, by power.
#[derive(Clone, Debug, Default)]
pub struct LightTable {
    pub(super) primitives: Vec<u32>,
    pub(super) cumulative: Vec<f32>,
    /// Entry of the first triangle of each draw.
    pub(super) first_of_draw: Vec<Option<u32>>,
    /// Cumulative shares of the lights without extent.
    pub(super) punctual: Vec<f32>,
    /// Probability of the kinds: punctual, emissive triangles, environment.
    pub(super) kinds: [f32; 3],
}
