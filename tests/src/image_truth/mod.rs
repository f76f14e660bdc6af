//! Images whose values are known in closed form, and the statistics that compare a rendered image with these
//! values. `docs/image-truth.md` lists the checks, and how to run them again.

mod albedo;
mod closed_forms;
mod estimate;
mod scenes;
mod studio;

pub use albedo::{Plastic, metal_albedo, plastic_albedo};
pub use closed_forms::{
    convex_occlusion, enclosure, interface_transmission, next_to_sphere, normal_reflectance,
    parallel_rectangles, perpendicular_rectangles, polygon_irradiance,
};
pub use estimate::{CHECK_LIMIT, Estimate, SIGMAS, assert_refused, assert_truth};
pub use scenes::{
    box_around, box_faces, diffuse, glass, glowing, looking, octahedron_sphere, parallel, scene_of, square,
    triangles, unlit,
};
pub use studio::{Picture, Studio, System};
