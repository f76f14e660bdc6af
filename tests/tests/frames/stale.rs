//! Frames that build: those for which something changed that the structure depends on.

use rasray_ads::{CameraView, Structure, Viewpoint};
use rasray_gpu::Timing;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tracer::{FrameOutcome, FrameSettings, Frames, TracerError};

use crate::frames::crowd::{Crowd, Shown};

const RAYS: usize = 64;

fn looking(eye: [f32; 3], right: [f32; 3], forward: [f32; 3]) -> Viewpoint {
    let camera = CameraView { right, up: [0.0, 1.0, 0.0], forward, half_width: 1.0, half_height: 1.0 };
    Viewpoint { eye, camera: Some(camera) }
}

#[test]
fn only_what_a_structure_depends_on_makes_it_build() {
    let bench = Bench::new();
    let device = bench.device();
    let mut random = Random::new(11);
    let shown = Shown::random(&mut random, 120, RAYS);
    let [x, y, z] = shown.eye;
    let here = looking(shown.eye, [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
    let turned = looking(shown.eye, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let away = looking([x + 0.01, y, z], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    for subject in Subject::all() {
        let name = subject.name();
        let settings = FrameSettings::default();
        let crowd = Crowd::new(device, settings.slots, 120, RAYS);
        let geometry = crowd.geometry(&shown);
        let structure = subject.structure(&bench, &geometry);
        let depends_on = structure.description().depends_on;
        // Cells along the axes are the same for every eye that is not far away.
        let eye_matters = structure.is_stale(turned, away);
        assert!(!eye_matters || depends_on.are_stale(turned, away), "{name}");
        let mut frames = Frames::new(device, structure, settings, Timing::None).expect("the device works");
        let show = |frames: &mut Frames, viewpoint: Viewpoint| {
            let slot = frames.free_slot().expect("none is in flight");
            crowd.write(slot, &shown);
            let trace = |recorder: &mut rasray_gpu::Recorder<'_>, slot: u32, structure: &dyn Structure| {
                crowd.record_trace(recorder, slot, structure);
                Ok::<(), TracerError>(())
            };
            let before = |recorder: &mut rasray_gpu::Recorder<'_>, slot: u32| {
                crowd.record_move(recorder, slot, &geometry);
            };
            frames.submit(viewpoint, before, trace).expect("the frame is recorded");
            let ended = frames.take().expect("the device works").expect("one is in flight");
            (ended.built, ended.outcome, crowd.read(ended.slot).0.iter().map(bits).collect::<Vec<_>>())
        };
        // Until the pools suffice.
        let first = loop {
            let (built, outcome, hits) = show(&mut frames, here);
            assert!(built, "{name}: what is not complete is built again");
            if outcome == FrameOutcome::Complete {
                break hits;
            }
        };
        let (built, outcome, hits) = show(&mut frames, here);
        assert_eq!((built, outcome), (false, FrameOutcome::Complete), "{name}: nothing changed");
        assert_eq!(hits, first, "{name}: nothing changed");
        assert_eq!(show(&mut frames, turned).0, depends_on.camera, "{name}: the camera turned");
        let (built, outcome, _) = show(&mut frames, away);
        assert_eq!(built, eye_matters, "{name}: the eye moved");
        assert!(outcome == FrameOutcome::Complete || built, "{name}");
        frames.geometry_moved();
        assert!(show(&mut frames, away).0, "{name}: the triangles moved");
        let same = crowd.geometry(&shown);
        frames.set_geometry(&same).expect("the geometry fits");
        assert!(show(&mut frames, away).0, "{name}: other triangles");
    }
}

#[test]
fn a_ring_is_used_in_turn() {
    let bench = Bench::new();
    let device = bench.device();
    let shown = Shown::random(&mut Random::new(3), 40, RAYS);
    let crowd = Crowd::new(device, 2, 40, RAYS);
    let geometry = crowd.geometry(&shown);
    let subject = Subject::all().into_iter().find(|subject| subject.name() == "bricks robust");
    let structure = subject.expect("the registry has bricks").structure(&bench, &geometry);
    let mut frames =
        Frames::new(device, structure, FrameSettings::default(), Timing::None).expect("the device works");
    assert!(frames.take().expect("nothing failed").is_none(), "none is in flight");
    let submit = |frames: &mut Frames, refuses: bool| {
        frames.submit(
            shown.eye.into(),
            |recorder, slot| {
                crowd.write(slot, &shown);
                crowd.record_move(recorder, slot, &geometry);
            },
            |recorder, slot, structure| {
                crowd.record_trace(recorder, slot, structure);
                if refuses { Err(TracerError::NoSteps { structure: "none" }) } else { Ok(()) }
            },
        )
    };
    // A frame that is refused was never there: the next one builds.
    let refused = submit(&mut frames, true).expect_err("the frame is refused");
    assert!(matches!(refused, TracerError::NoSteps { .. }), "{refused}");
    assert_eq!(submit(&mut frames, false).expect("the frame is recorded"), 0);
    assert_eq!(submit(&mut frames, false).expect("the frame is recorded"), 1);
    assert_eq!(frames.free_slot(), None);
    let busy = submit(&mut frames, false).expect_err("both slots are in use");
    assert!(matches!(busy, TracerError::Busy { slots: 2 }), "{busy}");
    let first = frames.take().expect("the device works").expect("two are in flight");
    assert_eq!((first.number, first.slot, first.built), (0, 0, true));
    let second = frames.take().expect("the device works").expect("one is in flight");
    assert_eq!((second.number, second.slot, second.built), (1, 1, false));
    // The second was traced through what the first built.
    assert_eq!(first.outcome, second.outcome);
}
