//! Every record that Rust and shaders share, and the push constants of every module, held against two readers
//! of the compiled modules: names, offsets, sizes and strides. Rust has records from the text of the GLSL;
//! the readers know compiled modules alone.

mod reader;

use std::collections::BTreeMap;
use std::sync::LazyLock;

use rasray_shaders_glsl::records::{self, Hit, RecordLayout, test_kernels};
use rasray_shaders_glsl::{self as shaders, Shader};
use rasray_systems::SYSTEMS;

use crate::layout::reader::{Member, Record, difference, push_constants, read_by_spirq, read_by_us};

/// A module with the records that each of the two readers finds in it, the own one first.
type Found = (&'static Shader, [BTreeMap<String, Record>; 2]);

/// Records that both readers find in every module, the product's own reader first.
fn found_in_modules() -> &'static [Found] {
    static FOUND: LazyLock<Vec<Found>> = LazyLock::new(|| {
        shaders::ALL.iter().map(|shader| (*shader, [read_by_us(shader), read_by_spirq(shader)])).collect()
    });
    &FOUND
}

/// Records of shaders that are used, and of those that only tests use.
fn all_records() -> impl Iterator<Item = &'static RecordLayout> {
    records::ALL.iter().chain(test_kernels::ALL)
}

/// Members of a record as readers of modules name them.
fn members_of(record: &RecordLayout) -> Vec<Member> {
    record.members.iter().map(|(name, offset, size)| ((*name).to_owned(), *offset, *size)).collect()
}

/// Records that shaders write word by word, in the order of their members, behind lists whose number only the
/// device knows; so no module declares them. `pictures::photons` of the integrators tests that their words
/// are those members.
const AS_WORDS: &[&str] = &["Photon"];

/// Whatever module a record is declared in, it is what Rust has; and no record is of Rust alone.
#[test]
fn every_record_in_every_module() {
    for record in all_records() {
        let members = members_of(record);
        let mut counts = [0, 0];
        for (shader, readers) in found_in_modules() {
            for (found, count) in readers.iter().zip(&mut counts) {
                if let Some(found) = found.get(record.name) {
                    let difference = difference(Some(found), &members, record.size);
                    assert_eq!(difference, None, "{} in {}", record.name, shader.name);
                    *count += 1;
                }
            }
        }
        let is_declared = counts[0] > 0 && counts[1] > 0;
        assert_eq!(
            is_declared,
            !AS_WORDS.contains(&record.name),
            "{}: {counts:?} modules have it",
            record.name
        );
    }
}

/// The records that a structure says it shares are of its folder, and all of its modules that trace have its
/// header.
#[test]
fn records_of_every_structure() {
    for system in SYSTEMS {
        let folder = system.structure;
        let of_folder =
            found_in_modules().iter().filter(|(shader, _)| shader.name.split('/').next() == Some(folder));
        for (place, record) in system.records.iter().enumerate() {
            assert!(
                place > 0 || record.members[0] == ("status", 0, 4),
                "statuses are read there: {record:?}"
            );
            assert!(records::ALL.contains(record), "{} is generated", record.name);
            let mut counts = [0, 0];
            for (shader, [ours, spirq]) in of_folder.clone() {
                let traces = place == 0 && shader.name.contains("/trace");
                // With device addresses records are reached by pointers, which only the own reader follows.
                let by_address = shader.name.ends_with(".address");
                for (found, count) in
                    [ours, spirq].into_iter().zip(&mut counts).take(2 - usize::from(by_address))
                {
                    let has = found.contains_key(record.name);
                    assert!(has || !traces, "{} has no {}", shader.name, record.name);
                    *count += usize::from(has);
                }
            }
            let more = counts[0] > counts[1] || !system.has("addressing");
            assert!(counts[1] > 0 && more, "{folder}: {counts:?} with {}", record.name);
        }
        assert!(!system.records.is_empty() || system.name == "brute-force", "{} shares nothing", system.name);
    }
}

/// Checks that the push constants of every module are a record of Rust, and that both readers agree on them.
#[test]
fn push_constants_of_every_module() {
    let known: Vec<_> = all_records().map(|record| record.name).collect();
    let mut modules = 0;
    for shader in shaders::ALL {
        let Some(name) = push_constants(shader) else { continue };
        assert!(known.contains(&name.as_str()), "{}: {name} is of the GLSL alone", shader.name);
        modules += 1;
    }
    assert!(modules > 200, "{modules} modules have push constants");
}

/// The comparer must be able to fail: each property of each member, and the record as a whole.
#[test]
fn a_wrong_expectation_is_noticed() {
    let (members, size) = (members_of(&Hit::LAYOUT), size_of::<Hit>());
    for records in [read_by_us as fn(&Shader) -> BTreeMap<String, Record>, read_by_spirq]
        .map(|read| read(&shaders::BRUTE_TRACE))
    {
        let hit = records.get("Hit");
        assert_eq!(difference(hit, &members, size), None);
        for index in 0..members.len() {
            let wrong = |change: fn(&mut Member)| {
                let mut wrong = members.clone();
                change(&mut wrong[index]);
                difference(hit, &wrong, size)
            };
            assert!(wrong(|(name, _, _)| name.push('x')).is_some());
            assert!(wrong(|(_, offset, _)| *offset += 4).is_some());
            assert!(wrong(|(_, _, size)| *size += 4).is_some());
            let mut fewer = members.clone();
            fewer.remove(index);
            assert!(difference(hit, &fewer, size).is_some());
        }
        let mut swapped = members.clone();
        swapped.swap(2, 3);
        assert!(difference(hit, &swapped, size).is_some());
        assert!(difference(hit, &members, size + 4).is_some());
        assert!(difference(None, &members, size).is_some());
        let strided = hit.map(|record| Record { stride: Some(size + 16), ..record.clone() });
        assert!(difference(strided.as_ref(), &members, size).is_some());
    }
}
