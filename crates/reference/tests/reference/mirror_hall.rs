//! Share of mirrors that `mirror-hall` promises, counted with the exact oracle.

use glam::{DVec3, Vec2};
use rasray_reference::oracle::Oracle;
use rasray_reference::shading::{PosedScene, View, camera_ray};
use rasray_scene::Sampler;
use rasray_scene::builtin::builtin;

/// Returns the percentage of the pixels of a picture of the scene's camera whose middle shows a perfect
/// mirror at the first hit.
fn share_of_mirrors(spec: &str, [width, height]: [u32; 2]) -> f64 {
    let scene = builtin(spec).expect("built in").expect("a share in range");
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("well formed");
    let oracle = Oracle::new(posed.positions(), posed.indices(), None).expect("well formed");
    let is_mirror: Vec<bool> = scene
        .instances
        .iter()
        .flat_map(|instance| {
            let mesh = &scene.meshes[instance.mesh];
            let material = &scene.materials[mesh.material];
            let mirror = material.metallic == 1.0 && material.roughness == 0.0;
            assert!(mirror || (material.metallic, material.specular) == (0.0, 0.0), "a mirror or Lambertian");
            std::iter::repeat_n(mirror, mesh.triangle_count())
        })
        .collect();
    let camera = scene.cameras[0].clone();
    let view = View { camera, width, height, samples: 1, seed: 1, sampler: Sampler::default() };
    let pixels = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
    let rays: Vec<_> = pixels
        .map(|(column, row)| Vec2::new(column as f32 + 0.5, row as f32 + 0.5))
        .map(|middle| camera_ray(&view, DVec3::ZERO, middle).to_oracle())
        .collect();
    let hits = oracle.closest_batch(&rays);
    let mirrors =
        hits.iter().filter_map(|verdict| verdict.outcome.hit()).filter(|(id, _)| is_mirror[*id as usize]);
    100.0 * mirrors.count() as f64 / rays.len() as f64
}

#[test]
fn as_many_pixels_are_mirrors_as_was_asked_for() {
    for share in [0.0, 12.5, 34.375, 80.0] {
        let found = share_of_mirrors(&format!("mirror-hall:{share}"), [320, 180]);
        println!("mirror-hall:{share}: {found:.3} %");
        assert!((found - share).abs() <= 0.25, "{share}: {found}");
    }
}
