//! Implementation of the A-buffer as a structure.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, Design, Parts, Pooled, bin_groups};
use rasray_ads::{
    AdsError, Dependencies, GeometryExtent, ListCounts, RecordLayout, SceneBinding, Sizes, StructureKind,
    StructureReport, Viewpoint,
};
use rasray_gpu::{BindingSet, Recorder, Requirements};
use rasray_shaders_glsl::constants::abuffer::ABUFFER_NEAR_BOX;
use rasray_shaders_glsl::constants::ads::{NEAR_REGION, TRIANGLE_ROUNDING};

use crate::build::Build;
use crate::layout::{Demand, bounds_and_blocks, first_plan, formula_bytes, plan, scratch, widest_view};
use crate::{Config, Contents, Header, March, Pool, Storage, well_formed};

/// A multiview, multilayer A-buffer, made from a [`Config`].
pub type ABuffer = Pooled<Build>;

/// Returns the header that the next build starts from.
///
/// # Errors
/// The configuration has a view of the camera and the viewpoint has no camera.
fn first_header(parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
    let Parts { config, pools, .. } = parts;
    let eye = viewpoint.eye;
    let camera = viewpoint.camera.filter(|camera| config.views.has_camera() && camera.is_valid());
    if config.views.has_camera() && camera.is_none() {
        return Err(AdsError::Option {
            option: "views",
            value: config.views.name().to_owned(),
            expected: "this build has no perspective camera; without one use `cube`",
        });
    }
    let faces = if config.views.has_cube() { config.resolution } else { 0 };
    let (camera_rows, camera_scale, camera_cells, camera_width) =
        camera.map_or_else(Default::default, |camera| {
            let cells = config.camera_cells();
            let side = cells[0].max(cells[1]) as f32;
            let halves = [camera.half_width, camera.half_height];
            let mut rows = camera.rows();
            for axis in 0..2 {
                rows[axis] = rows[axis].map(|x| x * (cells[axis] as f32 / side));
            }
            let width = |axis: usize| 2.0 * halves[axis] / cells[axis] as f32;
            // Points in the camera's view are also rotated and scaled, which doubles their rounding; narrow
            // views scale it further.
            let scale = 2.0 / camera.half_width.min(camera.half_height).min(1.0);
            (rows, scale, scale * side, width(0).max(width(1)))
        });
    let widest = if faces > 0 { (2.0 / faces as f32).max(camera_width) } else { camera_width };
    let scale = if camera.is_some() { camera_scale.max(1.0) } else { 1.0 };
    // Distance that a ray moves sideways between two searches of lists, where steps are widest. The default
    // thickness is half of it.
    let step = match config.march {
        March::Samples => widest.max(2.0 / config.samples as f32),
        March::Dda | March::Exact | March::Pyramid => widest,
    };
    let cells = (faces as f32).max(camera_cells);
    let [camera_x, camera_y, camera_z] = camera_rows;
    let [columns, rows] = config.camera_cells();
    Ok(Header {
        capacity: parts.elements(Pool::Nodes) as u32,
        near_capacity: parts.elements(Pool::Near) as u32,
        long_capacity: scratch(config).long_capacity(pools.sizes()) as u32,
        resolution: config.resolution,
        samples: config.samples,
        thickness: config.thickness.unwrap_or(0.0),
        thickness_per_reach: if config.thickness.is_some() { 0.0 } else { 0.5 * step },
        near_per_reach: cells * if config.has_conservative_lists() { NEAR_REGION } else { ABUFFER_NEAR_BOX },
        rounding_per_reach: if config.has_conservative_lists() { scale * TRIANGLE_ROUNDING } else { 0.0 },
        widest,
        eye,
        camera_cells: if camera.is_some() { columns | rows << 16 } else { 0 },
        camera_x,
        camera_y,
        camera_z,
        triangles: (32 * mark_words(config, pools.sizes())).min(u32::MAX.into()) as u32,
        conservative_capacity: parts.elements(Pool::Conservative) as u32,
        large_capacity: scratch(config).large_capacity(pools.sizes()) as u32,
        groups: [0, 0, bin_groups(widest_view(config))],
        ..Header::default()
    })
}

/// Returns the words of a set of marks of triangles.
fn mark_words(config: &Config, sizes: &Sizes) -> u64 {
    (sizes.elements_of(Pool::Bounds) - bounds_and_blocks(config)) / config.mark_sets()
}

