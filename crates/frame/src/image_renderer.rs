//! Renderer of one image, wave by wave.

use std::ops::{ControlFlow, Range};
use std::time::Instant;

use rasray_ads::{RayQueue, Structure};
use rasray_gpu::{Device, PassTiming, Timing};
use rasray_gpu_scene::GpuScene;
use rasray_integrators::{AovPass, AovPixel, AovSurface, Film, Wave, wave_capacity};

use crate::adaptive::{Adaptive, Pilot};
use crate::image_passes::{ImagePasses, unanswered};
use crate::moments::Variances;
use crate::{FrameError, Samples};

/// Result of a call of [`ImageRenderer::advance`].
#[derive(Clone, Debug)]
pub enum Advance {
    /// The call added a wave to the film.
    Wave {
        /// Times of the wave's passes, if they are timed. Times of the shadow maps precede them in the first
        /// wave that needs the maps.
        passes: Vec<PassTiming>,
    },
    /// Rays needed more rounds than they had: the image starts at 0 again, and the structure allows more
    /// rounds from now on.
    StartedOver,
}

/// Renderer of one image: sample after sample, and wave after wave within a sample. Each call submits and
/// waits, so no submission is longer than a wave, and the picture can be looked at or given up between calls.
///
/// The structure must be complete ([`rasray_tracer::build_until_complete`]); pictures are those of
/// [`FrameRenderer`](crate::FrameRenderer), bit for bit.
#[derive(Debug)]
pub struct ImageRenderer {
    device: Device,
    passes: ImagePasses,
    samples: Samples,
    /// First pixel of the next wave, counted among the pixels of the sample.
    next_pixel: u32,
    /// Range of each band that the waves of the sample divide: pixels, or positions in the band's list.
    of_sample: Vec<Range<u32>>,
    samples_done: u32,
    waves_done: u64,
    unfinished: u64,
    sharing: Option<Sharing>,
    variances: Option<Variances>,
}

/// State of adaptive sampling, which gives some pixels more samples than others.
#[derive(Debug)]
struct Sharing {
    rule: Adaptive,
    pilot: Pilot,
    /// Number of samples of each pixel; empty before the pilot is done.
    counts: Vec<u32>,
}

impl Sharing {
    /// Returns the pixels of a band that get the sample with this index.
    fn pixels_at(&self, sample: u32, band: Range<u32>) -> Vec<u32> {
        band.filter(|pixel| self.counts[*pixel as usize] > sample).collect()
    }
}

impl ImageRenderer {
    /// Makes a renderer whose film has no sample yet.
    ///
    /// # Errors
    /// The device fails.
    pub fn new(
        device: &Device,
        passes: impl Into<ImagePasses>,
        samples: impl Into<Samples>,
    ) -> Result<Self, FrameError> {
        let (device, passes, samples) = (device.clone(), passes.into(), samples.into());
        let mut made = Self {
            device,
            passes,
            samples,
            next_pixel: 0,
            of_sample: Vec::new(),
            samples_done: 0,
            waves_done: 0,
            unfinished: 0,
            sharing: None,
            variances: None,
        };
        made.clear()?;
        Ok(made)
    }

    /// Enables adaptive sampling: pixels with more noise get more samples, and the requested number of
    /// samples is the maximum for a pixel.
    ///
    /// # Errors
    /// [`FrameError::DrawnAdaptively`] if camera rays are drawn, `NotListed` if the film was not made by
    /// [`Film::listed`], or the device fails.
    pub fn adapting(mut self, rule: Adaptive) -> Result<Self, FrameError> {
        if self.passes.visibility().is_some() {
            return Err(FrameError::DrawnAdaptively);
        }
        let pilot = Pilot::new(self.film().width(), self.film().pixel_count());
        self.sharing = Some(Sharing { rule, pilot, counts: Vec::new() });
        self.clear()?;
        Ok(self)
    }

