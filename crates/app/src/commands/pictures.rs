//! Pictures of one command: their common inputs, and the rendering and writing of each.

use super::denoise::{denoise, key_of_denoised};
use super::images::{named, write_image};
use super::picture_targets::Targets;
use super::steps::with_progress;
use crate::arguments::RenderArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{Destination, Metadata, PartOf, Row, Rows, image_key};
use crate::terminal::{self, Talk};
use crate::version::{origin, version_text};
use rasray_denoise::Denoiser;
use rasray_experiment::{
    Aov, AovSelection, Backend, Frame, FrameBefore, KeptScene, Progress, RenderJob, RenderOutput, Shard,
    SystemConfig, check_run, count_not_uploaded, picture_key,
};
use rasray_report::{FramesRecord, Report, json_escaped, table_within};
use rasray_scene_source::{ChosenCamera, LoadedScene};

/// Inputs that all pictures of a command have in common.
pub(super) struct Pictures<'a> {
    pub(super) given: &'a RenderArguments,
    pub(super) line: &'a str,
    pub(super) interrupt: &'a Interrupt,
    pub(super) frame: Frame,
    /// Share of the samples to make; absent for all.
    pub(super) shard: Option<Shard>,
    pub(super) aovs: AovSelection,
    pub(super) system: SystemConfig,
    /// Frames that the command makes; absent for one picture.
    pub(super) frames: Option<FramesRecord>,
    /// Report with a row per frame.
    pub(super) rows: Option<Rows>,
    pub(super) loaded: LoadedScene,
    pub(super) chosen: ChosenCamera,
    pub(super) backend: Box<dyn Backend>,
    /// Scene on the device, in the state after the picture of another time.
    pub(super) kept: KeptScene,
    /// Frame before the one that is shown, if any wanted image needs it.
    pub(super) before: Option<FrameBefore>,
    /// Denoiser of the pictures, if they are to be denoised.
    pub(super) denoiser: Option<Denoiser>,
}