impl rasray_ads::kit::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self {
            nodes: with("nodes", self.nodes, other.nodes),
            near_triangles: with("near", self.near_triangles, other.near_triangles),
            long_lists: with("long", self.long_lists, other.long_lists),
            conservative: with("conservative", self.conservative, other.conservative),
            large: with("large", self.large, other.large),
            triangles: self.triangles,
        }
    }
}

impl Design for Build {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = "abuffer";
    const TITLE: &'static str = "the A-buffer";
    const BUILD_READS_SCENE: bool = true;
    const CORRUPTED: usize = offset_of!(Header, corrupted);
    const UNSORTED: Option<usize> = Some(offset_of!(Header, unsorted));
    const RECORDS: &'static [RecordLayout] = &[Header::LAYOUT];

    fn kind(config: &Config) -> StructureKind {
        if config.is_exact() { StructureKind::Primitive } else { StructureKind::Fragment }
    }

    fn depends_on(config: &Config) -> Dependencies {
        Dependencies { eye: true, camera: config.views.has_camera() }
    }

    fn requirements(config: &Config) -> Requirements {
        config.builder.requirements()
    }

    fn constants(config: &Config) -> Vec<(u32, u32)> {
        config.constants()
    }

    fn has_first_hits(config: &Config) -> bool {
        config.views.has_camera()
    }

    fn trace_variant(config: &Config) -> String {
        config.trace_variant()
    }

    fn first_plan(config: &Config, extent: &GeometryExtent) -> Result<Sizes, AdsError> {
        first_plan(config, extent.triangle_count)
    }

    fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
        plan(config, *demand)
    }

    fn make(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Self::new(pipelines, config, scene)
    }

    fn first_header(&mut self, parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
        first_header(parts, viewpoint)
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        self.record(recorder, &parts.config, parts.target(scene));
    }

    fn asked(&self, parts: &Parts<Config>, header: &Header) -> Demand {
        Demand {
            nodes: header.demand.into(),
            near_triangles: header.near_demand.into(),
            long_lists: header.long_demand.into(),
            triangles: parts.geometry.triangle_count().into(),
            conservative: header.conservative_demand.into(),
            large: header.large_demand.into(),
        }
    }

    fn capacity(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Demand {
        Demand {
            nodes: sizes.elements_of(Pool::Nodes),
            near_triangles: sizes.elements_of(Pool::Near),
            long_lists: scratch(config).long_capacity(sizes),
            triangles: u64::from(extent.triangle_count).max(32 * mark_words(config, sizes)),
            conservative: sizes.elements_of(Pool::Conservative),
            large: scratch(config).large_capacity(sizes),
        }
    }

    fn varies(config: &Config, name: &str) -> bool {
        // The number of pages varies with the order of threads.
        name == "nodes" && config.storage == Storage::Paged
    }

    fn ample_rounds(parts: &Parts<Config>, header: &Header) -> u32 {
        // A single conservative list may hold every triangle, as with a small object in a large world.
        parts.usual_rounds()
            + parts.rounds(header.conservative_demand.min(parts.elements(Pool::Conservative) as u32))
    }

    fn report(parts: &Parts<Config>, header: &Header, asked: &Demand) -> StructureReport {
        let formula = formula_bytes(&parts.config, *asked);
        let fragments = match parts.config.storage {
            Storage::Paged => header.fragments.into(),
            _ => asked.nodes,
        };
        StructureReport {
            options: parts.config.options(),
            paths: parts.config.paths(),
            formula_bytes: formula.total(),
            diagnostic_bytes: formula.ids,
            stored: Some(asked.conservative - u64::from(header.conservative_slices) + fragments),
            lost: Some(header.lost.into()),
            ..StructureReport::default()
        }
    }

    fn fault(contents: &Contents, _triangles: u32) -> Option<String> {
        well_formed(contents).err().map(|fault| fault.to_string())
    }

    fn list_counts(contents: &Contents) -> Result<Vec<ListCounts>, String> {
        contents.list_counts().map_err(|fault| fault.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [[f32; 3]; 2] = [[0.0; 3], [4.0, 2.0, 1.0]];

    #[test]
    fn pools_are_planned_without_a_device() {
        let extent = GeometryExtent::new(1_000, BOUNDS);
        for config in [Config::robust(64), Config::published(64)] {
            let sizes = Build::first_plan(&config, &extent).expect("options are in range");
            // The capacity of these pools, expressed as a demand, has to plan these pools again.
            let capacity = Build::capacity(&config, &sizes, &extent);
            assert_eq!(Build::plan(&config, &capacity).expect("options are in range"), sizes, "{config:?}");
        }
    }
}
