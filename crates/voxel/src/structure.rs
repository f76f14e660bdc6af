//! Implementation of voxels with axis A-buffers as a structure.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, Design, Parts, Pooled, bin_groups};
use rasray_ads::{
    AdsError, Dependencies, GeometryExtent, ListCounts, RecordLayout, SceneBinding, Sizes, StructureKind,
    StructureReport, Viewpoint,
};
use rasray_gpu::{BindingSet, Recorder, Requirements};
use rasray_shaders_glsl::constants::voxel::VOXEL_REFINEMENTS;

use crate::build::Build;
use crate::layout::{Demand, first_plan, formula_bytes, levels, plan, scratch, widest_view};
use crate::{
    Accept, Config, Contents, Coverage, Header, Leaves, March, Pool, Storage, Traversal, well_formed,
};

/// Number of lists of maximum length for which a ray gets rounds.
const LONG_LISTS_PER_RAY: u32 = 64;

/// A voxel grid over three axis A-buffers, made from a [`Config`].
pub type Voxels = Pooled<Build>;

/// Returns the header that the next build starts from.
fn first_header(parts: &Parts<Config>) -> Header {
    let Parts { config, pools, .. } = parts;
    Header {
        capacity: parts.elements(Pool::Fragments) as u32,
        long_capacity: scratch(config).long_capacity(pools.sizes()) as u32,
        resolution: config.resolution,
        grid: config.grid(),
        samples: config.samples,
        large_capacity: scratch(config).large_capacity(pools.sizes()) as u32,
        node_capacity: parts.elements(Pool::Nodes) as u32,
        levels: levels(config),
        groups: [0, 0, bin_groups(widest_view(config))],
        ..Header::default()
    }
}

impl rasray_ads::kit::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self {
            entries: with("fragments", self.entries, other.entries),
            long_lists: with("long", self.long_lists, other.long_lists),
            large: with("large", self.large, other.large),
            nodes: with("nodes", self.nodes, other.nodes),
        }
    }
}

impl Design for Build {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = "voxel";
    const TITLE: &'static str = "the voxels";
    const BUILD_READS_SCENE: bool = true;
    const CORRUPTED: usize = offset_of!(Header, corrupted);
    const UNSORTED: Option<usize> = Some(offset_of!(Header, unsorted));
    const RECORDS: &'static [RecordLayout] = &[Header::LAYOUT];

    fn kind(config: &Config) -> StructureKind {
        match config.coverage {
            Coverage::Conservative => StructureKind::Primitive,
            Coverage::Exact | Coverage::Hardware => StructureKind::Fragment,
        }
    }

    fn depends_on(_config: &Config) -> Dependencies {
        Dependencies::default()
    }

    fn requirements(config: &Config) -> Requirements {
        config.builder.requirements()
    }

    fn constants(config: &Config) -> Vec<(u32, u32)> {
        config.constants()
    }

    fn first_plan(config: &Config, _extent: &GeometryExtent) -> Result<Sizes, AdsError> {
        first_plan(config)
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

    fn first_header(&mut self, parts: &Parts<Config>, _viewpoint: Viewpoint) -> Result<Header, AdsError> {
        Ok(first_header(parts))
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        self.record(recorder, &parts.config, parts.target(scene));
    }

    fn asked(&self, _parts: &Parts<Config>, header: &Header) -> Demand {
        Demand {
            entries: header.demand.into(),
            long_lists: header.long_demand.into(),
            large: header.large_demand.into(),
            nodes: header.node_demand.into(),
        }
    }

    fn capacity(config: &Config, sizes: &Sizes, _extent: &GeometryExtent) -> Demand {
        Demand {
            entries: sizes.elements_of(Pool::Fragments),
            long_lists: scratch(config).long_capacity(sizes),
            large: scratch(config).large_capacity(sizes),
            nodes: sizes.elements_of(Pool::Nodes),
        }
    }

    fn varies(config: &Config, name: &str) -> bool {
        // The number of pages varies with the order of threads.
        name == "fragments" && config.storage == Storage::Paged
    }

    fn ample_rounds(parts: &Parts<Config>, header: &Header) -> u32 {
        let config = &parts.config;
        // Work of a ray: the cells of three views, the voxels, and lists. With bisection the lists count as
        // one that holds every triangle, else as LONG_LISTS_PER_RAY lists of maximum length. Parity without
        // bisection reads a list at each of its points: the entry of the voxel, its steps, the halvings, and
        // the nearest fragment.
        let budget = u64::from(parts.work_budget);
        let looked_up = match config.traversal {
            Traversal::Dda => 1,
            Traversal::Octree => 1 + u64::from(levels(config)),
        };
        let steps = 12 * u64::from(config.resolution) + 6 * looked_up * u64::from(config.grid());
        let points = match (config.accept, config.march) {
            (Accept::Plane, _) => 1,
            (Accept::Parity, March::Samples) => 1 + u64::from(config.samples),
            (Accept::Parity, March::Exact) => 2,
        };
        let parity = config.accept == Accept::Parity && !config.bisects();
        let reads = if parity { points + u64::from(VOXEL_REFINEMENTS) + 1 } else { 1 };
        let triangles = parts.geometry.triangle_count();
        if config.leaves == Leaves::Voxels {
            // A voxel that is a leaf has one triangle.
            return 16 + (2 * steps).div_ceil(budget) as u32;
        }
        let longest = match config.bisects() {
            true => triangles,
            false => header.longest.saturating_mul(LONG_LISTS_PER_RAY).min(triangles),
        };
        let entries = reads * u64::from(longest);
        16 + (steps + entries).div_ceil(budget).min(u64::from(u32::MAX) - 16) as u32
    }

    fn report(parts: &Parts<Config>, header: &Header, asked: &Demand) -> StructureReport {
        let formula = formula_bytes(&parts.config, *asked);
        StructureReport {
            options: parts.config.options(),
            paths: parts.config.paths(),
            formula_bytes: formula.total(),
            diagnostic_bytes: formula.ids,
            stored: (parts.config.leaves == Leaves::Fragments).then_some(header.fragments.into()),
            ..StructureReport::default()
        }
    }

    fn fault(contents: &Contents, triangles: u32) -> Option<String> {
        well_formed(contents, triangles).err().map(|fault| fault.to_string())
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
        for config in [Config::robust(64), Config::published_hu(64)] {
            let sizes = Build::first_plan(&config, &extent).expect("options are in range");
            // The capacity of these pools, expressed as a demand, has to plan these pools again.
            let capacity = Build::capacity(&config, &sizes, &extent);
            assert_eq!(Build::plan(&config, &capacity).expect("options are in range"), sizes, "{config:?}");
        }
    }
}
