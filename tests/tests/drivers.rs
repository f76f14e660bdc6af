//! Equal hits on every driver: one small scene through every robust preset. The test programs run on one
//! driver; this one runs on each of the others as well.

use rasray_ads::{Hit, Ray};
use rasray_systems::Preset;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tests::shapes::{closed_box, sphere};
use rasray_tests::tier::is_full;

const RAYS: usize = 400;

/// FNV-1a of all bits of the nearest hits by brute force. Software drivers round as IEEE 754 says, so that
/// these are one number; the quotients of hardware may be off by 2.5 ulp.
const HITS: u64 = 0x856d_cc03_a334_339a;

fn fnv(hits: &[Hit]) -> u64 {
    let words = hits.iter().flat_map(|hit| bits(hit).into_iter().flat_map(u32::to_le_bytes));
    words.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

#[test]
fn hits_are_the_same_on_every_driver() {
    let bench = Bench::new();
    let mut triangles = closed_box([-2.0; 3], [2.0; 3]);
    triangles.extend(sphere([0.3, 0.1, 0.9], 0.6, 12));
    let geometry = bench.geometry(&triangles);
    let mut random = Random::new(0x6472_6976_6572);
    let rays: Vec<Ray> = (0..RAYS)
        .map(|_| Ray::new([0; 3].map(|_: u8| random.between(-1.9, 1.9)), random.direction()))
        .collect();
    let subjects = Subject::all();
    let robust = subjects.iter().filter(|subject| subject.spec.preset() == Preset::Robust);
    let mut expected: Option<Vec<[u32; 4]>> = None;
    let brute_force_first = |subject: &&Subject| subject.spec.system().name != "brute-force";
    let mut robust: Vec<_> = robust.collect();
    robust.sort_by_key(brute_force_first);
    // Its compiler takes minutes for the traces of fragments.
    let slow = bench.device().name().contains("SwiftShader") && !is_full();
    for subject in robust {
        if slow && !subject.kind.finds_triangles() {
            println!("skipped: {} on {}: set RASRAY_FULL to 1", subject.name(), bench.device().name());
            continue;
        }
        let mut structure = subject.spec.create(bench.device(), &geometry, None).expect("it can be made");
        let hits = bench.build_and_trace(structure.as_mut(), [0.0; 3], &rays);
        println!("{}: {:016x} on {}", subject.name(), fnv(&hits), bench.device().name());
        let Some(expected) = &expected else {
            if bench.device().is_software() {
                assert_eq!(fnv(&hits), HITS, "{:016x}", fnv(&hits));
            }
            expected = Some(hits.iter().map(bits).collect());
            continue;
        };
        if subject.kind.finds_triangles() {
            assert!(hits.iter().map(bits).eq(expected.iter().copied()), "{}", subject.name());
        }
    }
}
