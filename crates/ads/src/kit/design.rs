//! Definition of a structure: the code that it shares with no other structure.

use std::fmt;

use bytemuck::Pod;
use rasray_gpu::{BindingSet, ComputePipeline, Device, Recorder, Requirements};
use rasray_shaders_glsl::constants::contract::TRACE_WORK_BUDGET;

use crate::kit::{BuildPipelines, BuildTarget, Configured, PoolContents, PoolName, Pools};
use crate::{
    AdsError, Dependencies, Geometry, GeometryExtent, ListCounts, RecordLayout, SceneBinding, Sizes,
    StructureKind, StructureReport, Viewpoint,
};

/// Work units that a ray may spend in a dispatch on a device that is not a CPU: nearly every ray then needs
/// one dispatch, and the dispatches that follow find no ray. A dispatch still ends long before a driver
/// declares the device lost.
const HARDWARE_WORK_BUDGET: u32 = 16 * TRACE_WORK_BUDGET;

/// Number of rounds that traces record at first. Few rays need a second one, and a round takes time even if
/// no ray is left: on a software driver as long as hundreds of rays.
pub const FIRST_ROUNDS: u32 = 2;

/// Returns the default work budget of structures on a device. Software drivers end all loops of a group after
/// 65,535 iterations; other drivers have no such limit. The budget does not change any hit.
pub fn default_work_budget(device: &Device) -> u32 {
    if device.is_software() { TRACE_WORK_BUDGET } else { HARDWARE_WORK_BUDGET }
}

/// Returns true if a search of a list should find the next entry in a loop of its own on a driver, which
/// changes no hit. Invocations that run together then test together, as a driver needs that runs both sides
/// of every branch. Mesa's software driver does so in version 22; in version 25 it jumps over sides that no
/// invocation takes.
pub(crate) fn nests_searches(driver: &str) -> bool {
    let mesa = driver.strip_prefix("llvmpipe Mesa ").and_then(|version| version.split('.').next());
    mesa.and_then(|major| major.parse().ok()).is_none_or(|major: u32| major < 25)
}

