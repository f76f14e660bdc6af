//! Implementation of primitive lists as a structure.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, Design, Parts, Pooled};
use rasray_ads::{
    AdsError, CameraView, Dependencies, GeometryExtent, ListCounts, RecordLayout, SceneBinding, Sizes,
    StructureKind, StructureReport, Viewpoint,
};
use rasray_gpu::{BindingSet, Feature, Recorder, Requirements};

use crate::build::Build;
use crate::layout::{Demand, bin_groups, first_plan, formula_bytes, plan};
use crate::{Centre, Config, Contents, Coverage, Header, Pool, Views, well_formed};

/// Structure with lists of triangles per tile and depth bucket, made from a [`Config`].
pub type PrimitiveLists = Pooled<Passes>;

/// Pipelines of the build, which are the design of [`PrimitiveLists`].
#[derive(Debug)]
pub struct Passes(Build);

/// Returns the camera columns of the header, which give metres along the axes of the camera's view; zeros if
/// the configuration does not draw this view.
///
/// # Errors
/// The configuration draws the camera's view and the viewpoint has no valid camera.
fn camera_columns(config: &Config, viewpoint: Viewpoint) -> Result<[[f32; 3]; 3], AdsError> {
    if config.views == Views::Cube {
        return Ok([[0.0; 3]; 3]);
    }
    let camera = viewpoint.camera.filter(CameraView::is_valid).ok_or_else(|| AdsError::Option {
        option: "views",
        value: "camera".to_owned(),
        expected: "this build has no perspective camera; without one use `cube`",
    })?;
    let [right, up, forward] = camera.rows();
    // Face 0 looks along the first axis, so `forward` comes first.
    Ok([0, 1, 2].map(|axis| [forward[axis], right[axis], up[axis]]))
}

/// Returns the header that the next build starts from.
fn first_header(parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
    let config = &parts.config;
    let [camera_x, camera_y, camera_z] = camera_columns(config, viewpoint)?;
    Ok(Header {
        capacity: parts.elements(Pool::Entries) as u32,
        near_capacity: parts.elements(Pool::Near) as u32,
        tiles: config.tiles(),
        tile: config.tile,
        eye: viewpoint.eye,
        camera_x,
        camera_y,
        camera_z,
        large_capacity: parts.elements(Pool::Large) as u32,
        groups: [0, 0, bin_groups(config)],
        ..Header::default()
    })
}

impl rasray_ads::kit::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self {
            entries: with("entries", self.entries, other.entries),
            near: with("near", self.near, other.near),
            ..self
        }
    }
}

impl Design for Passes {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = "primitive";
    const TITLE: &'static str = "the primitive lists";
    const BUILD_READS_SCENE: bool = false;
    const CORRUPTED: usize = offset_of!(Header, corrupted);
    const RECORDS: &'static [RecordLayout] = &[Header::LAYOUT];
    const HAS_SURFACES_OF_TRIANGLES: bool = true;

    fn kind(config: &Config) -> StructureKind {
        if config.is_exact() { StructureKind::Primitive } else { StructureKind::LossyPrimitive }
    }

    fn depends_on(config: &Config) -> Dependencies {
        Dependencies { eye: config.centre() != Centre::Fixed, camera: config.views == Views::Camera }
    }

    fn requirements(config: &Config) -> Requirements {
        let mut requirements = config.builder.requirements();
        if config.coverage == Coverage::ConservativeExtension {
            requirements.required.push(Feature::ConservativeRasterization);
        }
        requirements
    }

    fn constants(config: &Config) -> Vec<(u32, u32)> {
        config.constants()
    }

    fn first_plan(config: &Config, extent: &GeometryExtent) -> Result<Sizes, AdsError> {
        first_plan(config, extent.triangle_count)
    }

    fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
        plan(config, demand)
    }

    fn plan_for(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Result<Option<Sizes>, AdsError> {
        let wanted = plan(config, &Self::capacity(config, sizes, extent))?;
        Ok(wanted.exceed(sizes).then_some(wanted))
    }

    fn make(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        _scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Build::new(pipelines, config).map(Self)
    }

    fn first_header(&mut self, parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
        first_header(parts, viewpoint)
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        self.0.record(recorder, &parts.config, parts.target(scene));
    }

    fn asked(&self, parts: &Parts<Config>, header: &Header) -> Demand {
        Demand {
            entries: header.demand.into(),
            near: header.near_demand.into(),
            triangles: parts.geometry.triangle_count().into(),
        }
    }

    fn capacity(_config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Demand {
        Demand {
            entries: sizes.elements_of(Pool::Entries),
            near: sizes.elements_of(Pool::Near),
            triangles: extent.triangle_count.into(),
        }
    }

    fn ample_rounds(parts: &Parts<Config>, _header: &Header) -> u32 {
        parts.rounds_with_distant_rays()
    }

    fn report(parts: &Parts<Config>, _header: &Header, asked: &Demand) -> StructureReport {
        StructureReport {
            options: parts.config.options(),
            paths: parts.config.paths(),
            formula_bytes: formula_bytes(&parts.config, asked).total(),
            stored: Some(asked.entries),
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
        for config in [Config::robust(64), Config { buckets: 1, ..Config::robust(64) }] {
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