    /// Measures the variance of each pixel ([`ImageRenderer::variances`]): the film is read after every
    /// sample, and its contents do not change.
    #[must_use]
    pub fn measuring(self) -> Self {
        let variances = Some(Variances::new(self.film().pixel_count()));
        Self { variances, ..self }
    }

    /// Resets the film and the counters to 0.
    ///
    /// # Errors
    /// The device fails.
    pub fn clear(&mut self) -> Result<(), FrameError> {
        self.device.submit(|recorder| self.passes.record_reset(recorder))?;
        (self.next_pixel, self.samples_done, self.waves_done, self.unfinished) = (0, 0, 0, 0);
        self.of_sample = self.film().bands().ranges().collect();
        if self.variances.is_some() {
            self.variances = Some(Variances::new(self.film().pixel_count()));
        }
        if let Some(sharing) = &mut self.sharing {
            let film = self.passes.film();
            sharing.pilot = Pilot::new(film.width(), film.pixel_count());
            sharing.counts.clear();
            for (number, band) in film.bands().ranges().enumerate() {
                film.write_list(&self.device, number, &band.collect::<Vec<_>>())?;
            }
        }
        Ok(())
    }

    /// Updates the noise statistics with the sample that was just added to the film.
    fn measure(&mut self) -> Result<(), FrameError> {
        let Self { device, passes, samples_done, sharing, variances, .. } = self;
        let mut pilot = sharing.as_mut().filter(|sharing| *samples_done <= sharing.rule.least);
        if pilot.is_none() && variances.is_none() {
            return Ok(());
        }
        let mut first = 0;
        passes.film().read_bands(device, |pixels| {
            pilot.iter_mut().for_each(|sharing| sharing.pilot.add(first, pixels));
            variances.iter_mut().for_each(|variances| variances.add(first, pixels));
            first += pixels.len() as u32;
        })?;
        Ok(())
    }

    /// Chooses the pixels of the next sample. If no pixel needs one, the image is finished.
    fn choose_pixels(&mut self) -> Result<(), FrameError> {
        let Some(sharing) = &mut self.sharing else { return Ok(()) };
        let (film, done) = (self.passes.film(), self.samples_done);
        if done < sharing.rule.least {
            return Ok(());
        }
        if done == sharing.rule.least {
            sharing.counts = sharing.pilot.counts(sharing.rule, self.samples.count());
        }
        for (number, (band, listed)) in film.bands().ranges().zip(&mut self.of_sample).enumerate() {
            let pixels = sharing.pixels_at(done, band);
            if pixels.len() != listed.len() {
                *listed = film.write_list(&self.device, number, &pixels)?;
            }
        }
        if self.of_sample.iter().all(Range::is_empty) {
            self.samples_done = self.samples.count();
        }
        Ok(())
    }

    /// Returns the rest of the sample after `pixels` of its pixels, band by band.
    fn left(&self, pixels: u32) -> impl Iterator<Item = Range<u32>> {
        let mut skipped = pixels;
        self.of_sample.iter().filter_map(move |listed| {
            let start = listed.start + skipped.min(listed.len() as u32);
            skipped -= start - listed.start;
            (start < listed.end).then_some(start..listed.end)
        })
    }

    /// States that lights or triangles have moved: shadow maps are drawn again before the next wave. The film
    /// is kept.
    pub fn scene_moved(&mut self) {
        self.passes.scene_moved();
    }

    /// Draws shadow maps if lights or triangles moved since the last drawing; returns the times of the
    /// passes.
    fn draw_shadow_maps(&mut self, timing: Timing) -> Result<Vec<PassTiming>, FrameError> {
        if !self.passes.needs_shadow_maps() {
            return Ok(Vec::new());
        }
        let Self { device, passes, .. } = self;
        let submitted = device.submit_passes(timing, |recorder| passes.record_shadow_maps(recorder));
        Ok(submitted.inspect_err(|_| passes.scene_moved())?.passes)
    }

