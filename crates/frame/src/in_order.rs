//! Pictures of all frames, in order.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use crate::{FrameError, FrameInput, FrameRenderer, Picture, Shown};

/// Repeats after which a frame counts as unstable: as many as a build may grow, and one for rounds.
const REPEATS: u32 = 5;

/// What a sequence of frames cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InOrder {
    /// Pictures handed out.
    pub pictures: u64,
    /// Frames that were recorded again, because their build was not complete or rays did not finish.
    pub repeated: u64,
}

/// Renders frames with several in flight and hands out each picture in order; frames without a picture are repeated, with
/// those that were submitted after them. Ends early where `sink` says so. No input may continue the one before.
///
/// # Errors
/// What a frame reports, [`FrameError::Unstable`] where repeating does not help; nothing is in flight then.
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

fn in_order(
    renderer: &mut FrameRenderer,
    inputs: impl IntoIterator<Item = FrameInput>,
    sink: &mut impl FnMut(Picture) -> ControlFlow<()>,
) -> Result<InOrder, FrameError> {
    let mut done = InOrder::default();
    let mut inputs = inputs.into_iter();
    // With the number of times that each was repeated.
    let mut again: VecDeque<(FrameInput, u32)> = VecDeque::new();
    let mut in_flight: VecDeque<(FrameInput, u32)> = VecDeque::new();
    loop {
        while renderer.has_free_slot() {
            let Some((input, repeats)) = again.pop_front().or_else(|| inputs.next().map(|input| (input, 0)))
            else {
                break;
            };
            renderer.submit(&input)?;
            in_flight.push_back((input, repeats));
        }
        let Some(shown) = renderer.take()? else { return Ok(done) };
        let Some((input, repeats)) = in_flight.pop_front() else { return Ok(done) };
        match shown {
            Shown::Picture(picture) => {
                done.pictures += 1;
                if sink(picture).is_break() {
                    return Ok(done);
                }
            }
            Shown::Nothing => {
                if repeats >= REPEATS {
                    let structure = renderer.structure().structure().name();
                    return Err(FrameError::Unstable { structure, repeats });
                }
                // Poses follow each other, so those that came after it are repeated after it.
                while renderer.take()?.is_some() {}
                done.repeated += 1 + in_flight.len() as u64;
                again.push_front((input, repeats + 1));
                in_flight.drain(..).enumerate().for_each(|(place, later)| again.insert(1 + place, later));
            }
        }
    }
}
