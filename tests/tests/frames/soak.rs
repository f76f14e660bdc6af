//! Frame after frame with other triangles elsewhere: hits are those of the oracle or there is no picture, and
//! memory is bounded.

use std::collections::VecDeque;

use rasray_ads::StructureKind;
use rasray_gpu::Timing;
use rasray_metrics::{DeviceHit, HitConfusion};
use rasray_tests::harness::{Bench, bits, oracle_of, oracle_ray};
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tests::tier::Counts;
use rasray_tracer::{FrameOutcome, FrameSettings, Frames, TracerError};

use crate::frames::crowd::{Crowd, Shown};

/// Frames of the system that is the default, and of each other preset.
const FRAMES: [Counts<usize>; 2] = [
    Counts { quick: 2000, software: 2000, full: 10_000 },
    Counts { quick: 60, software: 2000, full: 10_000 },
];

/// Triangles of a frame at most, and rays of each.
const MOST: usize = 600;
const RAYS: usize = 24;

/// The number of triangles jumps, now and then to none or few.
fn count(random: &mut Random, frame: usize) -> usize {
    let small = [0, 1, 2, 5][(random.bits() % 4) as usize];
    let large = random.between(0.0, 1.0).powi(3) * MOST as f32;
    if frame.is_multiple_of(7) { small } else { large as usize }
}

#[test]
fn no_frame_is_wrong_and_nothing_is_left_behind() {
    let bench = Bench::new();
    for subject in Subject::all() {
        let is_default = subject.name() == "bricks robust";
        let frames = FRAMES[usize::from(!is_default)].on(bench.device(), "frames");
        // Two of three frames have other triangles, the third the same number elsewhere.
        soak(&bench, &subject, frames, |frame| frame % 3 == 2, elsewhere, "");
    }
}

/// As many triangles and rays, in places without order.
fn elsewhere(shown: &Shown, random: &mut Random) -> Shown {
    Shown::random(random, shown.triangles.len(), RAYS)
}

/// A tree that is kept: in most frames triangles only move, with the frame before still in flight.
#[test]
fn a_tree_is_refitted_with_frames_in_flight() {
    let bench = Bench::new();
    let bvh = Subject::all().into_iter().find(|subject| subject.name() == "bvh robust");
    let subject = bvh.and_then(|bvh| bvh.with(&[("builder", "refit")])).expect("it has the option");
    let frames = FRAMES[1].on(bench.device(), "frames");
    let refits =
        |moved| soak(&bench, &subject, frames, |frame| !frame.is_multiple_of(6), moved, "bvh/build_9_refit");
    // The first two of six frames make a tree each: a status of theirs is read when the third is recorded.
    // Now and then other triangles are as many as before, so that they count as moved.
    let smooth = refits(Shown::sheared);
    assert!(smooth >= frames * 2 / 3 && smooth < frames * 5 / 6, "{smooth} of {frames}");
    // Without order a tree is bad at once, which is noticed as late.
    let wild = refits(elsewhere);
    assert!(wild >= frames / 6 && wild < smooth, "{wild} of {frames}");
}

