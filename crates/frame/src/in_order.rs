//! Pictures of all frames, in order.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use rasray_gpu_scene::FramePose;

use crate::{FrameError, FrameInput, FrameRenderer, FrameResult, FrameScene, Picture};

/// Repeats after which a frame counts as unstable: as many as a build may grow, one for rounds of traces, and
/// as often as the rounds of paths that pass surfaces can double.
const REPEATS: u32 = 16;

/// Counts of a sequence of frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InOrder {
    /// Pictures handed out.
    pub pictures: u64,
    /// Frames that were recorded again, because their build was not complete or rays did not finish.
    pub repeated: u64,
}

/// Renders frames with several in flight and hands out each picture in order; frames without a picture are
/// repeated, with those that were submitted after them. Ends early where `sink` says so. No input may
/// continue the one before.
///
/// Frames that nothing has posed yet cannot be brought back once a later one moved the scene, so the first
/// frame with a pose waits for those before it that have none, in their own input or in one before. All
/// others overlap.
///
/// # Errors
/// Errors of frames, [`FrameError::Unstable`] where repeating does not help; nothing is in flight then.
pub fn render_in_order(
    renderer: &mut FrameRenderer,
    inputs: impl IntoIterator<Item = FrameInput>,
    mut sink: impl FnMut(Picture) -> ControlFlow<()>,
) -> Result<InOrder, FrameError> {
    let rendered = in_order(renderer, inputs, &mut sink);
    // Also after an error, and after an early end.
    loop {
        match renderer.take() {
            Ok(Some(_)) => {}
            Ok(None) => return rendered,
            Err(error) => return rendered.and(Err(error)),
        }
    }
}

/// Scene and pose of frames that name none.
struct Last {
    scene: FrameScene,
    /// Absent where nothing has posed the scene yet, or where it was shown before others were.
    pose: Option<FramePose>,
}

impl Last {
    /// The frame with its scene and its pose named, so that it shows these whatever is submitted between.
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

/// A frame with the number of times that it was repeated.
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
                // Poses follow each other, so those that came after it are repeated after it.
                while renderer.take()?.is_some() {}
                done.repeated += 1 + in_flight.len() as u64;
                waiting.push_front((input, repeats + 1));
                in_flight.drain(..).enumerate().for_each(|(place, later)| waiting.insert(1 + place, later));
            }
        }
    }
}
