//! The sort on the device against one of the host, and both forms of passes over chunks.

use rasray_bvh::{Builder, Chunks, Config};
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;

use super::trees::{build, checked, scattered};

const CHUNKS: [Chunks; 2] = [Chunks::Serial, Chunks::Shared];

/// The Morton code of a cell, bit by bit.
fn code(cell: [u32; 3]) -> u32 {
    (0..10).fold(0, |code, bit| {
        (0..3).fold(code, |code, axis| code | (cell[axis] >> bit & 1) << (3 * bit + axis as u32))
    })
}

/// Triangles without extent in the middles of cells, many of them in the same one: their order is that of
/// their codes, and of their numbers where codes are equal.
#[test]
fn triangles_are_in_the_order_of_a_stable_sort() {
    let bench = Bench::new();
    let mut random = Random::new(31);
    for (count, side) in
        [(2, 1024), (255, 1024), (256, 4), (257, 2), (1000, 1), (5000, 8), (70_000, 16), (70_000, 1024)]
    {
        let mut cells: Vec<[u32; 3]> = (0..count - 2)
            .map(|_| std::array::from_fn(|_| (random.bits() % side) as u32 * (1024 / side as u32)))
            .collect();
        // They bring the bounds to those of all cells.
        cells.extend([[0; 3], [1023; 3]]);
        let last = cells.len() - 1;
        let triangle = |(index, cell): (usize, &[u32; 3])| -> Triangle {
            let corner = if index == last { 1.0 } else { 0.5 };
            let corner = if index + 1 == last { 0.0 } else { corner };
            [std::array::from_fn(|axis| cell[axis] as f32 + corner); 3]
        };
        let triangles: Vec<Triangle> = cells.iter().enumerate().map(triangle).collect();
        let mut expected: Vec<u32> = (0..cells.len() as u32).collect();
        expected.sort_by_key(|index| code(cells[*index as usize]));
        for chunks in CHUNKS {
            let config = Config { chunks: Some(chunks), ..Config::new(Builder::Lbvh) };
            let contents = build(&bench, config, &triangles);
            let found: Vec<u32> = contents.records.iter().map(|record| record.primitive).collect();
            assert!(found == expected, "{chunks:?}, {count} triangles in {side} cells a side");
        }
    }
}

/// Numbers of triangles around those at which a chunk, and a level of chunks, is full.
#[test]
fn an_invocation_and_a_workgroup_merge_the_same_clusters() {
    let bench = Bench::new();
    for count in [1, 2, 255, 256, 257, 300, 2047, 2048, 2049, 2050, 20_000] {
        let triangles = scattered(count, count as u64, 0.2);
        let [serial, shared] = CHUNKS.map(|chunks| {
            let contents =
                build(&bench, Config { chunks: Some(chunks), ..Config::new(Builder::Ploc) }, &triangles);
            checked(&contents, &triangles, &format!("{chunks:?}, {count} triangles"));
            contents
        });
        assert_eq!(serial.header.root, shared.header.root, "{count} triangles");
        assert!(serial.nodes_of_four == shared.nodes_of_four, "{count} triangles");
    }
}