impl Pictures<'_> {
    /// Makes the job of the scene as it is shown.
    fn job<'a>(&self, loaded: &'a LoadedScene) -> RenderJob<'a> {
        let Self { given, frame, shard, chosen, .. } = self;
        let aovs = self.rendered_aovs();
        RenderJob {
            scene: &loaded.scene,
            moment: loaded.moment.as_ref(),
            camera: chosen.camera.clone(),
            system: self.system.clone().seen_by(&chosen.camera, frame),
            refresh: given.refresh,
            frame: frame.clone(),
            shard: *shard,
            aovs,
            before: self.before.clone(),
            needs: given.work.reading.needs(&loaded.scene, frame.workload(), aovs),
            repetitions: given.repetitions.unwrap_or(0),
        }
    }

    /// Returns the images that are rendered in addition to the colours: those that were asked for, and those
    /// that a denoiser needs.
    fn rendered_aovs(&self) -> AovSelection {
        self.aovs.with(self.denoiser.iter().flat_map(|_| Aov::FOR_DENOISING))
    }

    /// Returns the key of the picture of the scene as it is shown.
    pub(super) fn key(&self) -> String {
        let key = picture_key(version_text(), &self.loaded, &self.job(&self.loaded));
        key_of_denoised(key, self.denoiser.as_ref())
    }

    /// Renders the scene as it is and writes the files that were asked for; `key` is the picture's. With
    /// `keeps_part`, a signal keeps the samples done so far.
    pub(super) fn render(
        &mut self,
        targets: &Targets,
        key: String,
        keeps_part: bool,
    ) -> Result<(), AppError> {
        let Self { given, line, interrupt, shard, .. } = *self;
        let frame = self.frame.clone();
        let needs = given.work.reading.needs(&self.loaded.scene, frame.workload(), self.rendered_aovs());
        count_not_uploaded(&mut self.loaded, &self.chosen.camera, &needs);
        let mut job = self.job(&self.loaded);
        if shard.is_some_and(|shard| !shard.holds(0)) {
            // Only the share with the first sample has additional images.
            job.aovs = AovSelection::default();
        }
        let samples = shard.unwrap_or_default().samples(frame.spp).count();
        // A sample takes several waves; an early end keeps complete samples.
        let is_kept = |progress: &Progress<'_>| {
            keeps_part && progress.total > 0 && progress.done.saturating_mul(samples.into()) >= progress.total
        };
        let (backend, kept) = (&mut self.backend, &mut self.kept);
        let mut output = with_progress(interrupt, is_kept, |progress| backend.render(&job, kept, progress))?;
        check_samples(&output, samples, keeps_part)?;

        let mut run = output.run(&job.system, &frame);
        let whole = check_run(&run);
        // A picture that a signal cut short has no key, since another run would not make it.
        let key = Some(key).filter(|_| output.samples_done == samples);
        run.key.clone_from(&key);
        run.shard = shard.map(|shard| shard.to_string());
        let report = Report::new(origin(line), self.backend.device(), self.loaded.record(), vec![run])
            .seen_from(self.chosen.record());
        if let Some(place) = &targets.report {
            place.write(report_text(place, &report).as_bytes(), interrupt)?;
        }
        if let (Some(rows), Some(row)) = (&mut self.rows, Row::of(&report)) {
            rows.put(row, interrupt)?;
        }
        whole?;
        output.check_images(job.aovs)?;
        if let Some(denoiser) = &self.denoiser {
            denoise(denoiser, &mut output)?;
            output.aovs.retain(|aov, _| self.aovs.contains(*aov));
        }
        if let Some((place, format)) = &targets.image {
            let tone = given.tone.tone();
            let metadata = Metadata {
                scene: self.loaded.scene.name.clone(),
                system: job.system.system.name.to_owned(),
                preset: job.system.preset.name().to_owned(),
                integrator: frame.integrator.name().to_owned(),
                spp: frame.spp,
                samples: output.samples_done,
                seed: frame.seed,
                version: version_text().to_owned(),
                denoised: self.denoiser.as_ref().map(|denoiser| denoiser.version().to_owned()),
                key: key.as_ref().map(|key| image_key(key, *format, tone, shard)),
                part: shard.zip(key).map(|(shard, picture)| PartOf { picture, shard }),
            };
            write_image((place, *format), &output, &metadata, tone, interrupt)?;
        }
        let places = targets.image.iter().map(|(place, _)| place).chain(&targets.report);
        let takes_stdout = places.into_iter().any(Destination::is_stdout);
        terminal::summarize(
            &table_within(
                &report,
                Some(&self.chosen.described()),
                terminal::says(Talk::Verbose),
                terminal::width(),
            ),
            takes_stdout,
        )?;
        if output.samples_done < samples {
            let written = targets.image.as_ref().map_or_else(
                || "no image was asked for".to_owned(),
                |(place, _)| format!("the image in {} is valid and holds them", named(place)),
            );
            return Err(AppError::interrupted(
                format!("stopped after {} of {samples} samples per pixel; {written}", output.samples_done),
                "run again for the whole image, or with this many --spp for the same one",
            ));
        }
        Ok(())
    }
}

/// Refuses a render that ended before anything was complete that is kept.
fn check_samples(output: &RenderOutput, samples: u32, keeps_part: bool) -> Result<(), AppError> {
    if output.samples_done == 0 {
        return Err(AppError::interrupted(
            "stopped before the first sample was whole; nothing was written",
            "",
        ));
    }
    if output.samples_done < samples && !keeps_part {
        return Err(AppError::interrupted(
            "stopped before the image was whole; it was not written",
            "run again with --resume for what is left",
        ));
    }
    Ok(())
}

/// Returns the text of a report's file: one line if others may follow.
fn report_text(place: &Destination, report: &Report) -> String {
    let text = if Rows::are_in(place.named()) { report.to_json_line() + "\n" } else { report.to_json() };
    json_escaped(&text)
}
