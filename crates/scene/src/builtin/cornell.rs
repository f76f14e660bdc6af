//! The classic box: red and green walls, two white blocks, a light that fills a hole in the ceiling.

use glam::{DAffine3, DVec2, DVec3};

use super::shape::Shapes;
use crate::default_view::camera_looking_at;
use crate::{Instance, Material, Mesh, Scene};

/// Half the width of the room, metres.
const HALF_WIDTH: f64 = 0.278;
/// Height of the room, metres.
const HEIGHT: f64 = 0.5488;
/// Depth of the room, metres; it reaches from z = -DEPTH to the open front at z = 0.
const DEPTH: f64 = 0.5592;

/// Makes the Cornell box at its measured size of about half a metre, open at z = 0 where the camera looks in
/// along -z. All surfaces are Lambertian. Room and light together form a surface whose only border is the
/// open front. The blocks stand on the floor and have no bottom.
pub fn cornell() -> Scene {
    let materials = vec![
        diffuse("white", [0.725, 0.71, 0.68]),
        diffuse("red", [0.63, 0.065, 0.05]),
        diffuse("green", [0.14, 0.45, 0.091]),
        Material { emission: [17.0, 12.0, 4.0], ..diffuse("light", [0.78, 0.78, 0.78]) },
    ];
    let meshes = vec![
        room(),
        wall("red wall", 1, -HALF_WIDTH),
        wall("green wall", 2, HALF_WIDTH),
        light(),
        block("short block", [(0.130, 0.065), (0.082, 0.225), (0.240, 0.272), (0.290, 0.114)], 0.165),
        block("tall block", [(0.423, 0.247), (0.265, 0.296), (0.314, 0.456), (0.472, 0.406)], 0.330),
    ];
    let instances = place_each(&meshes);
    // The lens of the photographed box: 35 mm in front of 25 mm of film.
    let fov_y = 2.0 * (12.5_f64 / 35.0).atan();
    let eye = DVec3::new(0.0, 0.273, 0.8);
    let camera = camera_looking_at("camera", eye, eye - DVec3::Z, fov_y as f32);
    Scene {
        name: "cornell".to_owned(),
        meshes,
        instances,
        materials,
        cameras: vec![camera],
        ..Scene::default()
    }
}

/// Makes a Lambertian material: no metal, no specular reflection.
pub(super) fn diffuse(name: &str, [red, green, blue]: [f32; 3]) -> Material {
    Material {
        name: name.to_owned(),
        base_color: [red, green, blue, 1.0],
        metallic: 0.0,
        roughness: 1.0,
        specular: 0.0,
        ..Material::default()
    }
}

/// Makes one instance of each mesh, at the origin, in order.
pub(super) fn place_each(meshes: &[Mesh]) -> Vec<Instance> {
    let place = |(index, mesh): (usize, &Mesh)| Instance {
        name: mesh.name.clone(),
        mesh: index,
        world_from_mesh: DAffine3::IDENTITY,
    };
    meshes.iter().enumerate().map(place).collect()
}

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Returns the corners of the light, which are the corners of the hole, counter-clockwise from below.
fn light_corners() -> [DVec3; 4] {
    let (x, near, far) = (0.065, -0.227, -0.332);
    [at(-x, HEIGHT, near), at(-x, HEIGHT, far), at(x, HEIGHT, far), at(x, HEIGHT, near)]
}

fn room() -> Mesh {
    let w = HALF_WIDTH;
    let mut shapes = Shapes::new("room", 0);
    let once = DVec2::ONE;
    shapes.quad([at(-w, 0.0, 0.0), at(w, 0.0, 0.0), at(w, 0.0, -DEPTH), at(-w, 0.0, -DEPTH)], once);
    shapes
        .quad([at(-w, 0.0, -DEPTH), at(w, 0.0, -DEPTH), at(w, HEIGHT, -DEPTH), at(-w, HEIGHT, -DEPTH)], once);
    let outer = [at(-w, HEIGHT, 0.0), at(-w, HEIGHT, -DEPTH), at(w, HEIGHT, -DEPTH), at(w, HEIGHT, 0.0)];
    let inner = light_corners();
    for side in 0..4 {
        let next = (side + 1) % 4;
        shapes.quad([outer[side], outer[next], inner[next], inner[side]], once);
    }
    shapes.finish()
}

fn wall(name: &str, material: usize, x: f64) -> Mesh {
    let mut shapes = Shapes::new(name, material);
    // The first corner is the bottom left one as seen from inside.
    let (left, right) = if x < 0.0 { (0.0, -DEPTH) } else { (-DEPTH, 0.0) };
    shapes.quad([at(x, 0.0, left), at(x, 0.0, right), at(x, HEIGHT, right), at(x, HEIGHT, left)], DVec2::ONE);
    shapes.finish()
}

fn light() -> Mesh {
    let mut shapes = Shapes::new("light", 3);
    shapes.quad(light_corners(), DVec2::ONE);
    shapes.finish()
}

/// Makes a block over a footprint given as (metres from the right wall, metres from the front).
fn block(name: &str, footprint: [(f64, f64); 4], height: f64) -> Mesh {
    let mut shapes = Shapes::new(name, 0);
    let corner = |index: usize, y: f64| {
        let (from_right, from_front) = footprint[index % 4];
        at(HALF_WIDTH - from_right, y, -from_front)
    };
    let top = [3, 2, 1, 0].map(|index| corner(index, height));
    // Footprints may run clockwise or counter-clockwise; in both cases the top faces up.
    let up = (top[1] - top[0]).cross(top[2] - top[0]).y > 0.0;
    let order: [usize; 5] = if up { [3, 2, 1, 0, 3] } else { [0, 1, 2, 3, 0] };
    shapes.quad([order[0], order[1], order[2], order[3]].map(|index| corner(index, height)), DVec2::ONE);
    for side in order.windows(2) {
        let (a, b) = (side[0], side[1]);
        shapes.quad([corner(a, 0.0), corner(b, 0.0), corner(b, height), corner(a, height)], DVec2::ONE);
    }
    shapes.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Projection;
    use crate::builtin::picture;

    #[test]
    fn its_picture_shows_the_room_and_nothing_beside_it() {
        let scene = cornell();
        let camera = &scene.cameras[0];
        let Projection::Perspective { fov_y } = camera.projection else { panic!("a lens") };
        let [width, height] = picture("cornell").expect("of its own").size.map(f64::from);
        let view = camera.world_from_camera.inverse();
        for (x, y) in [(-HALF_WIDTH, 0.0), (HALF_WIDTH, 0.0), (-HALF_WIDTH, HEIGHT), (HALF_WIDTH, HEIGHT)] {
            let seen = view.transform_point3(at(x, y, 0.0));
            let half = -seen.z * (0.5 * f64::from(fov_y)).tan();
            // Corners of the opening lie inside the picture, less than one part in twenty from its edge.
            for share in [seen.x.abs() / (half * width / height), seen.y.abs() / half] {
                assert!((0.95..1.0).contains(&share), "{x} {y}: {share}");
            }
        }
    }
}
