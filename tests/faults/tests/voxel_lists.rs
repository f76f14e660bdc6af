//! Lists of voxels' views that were damaged after a build: traces end, say so, and touch nothing that is not theirs.
//!
//! As in `lists.rs` everything runs in a process of its own.

use std::time::Instant;

use rasray_ads::{Hit, TraceMode};
use rasray_faults::{device, finish, in_child, rays, scrambled, stage};
use rasray_gpu::Timing;
use rasray_tracer::{BatchTracer, TracerError, build_until_complete};
use rasray_voxel::{Addressing, Config, Contents, Payload, Storage, Voxels, well_formed};

const RAYS: u32 = 96;

/// Damage by its name.
type Damage = (&'static str, fn(&mut Contents));

/// Words of a fragment or a page, and that of its link among them.
fn link_word(config: &Config) -> (usize, usize) {
    let words = (config.payload.fragment_bytes() / 4) as usize;
    if config.storage == Storage::Paged { (1 + config.page as usize * words, 0) } else { (words + 1, words) }
}

/// Changes the link of every fragment or page; `change` is given what leads to the fragment or page itself.
fn each_link(contents: &mut Contents, mut change: impl FnMut(u32) -> u32) {
    let (stride, word) = link_word(&contents.config);
    let paged = contents.config.storage == Storage::Paged;
    let count = contents.header.demand.min(contents.header.capacity) as usize;
    for (index, entry) in contents.fragments.chunks_exact_mut(stride).take(count).enumerate() {
        let own = index as u32 + 1;
        entry[word] = change(if paged { own << 4 | 1 } else { own });
    }
}

/// What leads just past the end.
fn past(contents: &Contents) -> u32 {
    let link = contents.header.demand.min(contents.header.capacity) + 1;
    if contents.config.storage == Storage::Paged { link << 4 | 1 } else { link }
}

/// Damage to links.
const OF_LINKS: [Damage; 6] = [
    ("everything is its own neighbour", |c| each_link(c, |own| own)),
    ("every list is a circle", |c| {
        let config = c.config;
        let (stride, word) = link_word(&config);
        for list in (0..c.lists.len()).filter(|&list| c.lists[list] != 0).collect::<Vec<_>>() {
            let last = *c.places(list).expect("it is whole so far").last().expect("it is not empty") as usize;
            let last = if config.storage == Storage::Paged { last / config.page as usize } else { last };
            c.fragments[stride * last + word] = c.lists[list];
        }
    }),
    ("links just past the end", |c| {
        let past = past(c);
        each_link(c, |_| past);
    }),
    ("links far past the end", |c| each_link(c, |_| u32::MAX)),
    ("lists just past the end", |c| {
        let past = past(c);
        c.lists.fill(past);
    }),
    ("links at random", |c| {
        let mut next = scrambled(0x9E37_79B9);
        each_link(c, |_| next());
    }),
];

/// Damage to any storage.
const OF_ANY: [Damage; 3] = [
    ("lists at random", |c| {
        let mut next = scrambled(0x1234_5677);
        c.lists.fill_with(&mut next);
    }),
    ("lists that are all ones", |c| c.lists.fill(u32::MAX)),
    ("lists and fragments at random", |c| {
        let mut next = scrambled(0x2545_F491);
        c.lists.fill_with(&mut next);
        c.fragments.fill_with(&mut next);
    }),
];

fn check(config: Config, damages: &[Damage]) {
    let device = device().expect("a device");
    let scene = stage(&device).expect("a scene");
    let mut structure =
        Voxels::new(&device, config, scene.geometry(), Some(scene.binding())).expect("valid options");
    build_until_complete(&device, &mut structure, scene.eye(), Timing::None).expect("a build");
    let tracer = BatchTracer::new(&device, RAYS).expect("a queue");
    let rays = rays(&scene, RAYS);
    let trace = |structure: &Voxels, mode| {
        tracer.trace(structure, &rays, mode, Timing::None).map(|outcome| outcome.hits)
    };
    let triangles = scene.geometry().triangle_count();
    let whole = structure.download(&device).expect("contents");
    well_formed(&whole, triangles).expect("an undamaged build");
    let expected = trace(&structure, TraceMode::Closest).expect("hits");
    let found = expected.iter().filter(|hit| hit.is_hit()).count();
    assert!(found > 8, "{found} hits");
    for &(name, damage) in damages {
        let mut contents = whole.clone();
        damage(&mut contents);
        assert!(
            well_formed(&contents, triangles).is_err(),
            "{name}: the check of the contents finds nothing"
        );
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            structure.upload(&device, &contents).expect("damaged contents");
            let start = Instant::now();
            let result = trace(&structure, mode);
            println!("{name}, {mode:?}: {} in {:?}", words(&result), start.elapsed());
            assert!(
                matches!(result, Err(TracerError::Corrupted { .. })),
                "{name}, {mode:?}: {}",
                words(&result)
            );
        }
    }
    structure.upload(&device, &whole).expect("contents");
    assert_eq!(trace(&structure, TraceMode::Closest).expect("hits"), expected, "the damage outlives it");
    drop((tracer, structure, scene));
    assert_eq!(finish(device), Vec::<String>::new());
}

fn words(result: &Result<Vec<Hit>, TracerError>) -> String {
    match result {
        Ok(hits) => format!("{} hits", hits.iter().filter(|hit| hit.is_hit()).count()),
        Err(error) => error.to_string(),
    }
}

#[test]
fn damaged_links_of_voxels_are_survived_and_told() {
    if in_child("damaged_links_of_voxels_are_survived_and_told") {
        for storage in [Storage::Linked, Storage::Paged] {
            println!("{}", storage.name());
            check(Config { storage, ..Config::robust(32) }, &OF_LINKS);
            check(Config { storage, ..Config::published_hu(32) }, &OF_LINKS);
        }
    }
}

#[test]
fn damaged_links_of_voxels_reached_by_address_are_survived_and_told() {
    if in_child("damaged_links_of_voxels_reached_by_address_are_survived_and_told") {
        for storage in [Storage::Linked, Storage::Paged] {
            let addressing = Addressing::Address;
            check(Config { storage, addressing, ..Config::robust(32) }, &OF_LINKS);
        }
    }
}

#[test]
fn damaged_lists_of_voxels_of_every_storage_are_survived_and_told() {
    if in_child("damaged_lists_of_voxels_of_every_storage_are_survived_and_told") {
        for storage in Storage::ALL {
            println!("{}", storage.name());
            check(Config { storage, ..Config::robust(32) }, &OF_ANY);
            let parity = Config { storage, payload: Payload::Index, ..Config::published_selective(32) };
            check(parity, &OF_ANY);
        }
    }
}
