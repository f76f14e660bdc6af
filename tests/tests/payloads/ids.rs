//! Ids beside payloads that do not need them.

use rasray_ads::{PRIMITIVE_NONE, PRIMITIVE_UNKNOWN};
use rasray_gpu::Timing;
use rasray_systems::Spec;
use rasray_tests::harness::Bench;
use rasray_tests::pictures::{rays_inside, stage};
use rasray_tests::tier::is_full;
use rasray_tracer::build_until_complete;

use crate::payloads::published::{SIZE, made};

/// Ids kept for diagnostics give the triangle of a hit and change nothing else: t and surfaces are the same
/// to the bit.
#[test]
fn ids_name_triangles_and_change_nothing_else() {
    let bench = Bench::new();
    let scene = stage(&bench, "cornell", SIZE);
    let rays = rays_inside(&scene, 3000);
    let robust = Spec::new("bvh", "robust", []).expect("the options are valid");
    let mut tree =
        robust.create(bench.device(), scene.geometry(), Some(scene.binding())).expect("pipelines are made");
    build_until_complete(bench.device(), tree.as_mut(), scene.eye(), Timing::None)
        .expect("the build completes");
    let truth = bench.surfaces(tree.as_ref(), &rays);
    // Several choices at once; the full tier tries them separately.
    let apart: &[(&str, &[(&str, &str)])] = &[
        ("mmrt", &[]),
        ("mmrt", &[("storage", "sb"), ("inline", "on")]),
        ("hu", &[("storage", "paged")]),
        ("ldc", &[]),
        ("mmrt", &[("storage", "ll"), ("inline", "on")]),
        ("mmrt", &[("storage", "sb")]),
        ("mmrt", &[("storage", "paged"), ("page", "4")]),
        ("hu", &[("storage", "sb")]),
    ];
    let cases: &[(&str, &[(&str, &str)])] = &[
        ("mmrt", &[("storage", "paged"), ("page", "2"), ("inline", "on")]),
        ("mmrt", &[("payload", "normal")]),
        ("mmrt", &[("payload", "plane"), ("accept", "plane"), ("march", "exact")]),
        ("hu", &[]),
        ("ldc", &[("build", "peel")]),
        ("ldc", &[("depth", "32"), ("coverage", "conservative")]),
    ];
    for (system, options) in cases.iter().chain(if is_full() { apart } else { &[] }) {
        let name = format!("{system} {options:?}");
        let of = |ids: &'static str| {
            let given = [("resolution", "96"), ("ids", ids)];
            let given: Vec<_> = given.into_iter().chain(options.iter().copied()).collect();
            let structure = made(&bench, &scene, system, &given);
            let report = structure.report().expect("the header is readable");
            let used = report.bytes() - report.slack();
            (bench.surfaces(structure.as_ref(), &rays), used, report.diagnostic_bytes)
        };
        let (without, used, none) = of("off");
        let (with, more, diagnostic) = of("on");
        assert_eq!((none, more - used), (0, diagnostic), "{name}");
        assert!(diagnostic > 0 && diagnostic % 4 == 0, "{name}");
        let mut compared = (0, 0);
        for ((off, off_surface), ((on, on_surface), (true_hit, _))) in
            without.iter().zip(with.iter().zip(&truth))
        {
            assert_eq!(off.t.to_bits(), on.t.to_bits(), "{name}");
            if !off.is_hit() {
                continue;
            }
            assert_eq!(off_surface, on_surface, "{name}: another surface");
            assert!(on.primitive != PRIMITIVE_UNKNOWN, "{name}: a hit without a name");
            if off.primitive == PRIMITIVE_UNKNOWN {
                let near = (on.t - true_hit.t).abs() < 0.02 && true_hit.primitive != PRIMITIVE_NONE;
                compared.0 += usize::from(near);
                // The two triangles of a wall follow each other; either's plane is hit all over the wall.
                compared.1 += usize::from(near && on.primitive / 2 == true_hit.primitive / 2);
            } else {
                assert_eq!(off.primitive, on.primitive, "{name}");
            }
        }
        println!("{name}: {} of {} hit the wall, {diagnostic} bytes", compared.1, compared.0);
        // Where walls touch, a fragment may be a neighbour's; more often where fragments are as thick as
        // cells.
        let thick = *system == "mmrt" && !options.contains(&("accept", "plane"));
        let least = if thick { 0.9 } else { 0.95 };
        assert!(compared.0 > 500 && compared.1 as f64 >= least * compared.0 as f64, "{name}: {compared:?}");
    }
}

#[test]
fn ids_go_with_payloads_that_lack_them() {
    for (system, preset) in
        [("mmrt", "robust"), ("hu", "robust"), ("selective", "published"), ("ldc", "robust")]
    {
        let refused = Spec::new(system, preset, [("ids".to_owned(), "on".to_owned())]).err();
        let refused = refused.expect("it is refused").to_string();
        assert!(refused.contains("ids"), "{system}: {refused}");
    }
}
