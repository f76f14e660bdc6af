//! Command `rasray render`.

use super::denoise::denoiser;
use super::frames::{dealt, seconds};
use super::picture_targets::{Targets, rows, samples_shard};
use super::pictures::Pictures;
use super::steps::{Posing, Shown, fit_images, open_device, read_scene, stop_if_requested};
use crate::arguments::RenderArguments;
use crate::error::AppError;
use crate::hints::with_flags;
use crate::interrupt::Interrupt;
use crate::terminal;
use rasray_experiment::{Aov, KeptScene, OpenBackend};
use rasray_report::FramesRecord;
use rasray_scene_source::KeyHash;

/// Renders a scene, or frames of it, and writes the files that were asked for; `line` is the command as it
/// was typed.
///
/// # Errors
/// Errors that can be found without a device are reported before a device is opened.
pub(crate) fn render(
    given: &RenderArguments,
    line: &str,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let frame = given.frame()?;
    let aovs = given.aovs(&frame)?;
    let system = given.system()?.serving(frame.workload());
    let denoiser = denoiser(given.denoise)?;
    let shard = samples_shard(given)?;
    // All shares of the frames begin at the first frame of all, by which a camera that nothing moves is
    // placed.
    let first = given.frames.as_ref().map(|range| *range.start());
    let numbers = given.frames.as_ref().map(|range| dealt(range, given.shard));
    // For a range of frames this refuses faults of the first one.
    let targets = Targets::of(given, aovs, first)?;
    let rows = rows(given)?;
    let fps = given.work.reading.frames_per_second();
    let time = first.map_or(given.work.reading.time, |first| Some(seconds(first, fps)));
    let times: Vec<_> =
        given.frames.clone().into_iter().flatten().map(|number| seconds(number, fps)).collect();
    let shown = time.map(|seconds| Shown { seconds, posing: Posing::Device, times });
    let (mut loaded, chosen) =
        read_scene(&given.scene, &given.work.reading, shown.as_ref(), &given.work.view)?;
    let system = match given.frames {
        Some(_) => system.rebuilt_for(frame.rays(), loaded.triangles),
        None => system,
    };
    system.shortcoming(frame.workload()).iter().for_each(|text| terminal::warn(&with_flags(text)));

    let backend = open_device(open, &given.work.device)?;
    stop_if_requested(interrupt)?;
    // Images of the scene do not depend on the time.
    let rendered = aovs.with(denoiser.iter().flat_map(|_| Aov::FOR_DENOISING));
    let needs = given.work.reading.needs(&loaded.scene, frame.workload(), rendered);
    fit_images(&mut loaded, &needs, backend.as_ref())?;
    let mut pictures = Pictures {
        given,
        line,
        interrupt,
        frame,
        shard,
        aovs,
        system,
        frames: None,
        rows,
        loaded,
        chosen,
        backend,
        kept: KeptScene::default(),
        before: None,
        denoiser,
    };
    match numbers {
        None => pictures.render_one(&targets),
        Some(numbers) => {
            pictures.frames = pictures.frames_record();
            pictures.render_frames(&numbers)
        }
    }
}

impl Pictures<'_> {
    /// Returns the record of the frames that are made. The scene is shown at the time of the first frame of
    /// all, in every share.
    fn frames_record(&self) -> Option<FramesRecord> {
        let range = self.given.frames.as_ref()?;
        let fps = self.given.work.reading.frames_per_second();
        let key = KeyHash::default().with("first", self.key()).with("fps", format!("{fps:?}")).finish();
        let shard = self.given.shard.map(|shard| shard.to_string());
        Some(FramesRecord { first: *range.start(), last: *range.end(), shard, key })
    }

    /// Renders the scene at its only time, unless the image exists.
    fn render_one(&mut self, targets: &Targets) -> Result<(), AppError> {
        let key = self.key();
        if self.given.resume {
            let found = targets.standing(self.given, &key)?;
            match found.reason() {
                None => {
                    terminal::note("the image is there already; nothing was rendered");
                    return Ok(());
                }
                Some(reason) => terminal::note(&format!("the image is rendered: it is {reason}")),
            }
        }
        // A share of the samples is useless unless it is complete.
        self.render(targets, key, self.shard.is_none())
    }
}
