//! Trees of clusters, and trees whose treelets are restructured, cost less by surface area than the trees by
//! Morton codes.

use rasray_bvh::{Builder, Config};
use rasray_tests::harness::Bench;
use rasray_tests::shapes::Triangle;
use rasray_tests::tier::first;

use super::scenes::built_in;
use super::trees::{build, checked, of_two};

/// Built-in scenes, the large ones last.
const SCENES: [&str; 8] = [
    "cornell",
    "spheres:10k",
    "walker:10k",
    "ruins:10k",
    // Scenes of the full tier.
    "walker",
    "atrium",
    "ruins",
    "spheres:300k",
];

#[test]
fn better_trees_of_built_in_scenes_cost_less() {
    let bench = Bench::new();
    for name in first(&SCENES, 4) {
        let triangles = built_in(name);
        let cost = |config: Config| checked(&build(&bench, config, &triangles), &triangles, name).cost;
        let lbvh = cost(Config::new(Builder::Lbvh));
        let trbvh = cost(of_two(Config::new(Builder::Trbvh)));
        let sah = cost(of_two(Config { leaf: Some(1), ..Config::new(Builder::Sah) }));
        let ploc = cost(of_two(Config::new(Builder::Ploc)));
        println!(
            "{name}: lbvh {lbvh:.2}, ploc {ploc:.2}, trbvh {trbvh:.2}, sah, leaf=1, children=2 {sah:.2}"
        );
        assert!(trbvh < 0.95 * lbvh, "{name}: {trbvh} and {lbvh}");
        assert!(ploc < 0.96 * lbvh, "{name}: {ploc} and {lbvh}");
    }
}

/// Seven triangles around one place, small and large in turn, so that codes do not tell them apart: halved by
/// their places, every node is large. With the small ones together only those above both sizes are.
#[test]
fn a_treelet_becomes_the_tree_of_smaller_boxes() {
    let bench = Bench::new();
    let cube = |e: f32| -> Triangle { [[-e, -e, -e], [e, e, -e], [e, -e, e]] };
    const SMALL: f32 = 1.0 / 128.0;
    let triangles: Vec<Triangle> = (0..7).map(|i| cube(if i % 2 == 0 { SMALL } else { 1.0 })).collect();
    let cost = |builder| {
        checked(&build(&bench, of_two(Config::new(builder)), &triangles), &triangles, "seven triangles").cost
    };
    let small = f64::from(SMALL).powi(2);
    // Root and five nodes, then leaves: four small, three large.
    assert_eq!(cost(Builder::Lbvh), 6.0 + 3.0 + 4.0 * small);
    // Root and two of the nodes are large.
    assert_eq!(cost(Builder::Trbvh), 3.0 + 3.0 + 7.0 * small);
}
