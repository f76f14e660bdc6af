//! Terms of scenes that workloads observe.

use glam::DAffine3;
use rasray_scene::animation::{
    Channel, ChannelValues, Clip, Interpolation, NodeTransform, Placement, RigNode,
};
use rasray_scene::needs::{Needs, Term, Workload, moving_instances};
use rasray_scene::{
    AlphaMode, Environment, Filter, Image, Instance, Light, Material, Mesh, Scene, Texture, TextureRef, Wrap,
};

use crate::made::scene;

const OCCLUSION: Workload = Workload::VISIBILITY;
const RAYCAST: Workload =
    Workload { emission: true, shades: true, why: "it is lit from the eye", ..OCCLUSION };
const PATH: Workload = Workload::ALL;
const EMISSION_ONLY: Workload =
    Workload { emission: true, blends: true, why: "no light is scattered", ..OCCLUSION };

fn texture(index: usize, uv_set: u32) -> Option<TextureRef> {
    Some(TextureRef { texture: index, uv_set, uv_transform: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] })
}

/// Makes one triangle that has every attribute, every texture kind, every term of a material, and all lights.
fn everything() -> Scene {
    let image = Image { name: "image".to_owned(), width: 4, height: 4, rgba8: vec![255; 64] };
    let sampled = |image| Texture {
        image,
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filter: Filter::Linear,
        mipmapped: true,
    };
    let mesh = |material| Mesh {
        name: format!("mesh {material}"),
        positions: vec![[0.0; 3]; 3],
        normals: Some(vec![[0.0, 0.0, 1.0]; 3]),
        tangents: Some(vec![[1.0, 0.0, 0.0, 1.0]; 3]),
        uvs: [Some(vec![[0.0; 2]; 3]), Some(vec![[0.0; 2]; 3])],
        colors: Some(vec![[1.0; 4]; 3]),
        indices: vec![0, 1, 2],
        material,
    };
    let glass = Material {
        name: "glass".to_owned(),
        base_color_texture: texture(0, 0),
        metallic_roughness_texture: texture(1, 0),
        anisotropy: 0.5,
        anisotropy_texture: texture(1, 0),
        normal_texture: texture(2, 0),
        emission: [1.0; 3],
        emission_texture: texture(3, 1),
        transmission: 1.0,
        transmission_texture: texture(4, 0),
        thickness: 1.0,
        attenuation_color: [0.5; 3],
        attenuation_distance: 1.0,
        alpha_mode: AlphaMode::Blend,
        ..Material::default()
    };
    let leaf = Material {
        name: "leaf".to_owned(),
        base_color_texture: texture(5, 1),
        alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
        metallic: 0.0,
        ..Material::default()
    };
    let rotation = ChannelValues::Rotation(vec![[0.0, 0.0, 0.0, 1.0]]);
    let mut scene = Scene {
        meshes: vec![mesh(0), mesh(1)],
        instances: (0..2)
            .map(|mesh| Instance {
                name: format!("instance {mesh}"),
                mesh,
                world_from_mesh: DAffine3::IDENTITY,
            })
            .collect(),
        materials: vec![glass, leaf],
        textures: (0..6).map(sampled).collect(),
        images: vec![image; 6],
        lights: vec![
            Light::Point { position: glam::DVec3::ZERO, intensity: [1.0; 3], range: f32::INFINITY },
            Light::Directional { direction: glam::DVec3::NEG_Y, irradiance: [1.0; 3] },
            Light::Spot {
                position: glam::DVec3::ZERO,
                direction: glam::DVec3::NEG_Y,
                intensity: [1.0; 3],
                range: f32::INFINITY,
                inner_cone: 0.1,
                outer_cone: 0.2,
            },
        ],
        environment: Environment::LatLong { width: 2, height: 1, radiance: vec![[1.0; 3]; 2] },
        ..Scene::default()
    };
    let node = |parent| RigNode {
        name: "node".to_owned(),
        parent,
        transform: NodeTransform::Matrix(DAffine3::IDENTITY),
    };
    // The parent comes after its child; instance 1 hangs on a node of its own.
    scene.animation.rig.nodes = vec![node(Some(2)), node(None), node(None)];
    scene.animation.rig.placements =
        [0, 1].map(|node| Placement { node, node_from_mesh: DAffine3::IDENTITY }).to_vec();
    let channel =
        Channel { node: 2, interpolation: Interpolation::Linear, times: vec![0.0], values: rotation };
    scene.animation.rig.clips =
        vec![Clip { name: "turn".to_owned(), duration: 1.0, channels: vec![channel] }];
    scene
}

fn required(scene: &Scene, workload: Workload) -> Vec<Term> {
    let needs = Needs::of(scene, workload);
    Term::ALL.into_iter().filter(|term| needs.requires(*term)).collect()
}

#[test]
fn a_path_needs_everything_of_a_scene_that_has_everything() {
    let scene = everything();
    assert_eq!(required(&scene, PATH), Term::ALL);
}

#[test]
fn occlusion_needs_alpha_masks_and_what_they_read() {
    let mut scene = everything();
    assert_eq!(required(&scene, OCCLUSION), [Term::Uv1, Term::Colors, Term::AlphaMask, Term::Motion]);
    scene.materials[1].alpha_mode = AlphaMode::Opaque;
    assert_eq!(required(&scene, OCCLUSION), [Term::Motion]);
}

