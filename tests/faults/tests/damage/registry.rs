//! Every system of the registry with pools that hold anything at all: traces end within their bounds, and
//! what was built is found again once it is back. Which damage is reported, and how, is tested for each
//! structure that has a file here.

use rasray_ads::TraceMode;
use rasray_faults::{device, finish, in_child, rays, scrambled, spec, stage};
use rasray_gpu::Timing;
use rasray_systems::SYSTEMS;
use rasray_tests::tier::is_full;
use rasray_tracer::{BatchTracer, TracerError, build_until_complete};

use crate::damage::survive::{RAYS, words};

/// A name, and a function that overwrites every word of a pool.
type Filling = (&'static str, fn(&mut [u32]));

const FILLINGS: [Filling; 3] = [
    ("at random", |words| words.fill_with(scrambled(0x9E37_79B9))),
    ("all ones", |words| words.fill(u32::MAX)),
    ("zeros", |words| words.fill(0)),
];

fn check(system: &str, addressing: &str) {
    let device = device().expect("a device");
    let scene = stage(&device).expect("a scene");
    let spec = spec(system, "robust").expect("every system has it").with_option("addressing", addressing);
    let spec = spec.expect("every system with pools takes it");
    let mut structure =
        spec.create(&device, scene.geometry(), Some(scene.binding())).expect("the options are valid");
    build_until_complete(&device, structure.as_mut(), scene.eye(), Timing::None).expect("a build");
    let tracer = BatchTracer::new(&device, RAYS).expect("a queue");
    let rays = rays(&scene, RAYS);
    let trace =
        |mode| tracer.trace(structure.as_ref(), &rays, mode, Timing::None).map(|outcome| outcome.hits);
    let expected = trace(TraceMode::Closest).expect("hits");
    assert!(expected.iter().filter(|hit| hit.is_hit()).count() > 8, "{system}: rays hit something");
    let inspected = structure.inspect().expect("it has pools");
    assert_eq!(inspected.fault(&device).expect("contents"), None, "{system}: an undamaged build");
    let whole = inspected.download_pools(&device).expect("contents");
    let (mut told, mut found) = (0, 0);
    let upload = |pools: &[(&'static str, Vec<u32>)]| {
        // SAFETY: the header is the one that was downloaded, and nothing was resized since.
        unsafe { inspected.upload_pools(&device, pools) }.expect("contents");
    };
    // The header is trusted.
    for place in 1..whole.len() {
        for (filling, fill) in FILLINGS {
            let mut pools = whole.clone();
            fill(&mut pools[place].1);
            for mode in [TraceMode::Closest, TraceMode::Occluded] {
                // Damage counts once: each trace is evaluated by itself.
                upload(&pools);
                let result = trace(mode);
                println!(
                    "{system}, {addressing}: {} {filling}, {mode:?}: {}",
                    pools[place].0,
                    words(&result)
                );
                match result {
                    Ok(_) => {}
                    Err(TracerError::Corrupted { .. } | TracerError::Unfinished { .. }) => told += 1,
                    Err(error) => panic!("{system}: {error}"),
                }
            }
            found += usize::from(inspected.fault(&device).expect("contents").is_some());
        }
    }
    assert!(told > 0, "{system}: no trace says that anything is wrong");
    assert!(found > 0, "{system}: the check of the contents finds nothing");
    upload(&whole);
    assert_eq!(trace(TraceMode::Closest).expect("hits"), expected, "{system}: the damage outlives it");
    drop((tracer, structure, scene));
    assert_eq!(finish(device), Vec::<String>::new());
}

#[test]
fn whatever_pools_hold_is_survived() {
    if in_child("damage::registry::whatever_pools_hold_is_survived") {
        for system in SYSTEMS.iter().filter(|system| system.has("addressing")) {
            let tried: &[_] = if is_full() { &["descriptor", "address"] } else { &["descriptor"] };
            tried.iter().for_each(|addressing| check(system.name, addressing));
        }
    }
}