/// Answers in how many frames there was a pass of that label. `only_moves` says whether a frame keeps the
/// number of triangles of the one before; `moved` makes such a frame.
fn soak(
    bench: &Bench,
    subject: &Subject,
    count_of_frames: usize,
    only_moves: fn(usize) -> bool,
    moved: fn(&Shown, &mut Random) -> Shown,
    label: &str,
) -> usize {
    let (device, name) = (bench.device(), subject.name());
    let before = device.allocated_bytes();
    let mut random = Random::new(0x0066_7261_6D65);
    let settings = FrameSettings::default();
    let timing = if label.is_empty() { Timing::None } else { Timing::Device };
    let mut labelled = 0;
    let crowd = Crowd::new(device, settings.slots, MOST, RAYS);
    let mut shown = Shown::random(&mut random, MOST / 8, RAYS);
    let mut geometry = crowd.geometry(&shown);
    let structure = subject.structure(bench, &geometry);
    let mut frames = Frames::new(device, structure, settings, timing).expect("the device works");
    let mut in_flight = VecDeque::new();
    let (mut right, mut found, mut ambiguous, mut incomplete) = (0, 0, 0, 0);
    let mut halfway = None;
    for frame in 0..count_of_frames + settings.slots as usize {
        let is_over = frame >= count_of_frames;
        if is_over || frames.free_slot().is_none() {
            let ended = frames.take().expect("the device works").expect("a frame is in flight");
            let expected: Shown = in_flight.pop_front().expect("one for each frame");
            let (hits, counters) = crowd.read(ended.slot);
            labelled += usize::from(ended.passes.iter().any(|pass| pass.label == label));
            // All or nothing: either no ray of a frame has an answer, or all have the right one.
            assert_eq!((counters.unfinished, counters.corrupted), (0, 0), "{name}, frame {}", ended.number);
            let is_answered = counters.not_ready == 0;
            assert!(is_answered || counters.not_ready as usize == RAYS, "{name}, {counters:?}");
            if is_answered {
                ambiguous += check(bench, subject, &expected, &hits, ended.number);
            }
            match ended.outcome {
                FrameOutcome::Complete => assert!(is_answered, "{name}, frame {}", ended.number),
                FrameOutcome::Incomplete { pool } => {
                    assert!(!is_answered, "{name}: frame {} is right", ended.number);
                    assert!(pool.is_none_or(|pool| pool.lacking() > 0), "{name}: {pool:?}");
                    incomplete += 1;
                }
            }
            right += usize::from(is_answered);
            found += hits.iter().filter(|hit| is_answered && hit.is_hit()).count();
        }
        if is_over {
            continue;
        }
        shown = if only_moves(frame) {
            moved(&shown, &mut random)
        } else {
            let triangles = count(&mut random, frame);
            Shown::random(&mut random, triangles, RAYS)
        };
        if shown.triangles.len() as u32 == geometry.triangle_count() {
            frames.geometry_moved();
        } else {
            geometry = crowd.geometry(&shown);
            frames.set_geometry(&geometry).expect("the geometry fits");
        }
        let slot = frames.free_slot().expect("one was taken");
        crowd.write(slot, &shown);
        let submitted = frames.submit::<TracerError>(
            shown.eye.into(),
            |recorder, slot| crowd.record_move(recorder, slot, &geometry),
            |recorder, slot, structure| {
                crowd.record_trace(recorder, slot, structure);
                Ok(())
            },
        );
        assert_eq!(submitted.expect("the frame is recorded"), frame as u64);
        in_flight.push_back(shown.clone());
        if frame == count_of_frames / 2 {
            halfway = Some(overhead(device, &frames));
        }
    }
    let counts = frames.structure().counts();
    println!(
        "{name}: {right} answered, {incomplete} not shown, {found} hits, {ambiguous} rays ambiguous, {counts:?}"
    );
    assert!(found > right, "{name}: {found} hits cannot tell right from wrong");
    assert_eq!(counts.frames as usize, count_of_frames);
    assert_eq!(counts.incomplete as usize, incomplete);
    // Growth has headroom, so that pools soon suffice.
    assert!(incomplete <= 12 + count_of_frames / 50, "{name}: {incomplete} frames were not shown");
    // Beyond the pools of the structure nothing grows with the number of frames.
    let at_end = overhead(device, &frames);
    let halfway = halfway.expect("there is a frame halfway");
    assert!(at_end <= halfway + 65_536, "{name}: {halfway} bytes halfway, {at_end} in the end");
    drop((frames, crowd, geometry));
    assert_eq!(device.allocated_bytes(), before, "{name}");
    labelled
}

/// Bytes on the device that are not pools.
fn overhead(device: &rasray_gpu::Device, frames: &Frames) -> u64 {
    device.allocated_bytes().saturating_sub(frames.structure().structure().sizes().bytes())
}

/// Compares hits: on triangles with the oracle, of fragments with those of a structure made for this frame,
/// now and then. Returns how many rays have several right answers.
fn check(bench: &Bench, subject: &Subject, shown: &Shown, hits: &[rasray_ads::Hit], frame: u64) -> u64 {
    let name = subject.name();
    if subject.kind != StructureKind::Primitive {
        if frame.is_multiple_of(20) {
            let mut fresh = subject.structure(bench, &bench.geometry(&shown.triangles));
            let expected = bench.build_and_trace(fresh.as_mut(), shown.eye, &shown.rays);
            let key = |hits: &[rasray_ads::Hit]| hits.iter().map(bits).collect::<Vec<_>>();
            assert_eq!(key(hits), key(&expected), "{name}, frame {frame}");
        }
        return 0;
    }
    let rays: Vec<_> = shown.rays.iter().map(oracle_ray).collect();
    let verdicts = oracle_of(&shown.triangles).closest_batch(&rays);
    let found: Vec<_> = hits
        .iter()
        .map(|hit| hit.is_hit().then_some(DeviceHit { t: hit.t, primitive: Some(hit.primitive) }))
        .collect();
    let confusion = HitConfusion::measure(&verdicts, &found, 0.0).expect("one hit per ray");
    assert!(
        confusion.is_clean(),
        "{name}, frame {frame}, {} triangles: {confusion:?}",
        shown.triangles.len()
    );
    confusion.ambiguous
}
