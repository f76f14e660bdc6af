//! A single layer: of each cell the nearest fragments of all, whatever the storage, the builder and the
//! coverage.

use std::collections::HashSet;

use rasray_abuffer::{
    ABuffer, Accept, Addressing, Builder, Config, Contents, Coverage, March, Storage, Views, well_formed,
};
use rasray_ads::{Geometry, Hit, Ray, SceneBinding, Structure, Viewpoint};
use rasray_gpu::Timing;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::pictures::stage;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, all_sizes};
use rasray_tests::tier::{first, in_turn};
use rasray_tests::views::ALONG_Z;
use rasray_tracer::build_until_complete;

const EYE: [f32; 3] = [0.3, -0.7, 0.2];

fn viewpoint(config: &Config, eye: [f32; 3]) -> Viewpoint {
    Viewpoint { eye, camera: config.views.has_camera().then_some(ALONG_Z) }
}

/// A structure, with what is stored checked.
fn built(
    bench: &Bench,
    config: Config,
    geometry: &Geometry,
    scene: Option<&SceneBinding>,
    eye: [f32; 3],
) -> (ABuffer, Contents) {
    let mut structure = ABuffer::new(bench.device(), config, geometry, scene).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, viewpoint(&config, eye), Timing::None)
        .expect("the build completes");
    let report = structure.report().expect("the header is readable");
    assert_eq!(report.bytes() - report.slack(), report.formula_bytes, "{config:?}");
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents).unwrap_or_else(|fault| panic!("{config:?}: {fault}"));
    (structure, contents)
}

/// Depth and triangle of the fragments of each cell, in order.
fn cells(contents: &Contents) -> Vec<Vec<(u32, u32)>> {
    let cells = contents.fragments().expect("lists are well formed");
    let ordered = cells.into_iter().map(|cell| {
        let mut cell: Vec<_> =
            cell.into_iter().map(|fragment| (fragment.z.to_bits(), fragment.payload[0])).collect();
        cell.sort_unstable();
        cell
    });
    ordered.collect()
}

/// Maximum ratio of the distance of a fragment of the same layer to that of the nearest.
const LAYER: f32 = 1.0 + 4.8e-7;

/// The nearest of a cell's fragments.
fn nearest(cell: &[(u32, u32)]) -> Vec<(u32, u32)> {
    let z = |fragment: &(u32, u32)| f32::from_bits(fragment.0);
    let farthest = cell.first().map_or(0.0, |first| z(first) * LAYER);
    cell.iter().copied().filter(|fragment| z(fragment) <= farthest).collect()
}

/// Compares a single layer with all layers, and says how many fragments each stores.
fn compare(
    bench: &Bench,
    all: Config,
    geometry: &Geometry,
    scene: Option<&SceneBinding>,
    eye: [f32; 3],
) -> [usize; 2] {
    let single = Config { single_layer: true, ..all };
    let (_, of_all) = built(bench, all, geometry, scene, eye);
    let (structure, of_single) = built(bench, single, geometry, scene, eye);
    // Including those that a mask cuts out.
    let (_, covering) = built(bench, all, geometry, None, eye);
    let (of_all, kept, covering) = (cells(&of_all), cells(&of_single), cells(&covering));
    for (cell, (all, kept)) in of_all.iter().zip(&kept).enumerate() {
        assert_eq!(&nearest(all), kept, "cell {cell} of {single:?}");
    }
    // Triangles that are nowhere the nearest are counted as lost.
    let triangles = |cells: &[Vec<(u32, u32)>]| {
        cells.iter().flatten().map(|(_, primitive)| *primitive).collect::<HashSet<_>>().len() as u64
    };
    let lost = structure.report().expect("the header is readable").lost.expect("they are counted");
    let in_layer = covering.iter().zip(&kept).map(|(covering, kept)| {
        let farthest = kept.first().map_or(f32::INFINITY, |first| f32::from_bits(first.0) * LAYER);
        covering.iter().copied().filter(|fragment| f32::from_bits(fragment.0) <= farthest).collect()
    });
    let in_layer = triangles(&in_layer.collect::<Vec<_>>());
    assert_eq!(lost + in_layer, u64::from(geometry.triangle_count()), "{single:?}");
    assert!(triangles(&kept) < triangles(&of_all), "{single:?}");
    [of_all, kept].map(|cells| cells.iter().map(Vec::len).sum())
}

