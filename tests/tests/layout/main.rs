//! Every record that Rust and shaders share, held against two readers of the compiled modules: names,
//! offsets, sizes and strides. Rust has records from the text of the GLSL; the readers know compiled modules alone.

#[macro_use]
mod reader;

use std::collections::BTreeMap;
use std::sync::LazyLock;

use rasray_shaders_glsl::records::{self, Hit, RecordLayout};
use rasray_shaders_glsl::{self as shaders, Shader};
use rasray_systems::SYSTEMS;
use rasray_tests::visits::Visit;

use crate::reader::{Member, Record, check, difference, read_by_spirq, read_by_us};

/// A traversal, an occlusion test and a surface pass of either structure.
const TRACES: [&Shader; 5] = [
    &shaders::BRUTE_TRACE_CLOSEST,
    &shaders::BRUTE_TRACE_OCCLUDED,
    &shaders::ABUFFER_TRACE_CLOSEST_CELLS_PLANES,
    &shaders::ABUFFER_TRACE_OCCLUDED_CELLS_PLANES,
    &shaders::ABUFFER_TRACE_CLOSEST_CELLS_PLANES_ADDRESS,
];

/// A module with the records that each of the two readers finds in it, the own one first.
type Found = (&'static Shader, [BTreeMap<String, Record>; 2]);

/// What both readers find in every module, the own one first.
fn found_in_modules() -> &'static [Found] {
    static FOUND: LazyLock<Vec<Found>> = LazyLock::new(|| {
        shaders::ALL.iter().map(|shader| (*shader, [read_by_us(shader), read_by_spirq(shader)])).collect()
    });
    &FOUND
}

/// Members of a record as readers of modules name them.
fn members_of(record: &RecordLayout) -> Vec<Member> {
    record.members.iter().map(|(name, offset, size)| ((*name).to_owned(), *offset, *size)).collect()
}

/// Whatever module a record is declared in, it is what Rust has; and no record is of Rust alone.
#[test]
fn every_record_in_every_module() {
    for record in records::ALL {
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
        assert!(counts[0] > 0 && counts[1] > 0, "{}: {counts:?} modules have it", record.name);
    }
}

/// The records that a structure says it shares are of its folder, and all of its modules that trace have its header.
#[test]
fn records_of_every_structure() {
    for system in SYSTEMS {
        let folder = system.structure;
        let of_folder =
            found_in_modules().iter().filter(|(shader, _)| shader.name.split('/').next() == Some(folder));
        for (place, record) in system.records.iter().enumerate() {
            assert!(records::ALL.contains(record), "{} is generated", record.name);
            let mut counts = [0, 0];
            for (shader, [ours, spirq]) in of_folder.clone() {
                let traces = place == 0 && shader.name.contains("/trace_");
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
            assert!(counts[1] > 1 && counts[0] > counts[1], "{folder}: {counts:?} with {}", record.name);
        }
        assert!(!system.records.is_empty() || system.name == "brute-force", "{} shares nothing", system.name);
    }
}

/// Push constants of traversals: the address of the structure, in halves, where there is one, a count, and but for
/// surfaces the work budget.
#[test]
fn push_constants_of_traversals() {
    for shader in TRACES {
        let records = read_by_us(shader);
        let (name, push) = records
            .iter()
            .find(|(name, _)| name.ends_with("Constants"))
            .unwrap_or_else(|| panic!("{}: {:?}", shader.name, records.keys()));
        let words: &[_] = if name == "TraceConstants" { &[(8, 4), (12, 4), (16, 4)] } else { &[(8, 4)] };
        let found: Vec<_> = push.members.iter().map(|(_, offset, size)| (*offset, *size)).collect();
        assert!(found.ends_with(words), "{name}: {found:?}");
        assert_eq!(push.size, 8 + 4 * words.len(), "{name}");
    }
}

#[test]
fn the_record_of_a_test_kernel() {
    let members = members!(Visit { face, x, y, t_low, t_high });
    check(&shaders::ADS_TEST_MARCH_CELLS, "Visit", &members, size_of::<Visit>());
}

/// The comparer must be able to fail: each property of each member, and the record as a whole.
#[test]
fn a_wrong_expectation_is_noticed() {
    let (members, size) = (members_of(&Hit::LAYOUT), size_of::<Hit>());
    for records in [read_by_us(TRACES[0]), read_by_spirq(TRACES[0])] {
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
