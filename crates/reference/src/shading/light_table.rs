//! The table that lights are chosen by.

/// The emissive triangles, the lights without extent and the kinds of light, by power.
#[derive(Clone, Debug, Default)]
pub struct LightTable {
    pub(super) primitives: Vec<u32>,
    pub(super) cumulative: Vec<f32>,
    /// For each draw, the entry of its first triangle.
    pub(super) first_of_draw: Vec<Option<u32>>,
    /// Cumulative shares of the lights without extent.
    pub(super) punctual: Vec<f32>,
    /// Probability of the kinds: punctual, emissive triangles, environment.
    pub(super) kinds: [f32; 3],
}
