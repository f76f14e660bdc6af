//! Photon map of a sample.

use std::mem::offset_of;

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{Access, Buffer, Device, Recorder};
use rasray_gpu_scene::GpuScene;
use rasray_shaders_glsl::{
    INTEGRATORS_PHOTON_EMIT, INTEGRATORS_PHOTON_SHADE,
    constant_ids::{integrators::PHOTONS_ARE_ALL, scene::SPECULAR_IS_WARD},
    constants::integrators::PHOTON_RADIUS_IS_SHARE,
    records::{PathState, Photon, PhotonHeader},
};

use super::options::{PhotonKind, PhotonOptions};
use crate::registry::path::{ROUND_LIMIT, USUAL_LAYERS};
use crate::{
    IntegratorDesc, IntegratorError, SpecularLobe, Traced, Wave,
    kernels::{Bindings, Bound, Kernel, WaveConstants, binding, device_buffer, film},
    rounds::Rounds,
};

/// Binding of the map, as `integrators/photons.glsl` declares it.
const MAP: u32 = 9;
/// Offset of the number of lists, and start of the lists.
const COUNT_AT: u64 = offset_of!(PhotonHeader, lists) as u64;
const LISTS_AT: u64 = size_of::<PhotonHeader>() as u64;

/// Default radius of the first sample, as a share of the diagonal of the bounds of all triangles.
const RADIUS_SHARE: f64 = 0.01;
/// Share of the photons of a sample that the radius of the next one keeps: alpha of Knaus and Zwicker.
const KEPT_SHARE: f64 = 2.0 / 3.0;
/// 1 / gamma(1 + `KEPT_SHARE`).
const KEPT_SHARE_GAMMA: f64 = 1.107_732_167_432_472_5;
/// Least number of lists.
const LEAST_LISTS: u32 = 1024;

/// Photon map as it is on the device, for inspection.
#[derive(Clone, Debug, Default)]
pub struct PhotonMap {
    /// Distance within which a photon counts, metres.
    pub radius: f32,
    /// Stored photons, in no particular order.
    pub photons: Vec<Photon>,
}

/// Passes that make the map of each sample: photons are emitted and traced through the structure, in waves of
/// their own.
#[derive(Debug)]
pub(super) struct MapPasses {
    options: PhotonOptions,
    rounds: Rounds,
    queue: RayQueue,
    states: Buffer,
    /// Buffer of header, lists and photons.
    map: Buffer,
    bindings: Bindings,
    emit: Kernel,
    shade: Kernel,
}

impl MapPasses {
    pub fn new(desc: &IntegratorDesc<'_>, options: PhotonOptions) -> Result<Self, IntegratorError> {
        let PhotonOptions { paths, kind, photon_paths, .. } = options;
        let device = desc.device;
        // Each photon of a path has a place of its own, so none is ever left out.
        let photons = u64::from(photon_paths) * u64::from(stored(paths.bounces)) * size_of::<Photon>() as u64;
        let bytes = photons_at(photon_paths) + photons;
        let limit = device.limits().max_storage_buffer_range;
        if bytes > limit {
            return Err(IntegratorError::PhotonBytes { bytes, limit });
        }
        let queue = RayQueue::new(device, "photon rays", photon_paths, true)?;
        let of_states = u64::from(photon_paths) * size_of::<PathState>() as u64;
        let states = device_buffer(device, "photon states", of_states)?;
        let map = device_buffer(device, "photon map", bytes)?;
        let own = [(binding::PATH_STATES, &states), (MAP, &map)];
        let bindings = Bindings::new(device, desc.scene, &film(desc.film), &own)?;
        let mut constants = Vec::from(desc.features.constants());
        constants.push((SPECULAR_IS_WARD, (paths.specular == SpecularLobe::Ward).into()));
        constants.push((PHOTONS_ARE_ALL, (kind == PhotonKind::All).into()));
        let [first, most] = rounds(paths.bounces, desc.features.blend);
        Ok(Self {
            rounds: Rounds::new(first, most),
            emit: bindings.kernel(device, &INTEGRATORS_PHOTON_EMIT, &desc.features.constants())?,
            shade: bindings.kernel(device, &INTEGRATORS_PHOTON_SHADE, &constants)?,
            options,
            queue,
            states,
            map,
            bindings,
        })
    }

    /// Returns the bindings of kernels that gather.
    pub fn bound(&self) -> [Bound<'_>; 1] {
        [(MAP, &self.map)]
    }

    pub fn queue(&self) -> &RayQueue {
        &self.queue
    }

    pub fn rounds(&self) -> &Rounds {
        &self.rounds
    }

    pub fn bytes(&self) -> u64 {
        self.states.size() + self.map.size()
    }

    pub fn set_scene(&mut self, scene: &GpuScene) {
        self.bindings.set_scene(scene);
    }

    /// True if emitted photons can ever be stored.
    fn stores_any(&self) -> bool {
        stored(self.options.paths.bounces) > 0
    }

    fn wave(&self, sample: u32) -> Wave {
        Wave { first_pixel: 0, pixel_count: self.options.photon_paths, sample }
    }

