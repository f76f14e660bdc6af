use glam::{Vec2, Vec4};
use rasray_scene::{Filter, Image, Scene, Texture, TextureRef, Wrap};

use crate::shading::texture::{TextureTable, Use, srgb_decode};

const IDENTITY: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn scene(width: u32, height: u32, reds: &[u8], filter: Filter, wrap: Wrap, mipmapped: bool) -> Scene {
    let rgba8 = reds.iter().flat_map(|red| [*red, 0, 0, 255]).collect();
    let image = Image { name: "image".to_owned(), width, height, rgba8 };
    let texture = Texture { image: 0, wrap_u: wrap, wrap_v: wrap, filter, mipmapped };
    Scene { images: vec![image], textures: vec![texture], ..Scene::default() }
}

fn sample(scene: &Scene, usage: Use, u: f32, v: f32, level: f32) -> Vec4 {
    let reference = TextureRef { texture: 0, uv_set: 0, uv_transform: IDENTITY };
    let mut table = TextureTable::new(scene);
    table.prepare(reference, usage);
    table.sample(Some(&reference), usage, Vec2::new(u, v), level)
}

fn byte(value: f32) -> f32 {
    value * 255.0
}

#[test]
fn nearest_takes_the_texel_that_holds_the_point() {
    let scene = scene(2, 2, &[10, 20, 30, 40], Filter::Nearest, Wrap::Repeat, false);
    for (u, v, expected) in [(0.1, 0.1, 10.0), (0.6, 0.1, 20.0), (0.1, 0.9, 30.0), (0.99, 0.99, 40.0)] {
        assert!((byte(sample(&scene, Use::Linear, u, v, 3.0).x) - expected).abs() < 1.0e-3);
    }
}

#[test]
fn every_wrap_continues_its_own_way() {
    for (wrap, expected) in [
        (Wrap::Repeat, [10.0, 40.0, 10.0, 40.0]),
        (Wrap::Mirror, [40.0, 10.0, 10.0, 40.0]),
        (Wrap::Clamp, [40.0, 10.0, 10.0, 10.0]),
    ] {
        let scene = scene(4, 1, &[10, 20, 30, 40], Filter::Nearest, wrap, false);
        let measured =
            [1.1, -0.1, -0.9, -1.1].map(|u| byte(sample(&scene, Use::Linear, u, 0.0, 0.0).x).round());
        let expected = match wrap {
            // -0.9 is one texel from the left end of the copy before.
            Wrap::Mirror => [40.0, 10.0, 40.0, 40.0],
            _ => expected,
        };
        assert_eq!(measured, expected, "{wrap:?}");
    }
}

#[test]
fn linear_mixes_between_centres_and_across_the_border() {
    let clamped = scene(2, 1, &[0, 200], Filter::Linear, Wrap::Clamp, false);
    for (u, expected) in [(0.25, 0.0), (0.5, 100.0), (0.75, 200.0), (0.0, 0.0), (0.375, 50.0), (1.0, 200.0)] {
        assert!((byte(sample(&clamped, Use::Linear, u, 0.5, 0.0).x) - expected).abs() < 1.0e-3, "{u}");
    }
    let repeated = scene(2, 1, &[0, 200], Filter::Linear, Wrap::Repeat, false);
    assert!((byte(sample(&repeated, Use::Linear, 0.0, 0.5, 0.0).x) - 100.0).abs() < 1.0e-3);
}

#[test]
fn colours_are_decoded_before_they_are_mixed() {
    let scene = scene(2, 1, &[0, 255], Filter::Linear, Wrap::Clamp, true);
    assert!((sample(&scene, Use::Color, 0.5, 0.5, 0.0).x - 0.5).abs() < 1.0e-6);
    // Level 1 holds the encoded mean of linear light, 188.
    assert!((sample(&scene, Use::Color, 0.5, 0.5, 1.0).x - srgb_decode(188.0 / 255.0)).abs() < 1.0e-6);
    assert!((byte(sample(&scene, Use::Linear, 0.5, 0.5, 1.0).x) - 128.0).abs() < 1.0e-3);
    assert!((srgb_decode(0.5) - 0.214_041_14).abs() < 1.0e-6);
}

#[test]
fn levels_are_mixed_and_end_at_the_last() {
    let scene = scene(4, 1, &[0, 80, 160, 240], Filter::Linear, Wrap::Clamp, true);
    let at = |level| byte(sample(&scene, Use::Linear, 0.125, 0.5, level).x);
    assert!((at(-3.0) - 0.0).abs() < 1.0e-3);
    assert!((at(1.0) - 40.0).abs() < 1.0e-3);
    assert!((at(0.5) - 20.0).abs() < 1.0e-3);
    assert!((at(2.0) - 120.0).abs() < 1.0e-3 && (at(9.0) - 120.0).abs() < 1.0e-3);
}

#[test]
fn a_texel_as_wide_as_the_footprint_is_level_zero() {
    let scene = scene(4, 4, &[0; 16], Filter::Linear, Wrap::Repeat, true);
    let mut reference = TextureRef { texture: 0, uv_set: 0, uv_transform: IDENTITY };
    let mut table = TextureTable::new(&scene);
    table.prepare(reference, Use::Linear);
    // One copy of 4 x 4 texels covers a square metre: a texel is 0.25 m.
    assert_eq!(table.level(Some(&reference), 1.0, 0.25), 0.0);
    assert_eq!(table.level(Some(&reference), 1.0, 1.0), 2.0);
    reference.uv_transform = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    assert_eq!(table.level(Some(&reference), 1.0, 1.0), 3.0);
    assert_eq!(table.level(Some(&reference), 0.0, 1.0), 0.0);
}

#[test]
fn coordinates_that_are_no_numbers_are_survived() {
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        let scene = scene(3, 3, &[9; 9], Filter::Linear, wrap, true);
        for u in [f32::NAN, f32::INFINITY, -f32::INFINITY, 1.0e30, -1.0e8, -1.0e-9] {
            assert!((byte(sample(&scene, Use::Linear, u, u, 0.3).x) - 9.0).abs() < 1.0e-3);
        }
    }
}