/// Numbers of elements that only a build counts, and other inputs of the planning of sizes.
pub trait Demand: Copy {
    /// Calls `with` once per counted number, with its name in statuses, this number and that of `other`. The
    /// result has the values that `with` returns in their place.
    #[must_use]
    fn zip(self, other: Self, with: impl FnMut(&'static str, u64, u64) -> u64) -> Self;
}

/// Parts of a structure that its design works on, except its passes.
#[derive(Debug)]
pub struct Parts<C> {
    /// Configuration of the structure.
    pub config: C,
    /// Triangles of the structure.
    pub geometry: Geometry,
    /// Pools of the structure.
    pub pools: Pools,
    /// Work units that a ray may spend per dispatch.
    pub work_budget: u32,
    /// Pass that computes the values of the header that follow from bounds and eye.
    pub header_pass: ComputePipeline,
}

impl<C> Parts<C> {
    /// Returns the number of elements allocated in a pool.
    pub fn elements(&self, pool: impl PoolName) -> u64 {
        self.pools.sizes().elements_of(pool)
    }

    /// Returns number and bounds of the triangles.
    pub fn extent(&self) -> GeometryExtent {
        self.geometry.extent()
    }

    /// Returns the number of dispatches in which a ray spends `units` of work.
    pub fn rounds(&self, units: u32) -> u32 {
        units.div_ceil(self.work_budget)
    }

    /// Returns the number of dispatches in which nearly every ray finishes, except in long lists: 16 with the
    /// work budget of software drivers, 2 with that of other drivers.
    pub fn usual_rounds(&self) -> u32 {
        usual_rounds(self.work_budget)
    }

    /// Returns [`Parts::usual_rounds`] plus the rounds of rays from far outside, for structures of triangles
    /// in cells, which test such rays against every triangle.
    pub fn rounds_with_distant_rays(&self) -> u32 {
        self.usual_rounds() + 2 * self.rounds(self.geometry.triangle_count())
    }

    /// Returns the triangles, the pools and the scene that the passes of a build work on.
    pub fn target<'a>(&'a self, scene: Option<&'a BindingSet>) -> BuildTarget<'a> {
        BuildTarget { geometry: &self.geometry, pools: &self.pools, header_pass: &self.header_pass, scene }
    }
}

/// Returns 16 dispatches for the smaller budget. For a larger budget, returns the number of dispatches that
/// do the same work, and one more for rays that pause at the end of the last.
fn usual_rounds(work_budget: u32) -> u32 {
    const SMALL: u32 = 16;
    ((SMALL * TRACE_WORK_BUDGET).div_ceil(work_budget) + 1).min(SMALL)
}

/// Definition of one structure: its options, pools, constants and passes. [`Pooled`](crate::kit::Pooled)
/// implements [`Structure`](crate::Structure) for it. A value holds the pipelines of the build, and data that
/// a build keeps on the host.
pub trait Design: fmt::Debug + Sized + Send + Sync {
    /// Options of the structure.
    type Config: Configured + fmt::Debug + Copy + Send + Sync;
    /// Header that shaders start from. Its first word is the status, bits `STATUS_*`, which the last pass of
    /// a build writes.
    type Header: Pod + Send;
    /// Demand of builds.
    type Demand: Demand;
    /// Pools of the structure.
    type Pool: PoolName<Header = Self::Header>;
    /// Copy of the pools on the host, for checks.
    type Contents: PoolContents<Self::Config, Self::Pool>;

    /// [`Description::name`](crate::Description::name), which is also the folder of the structure's shaders
    /// and the prefix of their declarations.
    const NAME: &'static str;
    /// Name in error messages, such as "the A-buffer".
    const TITLE: &'static str;
    /// True if passes of the build read the scene.
    const BUILD_READS_SCENE: bool;
    /// Byte of the header at which list entries with an invalid index are counted.
    const CORRUPTED: usize;
    /// Byte of the header at which lists too long to be sorted are counted; absent if the structure counts
    /// none.
    const UNSORTED: Option<usize> = None;
    /// Records that the structure shares with its shaders, the header first.
    const RECORDS: &'static [RecordLayout];
    /// True if the surface of every hit is `scene_surface` of its triangle.
    const HAS_SURFACES_OF_TRIANGLES: bool = false;

    /// Returns the kind of the structure's hits.
    fn kind(config: &Self::Config) -> StructureKind;

    /// Returns the changes of the viewpoint that make a build stale.
    fn depends_on(config: &Self::Config) -> Dependencies;

    /// Returns the answer of [`Structure::is_stale`](crate::Structure::is_stale).
    fn is_stale(parts: &Parts<Self::Config>, built: Viewpoint, wanted: Viewpoint) -> bool {
        Self::depends_on(&parts.config).are_stale(built, wanted)
    }

    /// Returns the requirements on a device in addition to those of the structure's modules.
    fn requirements(config: &Self::Config) -> Requirements;

    /// Returns the specialisation constants: id and bits.
    fn constants(config: &Self::Config) -> Vec<(u32, u32)>;

    /// Returns true if the structure has first hits of camera rays without a trace, by a module `first_hits`.
    fn has_first_hits(_config: &Self::Config) -> bool {
        false
    }

    /// Fills in the options that are left open and follow the device.
    fn complete(_device: &Device, _config: &mut Self::Config) {}

    /// Returns the suffix of the names of the modules that trace.
    fn trace_variant(_config: &Self::Config) -> String {
        String::new()
    }

    /// Specialisation constants of a part that is built in a space of its own.
    const FOLLOWING: &'static [(u32, u32)] = &[];

    /// Byte in a header at which surfaces of stored fragments find the linear map of a part that is built in
    /// a space of its own: 36 bytes, the first of [`GeometryRigid`](crate::GeometryRigid), which each lookup
    /// copies.
    const RIGID: Option<usize> = None;

    /// Changes a configuration for a part that is built in a space of its own, so that a build stays valid
    /// while an affine map moves the part ([`Geometry::record_map`]); traces then use the variant `.rigid`.
    /// Returns false, without a change, if traces cannot follow the map.
    fn follow(_config: &mut Self::Config, _part: &GeometryExtent) -> bool {
        false
    }

    /// Returns the initial sizes, before any build has counted its demand.
    ///
    /// # Errors
    /// An option is out of range, or a pool has more elements than 32-bit indices can address.
    fn first_plan(config: &Self::Config, extent: &GeometryExtent) -> Result<Sizes, AdsError>;

    /// Returns the sizes for a demand.
    ///
    /// # Errors
    /// As [`Design::first_plan`].
    fn plan(config: &Self::Config, demand: &Self::Demand) -> Result<Sizes, AdsError>;

    /// Returns the sizes that new triangles require before the first build, if a build cannot count them
    /// itself; `None` if the allocated sizes, `sizes`, suffice.
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
    /// An option forbids the sizes.
    fn accepts(_config: &Self::Config, _sizes: &Sizes) -> Result<(), AdsError> {
        Ok(())
    }

    /// Makes the pipelines of the build; `scene` is absent if [`Design::BUILD_READS_SCENE`] is false.
    ///
    /// # Errors
    /// The configuration needs a scene and there is none, or the device refuses a pipeline.
    fn make(
        pipelines: &BuildPipelines<'_>,
        config: &Self::Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError>;

    /// Returns true if [`Design::prepare`] reads the triangles.
    fn builds_on_host(_config: &Self::Config) -> bool {
        false
    }

    /// Does the host's part of [`Structure::prepare_build`](crate::Structure::prepare_build).
    ///
    /// # Errors
    /// Those of [`Structure::prepare_build`](crate::Structure::prepare_build).
    fn prepare(&mut self, _parts: &mut Parts<Self::Config>, _device: &Device) -> Result<(), AdsError> {
        Ok(())
    }

    /// Drops the data of the last build that the host keeps, because pools or triangles were replaced.
    fn forget(&mut self) {}

    /// Notes that the host has read the header of a build that was complete in the present pools.
    fn completed(&self, _header: &Self::Header) {}

    /// Notes that pools were written from outside: data that an earlier build left in them is no longer
    /// reliable.
    fn overwritten(&self) {}

    /// Returns the header that the next build starts from: options, capacities, eye. [`Pools::begin`] adds
    /// the addresses. The structure's `from_bounds.glsl` computes the values that follow from the bounds of
    /// the geometry, because only the device knows the bounds.
    ///
    /// # Errors
    /// The viewpoint lacks what the configuration needs, or the build was not prepared.
    fn first_header(
        &mut self,
        parts: &Parts<Self::Config>,
        viewpoint: Viewpoint,
    ) -> Result<Self::Header, AdsError>;

    /// Records all passes of the build.
    fn record_passes(
        &self,
        recorder: &mut Recorder<'_>,
        parts: &Parts<Self::Config>,
        scene: Option<&BindingSet>,
    );

    /// Keeps objects that traces use in addition to the pools alive until the device has finished a
    /// recording.
    fn keep(&self, _recorder: &mut Recorder<'_>) {}

    /// Returns the demand of the last build.
    fn asked(&self, parts: &Parts<Self::Config>, header: &Self::Header) -> Self::Demand;

    /// Returns the capacity of pools of these sizes for a geometry of this extent, in the terms of the
    /// demand.
    fn capacity(config: &Self::Config, sizes: &Sizes, extent: &GeometryExtent) -> Self::Demand;

    /// Returns true if the demand with that name varies slightly with the order in which threads run: by one
    /// in [`VARYING_SHARE`](crate::kit::VARYING_SHARE).
    fn varies(_config: &Self::Config, _name: &str) -> bool {
        false
    }

    /// Returns the number of rounds in which nearly every ray finishes, also one with much more work than
    /// others; `header` is that of the last build, and zeros before the first build. A trace records fewer at
    /// first ([`FIRST_ROUNDS`](crate::kit::FIRST_ROUNDS)).
    fn ample_rounds(parts: &Parts<Self::Config>, header: &Self::Header) -> u32;

    /// Returns the number of rounds in which every ray finishes; absent if a ray may have to read every
    /// stored element.
    fn most_rounds(_parts: &Parts<Self::Config>) -> Option<u32> {
        None
    }

    /// Returns the number of elements of a pool that are in use: the planned number for the demand, unless a
    /// build uses fewer. Absent if no sizes can be planned for the demand.
    fn used(parts: &Parts<Self::Config>, asked: &Self::Demand, pool: Self::Pool) -> Option<u64> {
        Some(Self::plan(&parts.config, asked).ok()?.elements_of(pool))
    }

    /// Returns the bytes allocated in addition to the pools, by part.
    fn bytes_outside_of_pools(&self) -> Vec<(&'static str, u64)> {
        Vec::new()
    }

    /// Returns the report, except [`StructureReport::bytes_by_part`].
    fn report(parts: &Parts<Self::Config>, header: &Self::Header, asked: &Self::Demand) -> StructureReport;

    /// Returns the first fault of the pools after a build over that number of triangles, in words; absent if
    /// the pools have no fault.
    fn fault(contents: &Self::Contents, triangles: u32) -> Option<String>;

    /// Returns [`Inspect::list_counts`](crate::Inspect::list_counts) of a complete build.
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

    #[test]
    fn searches_are_nested_unless_the_driver_jumps_over_branches() {
        assert!(nests_searches("llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"));
        assert!(!nests_searches("llvmpipe Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)"));
        assert!(nests_searches("NVIDIA 570.0"));
        assert!(nests_searches("radv Mesa 25.0.7"));
    }
}
