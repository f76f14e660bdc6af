//! Traces bricks within the frames of a host that has its own buffers, two frames in flight, triangles that
//! move, and a compute shader that traces on the spot. Compares every frame with brute force.

use std::path::Path;

use rasray_ads::{BruteForce, Domain, Geometry, Hit, InlineTrace, Ray, RayQueue, Structure, Trace};
use rasray_bricks::{Bricks, Config, Views};
use rasray_gpu::{Access, Device, Recorded, Recorder, vk};
use rasray_shader_compiler::{Module, compile};
use rasray_tracer::{FrameOutcome, FrameSettings, FrameStructure};

#[path = "../../ads/examples/host/mod.rs"]
mod host;

use host::{FRAMES, Host, HostBuffer, Mesh, Result, staircase};

/// Pixels along a side of the image, as in `inline.comp`.
const SIDE: u32 = 32;

/// Number of frames that the program submits.
const COUNT: usize = 12;
/// Maximum number of builds of the first frame; a demand that is not met by then counts as not stable.
const BUILDS: u32 = 9;

/// Buffers and recorded resources of one frame in flight.
struct Slot {
    positions: HostBuffer,
    geometry: Geometry,
    /// Hits that the host's shader finds.
    found: HostBuffer,
    pipeline: (vk::Pipeline, vk::PipelineLayout, vk::DescriptorSet),
    reference: BruteForce,
    rays: RayQueue,
    /// Hits that brute force finds.
    expected: HostBuffer,
    /// Resources that the device may still use.
    recorded: Option<Recorded>,
}

/// Runs the program; returns an error where hits differ, a frame was not complete or the validation layer
/// complains.
pub fn main() -> Result<()> {
    let config = Config::new(Views::Axes);
    let enabled = Bricks::requirements_of(&config).required;
    let host = Host::new(&enabled)?;
    // SAFETY: the host made the device with these features, and the host is dropped last.
    let device = unsafe { Device::from_raw(host.raw_device(&enabled)) }?;
    let mut mesh = staircase(200);
    // The bounds have to contain the mesh in all frames.
    mesh.bounds[1][0] += 1.0;
    let shader = Module { entry: "inline.comp", defines: &[] };
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let spirv = compile(&[&own, Path::new(rasray_shaders_glsl::ROOT)], &shader)?;
    let first = host.geometry(&device, &mesh, host.buffer(&mesh.positions)?)?;
    let bricks = Box::new(Bricks::new(&device, config, &first, None)?);
    // Pools have half as much again as a frame needs, since later frames may need a little more.
    let mut bricks =
        FrameStructure::new(&device, bricks, FrameSettings { slots: FRAMES as u32, headroom: 50 })?;
    let mut slots = Vec::new();
    for _ in 0..FRAMES {
        slots.push(Slot::new(&host, &device, &mesh, &bricks, &spirv)?);
    }
    let complete = frames(&host, &device, &mesh, &mut bricks, &mut slots);
    // The host waits after an error too: slots may be dropped only when the device no longer uses them.
    host.wait_for_all()?;
    let complete = complete?;
    println!("{complete} of {COUNT} frames were complete");
    if complete == COUNT { Ok(()) } else { Err("a frame was not complete".into()) }
}

/// Repeats the first frame until its pools suffice, while the program loads. The program waits for no other
/// frame.
fn load(host: &Host, device: &Device, bricks: &mut FrameStructure, slot: &mut Slot) -> Result<()> {
    let mut lacking = None;
    for _ in 0..BUILDS {
        slot.submit(host, device, 0, bricks)?;
        host.wait(0)?;
        match slot.finish(host, device, 0, bricks)? {
            Some(FrameOutcome::Incomplete { pool }) => lacking = pool,
            Some(FrameOutcome::Complete) | None => return Ok(()),
        }
    }
    let lacking = lacking.map(|pool| format!(": {pool}")).unwrap_or_default();
    Err(format!(
        "bricks are still incomplete after {BUILDS} builds{lacking}; keep them with more headroom, or choose fewer cells"
    )
    .into())
}

/// Runs the loop of the host, and returns the number of complete frames.
fn frames(
    host: &Host,
    device: &Device,
    mesh: &Mesh,
    bricks: &mut FrameStructure,
    slots: &mut [Slot],
) -> Result<usize> {
    load(host, device, bricks, &mut slots[0])?;
    let mut complete = 0;
    for frame in 0..COUNT + FRAMES {
        let (number, slot) = (frame % FRAMES, &mut slots[frame % FRAMES]);
        host.wait(number)?;
        let outcome = slot.finish(host, device, number, bricks)?;
        complete += usize::from(outcome == Some(FrameOutcome::Complete));
        if frame < COUNT {
            let moved = mesh.positions.iter().map(|[x, y, z]| [x + frame as f32 / 16.0, *y, *z]);
            slot.positions.write(&moved.collect::<Vec<_>>());
            slot.submit(host, device, number, bricks)?;
        }
    }
    Ok(complete)
}

