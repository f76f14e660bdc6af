//! Writes the positions of the vertices of a scene's triangles at a time, one per line: x, y, z, metres,
//! world.
//!
//! Usage: `positions FILE [SECONDS [CLIP]]`. Without a time the scene is at rest; without a clip (a number
//! from 0) all clips are played that can be played at once.

use std::io::{BufWriter, Write, stdout};
use std::path::Path;

use glam::DVec3;
use rasray_scene::Moment;
use rasray_scene_files::{LoadOptions, load};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("positions FILE [SECONDS [CLIP]]")?;
    let mut scene = load(Path::new(&file), &LoadOptions::default())?;
    if let Some(seconds) = arguments.next() {
        let clips = match arguments.next() {
            Some(clip) => vec![clip.parse()?],
            None => scene.animation.rig.compatible_clips(),
        };
        scene = scene.at(&Moment { seconds: seconds.parse()?, clips })?;
    }
    let mut out = BufWriter::new(stdout().lock());
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh];
        for index in &mesh.indices {
            let position = DVec3::from(mesh.positions[*index as usize].map(f64::from));
            let DVec3 { x, y, z } = instance.world_from_mesh.transform_point3(position);
            writeln!(out, "{x} {y} {z}")?;
        }
    }
    out.flush()?;
    Ok(())
}
