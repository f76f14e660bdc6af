//! A structure over frames, one at a time, and what they record.

use rasray_ads::{Ray, Viewpoint};
use rasray_gpu::PassCommands;
use rasray_tests::harness::{Bench, bits, processor_seconds};
use rasray_tracer::{FrameOutcome, FrameSettings, FrameStructure, Refresh};

/// Work of a frame recorded in passes that structures label.
#[derive(Clone, Copy, Debug, Default)]
pub struct Recorded {
    pub dispatches: u32,
    pub workgroups: u64,
    pub vertices: u64,
}

impl Recorded {
    pub fn of(passes: &[PassCommands]) -> Self {
        let add = |sum: Self, pass: &PassCommands| Self {
            dispatches: sum.dispatches + pass.dispatches + pass.indirect + pass.draws,
            workgroups: sum.workgroups + pass.workgroups,
            vertices: sum.vertices + pass.vertices,
        };
        passes.iter().fold(Self::default(), add)
    }
}

/// A structure over frames, one at a time.
pub struct Kept {
    pub frames: FrameStructure,
}

impl Kept {
    pub fn new(bench: &Bench, structure: impl Into<Refresh>) -> Self {
        let frames =
            FrameStructure::new(bench.device(), structure, FrameSettings::default()).expect("it fits");
        Self { frames }
    }

    /// A frame until it is complete: what its last try recorded.
    pub fn build(&mut self, bench: &Bench, viewpoint: Viewpoint) -> Recorded {
        let device = bench.device();
        for _ in 0..6 {
            self.frames.prepare(device, viewpoint).expect("the device works");
            let submitted = device.submit(|recorder| {
                self.frames.record(recorder, 0, viewpoint).map(|_| Recorded::of(recorder.passes()))
            });
            let recorded = submitted.expect("the device works").value.expect("it is recorded");
            if self.frames.finish(device, 0).expect("sizes suffice") == FrameOutcome::Complete {
                return recorded;
            }
        }
        panic!("the demand does not settle");
    }

    /// Answers bit for bit, nearest and occluded; and cells visited, entries read and triangles tested for
    /// the nearest.
    pub fn answers(&self, bench: &Bench, rays: &[Ray]) -> (Vec<[u32; 4]>, Vec<bool>, [u64; 3]) {
        let structure = self.frames.structure();
        let traced = bench.trace(structure, rays);
        let counters = traced.counters;
        let work = [counters.cells, counters.entries, counters.tests];
        (traced.hits.iter().map(bits).collect(), bench.occluded(structure, rays), work)
    }

    /// Processor time of builds of what moved, one after the other, seconds each.
    pub fn timed(&mut self, bench: &Bench, viewpoint: Viewpoint) -> Option<f64> {
        const BUILDS: u32 = 30;
        let begun = processor_seconds()?;
        for _ in 0..BUILDS {
            self.frames.geometry_moved();
            self.build(bench, viewpoint);
        }
        Some((processor_seconds()? - begun) / f64::from(BUILDS))
    }
}
