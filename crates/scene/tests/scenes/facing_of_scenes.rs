//! Share of fragments that is saved if each triangle is kept in one of three views.

use approx::assert_abs_diff_eq;
use rasray_scene::facing::Facing;
use rasray_scene::{Instance, Mesh, Scene};

use crate::made::scene;

/// Returns the facing of the triangle (0, u, v).
fn facing(u: [f32; 3], v: [f32; 3]) -> Facing {
    let mesh = Mesh { positions: vec![[0.0; 3], u, v], indices: vec![0, 1, 2], ..Mesh::default() };
    let instance = Instance { name: "it".to_owned(), mesh: 0, world_from_mesh: glam::DAffine3::IDENTITY };
    Facing::of(&Scene { meshes: vec![mesh], instances: vec![instance], ..Scene::default() })
}

#[test]
fn directions_decide_what_one_view_saves() {
    let wall = facing([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    assert_eq!((wall.most, wall.all), (0.5, 0.5));
    assert_eq!(wall.saved_by_one_view(), Some(0.0));
    // The triangle faces (0, 1, 1), and (1, 1, 1).
    let slope = facing([1.0, 0.0, 0.0], [0.0, 1.0, -1.0]);
    assert_eq!(slope.saved_by_one_view(), Some(0.5));
    let corner = facing([1.0, -1.0, 0.0], [0.0, 1.0, -1.0]).saved_by_one_view().expect("it has an area");
    assert_abs_diff_eq!(corner, 2.0 / 3.0, epsilon = 1e-12);
    assert_eq!(facing([1.0, 0.0, 0.0], [2.0, 0.0, 0.0]).saved_by_one_view(), None);
    assert_eq!(facing([1.0, 0.0, 0.0], [0.0, f32::NAN, 0.0]), Facing::default());
}

#[test]
fn a_sphere_saves_what_all_directions_do() {
    // The directions are spread evenly over an octant.
    let mut sums = (0.0, 0.0);
    let steps = 400;
    for i in 0..steps {
        let z = (f64::from(i) + 0.5) / f64::from(steps);
        let r = (1.0 - z * z).sqrt();
        for j in 0..steps {
            let angle = (f64::from(j) + 0.5) / f64::from(steps) * std::f64::consts::FRAC_PI_2;
            let n = [r * angle.cos(), r * angle.sin(), z];
            sums.0 += n.iter().fold(0.0_f64, |largest, x| largest.max(*x));
            sums.1 += n.iter().sum::<f64>();
        }
    }
    let spheres = scene("spheres:10k");
    let saved = Facing::of(&spheres).saved_by_one_view().expect("it has an area");
    assert_abs_diff_eq!(saved, (1.0 - sums.0 / sums.1), epsilon = 0.01);
}
