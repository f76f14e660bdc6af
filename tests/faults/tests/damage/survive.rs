//! Damages what a structure has built, one way after the other, and holds traces to what they must say of it.

use std::time::Instant;

use rasray_ads::kit::{Design, Pooled};
use rasray_ads::{Geometry, Hit, SceneBinding, TraceMode};
use rasray_faults::{device, finish, rays, stage};
use rasray_gpu::{Device, Timing};
use rasray_tests::harness::bits_of_any_build;
use rasray_tracer::{BatchTracer, TracerError, build_until_complete};

pub const RAYS: u32 = 96;

/// Signs of damage in traces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flag {
    /// Rays in a cyclic list are given up and counted.
    Unfinished,
    /// Entries with an invalid index are counted.
    Corrupted,
    /// A trace cannot detect it: the indices are valid, but wrong. The check of the contents does.
    Contents,
}

/// Damage by its name, and what traces say of it.
pub type Damage<C> = (&'static str, fn(&mut C), Flag);

/// Changes the link of every node of a conservative list (`ads/conservative.glsl`); `change` is given the
/// node's own link.
pub fn each_conservative_node(conservative: &mut [u32], count: u32, change: impl Fn(u32) -> u32) {
    for (index, node) in conservative.chunks_exact_mut(3).take(count as usize).enumerate() {
        node[1] = change(index as u32 + 1);
    }
}

/// Builds a structure over the room, and checks every damage to it.
pub fn survive<D: Design<Contents: Clone>>(
    make: impl FnOnce(&Device, &Geometry, &SceneBinding) -> Pooled<D>,
    damages: &[Damage<D::Contents>],
) {
    let device = device().expect("a device");
    let scene = stage(&device).expect("a scene");
    let mut structure = make(&device, scene.geometry(), scene.binding());
    build_until_complete(&device, &mut structure, scene.eye(), Timing::None).expect("a build");
    let tracer = BatchTracer::new(&device, RAYS).expect("a queue");
    let rays = rays(&scene, RAYS);
    let trace = |structure: &Pooled<D>, mode| {
        tracer.trace(structure, &rays, mode, Timing::None).map(|outcome| outcome.hits)
    };
    let upload = |structure: &Pooled<D>, contents: &D::Contents| {
        // SAFETY: damages leave the header's capacities and addresses alone, and nothing was resized since
        // the download.
        unsafe { structure.upload(&device, contents) }.expect("contents");
    };
    let triangles = scene.geometry().triangle_count();
    let whole = structure.download(&device).expect("contents");
    assert_eq!(D::fault(&whole, triangles), None, "an undamaged build");
    let expected = trace(&structure, TraceMode::Closest).expect("hits");
    let found = expected.iter().filter(|hit| hit.is_hit()).count();
    // At this resolution published presets lose many hits.
    assert!(found > 8, "{found} hits");
    for &(name, damage, flag) in damages {
        let mut contents = whole.clone();
        damage(&mut contents);
        assert!(D::fault(&contents, triangles).is_some(), "{name}: the check of the contents finds nothing");
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            // Damage counts once: each trace is evaluated by itself.
            upload(&structure, &contents);
            let start = Instant::now();
            let result = trace(&structure, mode);
            println!("{name}, {mode:?}: {} in {:?}", words(&result), start.elapsed());
            // A ray that is answered at its first hit need not reach the damage.
            let any = mode == TraceMode::Occluded && flag == Flag::Unfinished;
            let flagged = match flag {
                Flag::Unfinished => matches!(result, Err(TracerError::Unfinished { .. })),
                Flag::Corrupted => matches!(result, Err(TracerError::Corrupted { .. })),
                Flag::Contents => result.is_ok(),
            };
            assert!(flagged || any && result.is_ok(), "{name}, {mode:?}: {}", words(&result));
        }
    }
    upload(&structure, &whole);
    assert_eq!(trace(&structure, TraceMode::Closest).expect("hits"), expected, "the damage outlives it");
    let of_any_build = |hits: &[Hit]| hits.iter().map(bits_of_any_build).collect::<Vec<_>>();
    let again = build_until_complete(&device, &mut structure, scene.eye(), Timing::None).expect("a build");
    assert_eq!(again.status.corrupted, 0);
    let rebuilt = trace(&structure, TraceMode::Closest).expect("hits");
    assert_eq!(of_any_build(&rebuilt), of_any_build(&expected));
    drop((tracer, structure, scene));
    assert_eq!(finish(device), Vec::<String>::new());
}

/// Report of a trace, in words.
pub fn words(result: &Result<Vec<Hit>, TracerError>) -> String {
    match result {
        Ok(hits) => format!("{} hits", hits.iter().filter(|hit| hit.is_hit()).count()),
        Err(error) => error.to_string(),
    }
}