    /// Renders one pixel, shadow maps included, and discards it: software drivers compile a kernel at its
    /// first dispatch, and that time is not part of a trace. Returns milliseconds. The film and the counters
    /// are 0 after the call.
    ///
    /// # Errors
    /// The device fails.
    pub fn warm_up(&mut self, structure: &dyn Structure) -> Result<f64, FrameError> {
        let started = Instant::now();
        self.draw_shadow_maps(Timing::None)?;
        let one = Wave { first_pixel: 0, pixel_count: 1, sample: 0 };
        let (integrator, traced) = (self.passes.integrator(), self.passes.traced(structure));
        let submitted = self.device.submit(|recorder| integrator.record_wave(recorder, traced, one))?;
        submitted.value?;
        self.scene_moved();
        self.clear()?;
        Ok(started.elapsed().as_secs_f64() * 1.0e3)
    }

    /// Renders the next wave, of the requested samples or of samples beyond them.
    ///
    /// # Errors
    /// The device fails, or rays met list entries with an invalid index.
    pub fn advance(&mut self, structure: &dyn Structure, timing: Timing) -> Result<Advance, FrameError> {
        let mut timings = self.draw_shadow_maps(timing)?;
        let integrator = self.passes.integrator();
        let next = self.left(self.next_pixel).next().unwrap_or_default();
        let wave = Wave {
            first_pixel: next.start,
            pixel_count: integrator.wave_capacity().min(next.len() as u32),
            sample: self.samples.index(self.samples_done),
        };
        let traced = self.passes.traced(structure);
        timings.extend(integrator.render_wave(&self.device, timing, traced, wave)?);
        // The film lacks light if a ray had no answer, so such rays are counted after each wave and not only
        // after the last one. The counters of the queues accumulate over waves.
        self.unfinished = self.count_unfinished(structure, &integrator.queues())?;
        if self.unfinished > 0 && structure.allow_more_rounds() {
            self.clear()?;
            return Ok(Advance::StartedOver);
        }
        self.next_pixel += wave.pixel_count;
        self.waves_done += 1;
        if self.left(self.next_pixel).next().is_none() {
            self.next_pixel = 0;
            self.samples_done += 1;
            self.measure()?;
            self.choose_pixels()?;
        }
        Ok(Advance::Wave { passes: timings })
    }

    /// Renders all requested samples and passes each step to `after`. If `after` breaks, rendering ends
    /// early, between samples, so that all pixels have the same number of samples.
    ///
    /// # Errors
    /// As [`ImageRenderer::advance`]. Rays without an answer are no error: [`ImageRenderer::unfinished`]
    /// counts them.
    pub fn render(
        &mut self,
        structure: &dyn Structure,
        timing: Timing,
        mut after: impl FnMut(&Self, Advance) -> ControlFlow<()>,
    ) -> Result<(), FrameError> {
        let mut stopping = false;
        while self.samples_done < self.samples.count() && !(stopping && self.next_pixel == 0) {
            let step = self.advance(structure, timing)?;
            stopping &= matches!(step, Advance::Wave { .. });
            stopping |= after(self, step).is_break();
        }
        Ok(())
    }

    /// Traces the rays through the pixels' centres in the scene as it is shown, and hands out their hits, row
    /// by row from the top left, band by band.
    ///
    /// # Errors
    /// The device fails, sizes do not fit, rays met list entries with an invalid index, or rays did not
    /// finish in the maximum number of rounds ([`FrameError::Unfinished`]).
    pub fn aovs(
        &self,
        scene: &GpuScene,
        structure: &dyn Structure,
        mut take: impl FnMut(&[AovPixel]),
    ) -> Result<(), FrameError> {
        let aov = AovPass::new(&self.device, scene, self.film().bands(), self.aov_capacity())?;
        self.trace_centres(&aov, structure, |pixels, _| take(pixels))
    }

