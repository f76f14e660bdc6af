//! Bounds of geometries, computed on the device.

use std::mem::offset_of;

use rasray_gpu::{Access, ComputePipeline, Device, Recorder, Stage};
use rasray_shaders_glsl::records::GeometryGatherConstants;
use rasray_shaders_glsl::{
    ADS_GEOMETRY_BOUNDS, ADS_GEOMETRY_BOUNDS_END, ADS_GEOMETRY_BOUNDS_GATHERED, ADS_GEOMETRY_BOUNDS_UNITE,
};

use crate::geometry::BINDINGS;
use crate::geometry::gather::{GATHER_BINDINGS, pipeline};
use crate::{AdsError, Geometry, GeometryHeader, GeometryParts};

/// Bytes of the integer keys of one corner of the bounds.
const KEY_BYTES: u64 = size_of::<[u32; 3]>() as u64;

/// Computes the bounds of geometries on the device, for positions that the device moved.
#[derive(Debug)]
pub struct BoundsPass {
    measure: ComputePipeline,
    /// Measures the bounds from indices before they are gathered.
    measure_gathered: ComputePipeline,
    end: ComputePipeline,
    unite: ComputePipeline,
}

impl BoundsPass {
    /// Makes the pipelines, which serve every geometry of the device.
    ///
    /// # Errors
    /// The device refuses a pipeline.
    pub fn new(device: &Device) -> Result<Self, AdsError> {
        let layout = device.create_set_layout("geometry", BINDINGS)?;
        let gathered = device.create_set_layout("geometry gather", GATHER_BINDINGS)?;
        let parts = GeometryParts::layout(device)?;
        let pushed = size_of::<GeometryGatherConstants>();
        Ok(Self {
            measure: pipeline(device, &ADS_GEOMETRY_BOUNDS, &[&layout], 0)?,
            measure_gathered: pipeline(device, &ADS_GEOMETRY_BOUNDS_GATHERED, &[&layout, &gathered], pushed)?,
            end: pipeline(device, &ADS_GEOMETRY_BOUNDS_END, &[&layout], 0)?,
            unite: pipeline(device, &ADS_GEOMETRY_BOUNDS_UNITE, &[&layout, &parts], 0)?,
        })
    }

    /// Records the computation of the bounds of a geometry of which only parts moved. It reads the triangles
    /// of the moving parts alone for their bounds, and unites these with the bounds that the static part's
    /// header states into those of the whole. Otherwise it does the same as [`BoundsPass::record`].
    pub fn record_parts(&self, recorder: &mut Recorder<'_>, parts: &GeometryParts) {
        for part in &parts.parts()[1..] {
            self.record(recorder, part);
        }
        recorder.begin_pass(Stage::Pose, "ads/geometry_bounds_unite");
        parts.record_unite(recorder, &self.unite);
        recorder.end_pass();
    }

    /// Records the computation of the bounds of all triangles, in two dispatches that read every triangle
    /// once, into the header on the device; a further dispatch counts the triangles if only the device knows
    /// their number. Positions and indices must be visible to compute shaders before; the bounds are visible
    /// to all commands that follow. Indices that builds gather are read at their source, since the build that
    /// follows gathers them. Corners that are not finite are ignored; the check of a build counts triangles
    /// with infinite corners.
    pub fn record(&self, recorder: &mut Recorder<'_>, geometry: &Geometry) {
        let [lower, upper] = [offset_of!(GeometryHeader, lower_keys), offset_of!(GeometryHeader, upper_keys)]
            .map(|at| at as u64);
        recorder.begin_pass(Stage::Pose, "ads/geometry_bounds");
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
        recorder.fill(geometry.header(), lower, KEY_BYTES, u32::MAX);
        recorder.fill(geometry.header(), upper, KEY_BYTES, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        geometry.record_count(recorder);
        if geometry.record_measure(recorder, &self.measure, &self.measure_gathered) {
            recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        }
        geometry.record(recorder, &self.end, None, &[], [1; 3]);
        recorder.barrier(Access::COMPUTE_WRITE, Access::ALL);
        recorder.end_pass();
    }
}
