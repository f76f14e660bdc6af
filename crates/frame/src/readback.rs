//! Results of a frame that are copied to the host.

use std::mem::size_of;

use rasray_ads::{QueueCounters, QueueHeader, RayQueue};
use rasray_gpu::{Access, Buffer, BufferDesc, BufferUsage, Device, GpuError, MemoryLocation, Recorder};
use rasray_integrators::{FilmFaults, FilmPixel, Integrator};

/// Film of a frame, on the host.
#[derive(Clone, Debug, Default)]
pub struct FilmCopy {
    /// Sums and counts per pixel, row by row from the top left.
    pub pixels: Vec<FilmPixel>,
    /// Samples that the film did not take, by cause.
    pub faults: FilmFaults,
}

impl FilmCopy {
    /// Returns the mean of each pixel.
    pub fn means(&self) -> Vec<[f32; 3]> {
        self.pixels.iter().map(FilmPixel::mean).collect()
    }
}

/// Host-visible memory that one frame in flight writes: film, faults, and the header of each queue.
#[derive(Debug)]
pub(crate) struct Readback {
    /// Film of each band; empty where films are not read.
    film: Vec<Buffer>,
    counters: Buffer,
}

const HEADER: u64 = size_of::<QueueHeader>() as u64;
const FAULTS: u64 = size_of::<FilmFaults>() as u64;

impl Readback {
    pub fn new(device: &Device, integrator: &dyn Integrator, reads_film: bool) -> Result<Self, GpuError> {
        let buffer = |name, size| {
            let (usage, location) = (BufferUsage::TRANSFER_DST, MemoryLocation::Readback);
            device.create_buffer(&BufferDesc { name, size, usage, location })
        };
        let queues = integrator.queues().len() as u64;
        let read = if reads_film { integrator.film().pixels() } else { &[] };
        let film = read.iter().map(|pixels| buffer("film of a frame", pixels.size()));
        Ok(Self {
            film: film.collect::<Result<_, _>>()?,
            counters: buffer("counters of a frame", FAULTS + queues * HEADER)?,
        })
    }

    /// Records the copies to the host, after all other passes of the frame.
    pub fn record(&self, recorder: &mut Recorder<'_>, integrator: &dyn Integrator) {
        recorder.barrier(Access::COMPUTE_WRITE | Access::TRANSFER_WRITE, Access::TRANSFER);
        for (film, pixels) in self.film.iter().zip(integrator.film().pixels()) {
            recorder.copy(pixels, 0, film, 0, film.size());
        }
        recorder.copy(integrator.film().faults(), 0, &self.counters, 0, FAULTS);
        for (at, queue) in (0..).zip(integrator.queues()) {
            recorder.copy(queue.header(), 0, &self.counters, FAULTS + at * HEADER, HEADER);
        }
    }

    /// Returns the [`FilmCopy`] and the counters of the queues; the frame must have ended.
    pub fn read(&self) -> Result<(FilmCopy, Vec<QueueCounters>), GpuError> {
        let bytes = self.counters.read(0, self.counters.size())?;
        let (faults, headers) = bytes.split_at(FAULTS as usize);
        let mut pixels = Vec::new();
        for film in &self.film {
            pixels.extend(bytemuck::pod_collect_to_vec::<u8, FilmPixel>(&film.read(0, film.size())?));
        }
        let counters = headers
            .chunks_exact(HEADER as usize)
            .map(|header| RayQueue::counters(&bytemuck::pod_read_unaligned(header)))
            .collect();
        Ok((FilmCopy { pixels, faults: bytemuck::pod_read_unaligned(faults) }, counters))
    }
}