    /// Traces as [`ImageRenderer::aovs`] does and hands out materials and meshes of the hits as well. Bands
    /// are smaller if the device cannot bind the larger records of as many pixels.
    ///
    /// # Errors
    /// As [`ImageRenderer::aovs`].
    pub fn aovs_with_surfaces(
        &self,
        scene: &GpuScene,
        structure: &dyn Structure,
        take: impl FnMut(&[AovPixel], &[AovSurface]),
    ) -> Result<(), FrameError> {
        let (bands, capacity) = (self.film().bands(), self.aov_capacity());
        let aov = AovPass::with_surfaces(&self.device, scene, bands, capacity)?;
        self.trace_centres(&aov, structure, take)
    }

    /// Returns the maximum number of rays through pixels' centres in a wave.
    fn aov_capacity(&self) -> u32 {
        wave_capacity(&self.device).min(self.film().pixel_count())
    }

    fn trace_centres(
        &self,
        aov: &AovPass,
        structure: &dyn Structure,
        mut take: impl FnMut(&[AovPixel], &[AovSurface]),
    ) -> Result<(), FrameError> {
        for band in aov.bands().ranges() {
            loop {
                self.device.submit(|recorder| aov.record_reset(recorder))?;
                for wave in Wave::cut(band.clone(), 0, aov.queue().capacity()) {
                    let traced = self.passes.traced(structure);
                    self.device.submit(|recorder| aov.record_wave(recorder, traced, wave))?.value?;
                }
                let rays = self.count_unfinished(structure, &[aov.queue()])?;
                if rays == 0 {
                    break;
                }
                if !structure.allow_more_rounds() {
                    return Err(FrameError::Unfinished { rays });
                }
            }
            let count = band.len() as u32;
            take(&aov.read(&self.device, count)?, &aov.read_surfaces(&self.device, count)?);
        }
        Ok(())
    }

    /// Downloads the counters of queues and returns the number of rays without an answer.
    fn count_unfinished(&self, structure: &dyn Structure, queues: &[&RayQueue]) -> Result<u64, FrameError> {
        let counters = queues.iter().map(|queue| queue.download_counters(&self.device));
        unanswered(structure, &counters.collect::<Result<Vec<_>, _>>()?)
    }

    /// Returns the passes of each wave.
    pub fn passes(&self) -> &ImagePasses {
        &self.passes
    }

    /// Returns the film to which samples are added.
    pub fn film(&self) -> &Film {
        self.passes.film()
    }

    /// Returns the number of waves of all requested samples; with adaptive sampling, an upper bound of it.
    pub fn waves(&self) -> u64 {
        let capacity = self.passes.integrator().wave_capacity() as usize;
        let after = |pixels| self.left(pixels).map(|left| left.len().div_ceil(capacity) as u64).sum::<u64>();
        let left = self.samples.count().saturating_sub(self.samples_done + u32::from(self.next_pixel > 0));
        let in_sample = if self.next_pixel > 0 { after(self.next_pixel) } else { 0 };
        self.waves_done + in_sample + u64::from(left) * after(0)
    }

    /// Returns the number of waves that are on the film.
    pub fn waves_done(&self) -> u64 {
        self.waves_done
    }

    /// Returns the number of samples that all pixels have. With adaptive sampling it is the number of samples
    /// that are complete on the film, and the requested number once every pixel has the samples it needs.
    pub fn samples_done(&self) -> u32 {
        self.samples_done
    }

    /// Returns true if no sample is partly done, so that the film is between two samples.
    pub fn is_between_samples(&self) -> bool {
        self.next_pixel == 0
    }

    /// Returns the variance of the mean of each pixel, row by row from the top left, as if its samples were
    /// independent: the variance of a sample divided by their number, 0 if there are fewer than two. Absent
    /// unless variances are measured ([`ImageRenderer::measuring`]).
    pub fn variances(&self) -> Option<impl Iterator<Item = [f32; 3]>> {
        self.variances.as_ref().map(Variances::of_means)
    }

    /// Returns the number of rays without an answer; if it is not 0, the image is invalid.
    pub fn unfinished(&self) -> u64 {
        self.unfinished
    }
}
