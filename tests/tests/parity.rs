//! Several structures in one shader that is not ours: their GLSL functions called side by side find what the queue
//! kernels find, with pools in descriptors and by address, and two of a kind by address.

use rasray_ads::{Hit, InlineTrace, Ray, Structure};
use rasray_ads_primitive::PrimitiveLists;
use rasray_bvh::{Addressing, Builder, Bvh};
use rasray_gpu::{BufferDesc, BufferUsage, ComputePipelineDesc, Feature, MemoryLocation, Timing};
use rasray_shaders_glsl::{ADS_TEST_PARITY, ADS_TEST_PARITY_ADDRESS, ADS_TEST_PARITY_TREES_ADDRESS, Shader};
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box, sphere};
use rasray_tracer::build_until_complete;

const RAYS: usize = 2000;

fn scene() -> Vec<Triangle> {
    let mut triangles = sphere([0.5, 0.25, 0.75], 1.0, 24);
    triangles.extend(sphere([-2.0, 1.0, -1.0], 0.5, 12));
    triangles.extend(closed_box([-4.0; 3], [4.0; 3]));
    triangles
}

fn rays() -> Vec<Ray> {
    let mut random = Random::new(401);
    // Some start outside and miss.
    (0..RAYS).map(|_| Ray::new(random.point(-6.0, 6.0), random.direction())).collect()
}

/// The answers of both structures to every ray; one that filed none leaves a hit that no trace answers.
fn side_by_side(
    bench: &Bench,
    shader: &Shader,
    triangles: &[Triangle],
    tree: &InlineTrace<'_>,
    other: &InlineTrace<'_>,
    rays: &[Ray],
) -> Vec<[Hit; 2]> {
    let device = bench.device();
    let geometry = bench.geometry(triangles);
    let input = device.create_buffer_with("rays", BufferUsage::STORAGE, rays).expect("rays fit");
    let unanswered = Hit { t: f32::NAN, primitive: 0xDEAD, a: 0.0, b: 0.0 };
    let output = device
        .create_buffer(&BufferDesc {
            name: "hits",
            size: (2 * size_of::<Hit>() * rays.len()) as u64,
            usage: BufferUsage::ALL,
            location: MemoryLocation::Device,
        })
        .expect("hits fit");
    device.upload_slice(&output, 0, &vec![unanswered; 2 * rays.len()]).expect("the device takes hits");
    let layout = device.create_set_layout("parity", 2).expect("a set layout");
    let set = device.create_binding_set(&layout, "parity", &[&input, &output]).expect("a set");
    let mut constants = tree.constants.clone();
    constants.extend(&other.constants);
    let pipeline = device
        .create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            spirv: shader.words(),
            sets: &[geometry.layout(), tree.layout, other.layout, &layout],
            push_constant_bytes: 20,
            constants: &constants,
        })
        .expect("the kernel compiles");
    let words = |address: u64| [address as u32, (address >> 32) as u32];
    let ([a, b], [c, d]) = (words(tree.address), words(other.address));
    device
        .submit(|recorder| {
            recorder.bind_compute(&pipeline);
            recorder.bind_sets(0, &[geometry.set()]);
            for (index, trace) in [(1, tree), (2, other)] {
                if let Some(set) = trace.set {
                    recorder.bind_sets(index, &[set]);
                }
            }
            recorder.bind_sets(3, &[&set]);
            recorder.push_constants(bytemuck::bytes_of(&[a, b, c, d, rays.len() as u32]));
            recorder.dispatch([rays.len().div_ceil(64) as u32, 1, 1]);
        })
        .expect("the kernel runs");
    device.download_as::<[Hit; 2]>(&output, 0, rays.len()).expect("the device answers")
}

/// Rays for which an answer differs from what the structure's own kernels say.
fn differences(found: &[[Hit; 2]], expected: [&[Hit]; 2]) -> usize {
    (0..found.len()).filter(|&ray| (0..2).any(|k| bits(&found[ray][k]) != bits(&expected[k][ray]))).count()
}

fn tree(bench: &Bench, triangles: &[Triangle], builder: Builder, addressing: Addressing) -> Bvh {
    let geometry = bench.geometry(triangles);
    let config = rasray_bvh::Config { addressing, ..rasray_bvh::Config::new(builder) };
    let mut structure = Bvh::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None).expect("it is built");
    structure
}

fn lists(bench: &Bench, triangles: &[Triangle], addressing: Addressing) -> PrimitiveLists {
    let geometry = bench.geometry(triangles);
    let config = rasray_ads_primitive::Config { addressing, ..rasray_ads_primitive::Config::robust(64) };
    let mut structure =
        PrimitiveLists::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None).expect("it is built");
    structure
}

fn check(bench: &Bench, shader: &Shader, tree: &dyn Structure, other: &dyn Structure) {
    let (triangles, rays) = (scene(), rays());
    let expected = [bench.trace(tree, &rays).hits, bench.trace(other, &rays).hits];
    let hits = expected[0].iter().filter(|hit| hit.is_hit()).count();
    assert!((RAYS / 4..RAYS).contains(&hits), "{hits} of {RAYS} rays hit");
    let inline = [tree, other].map(|structure| structure.inline_trace().expect("it can be called"));
    let found = side_by_side(bench, shader, &triangles, &inline[0], &inline[1], &rays);
    assert_eq!(differences(&found, [&expected[0], &expected[1]]), 0, "{}", shader.name);
    assert_eq!(
        differences(&found, [&expected[1], &expected[0]]),
        0,
        "{}: exact structures agree",
        shader.name
    );
    // The comparison notices answers to other rays.
    let mut moved = expected[0].clone();
    moved.rotate_left(1);
    assert_ne!(differences(&found, [&moved, &expected[1]]), 0);
}

#[test]
fn two_structures_share_a_shader() {
    let bench = Bench::new();
    let triangles = scene();
    let tree = tree(&bench, &triangles, Builder::Sah, Addressing::Descriptor);
    let lists = lists(&bench, &triangles, Addressing::Descriptor);
    check(&bench, &ADS_TEST_PARITY, &tree, &lists);
}

#[test]
fn by_address_two_of_a_kind_share_a_shader() {
    let bench = Bench::new();
    if !bench.device().has(Feature::BufferDeviceAddress) {
        println!("skipped: the device has no buffer device addresses");
        return;
    }
    let triangles = scene();
    let sah = tree(&bench, &triangles, Builder::Sah, Addressing::Address);
    let lbvh = tree(&bench, &triangles, Builder::Lbvh, Addressing::Address);
    let lists = lists(&bench, &triangles, Addressing::Address);
    check(&bench, &ADS_TEST_PARITY_ADDRESS, &sah, &lists);
    check(&bench, &ADS_TEST_PARITY_TREES_ADDRESS, &sah, &lbvh);
}