    /// Records the map of a sample, or the remaining rounds of the photons recorded last.
    ///
    /// # Errors
    /// An error if the structure was made without a scene.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        sample: u32,
        is_rest: bool,
    ) -> Result<(), IntegratorError> {
        if !self.stores_any() {
            return Ok(());
        }
        let wave = self.wave(sample);
        if !is_rest {
            self.record_emission(recorder, wave);
        }
        // Photons do not leave the eye, so drawing does not answer them.
        let traced = traced.with_primary(None);
        self.rounds.record(recorder, (traced, wave), &self.queue, is_rest, |recorder, live, constants| {
            let constants = WaveConstants { limit: self.options.paths.bounces, ..constants };
            self.bindings.record(recorder, &self.shade, &self.queue, live, &constants);
        })
    }

    fn record_emission(&self, recorder: &mut Recorder<'_>, wave: Wave) {
        // Kernels of the previous sample read the lists.
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
        let count = lists(self.options.photon_paths);
        recorder.fill(&self.map, COUNT_AT, 4, count);
        recorder.fill(&self.map, LISTS_AT, 4 * u64::from(count), 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        let (radius, marks) = match self.options.radius {
            Some(radius) => (f64::from(radius), 0),
            None => (RADIUS_SHARE, PHOTON_RADIUS_IS_SHARE),
        };
        let number = (radius * shrunk(wave.sample)) as f32;
        let constants = WaveConstants { number, marks, ..WaveConstants::from(wave) };
        self.bindings.record(recorder, &self.emit, &self.queue, Domain::First(wave.pixel_count), &constants);
        self.queue.record_select_none(recorder);
    }

    /// Downloads the map of the sample recorded last.
    pub fn read(&self, device: &Device) -> Result<PhotonMap, IntegratorError> {
        if !self.stores_any() {
            return Ok(PhotonMap::default());
        }
        let PhotonOptions { paths, photon_paths, .. } = self.options;
        let header: Vec<PhotonHeader> = device.download_as(&self.map, 0, 1)?;
        let lists: Vec<u32> = device.download_as(&self.map, LISTS_AT, lists(photon_paths) as usize)?;
        let count = photon_paths as usize * stored(paths.bounces) as usize;
        let all: Vec<Photon> = device.download_as(&self.map, photons_at(photon_paths), count)?;
        let mut photons = Vec::new();
        for mut link in lists {
            while let Some(photon) = (link as usize).checked_sub(1).and_then(|number| all.get(number)) {
                photons.push(*photon);
                link = photon.next;
            }
        }
        let radius = header.first().map_or(0.0, |header| header.radius);
        Ok(PhotonMap { radius, photons })
    }
}

/// Returns the largest number of stored photons of a path: one after each scattering but the last, at which
/// they are gathered.
fn stored(bounces: u32) -> u32 {
    bounces.saturating_sub(1)
}

/// Returns the number of lists that cells are hashed to: a power of two, two to four per path.
fn lists(photon_paths: u32) -> u32 {
    (2 * photon_paths.next_power_of_two()).max(LEAST_LISTS)
}

/// Returns the start of the photons in the map, bytes.
fn photons_at(photon_paths: u32) -> u64 {
    LISTS_AT + 4 * u64::from(lists(photon_paths))
}

/// Returns the number of rounds of a map at first, and the largest: a photon may pass any number of blended
/// surfaces.
fn rounds(bounces: u32, blend: bool) -> [u32; 2] {
    if blend { [bounces + USUAL_LAYERS, ROUND_LIMIT] } else { [bounces; 2] }
}

/// Returns the ratio of the radius of a sample, numbered from 0, to that of the first: the root of the
/// product of (k + alpha) / (k + 1) over all k from 1 to the sample's number.
fn shrunk(sample: u32) -> f64 {
    // Number of the sample from which on the product is computed as a quotient of gamma functions, to 10
    // digits by Stirling's series.
    const EXACT: u32 = 4096;
    if sample <= EXACT {
        let factors = (1..=sample).map(|k| (f64::from(k) + KEPT_SHARE) / (f64::from(k) + 1.0));
        return factors.product::<f64>().sqrt();
    }
    let middle = f64::from(sample) + 1.0 + 0.5 * KEPT_SHARE;
    (KEPT_SHARE_GAMMA * middle.powf(KEPT_SHARE - 1.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_shrink_as_the_product_says() {
        assert_eq!(shrunk(0), 1.0);
        let first = ((1.0 + KEPT_SHARE) / 2.0).sqrt();
        assert!((shrunk(1) - first).abs() < 1.0e-15);
        // The samples are around the border of the two methods.
        for sample in [4096, 4097, 4098] {
            let k = f64::from(sample) + 1.0;
            let next = shrunk(sample) * ((k + KEPT_SHARE) / (k + 1.0)).sqrt();
            assert!((shrunk(sample + 1) / next - 1.0).abs() < 1.0e-9, "{sample}");
        }
        let last = shrunk(u32::MAX);
        assert!(0.0 < last && last < 0.03, "{last}");
    }

    #[test]
    fn a_photon_of_each_scattering_but_the_last_is_stored() {
        assert_eq!([0, 1, 2, 8].map(stored), [0, 0, 1, 7]);
        assert_eq!([1, 512, 513, 16_384].map(lists), [1024, 1024, 2048, 32_768]);
        assert_eq!(rounds(3, false), [3, 3]);
        assert_eq!(rounds(3, true), [3 + USUAL_LAYERS, ROUND_LIMIT]);
    }
}
