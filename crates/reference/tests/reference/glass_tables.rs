//! Uploaded tables of rough glass against those of this crate.

use rasray_gpu_scene::{Parts, SceneTables};
use rasray_reference::shading::glass_albedo::{self, Block};
use rasray_scene::{Material, Scene};
use rasray_shaders_glsl::constants::scene::{ATTRIBUTE_NONE, GLASS_ROW_WORDS, GLASS_ROWS};

fn volume(ior: f32, specular: f32) -> Material {
    Material { transmission: 1.0, thickness: 1.0, ior, specular, ..Material::default() }
}

fn tables(materials: Vec<Material>, parts: &Parts) -> SceneTables {
    let scene = Scene { materials, ..Scene::default() };
    SceneTables::new(&scene, glam::DVec3::ZERO, parts).expect("valid")
}

#[test]
fn uploaded_tables_are_those_of_the_reference() {
    let (rows, words) = (GLASS_ROWS as usize, GLASS_ROW_WORDS as usize);
    for (ior, specular) in [(1.33, 1.0), (1.5, 0.5), (2.4, 0.0), (0.7, 1.0), (100.0, 1.0)] {
        let tables = tables(vec![volume(ior, specular)], &Parts::ALL);
        let root = (ior - 1.0) / (ior + 1.0);
        let reference = glass_albedo::table(ior, root * root * specular, specular);
        assert_eq!((tables.materials[0].albedo, tables.vertex_attributes.len()), (0, 3 * rows * words));
        for (place, &found) in tables.vertex_attributes.iter().enumerate() {
            let block = [Block::Front, Block::Back, Block::Reflected][place / (rows * words)];
            let (row, column) = (place / words % rows, place % words);
            let roughness = row as f32 / (rows - 1) as f32;
            let cosine = (column as f32 / (words - 2) as f32).powi(2);
            let expected = if column == words - 1 {
                reference.mean(block, roughness)
            } else {
                reference.share(block, roughness, cosine)
            };
            assert!((found - expected).abs() < 1.0e-5, "{ior} {block:?} {row} {column}: {found} {expected}");
        }
    }
}

/// Equal glasses share a table, and no other material has one.
#[test]
fn only_rough_volumes_have_tables() {
    let glass = volume(1.5, 1.0);
    let without = [
        Material { transmission: 0.0, ..glass.clone() },
        Material { thickness: 0.0, ..glass.clone() },
        Material { roughness: 0.05, ..glass.clone() },
        Material { ior: 1.0, ..glass.clone() },
        Material { ior: 0.0, ..glass.clone() },
        Material { unlit: true, ..glass.clone() },
    ];
    let none = tables(without.to_vec(), &Parts::ALL);
    assert!(none.materials.iter().all(|material| material.albedo == ATTRIBUTE_NONE));
    assert!(none.vertex_attributes.is_empty());
    let again = Material { roughness: 0.3, transmission: 0.5, ..glass.clone() };
    let dense = volume(2.0, 1.0);
    let some = tables(vec![glass.clone(), dense, again], &Parts::ALL);
    let words = 3 * GLASS_ROWS * GLASS_ROW_WORDS;
    assert_eq!(some.materials.iter().map(|material| material.albedo).collect::<Vec<_>>(), [0, words, 0]);
    assert_eq!(some.vertex_attributes.len(), 2 * words as usize);
    // Visibility rays read no table.
    assert!(tables(vec![glass], &Parts::VISIBILITY).vertex_attributes.is_empty());
}
