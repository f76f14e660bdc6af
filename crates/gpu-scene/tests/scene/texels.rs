//! Texels that exceed the available memory: images lose their finest levels, and nothing else changes.
//! Without a device.

use rasray_gpu_scene::{GpuSceneError, Parts, SceneTables, SmallerImage, TEXEL_BYTES, TexelDemand, layout};
use rasray_scene::{AlphaMode, Filter, Image, Material, Scene, Texture, TextureRef, Wrap};

use glam::DVec3;

fn image(name: &str, width: u32, height: u32) -> Image {
    // Texels of an image are all different, and so are bytes that follow each other.
    let rgba8 = (0..width * height * 4).map(|byte| (byte.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    Image { name: name.to_owned(), width, height, rgba8 }
}

fn used(texture: usize) -> Option<TextureRef> {
    Some(TextureRef { texture, uv_set: 0, uv_transform: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] })
}

/// Makes colour, normals and a mask of different sizes; the mask has no smaller levels; one image is not
/// used.
fn scene() -> Scene {
    let texture = |image, mipmapped| Texture {
        image,
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filter: Filter::Linear,
        mipmapped,
    };
    Scene {
        materials: vec![
            Material {
                base_color_texture: used(0),
                normal_texture: used(1),
                alpha_mode: AlphaMode::Opaque,
                ..Material::default()
            },
            Material {
                base_color_texture: used(2),
                alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
                ..Material::default()
            },
        ],
        textures: vec![texture(0, true), texture(1, true), texture(2, false)],
        images: vec![
            image("bark", 16, 8),
            image("bumps", 9, 7),
            image("leaf", 8, 16),
            image("unused", 64, 64),
        ],
        ..Scene::default()
    }
}

fn tables(scene: &Scene, parts: &Parts) -> SceneTables {
    SceneTables::new(scene, DVec3::ZERO, parts).expect("the scene is well formed")
}

fn demand(scene: &Scene, parts: &Parts) -> TexelDemand {
    TexelDemand::of(scene, parts).expect("the scene is well formed")
}

/// Returns the texels of a texture with all its levels.
fn texels(tables: &SceneTables, texture: layout::Texture) -> &[u32] {
    let size = |level: u32| (texture.width >> level).max(1) * (texture.height >> level).max(1);
    let count: u32 = (0..texture.level_count).map(size).sum();
    &tables.texels[texture.first_texel as usize..][..count as usize]
}

#[test]
fn the_demand_is_what_is_packed() {
    let scene = scene();
    for parts in [Parts::ALL, Parts::VISIBILITY] {
        let demand = demand(&scene, &parts);
        assert_eq!(demand.texels(), tables(&scene, &parts).texels.len() as u64);
        assert_eq!(demand.bytes(), TEXEL_BYTES * demand.texels());
    }
    let all = (128 + 32 + 8 + 2 + 1) + (63 + 12 + 2 + 1) + 128;
    assert_eq!(demand(&scene, &Parts::ALL).texels(), all);
    assert_eq!(demand(&scene, &Parts::VISIBILITY).texels(), 128, "the mask alone");
}

#[test]
fn the_largest_image_is_halved_until_all_fit() {
    let scene = scene();
    let demand = demand(&scene, &Parts::ALL);
    let sizes = |most| -> Vec<_> {
        let smaller = demand.smaller_images(most).expect("there is room for three texels");
        smaller.into_iter().map(|SmallerImage { name, from, to, .. }| (name, from, to)).collect()
    };
    let entry = |name: &str, from, to| (name.to_owned(), from, to);
    assert_eq!(sizes(377), []);
    // The first of two equal images is halved first.
    assert_eq!(sizes(376), [entry("bark", [16, 8], [8, 4])]);
    assert_eq!(sizes(249), [entry("bark", [16, 8], [8, 4])]);
    assert_eq!(sizes(248), [entry("bark", [16, 8], [8, 4]), entry("leaf", [8, 16], [4, 8])]);
    assert_eq!(
        sizes(3),
        [entry("bark", [16, 8], [1, 1]), entry("bumps", [9, 7], [1, 1]), entry("leaf", [8, 16], [1, 1]),]
    );
    match demand.smaller_images(2) {
        Err(GpuSceneError::TooManyTexels { count: 377, limit: 2 }) => {}
        other => panic!("three images do not fit two texels, got {other:?}"),
    }
}

/// A render then reads the levels that existed before.
#[test]
fn smaller_images_are_the_coarser_levels_bit_for_bit() {
    let whole = scene();
    let before = tables(&whole, &Parts::ALL);
    for most in (3..=377).step_by(11) {
        let mut scene = whole.clone();
        for smaller in demand(&scene, &Parts::ALL).smaller_images(most).expect("there is room") {
            smaller.apply(&mut scene);
            assert_eq!([scene.images[smaller.image].width, scene.images[smaller.image].height], smaller.to);
        }
        let after = tables(&scene, &Parts::ALL);
        assert!(after.texels.len() as u64 <= most, "{} of {most}", after.texels.len());
        assert_eq!(after.texels.len() as u64, demand(&scene, &Parts::ALL).texels());
        assert_eq!(after.materials, before.materials);
        for (&texture, &old) in after.textures.iter().zip(&before.textures) {
            assert_eq!(texture.sampling, old.sampling);
            if old.level_count > 1 {
                let dropped = (old.level_count - texture.level_count) as usize;
                assert_eq!(texture.level_count, old.level_count - dropped as u32);
                assert!(texels(&before, old).ends_with(texels(&after, texture)), "at most {most}");
            }
        }
        assert_eq!(scene.images[3].rgba8, whole.images[3].rgba8, "what is not used is left alone");
    }
}

#[test]
fn an_image_with_two_uses_is_counted_twice() {
    let mut scene = scene();
    scene.materials[0].normal_texture = used(0);
    let demand = demand(&scene, &Parts::ALL);
    assert_eq!(demand.texels(), 2 * 171 + 128);
    let smaller = demand.smaller_images(300).expect("there is room");
    assert_eq!((smaller.len(), smaller[0].to), (1, [8, 4]));
    smaller[0].apply(&mut scene);
    assert_eq!(tables(&scene, &Parts::ALL).texels.len(), 2 * 43 + 128);
}