#[test]
fn a_single_layer_is_the_nearest_of_all() {
    let bench = Bench::new();
    let geometry = bench.geometry(&all_sizes());
    for (index, storage) in Storage::ALL.into_iter().enumerate() {
        let tried = [
            (Coverage::Exact, Accept::Plane, Views::Cube, March::Exact, Builder::Raster),
            (Coverage::Exact, Accept::Interval, Views::CubeCamera, March::Pyramid, Builder::Binning),
            (Coverage::Hardware, Accept::Interval, Views::Camera, March::Samples, Builder::Raster),
        ];
        for &(coverage, accept, views, march, builder) in in_turn(&tried, index) {
            let addressing = if index % 2 == 0 { Addressing::Descriptor } else { Addressing::Address };
            let config = Config {
                storage,
                coverage,
                accept,
                views,
                march,
                builder,
                addressing,
                inline: index % 3 == 0,
                camera_resolution: [41, 30],
                ..Config::at_centres(32)
            };
            let [all, kept] = compare(&bench, config, &geometry, None, EYE);
            assert!(kept > 1000 && kept < all * 9 / 10, "{kept} of {all} fragments, {config:?}");
        }
    }
}

/// Fragments that a mask cuts out are not the nearest.
#[test]
fn holes_of_masks_show_the_layer_behind() {
    let bench = Bench::new();
    let scene = stage(&bench, "atrium:detail=0.25", 16);
    assert!(scene.binding().alpha_masked);
    for builder in Builder::ALL {
        let config = Config { builder, ..Config::at_centres(48) };
        let opaque = Config { single_layer: true, ..config };
        let (_, without_masks) = built(&bench, opaque, scene.geometry(), None, scene.eye());
        let (_, with_masks) = built(&bench, opaque, scene.geometry(), Some(scene.binding()), scene.eye());
        assert!(cells(&without_masks) != cells(&with_masks), "{builder:?}: no hole is seen");
        compare(&bench, config, scene.geometry(), Some(scene.binding()), scene.eye());
    }
}

/// Hits do not depend on how a single layer is stored, and of rays through the centres of cells they are
/// those of all layers.
#[test]
fn through_centres_a_single_layer_is_enough() {
    const SIDE: u32 = 40;
    let bench = Bench::new();
    let triangles: Vec<Triangle> = all_sizes();
    let geometry = bench.geometry(&triangles);
    let center = |cell: u32| (2 * cell + 1) as f32 / SIDE as f32 - 1.0;
    let centers = (0..SIDE * SIDE).map(|cell| [center(cell % SIDE), center(cell / SIDE), 1.0]);
    let from_eye: Vec<Ray> = centers.map(|direction| Ray::new(EYE, direction)).collect();
    let anywhere = Random::new(0x6c61).rays(2000, -6.0, 6.0);
    let mut expected: Option<Vec<[u32; 4]>> = None;
    let tried = [
        (Storage::Ll, March::Exact),
        (Storage::Sb, March::Exact),
        (Storage::Paged, March::Pyramid),
        (Storage::Dll, March::Pyramid),
        (Storage::Llb, March::Exact),
        (Storage::Dllb, March::Pyramid),
    ];
    for &(storage, march) in first(&tried, 3) {
        let all = Config {
            storage,
            march,
            views: Views::Camera,
            camera_resolution: [SIDE; 2],
            ..Config::at_centres(SIDE)
        };
        let [of_all, of_single] = [false, true]
            .map(|single_layer| built(&bench, Config { single_layer, ..all }, &geometry, None, EYE).0);
        let hits = |structure: &ABuffer, rays: &[Ray]| bench.trace(structure, rays).hits;
        let key = |hit: &Hit| (hit.t.to_bits(), hit.primitive);
        let (seen, kept) = (hits(&of_all, &from_eye), hits(&of_single, &from_eye));
        let found = kept.iter().filter(|hit| hit.is_hit()).count();
        let same = seen.iter().zip(&kept).filter(|(all, single)| key(all) == key(single)).count();
        println!("{storage:?}: {found} of {} hit, {same} the same", from_eye.len());
        assert!(found > from_eye.len() * 9 / 10, "{storage:?}: {found} hit");
        assert_eq!(same, from_eye.len(), "{storage:?}");
        // Elsewhere what is behind is not hit.
        let (seen, kept) = (hits(&of_all, &anywhere), hits(&of_single, &anywhere));
        let count = |hits: &[Hit]| hits.iter().filter(|hit| hit.is_hit()).count();
        assert!(count(&kept) < count(&seen) * 9 / 10, "{} of {}", count(&kept), count(&seen));
        let kept: Vec<_> = kept.iter().map(bits).collect();
        assert_eq!(expected.get_or_insert_with(|| kept.clone()), &kept, "{storage:?}");
    }
}

#[test]
fn a_single_layer_excludes_conservative_coverage() {
    let config = Config { single_layer: true, coverage: Coverage::Conservative, ..Config::at_centres(16) };
    let message = config.validate().expect_err("refused").to_string();
    assert!(message.contains("single-layer"), "{message}");
}
