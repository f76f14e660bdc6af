//! Rendering of a sequence of frames into pictures in order.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use rasray_gpu_scene::FramePose;

use crate::{FrameError, FrameInput, FrameRenderer, FrameResult, FrameScene, Picture};

/// Maximum number of repeats; a frame that needs more counts as unstable. It covers the maximum number of
/// regrowths of a build, one repeat for the rounds of traces, and one for each doubling of the rounds of
/// paths that pass surfaces.
const REPEATS: u32 = 16;

/// Counts of a rendered sequence of frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InOrder {
    /// Number of pictures handed out.
    pub pictures: u64,
    /// Number of frames that were recorded again, because their build was not complete or rays did not
    /// finish.
    pub repeated: u64,
}

/// Renders frames with several in flight and hands out each picture in order. A frame without a picture is
/// repeated, together with the frames that were submitted after it. Rendering ends early if `sink` says so.
/// No input may continue the one before.
///
/// A frame that shows the scene as it was before the first pose cannot be repeated once a later frame has
/// moved the scene. The first frame with a pose therefore waits for the earlier frames without a pose, in
/// their own input or in an input before. All other frames overlap.
///
/// # Errors
/// Errors of frames, [`FrameError::Unstable`] if repeating does not help; no frame is in flight after an
/// error.
pub fn render_in_order(
    renderer: &mut FrameRenderer,
    inputs: impl IntoIterator<Item = FrameInput>,
    mut sink: impl FnMut(Picture) -> ControlFlow<()>,
) -> Result<InOrder, FrameError> {
    let rendered = in_order(renderer, inputs, &mut sink);
    // The loop also runs after an error and after an early end.
    loop {
        match renderer.take() {
            Ok(Some(_)) => {}
            Ok(None) => return rendered,
            Err(error) => return rendered.and(Err(error)),
        }
    }
}

/// Scene and pose of the last input, for frames that name none.
struct Last {
    scene: FrameScene,
    /// Pose of the scene; absent if no frame has posed the scene yet, or not since it replaced another scene.
    pose: Option<FramePose>,
}

impl Last {
    /// Fills in the scene and the pose of an input that names none, so that the frame shows them whatever
    /// frames are submitted in between.
    fn complete(&mut self, input: FrameInput) -> FrameInput {
        if let Some(scene) = input.scene.as_ref().filter(|scene| !scene.is(&self.scene)) {
            *self = Self { scene: scene.clone(), pose: None };
        }
        if input.pose.is_some() {
            self.pose.clone_from(&input.pose);
        }
        FrameInput { scene: Some(self.scene.clone()), pose: self.pose.clone(), ..input }
    }
}

/// Input of a frame, with the number of times that it was repeated.
type Repeated = (FrameInput, u32);

fn in_order(
    renderer: &mut FrameRenderer,
    inputs: impl IntoIterator<Item = FrameInput>,
    sink: &mut impl FnMut(Picture) -> ControlFlow<()>,
) -> Result<InOrder, FrameError> {
    let mut done = InOrder::default();
    let mut last = Last { scene: renderer.scene().clone(), pose: renderer.posed().cloned() };
    let mut inputs = inputs.into_iter().map(|input| (last.complete(input), 0));
    let mut waiting: VecDeque<Repeated> = VecDeque::new();
    let mut in_flight: VecDeque<Repeated> = VecDeque::new();
    loop {
        while renderer.has_free_slot() {
            let Some((input, repeats)) = waiting.pop_front().or_else(|| inputs.next()) else { break };
            if input.pose.is_some() && in_flight.iter().any(|(before, _)| before.pose.is_none()) {
                waiting.push_front((input, repeats));
                break;
            }
            renderer.submit(&input)?;
            in_flight.push_back((input, repeats));
        }
        let Some(shown) = renderer.take()? else { return Ok(done) };
        let Some((input, repeats)) = in_flight.pop_front() else { return Ok(done) };
        match shown {
            FrameResult::Picture(picture) => {
                done.pictures += 1;
                if sink(picture).is_break() {
                    return Ok(done);
                }
            }
            FrameResult::Nothing { pool } => {
                if repeats >= REPEATS {
                    let structure = renderer.structure().structure().description().name;
                    return Err(FrameError::Unstable { structure, repeats, pool });
                }
                // Poses are applied in order, so the frames submitted after this one are repeated after it.
                while renderer.take()?.is_some() {}
                done.repeated += 1 + in_flight.len() as u64;
                waiting.push_front((input, repeats + 1));
                in_flight.drain(..).enumerate().for_each(|(place, later)| waiting.insert(1 + place, later));
            }
        }
    }
}
