//! Two mirrors that face each other: every ray between them hits one after another.

use glam::{DVec2, DVec3};

use super::cornell::{diffuse, place_each};
use super::shape::{Icosphere, Shapes};
use crate::default_view::camera_looking_at;
use crate::{Material, Scene};

/// Length of the corridor along z, metres.
const LENGTH: f64 = 8.0;
/// Height of the corridor, metres.
const HEIGHT: f64 = 3.0;

/// Parameters of [`corridor`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corridor {
    /// Reflectance of the mirrors, in [0, 1].
    pub reflectance: f32,
    /// Distance between the mirrors, metres, in [0.5, 50].
    pub width: f64,
}

impl Default for Corridor {
    fn default() -> Self {
        Self { reflectance: 0.95, width: 2.0 }
    }
}

/// Makes a closed corridor along z. The walls at x = -width/2 and x = width/2 are perfect mirrors; floor,
/// ceiling and ends are Lambertian, a strip of the ceiling glows, and a sphere stands on the floor. A path
/// that hits k mirrors is dimmed by reflectance^k. The camera looks into a mirror at a slant.
pub fn corridor(parameters: Corridor) -> Scene {
    let Corridor { reflectance, width } = parameters;
    let half = width / 2.0;
    let materials = vec![
        Material { metallic: 1.0, roughness: 0.0, ..diffuse("mirror", [reflectance; 3]) },
        diffuse("plaster", [0.6, 0.6, 0.58]),
        Material { emission: [12.0, 11.0, 10.0], ..diffuse("lamp", [0.5; 3]) },
        diffuse("sphere", [0.7, 0.18, 0.1]),
    ];
    let at = DVec3::new;
    let end = LENGTH / 2.0;
    let once = DVec2::ONE;

    let mut mirrors = Shapes::new("mirrors", 0);
    mirrors.quad(
        [at(-half, 0.0, end), at(-half, 0.0, -end), at(-half, HEIGHT, -end), at(-half, HEIGHT, end)],
        once,
    );
    mirrors
        .quad([at(half, 0.0, -end), at(half, 0.0, end), at(half, HEIGHT, end), at(half, HEIGHT, -end)], once);

    let mut plaster = Shapes::new("plaster", 1);
    plaster.quad([at(-half, 0.0, end), at(half, 0.0, end), at(half, 0.0, -end), at(-half, 0.0, -end)], once);
    plaster.quad(
        [at(-half, 0.0, -end), at(half, 0.0, -end), at(half, HEIGHT, -end), at(-half, HEIGHT, -end)],
        once,
    );
    plaster
        .quad([at(half, 0.0, end), at(-half, 0.0, end), at(-half, HEIGHT, end), at(half, HEIGHT, end)], once);
    // The ceiling leaves a hole for the lamp and shares its edges.
    let ring = |x: f64, z: f64| [at(-x, HEIGHT, z), at(-x, HEIGHT, -z), at(x, HEIGHT, -z), at(x, HEIGHT, z)];
    let (outer, inner) = (ring(half, end), ring(half * 0.3, end * 0.5));
    for side in 0..4 {
        let next = (side + 1) % 4;
        plaster.quad([outer[side], outer[next], inner[next], inner[side]], once);
    }

    let mut lamp = Shapes::new("lamp", 2);
    lamp.quad(inner, once);

    let radius = (half * 0.4).min(0.5);
    let mut sphere = Shapes::new("sphere", 3);
    // The sphere hovers a little above the floor: its lowest vertex would otherwise lie in the floor's plane.
    sphere.sphere(&Icosphere::new(3), at(0.15 * half, radius * 1.02, -0.5), radius, false);

    let meshes = vec![mirrors.finish(), plaster.finish(), lamp.finish(), sphere.finish()];
    let eye = at(-0.55 * half, 1.6, 0.85 * end);
    let camera = camera_looking_at("camera", eye, at(half, 1.2, -0.2 * end), 1.0);
    Scene {
        name: "corridor".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials,
        cameras: vec![camera],
        ..Scene::default()
    }
}
