//! Frames of an animation, one after another.

use super::picture_targets::Targets;
use super::pictures::Pictures;
use crate::error::AppError;
use crate::output::ImageState;
use crate::terminal;
use rasray_experiment::{Aov, FrameBefore, Shard};
use std::ops::RangeInclusive;

/// Returns the time at which a frame is shown, seconds.
pub(super) fn seconds(number: u32, fps: f64) -> f64 {
    f64::from(number) / fps
}

/// Returns the frames of a range that belong to a share.
pub(super) fn dealt(range: &RangeInclusive<u32>, shard: Option<Shard>) -> Vec<u32> {
    let shard = shard.unwrap_or_default();
    range.clone().filter(|number| shard.holds(number - range.start())).collect()
}

impl Pictures<'_> {
    /// Renders the frames. A camera of the scene moves with it, any other camera stays.
    pub(super) fn render_frames(&mut self, numbers: &[u32]) -> Result<(), AppError> {
        let mut tally = Tally::default();
        for (position, &number) in numbers.iter().enumerate() {
            let about = |error: AppError| {
                error.about(&format!("frame {number}, {} of {}", position + 1, numbers.len()))
            };
            let found = self.render_frame(number).map_err(about)?;
            tally.0[found as usize] += 1;
        }
        if let Some(rows) = &mut self.rows {
            if numbers.is_empty() || rows.is_changed() {
                // A share without frames gets a report without rows, so that reports of all shares can be
                // merged.
                rows.write(self.interrupt)?;
            }
            terminal::note(&format!("{} has a row of each frame", rows.place().named().display()));
        }
        if self.given.resume {
            terminal::note(&tally.text());
        }
        Ok(())
    }

    /// Returns the frame before, if any wanted image needs it; also for the first frame, so that no frame
    /// depends on which others are made. The scene is shown as in the frame before afterwards.
    fn frame_before(&mut self, number: u32) -> Result<Option<FrameBefore>, AppError> {
        if !self.aovs.contains(Aov::Motion) {
            return Ok(None);
        }
        let reading = &self.given.work.reading;
        let seconds = (f64::from(number) - 1.0) / reading.frames_per_second();
        self.loaded.show(seconds, reading.clip.as_deref())?;
        let Some(moment) = self.loaded.moment.clone() else {
            return Err(AppError::usage(
                "--aov motion follows triangles, and this scene has others in each frame",
                "leave it out",
            ));
        };
        let moved = self.chosen.index.and_then(|index| self.loaded.camera(index));
        Ok(Some(FrameBefore { moment, camera: moved.unwrap_or_else(|| self.chosen.camera.clone()) }))
    }

    /// Renders a frame, unless it exists. Returns the state of its files before.
    fn render_frame(&mut self, number: u32) -> Result<ImageState, AppError> {
        let targets = Targets::of(self.given, self.aovs, Some(number))?;
        if let (Some((image, _)), Some(rows)) = (&targets.image, &self.rows)
            && image.same_as(rows.place())
        {
            return Err(AppError::usage("--output and --report name the same file", "name two files"));
        }
        self.before = self.frame_before(number)?;
        let reading = &self.given.work.reading;
        let said = self.loaded.scene.animation.deformer_warnings.clone();
        self.loaded.show(seconds(number, reading.frames_per_second()), reading.clip.as_deref())?;
        terminal::warn_of_frame(&self.loaded.scene, &said);
        if let Some(pose) = &mut self.loaded.pose {
            pose.frame = Some(number);
            pose.frames.clone_from(&self.frames);
        }
        if let Some(camera) = self.chosen.index.and_then(|index| self.loaded.camera(index)) {
            self.chosen.camera = camera;
        }
        let key = self.key();
        let mut found = ImageState::Missing;
        if self.given.resume {
            found = targets.standing(self.given, &key)?;
            let has_row = self.rows.as_ref().is_none_or(|rows| rows.has(number, &key));
            match found {
                ImageState::Same if has_row => {
                    self.rows.iter_mut().for_each(|rows| rows.keep(number, self.frames.as_ref()));
                    return Ok(found);
                }
                ImageState::Same => found = ImageState::Unreported,
                _ => {}
            }
        }
        self.render(&targets, key, false)?;
        Ok(found)
    }
}

/// Number of frames for each state of the files.
#[derive(Default)]
struct Tally([u32; ImageState::ALL.len()]);

impl Tally {
    fn text(&self) -> String {
        let counted = |standing: ImageState| Some(self.0[standing as usize]).filter(|count| *count > 0);
        let kept = counted(ImageState::Same).unwrap_or(0);
        let made = self.0.iter().sum::<u32>() - kept;
        let reasons: Vec<_> = ImageState::ALL
            .into_iter()
            .filter_map(|standing| Some(format!("{} {}", counted(standing)?, standing.reason()?)))
            .collect();
        let reasons = if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join(", ")) };
        format!("{made} frames were rendered{reasons}, {kept} were there already")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_dealt_out_in_turns_from_the_first() {
        let dealt = |text: &str| dealt(&(3..=9), Shard::parse(text));
        assert_eq!((dealt("1/3"), dealt("2/3"), dealt("3/3")), (vec![3, 6, 9], vec![4, 7], vec![5, 8]));
        assert_eq!((dealt(""), dealt("8/8")), ((3..=9).collect(), vec![]));
    }

    #[test]
    fn a_tally_says_why_frames_were_rendered() {
        let mut tally = Tally::default();
        assert_eq!(tally.text(), "0 frames were rendered, 0 were there already");
        tally.0[ImageState::Same as usize] = 9;
        tally.0[ImageState::Missing as usize] = 2;
        tally.0[ImageState::Damaged as usize] = 1;
        assert_eq!(tally.text(), "3 frames were rendered (2 missing, 1 damaged), 9 were there already");
    }
}
