//! Implementation of the driver's tree as a structure.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, Design, Parts, Pooled, box_is_same};
use rasray_ads::{
    AdsError, Dependencies, GeometryExtent, RecordLayout, SceneBinding, Sizes, StructureKind,
    StructureReport, Viewpoint,
};
use rasray_gpu::{
    Access, BindingSet, ComputePipeline, Device, DriverTree, DriverTreeDesc, Feature, Recorder, Requirements,
    Stage,
};

use crate::layout::{Demand, formula_bytes, plan};
use crate::{Config, Contents, Header, Pool, well_formed};

/// Structure with the driver's tree over boxes of triangles, made from a [`Config`].
pub type Driver = Pooled<Passes>;

/// Pipelines of the build and the tree, which are the design of [`Driver`].
#[derive(Debug)]
pub struct Passes {
    boxes: ComputePipeline,
    status: ComputePipeline,
    /// Tree over as many boxes as the pool holds; made when a build is prepared.
    tree: Option<DriverTree>,
}

impl rasray_ads::kit::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self { triangles: with("boxes", self.triangles, other.triangles) }
    }
}

impl Design for Passes {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = "driver";
    const TITLE: &'static str = "the driver's tree";
    const BUILD_READS_SCENE: bool = false;
    const CORRUPTED: usize = offset_of!(Header, corrupted);
    const RECORDS: &'static [RecordLayout] = &[Header::LAYOUT];
    const HAS_SURFACES_OF_TRIANGLES: bool = true;

    fn kind(_config: &Config) -> StructureKind {
        StructureKind::Primitive
    }

    fn depends_on(_config: &Config) -> Dependencies {
        Dependencies { eye: true, camera: false }
    }

    /// Returns true if the eye has moved so that the boxes are stale. Boxes depend on the eye only through a
    /// margin for an eye far away.
    fn is_stale(parts: &Parts<Config>, built: Viewpoint, wanted: Viewpoint) -> bool {
        !box_is_same(&parts.extent(), built, wanted)
            && Self::depends_on(&parts.config).are_stale(built, wanted)
    }

    fn requirements(_config: &Config) -> Requirements {
        let mut requirements = Requirements::compute();
        requirements.required.extend([
            Feature::BufferDeviceAddress,
            Feature::AccelerationStructure,
            Feature::RayQuery,
        ]);
        requirements
    }

    fn constants(_config: &Config) -> Vec<(u32, u32)> {
        Vec::new()
    }

    fn first_plan(config: &Config, extent: &GeometryExtent) -> Result<Sizes, AdsError> {
        plan(config, &Demand { triangles: extent.triangle_count.into() })
    }

    fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
        plan(config, demand)
    }

    fn plan_for(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Result<Option<Sizes>, AdsError> {
        let wanted = Self::first_plan(config, extent)?;
        Ok(wanted.exceed(sizes).then_some(wanted))
    }

    fn make(
        pipelines: &BuildPipelines<'_>,
        _config: &Config,
        _scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Ok(Self {
            boxes: pipelines.compute("build_1_boxes")?,
            status: pipelines.compute("build_3_status")?,
            tree: None,
        })
    }

    fn prepare(&mut self, parts: &mut Parts<Config>, device: &Device) -> Result<(), AdsError> {
        let boxes = parts.elements(Pool::Boxes) as u32;
        if self.tree.as_ref().is_none_or(|tree| tree.boxes() != boxes) {
            let desc = DriverTreeDesc { name: "driver tree", boxes, goal: parts.config.goal.into() };
            self.tree = Some(device.create_driver_tree(&desc)?);
        }
        Ok(())
    }

    fn first_header(&mut self, parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
        let tree = self.tree.as_ref().ok_or(AdsError::NotPrepared { structure: Self::NAME })?.address();
        Ok(Header {
            capacity: parts.elements(Pool::Boxes) as u32,
            eye: viewpoint.eye,
            tree: [tree as u32, (tree >> 32) as u32],
            ..Header::default()
        })
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        let target = parts.target(scene);
        let Some(tree) = &self.tree else {
            return recorder.refuse("the build of the driver's tree was not prepared");
        };
        target.record_header(recorder, "driver/build_0_header", &[] as &[Pool], Access::COMPUTE);
        // The tree may have fewer boxes than there are triangles; the status then reports that they do not
        // fit.
        let boxes = parts.geometry.triangle_count().min(tree.boxes());
        let pass = &self.boxes;
        target.items_pass(recorder, "driver/build_1_boxes", pass, boxes.into(), 0, Access::TREE_BUILD);
        recorder.begin_pass(Stage::Build, "driver/build_2_tree");
        recorder.build_driver_tree(tree, parts.pools.pool(Pool::Boxes), boxes);
        recorder.end_pass();
        target.status_pass(recorder, "driver/build_3_status", &self.status);
    }

    fn keep(&self, recorder: &mut Recorder<'_>) {
        if let Some(tree) = &self.tree {
            recorder.keep_driver_tree(tree);
        }
    }

    fn asked(&self, parts: &Parts<Config>, _header: &Header) -> Demand {
        Demand { triangles: parts.geometry.triangle_count().into() }
    }

    fn capacity(_config: &Config, sizes: &Sizes, _extent: &GeometryExtent) -> Demand {
        Demand { triangles: sizes.elements_of(Pool::Boxes) }
    }

    fn ample_rounds(parts: &Parts<Config>, _header: &Header) -> u32 {
        parts.rounds_with_distant_rays()
    }

    fn bytes_outside_of_pools(&self) -> Vec<(&'static str, u64)> {
        let of = |bytes: fn(&DriverTree) -> u64| self.tree.as_ref().map_or(0, bytes);
        vec![("tree", of(DriverTree::bytes)), ("tree scratch", of(DriverTree::scratch_bytes))]
    }

    fn report(parts: &Parts<Config>, _header: &Header, asked: &Demand) -> StructureReport {
        StructureReport {
            options: parts.config.options(),
            formula_bytes: formula_bytes(asked),
            stored: Some(asked.triangles),
            ..StructureReport::default()
        }
    }

    fn fault(contents: &Contents, triangles: u32) -> Option<String> {
        well_formed(contents, triangles).err().map(|fault| fault.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Goal;

    const BOUNDS: [[f32; 3]; 2] = [[0.0; 3], [4.0, 2.0, 1.0]];

    #[test]
    fn pools_are_planned_without_a_device() {
        let extent = GeometryExtent::new(1_000, BOUNDS);
        for config in [Config::new(), Config { goal: Goal::Build, ..Config::new() }] {
            let sizes = Passes::first_plan(&config, &extent).expect("options are in range");
            // The capacity of these pools, expressed as a demand, has to plan these pools again.
            let capacity = Passes::capacity(&config, &sizes, &extent);
            assert_eq!(Passes::plan(&config, &capacity).expect("options are in range"), sizes, "{config:?}");
            let of = |triangles| {
                let extent = GeometryExtent::new(triangles, BOUNDS);
                Passes::plan_for(&config, &sizes, &extent).expect("options are in range")
            };
            assert_eq!([0, 1, 500, 1_000].map(of), [const { None }; 4], "{config:?}");
            assert!(of(2_000).is_some_and(|larger| larger.exceed(&sizes)), "{config:?}");
        }
    }
}