#[test]
fn ray_casting_needs_colour_and_shape_of_shading() {
    let needed = required(&everything(), RAYCAST);
    for term in [Term::Normals, Term::Tangents, Term::NormalTextures, Term::BaseColorTextures, Term::Emission]
    {
        assert!(needed.contains(&term), "{term:?}");
    }
    for term in [Term::PointLights, Term::AreaLights, Term::Transmission, Term::MetallicRoughnessTextures] {
        assert!(!needed.contains(&term), "{term:?}");
    }
}

#[test]
fn without_bounces_only_emission_is_seen() {
    let needed = required(&everything(), EMISSION_ONLY);
    for term in [Term::Emission, Term::EmissionTextures, Term::Uv1, Term::AlphaBlend, Term::Environment] {
        assert!(needed.contains(&term), "{term:?}");
    }
    for term in [Term::Normals, Term::AreaLights, Term::Specular, Term::NormalTextures, Term::Tangents] {
        assert!(!needed.contains(&term), "{term:?}");
    }
}

#[test]
fn each_term_goes_with_its_cause() {
    let without = |change: &dyn Fn(&mut Scene), gone: &[Term]| {
        let mut scene = everything();
        change(&mut scene);
        let needed = required(&scene, PATH);
        let missing: Vec<_> = Term::ALL.into_iter().filter(|term| !needed.contains(term)).collect();
        assert_eq!(missing, gone);
    };
    without(&|scene| scene.meshes.iter_mut().for_each(|mesh| mesh.normals = None), &[Term::Normals]);
    without(&|scene| scene.materials[0].normal_texture = None, &[Term::NormalTextures]);
    without(&|scene| scene.materials[0].anisotropy = 0.0, &[Term::AnisotropyTextures]);
    let flat = |scene: &mut Scene| {
        scene.materials[0].normal_texture = None;
        scene.materials[0].anisotropy = 0.0;
    };
    without(&flat, &[Term::Tangents, Term::AnisotropyTextures, Term::NormalTextures]);
    without(
        &|scene| scene.materials[0].emission = [0.0; 3],
        &[Term::EmissionTextures, Term::Emission, Term::AreaLights],
    );
    without(
        &|scene| scene.materials[0].transmission = 0.0,
        &[Term::TransmissionTextures, Term::Transmission, Term::Volume],
    );
    without(&|scene| scene.materials[0].thickness = 0.0, &[Term::Volume]);
    without(&|scene| scene.materials[0].alpha_mode = AlphaMode::Opaque, &[Term::AlphaBlend]);
    without(&|scene| scene.environment = Environment::default(), &[Term::Environment]);
    without(&|scene| scene.animation.rig.clips.clear(), &[Term::Motion]);
    without(&|scene| scene.lights.truncate(1), &[Term::DirectionalLights, Term::SpotLights]);
    without(
        &|scene| {
            scene.materials.iter_mut().for_each(|material| {
                material.specular = 0.0;
                material.metallic = 0.0;
            });
        },
        &[Term::Specular],
    );
}

#[test]
fn what_is_not_placed_does_not_count() {
    let mut scene = everything();
    scene.instances.clear();
    scene.lights.clear();
    scene.environment = Environment::default();
    assert!(required(&scene, PATH).is_empty());
    assert!(required(&Scene::default(), PATH).is_empty());
}

#[test]
fn motion_is_inherited_from_parents_only() {
    assert_eq!(moving_instances(&everything()), [true, false]);
}

#[test]
fn verdicts_say_why() {
    let scene = everything();
    let why = |needs: &Needs, term: Term| {
        needs.verdicts().iter().find(|verdict| verdict.term == term).map(|verdict| verdict.why.clone())
    };
    let path = Needs::of(&scene, PATH);
    assert_eq!(why(&path, Term::AlphaMask).as_deref(), Some("material `leaf` has an alpha mask"));
    assert_eq!(
        why(&path, Term::Normals).as_deref(),
        Some("2 meshes have shading normals, the first is `mesh 0`")
    );
    assert_eq!(why(&path, Term::SpotLights).as_deref(), Some("one spot light is in the scene"));
    let occlusion = Needs::of(&scene, OCCLUSION);
    assert_eq!(why(&occlusion, Term::Normals).as_deref(), Some("only visibility is asked for"));
    assert_eq!(
        why(&occlusion, Term::Uv0).as_deref(),
        Some("no mesh has texture coordinates 0 that a texture is read at")
    );
    for needs in [path, occlusion, Needs::all()] {
        assert_eq!(needs.verdicts().len(), Term::ALL.len());
        assert!(needs.verdicts().iter().all(|verdict| verdict.why.len() > 10 && !verdict.why.contains("  ")));
    }
}

#[test]
fn all_switches_everything_on() {
    assert!(Term::ALL.into_iter().all(|term| Needs::all().requires(term)));
}

#[test]
fn built_in_scenes_need_what_they_are_made_of() {
    let cornell = required(&scene("cornell"), PATH);
    assert_eq!(cornell, [Term::Normals, Term::Emission, Term::AreaLights]);
    let atrium = scene("atrium");
    let needed = required(&atrium, PATH);
    for term in
        [Term::Uv0, Term::BaseColorTextures, Term::AlphaMask, Term::DirectionalLights, Term::Environment]
    {
        assert!(needed.contains(&term), "{term:?}");
    }
    assert_eq!(required(&atrium, OCCLUSION), [Term::Uv0, Term::AlphaMask]);
    assert_eq!(required(&scene("spheres:10k"), OCCLUSION), []);
}