/// Returns the interface through which a shader of the host traces the bricks.
fn inline(bricks: &FrameStructure) -> Result<InlineTrace<'_>> {
    bricks.structure().inline_trace().ok_or_else(|| "bricks can be traced on the spot".into())
}

impl Slot {
    fn new(
        host: &Host,
        device: &Device,
        mesh: &Mesh,
        bricks: &FrameStructure,
        spirv: &[u32],
    ) -> Result<Self> {
        let positions = host.buffer(&mesh.positions)?;
        let geometry = host.geometry(device, mesh, positions)?;
        let inline = inline(bricks)?;
        let unanswered = vec![[0_u32; 4]; (SIDE * SIDE) as usize];
        let found = host.buffer(&unanswered)?;
        let sets = [geometry.layout().raw(), inline.layout.raw()];
        let pipeline = host.pipeline(spirv, &sets, &inline.constants, found)?;
        let reference = BruteForce::new(device, &geometry, None, false)?;
        let rays = RayQueue::new(device, "rays", SIDE * SIDE, false)?;
        let origin = |k: u32| [(k % SIDE) as f32 / SIDE as f32, (k / SIDE) as f32 / SIDE as f32, -1.0];
        let ray = |k| Ray { t_max: 4.0, ..Ray::new(origin(k), [0.0625, 0.03125, 1.0]) };
        device.upload_slice(rays.rays(), 0, &(0..SIDE * SIDE).map(ray).collect::<Vec<_>>())?;
        let expected = host.buffer(&unanswered)?;
        Ok(Self { positions, geometry, found, pipeline, reference, rays, expected, recorded: None })
    }

    /// Submits a frame, and keeps the resources that it uses.
    fn submit(
        &mut self,
        host: &Host,
        device: &Device,
        number: usize,
        bricks: &mut FrameStructure,
    ) -> Result<()> {
        let recorded = host.submit(number, |commands| self.record(host, device, commands, number, bricks))?;
        self.recorded = Some(recorded);
        Ok(())
    }

    /// Records a build, the host's shader, and brute force.
    fn record(
        &mut self,
        host: &Host,
        device: &Device,
        commands: vk::CommandBuffer,
        number: usize,
        bricks: &mut FrameStructure,
    ) -> Result<Recorded> {
        // SAFETY: nobody else records into the command buffer, and the caller keeps the returned resources
        // until the host has waited for the frame.
        let mut recorder = unsafe { Recorder::from_raw(device, commands) };
        bricks.set_geometry(device, &self.geometry)?;
        bricks.record(&mut recorder, number as u32, [0.5; 3].into())?;
        let (pipeline, layout, own) = self.pipeline;
        let inline = inline(bricks)?;
        let set = inline.set.ok_or("bricks are reached through a set")?;
        let (sets, point) = ([own, self.geometry.set().raw(), set.raw()], vk::PipelineBindPoint::COMPUTE);
        // SAFETY: the pipeline layout is that of these sets, and a build ends with a barrier towards compute
        // shaders.
        unsafe {
            host.device.cmd_bind_pipeline(commands, point, pipeline);
            host.device.cmd_bind_descriptor_sets(commands, point, layout, 0, &sets, &[]);
            host.device.cmd_dispatch(commands, SIDE / 8, SIDE / 8, 1);
        }
        self.rays.record_reset(&mut recorder);
        self.reference.record_build(&mut recorder, 0, [0.5; 3].into())?;
        let count = self.rays.capacity();
        self.reference.record_trace(&mut recorder, &self.rays, Trace::closest(Domain::First(count)));
        let expected = host.adopted(device, "expected", self.expected);
        recorder.copy(self.rays.hits(), 0, &expected, 0, expected.size());
        recorder.barrier(Access::COMPUTE | Access::TRANSFER, Access::HOST_READ);
        Ok(recorder.finish()?)
    }

    /// Returns the outcome of the frame that the host has waited for, or `None` if no frame was submitted.
    /// Compares the hits of a complete frame with those of brute force. Pools that were too small have grown
    /// afterwards.
    fn finish(
        &mut self,
        host: &Host,
        device: &Device,
        number: usize,
        bricks: &mut FrameStructure,
    ) -> Result<Option<FrameOutcome>> {
        if self.recorded.take().is_none() {
            return Ok(None);
        }
        let outcome = bricks.finish(device, number as u32)?;
        if outcome == FrameOutcome::Complete {
            host.compare(&self.found.read::<Hit>(), &self.expected.read::<Hit>())?;
        }
        Ok(Some(outcome))
    }
}
