//! Definition of one structure: the part that it shares with no other.

use std::fmt;

use bytemuck::Pod;
use rasray_gpu::{BindingSet, ComputePipeline, Device, Recorder, Requirements};
use rasray_shaders_glsl::constants::contract::TRACE_WORK_BUDGET;

use crate::kit::{BuildPipelines, BuildTarget, Configured, PoolContents, PoolName, Pools};
use crate::{
    AdsError, Dependencies, Geometry, GeometryExtent, ListCounts, RecordLayout, SceneBinding, Sizes,
    StructureKind, StructureReport, Viewpoint,
};

/// Work units that a ray may spend in a dispatch where the device is not a CPU: nearly every ray needs one
/// dispatch then, and those that follow find no ray. A dispatch still ends long before a driver gives the
/// device up.
const HARDWARE_WORK_BUDGET: u32 = 16 * TRACE_WORK_BUDGET;

/// The work budget that structures have on a device unless told otherwise. Software drivers end all loops of
/// a group after 65,535 iterations, others have no such limit. No hit depends on it.
pub fn default_work_budget(device: &Device) -> u32 {
    if device.is_software() { TRACE_WORK_BUDGET } else { HARDWARE_WORK_BUDGET }
}

/// Numbers of elements that only a build counts, and other inputs of planning.
pub trait Demand: Copy {
    /// Calls `with` per counted number: its name in statuses, this number and that of `other`. The result has
    /// what `with` returns in their place.
    #[must_use]
    fn zip(self, other: Self, with: impl FnMut(&'static str, u64, u64) -> u64) -> Self;
}

/// Parts that a structure is made of and works on, except its passes.
#[derive(Debug)]
pub struct Parts<C> {
    /// The configuration.
    pub config: C,
    /// The triangles.
    pub geometry: Geometry,
    /// The pools.
    pub pools: Pools,
    /// Work units that a ray may spend per dispatch.
    pub work_budget: u32,
    /// The pass that works out what of the header follows from bounds and eye.
    pub header_pass: ComputePipeline,
}

impl<C> Parts<C> {
    /// Elements allocated in a pool.
    pub fn elements(&self, pool: impl PoolName) -> u64 {
        self.pools.sizes().elements_of(pool)
    }

    /// Number and bounds of the triangles.
    pub fn extent(&self) -> GeometryExtent {
        self.geometry.extent()
    }

    /// Dispatches in which a ray spends `units` of work.
    pub fn rounds(&self, units: u32) -> u32 {
        units.div_ceil(self.work_budget)
    }

    /// Dispatches in which nearly every ray finishes, long lists apart: 16 with the budget of software
    /// drivers, 2 with that of others.
    pub fn usual_rounds(&self) -> u32 {
        usual_rounds(self.work_budget)
    }

    /// As [`Parts::usual_rounds`] for structures of triangles in cells, which test rays from far outside
    /// against every triangle.
    pub fn rounds_with_distant_rays(&self) -> u32 {
        self.usual_rounds() + 2 * self.rounds(self.geometry.triangle_count())
    }

    /// Triangles, pools and scene that the passes of a build work on.
    pub fn target<'a>(&'a self, scene: Option<&'a BindingSet>) -> BuildTarget<'a> {
        BuildTarget { geometry: &self.geometry, pools: &self.pools, header_pass: &self.header_pass, scene }
    }
}

/// 16 dispatches of the smaller budget. With a larger budget: as many as do the same work, and one more for
/// rays that pause at the end of the last.
fn usual_rounds(work_budget: u32) -> u32 {
    const SMALL: u32 = 16;
    ((SMALL * TRACE_WORK_BUDGET).div_ceil(work_budget) + 1).min(SMALL)
}

/// Definition of one structure: its options, pools, constants and passes. [`Pooled`](crate::kit::Pooled)
/// makes a [`Structure`](crate::Structure) of it. A value holds the pipelines of the build, and data that a
/// build keeps on the host.
pub trait Design: fmt::Debug + Sized + Send + Sync {
    /// Options.
    type Config: Configured + fmt::Debug + Copy + Send + Sync;
    /// Header that shaders start from. Its first word is the status that the last pass of a build writes,
    /// bits `STATUS_*`.
    type Header: Pod + Send + Sync;
    /// The demand of builds.
    type Demand: Demand + Send + Sync;
    /// Its pools.
    type Pool: PoolName<Header = Self::Header>;
    /// Pools on the host, for checks.
    type Contents: PoolContents<Self::Config, Self::Pool>;

    /// [`Description::name`](crate::Description::name); the folder of its shaders, and the prefix of what
    /// they declare.
    const NAME: &'static str;
    /// Name in errors: "the A-buffer".
    const TITLE: &'static str;
    /// True if passes of the build read the scene.
    const BUILD_READS_SCENE: bool;
    /// Byte of the header at which list entries with an invalid index are counted.
    const CORRUPTED: usize;
    /// Byte of the header at which lists too long to be sorted are counted; absent where none is.
    const UNSORTED: Option<usize> = None;
    /// Records that it shares with its shaders, the header first.
    const RECORDS: &'static [RecordLayout];
    /// True if the surface of every hit is `scene_surface` of its triangle.
    const HAS_SURFACES_OF_TRIANGLES: bool = false;

    /// Kind of its hits.
    fn kind(config: &Self::Config) -> StructureKind;

    /// Changes of the viewpoint that make a build stale.
    fn depends_on(config: &Self::Config) -> Dependencies;

    /// As for [`Structure::is_stale`](crate::Structure::is_stale).
    fn is_stale(parts: &Parts<Self::Config>, built: Viewpoint, wanted: Viewpoint) -> bool {
        Self::depends_on(&parts.config).are_stale(built, wanted)
    }

    /// Requirements of a device in addition to those of its modules.
    fn requirements(config: &Self::Config) -> Requirements;

    /// Specialisation constants: id and bits.
    fn constants(config: &Self::Config) -> Vec<(u32, u32)>;

    /// True if it has first hits of camera rays without a trace, by a module `first_hits`.
    fn has_first_hits(_config: &Self::Config) -> bool {
        false
    }

    /// Suffix of the names of the modules that trace.
    fn trace_variant(_config: &Self::Config) -> String {
        String::new()
    }

    /// Specialisation constants of a part that is built in a space of its own.
    const FOLLOWING: &'static [(u32, u32)] = &[];

    /// Place in a header of the linear map of such a part, for surfaces of stored fragments: 36 bytes, the
    /// first of [`GeometryRigid`](crate::GeometryRigid), which each lookup copies.
    const RIGID: Option<usize> = None;

    /// Changes a configuration for a part that is built in a space of its own, so that a build stays while an
    /// affine map moves the part ([`Geometry::record_map`]): traces are those of the variant `.rigid`. False,
    /// and no change, where traces cannot follow.
    fn follow(_config: &mut Self::Config, _part: &GeometryExtent) -> bool {
        false
    }

    /// The sizes to begin with, before anything has been counted.
    ///
    /// # Errors
    /// An option is out of range, or a pool has more elements than 32-bit indices can address.
    fn first_plan(config: &Self::Config, extent: &GeometryExtent) -> Result<Sizes, AdsError>;

    /// The sizes for a demand.
    ///
    /// # Errors
    /// As [`Design::first_plan`].
    fn plan(config: &Self::Config, demand: &Self::Demand) -> Result<Sizes, AdsError>;

    /// The sizes that new triangles require before the first build, where a build cannot count them itself;
    /// `None`: those that are allocated, `sizes`, suffice.
    ///
    /// # Errors
    /// As [`Design::first_plan`].
    fn plan_for(
        _config: &Self::Config,
        _sizes: &Sizes,
        _extent: &GeometryExtent,
    ) -> Result<Option<Sizes>, AdsError> {
        Ok(None)
    }

    /// Refuses sizes that no build could use.
    ///
    /// # Errors
    /// An option forbids them.
    fn accepts(_config: &Self::Config, _sizes: &Sizes) -> Result<(), AdsError> {
        Ok(())
    }

    /// Makes the pipelines of the build; `scene` is absent where [`Design::BUILD_READS_SCENE`] is false.
    ///
    /// # Errors
    /// The configuration needs a scene and there is none, or the device refuses a pipeline.
    fn make(
        pipelines: &BuildPipelines<'_>,
        config: &Self::Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError>;

    /// True if [`Design::prepare`] works on the triangles.
    fn builds_on_host(_config: &Self::Config) -> bool {
        false
    }

    /// [`Structure::prepare_build`](crate::Structure::prepare_build).
    ///
    /// # Errors
    /// As there.
    fn prepare(&mut self, _parts: &mut Parts<Self::Config>, _device: &Device) -> Result<(), AdsError> {
        Ok(())
    }

    /// Drops what the host keeps of the last build: pools or triangles are others now.
    fn forget(&mut self) {}

    /// The host has read that the build with this header was complete, in the pools that there are.
    fn completed(&self, _header: &Self::Header) {}

    /// Pools were written from outside: nothing that an earlier build left in them can be relied on.
    fn overwritten(&self) {}

    /// The header that the next build starts from: options, capacities, eye. [`Pools::begin`] adds the
    /// addresses. What follows from the bounds of the geometry, which only the device knows, is worked out
    /// there: by the structure's `from_bounds.glsl`.
    ///
    /// # Errors
    /// The viewpoint lacks what the configuration needs, or the build was not prepared.
    fn first_header(
        &mut self,
        parts: &Parts<Self::Config>,
        viewpoint: Viewpoint,
    ) -> Result<Self::Header, AdsError>;

    /// Records all passes.
    fn record_passes(
        &self,
        recorder: &mut Recorder<'_>,
        parts: &Parts<Self::Config>,
        scene: Option<&BindingSet>,
    );

    /// Keeps what traces use beside the pools alive until the device is done with a recording.
    fn keep(&self, _recorder: &mut Recorder<'_>) {}

    /// The demand of the last build.
    fn asked(&self, parts: &Parts<Self::Config>, header: &Self::Header) -> Self::Demand;

    /// The capacity of pools of these sizes for that geometry, in the terms of the demand.
    fn capacity(config: &Self::Config, sizes: &Sizes, extent: &GeometryExtent) -> Self::Demand;

    /// True if the demand of that name varies slightly with the order in which threads run: by one in
    /// [`VARYING_SHARE`](crate::kit::VARYING_SHARE).
    fn varies(_config: &Self::Config, _name: &str) -> bool {
        false
    }

    /// Rounds in which nearly every ray finishes; `header` is that of the last build, and zeros before the
    /// first.
    fn first_rounds(parts: &Parts<Self::Config>, header: &Self::Header) -> u32;

    /// Rounds in which every ray finishes; absent where a ray may have to read everything that is stored.
    fn most_rounds(_parts: &Parts<Self::Config>) -> Option<u32> {
        None
    }

    /// Elements of a pool that are in use: what is planned for the demand, unless a build uses less. Absent
    /// where nothing can be planned for it.
    fn used(parts: &Parts<Self::Config>, asked: &Self::Demand, pool: Self::Pool) -> Option<u64> {
        Some(Self::plan(&parts.config, asked).ok()?.elements_of(pool))
    }

    /// Bytes allocated beside the pools, by part.
    fn bytes_outside_of_pools(&self) -> Vec<(&'static str, u64)> {
        Vec::new()
    }

    /// The report, but for [`StructureReport::bytes_by_part`].
    fn report(parts: &Parts<Self::Config>, header: &Self::Header, asked: &Self::Demand) -> StructureReport;

    /// The first fault of the pools after a build over that number of triangles, in words; absent where they
    /// are whole.
    fn fault(contents: &Self::Contents, triangles: u32) -> Option<String>;

    /// [`Inspect::list_counts`](crate::Inspect::list_counts) of a complete build.
    ///
    /// # Errors
    /// A fault of the lists, in words.
    fn list_counts(_contents: &Self::Contents) -> Result<Vec<ListCounts>, String> {
        Ok(Vec::new())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_follow_the_budget() {
        assert_eq!([1, 64, TRACE_WORK_BUDGET].map(usual_rounds), [16; 3]);
        assert_eq!(usual_rounds(HARDWARE_WORK_BUDGET), 2);
        assert_eq!(usual_rounds(u32::MAX), 2);
    }
}
