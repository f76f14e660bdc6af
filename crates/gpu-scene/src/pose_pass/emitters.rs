//! Emissive triangles that move: their power follows their area.

use rasray_scene::pose::{Pose, posed_mesh};

use super::frame_pose::Placer;
use super::shapes::FrameShapes;
use super::sources::DrawPlace;
use crate::emissive::{EmissiveSources, area};
use crate::layout::EmissiveTriangle;
use crate::pose::{is_usable, placed};
use crate::{SceneTables, layout::DrawShading};
use rasray_shaders_glsl::constants::scene::EMISSIVE_NONE;

/// Emissive triangles with their areas at rest.
#[derive(Clone, Debug)]
pub struct Emitters {
    sources: EmissiveSources,
    /// Areas at rest, m^2.
    areas: Vec<f64>,
    /// Power of all emitters at rest, W.
    power: f64,
    /// Moving draws, each with the index of its first entry.
    moving: Vec<(DrawPlace, usize)>,
}

impl Emitters {
    /// Collects the emitters of the draws of `tables`; `places` are the moving ones.
    pub fn new(tables: &SceneTables, places: &[DrawPlace]) -> Self {
        let sources = EmissiveSources {
            primitives: tables.emissive_triangles.iter().map(|entry| entry.primitive).collect(),
            radiosities: tables.emissive_radiosities.clone(),
        };
        let entry = |shading: &DrawShading| {
            (shading.first_emissive != EMISSIVE_NONE).then_some(shading.first_emissive as usize)
        };
        let moving = places
            .iter()
            .filter_map(|place| Some((place.clone(), entry(&tables.draw_shadings[place.draw])?)))
            .collect();
        Self { areas: sources.areas(&tables.posed), power: tables.emissive_power, sources, moving }
    }

    /// Returns the power of all emitters at rest, W.
    pub fn power_at_rest(&self) -> f64 {
        self.power
    }

    /// True if any emitter moves.
    pub fn moves(&self) -> bool {
        !self.moving.is_empty()
    }

    /// Returns the table and the total power, W, with moving draws posed as for new tables: on the host, in
    /// f64.
    pub fn at(&self, pose: &Pose, placer: &Placer<'_>, shapes: &FrameShapes) -> (f64, Vec<EmissiveTriangle>) {
        let scene = placer.scene;
        let mut areas = self.areas.clone();
        for (place, first) in &self.moving {
            let mesh = &scene.meshes[scene.instances[place.instance].mesh];
            let deformed = place.deformed.map(|deformed| &placer.rig.deformed[deformed]);
            let shown =
                deformed.map(|deformed| posed_mesh(mesh, deformed, &placer.weights(place), placer.rig, pose));
            let (positions, world) = match (&shown, place.shape) {
                (Some((mesh, world)), _) => (&mesh.positions, *world),
                (None, Some(shape)) => (&shapes.positions[shape].1, None),
                (None, None) => (&mesh.positions, None),
            };
            let world = world.unwrap_or_else(|| placer.world_from_mesh(place.instance));
            let corners: Vec<_> = placed(positions, world, placer.frame_origin).collect();
            for (triangle, area_of) in mesh.indices.chunks_exact(3).zip(&mut areas[*first..]) {
                let corners = [0, 1, 2].map(|corner| corners[triangle[corner] as usize]);
                *area_of = if corners.iter().all(|&corner| is_usable(corner)) { area(corners) } else { 0.0 };
            }
        }
        self.sources.pack(&areas)
    }
}
