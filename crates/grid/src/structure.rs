//! A grid as a structure.

use std::mem::offset_of;

use rasray_ads::{
    AdsError, BuildPipelines, Dependencies, Design, Geometry, ListCounts, Parts, Pooled, RecordLayout, Scan,
    SceneBinding, Sizes, StructureKind, StructureReport, Viewpoint, bin_groups, box_is_same,
};
use rasray_gpu::{BindingSet, Recorder, Requirements};

use crate::build::Build;
use crate::layout::{Demand, cell_count, first_plan, formula_bytes, plan};
use crate::{Config, Contents, Header, Pool, well_formed};

/// Lists of triangles in cells of one size; made from a [`Config`].
pub type Grid = Pooled<Passes>;

/// Pipelines of the build: the design of [`Grid`].
#[derive(Debug)]
pub struct Passes(Build);

/// Cells along each axis, one where the capacity does not suffice for the geometry; and whether it suffices.
fn cells(parts: &Parts<Config>) -> ([u32; 3], bool) {
    let wanted = parts.config.cells_over(&parts.geometry);
    let fits = cell_count(wanted) <= parts.elements(Pool::Lists);
    (if fits { wanted } else { [1; 3] }, fits)
}

/// Maximum number of iterations of the loops over the cells of a triangle, in all its invocations: a plane has three
/// times the cells of the largest side of the grid, with its margins twice as many, and some of its columns have none.
fn turns(cells: [u32; 3]) -> u64 {
    let [x, y, z] = cells.map(u64::from);
    8 * (x * y).max(y * z).max(z * x)
}

/// The header that the next build starts from.
fn first_header(parts: &Parts<Config>, eye: [f32; 3]) -> Header {
    let (cells, fits) = cells(parts);
    Header {
        capacity: parts.elements(Pool::Entries) as u32,
        cells,
        eye,
        // None where cells do not fit, so that the build is not complete.
        triangle_capacity: if fits { queue_capacity(parts) } else { 0 },
        groups: [0, 0, bin_groups(turns(cells))],
        ..Header::default()
    }
}

/// Triangles that fit into the large-triangle queue, behind the sums of the scan.
fn queue_capacity(parts: &Parts<Config>) -> u32 {
    let sums = Scan::sums(cell_count(parts.config.cells_over(&parts.geometry)));
    parts.elements(Pool::Scratch).saturating_sub(sums) as u32
}

impl rasray_ads::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self { entries: with("entries", self.entries, other.entries), ..self }
    }
}

impl Design for Passes {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = "grid";
    const TITLE: &'static str = "the grid";
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

    /// Cells along the axes have a margin for the eye only where that is far away.
    fn is_stale(parts: &Parts<Config>, built: Viewpoint, wanted: Viewpoint) -> bool {
        !box_is_same(&parts.geometry, built, wanted)
            && Self::depends_on(&parts.config).are_stale(built, wanted)
    }

    fn requirements(_config: &Config) -> Requirements {
        Requirements::compute()
    }

    fn constants(_config: &Config) -> Vec<(u32, u32)> {
        Vec::new()
    }

    fn first_plan(config: &Config, geometry: &Geometry) -> Result<Sizes, AdsError> {
        first_plan(config, geometry.triangle_count(), config.cells_over(geometry))
    }

    fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
        plan(config, demand)
    }

    fn plan_for(parts: &Parts<Config>, geometry: &Geometry) -> Result<Option<Sizes>, AdsError> {
        let (triangles, cells) = (geometry.triangle_count().into(), parts.config.cells_over(geometry));
        let sizes = plan(&parts.config, &Demand { triangles, cells, ..Self::capacity(parts) })?;
        Ok(sizes.exceed(parts.pools.sizes()).then_some(sizes))
    }

    fn make(
        pipelines: &BuildPipelines<'_>,
        _config: &Config,
        _scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Build::new(pipelines).map(Self)
    }

    fn first_header(&mut self, parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
        Ok(first_header(parts, viewpoint.eye))
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        self.0.record(recorder, cell_count(cells(parts).0), parts.target(scene));
    }

    fn asked(&self, parts: &Parts<Config>, header: &Header) -> Demand {
        Demand { entries: header.demand.into(), ..Self::capacity(parts) }
    }

    fn capacity(parts: &Parts<Config>) -> Demand {
        Demand {
            entries: parts.elements(Pool::Entries),
            triangles: parts.geometry.triangle_count().into(),
            cells: parts.config.cells_over(&parts.geometry),
        }
    }

    fn first_rounds(parts: &Parts<Config>, _header: &Header) -> u32 {
        parts.rounds_with_distant_rays()
    }

    fn report(parts: &Parts<Config>, _header: &Header, asked: &Demand) -> StructureReport {
        StructureReport {
            options: parts.config.options(asked.cells),
            paths: parts.config.paths(),
            formula_bytes: formula_bytes(asked).total(),
            stored: Some(asked.entries),
            ..StructureReport::default()
        }
    }

    fn fault(contents: &Contents, triangles: u32) -> Option<String> {
        well_formed(contents, triangles).err().map(|fault| fault.to_string())
    }

    fn list_counts(contents: &Contents) -> Result<Vec<ListCounts>, String> {
        Ok(vec![contents.list_counts().map_err(|fault| fault.to_string())?])
    }
}
