//! Several structures in one shader that is not ours: their GLSL functions called side by side find what the
//! queue kernels find; every pair of structures, with pools in descriptors and by address, and two of a kind
//! by address.

use std::collections::BTreeMap;

use rasray_ads::{Geometry, Hit, InlineTrace, Ray, Structure};
use rasray_gpu::{BufferDesc, BufferUsage, ComputePipelineDesc, Feature, MemoryLocation, Timing};
use rasray_shaders_glsl::records::test_kernels::ParityTestConstants;
use rasray_shaders_glsl::{ALL, Shader};
use rasray_systems::{SYSTEMS, Spec};
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box, sphere};
use rasray_tests::tier::is_full;
use rasray_tracer::build_until_complete;

const RAYS: usize = 1000;

fn scene() -> Vec<Triangle> {
    let mut triangles = sphere([0.5, 0.25, 0.75], 1.0, 24);
    triangles.extend(sphere([-2.0, 1.0, -1.0], 0.5, 12));
    triangles.extend(closed_box([-4.0; 3], [4.0; 3]));
    triangles
}

fn rays() -> Vec<Ray> {
    // Some start outside and miss.
    Random::new(401).rays(RAYS, -6.0, 6.0)
}

/// The answers of both structures to every ray; where none was stored, a hit that no trace answers.
fn side_by_side(
    bench: &Bench,
    shader: &Shader,
    geometry: &Geometry,
    [first, second]: [&InlineTrace<'_>; 2],
    rays: &[Ray],
) -> Vec<[Hit; 2]> {
    let device = bench.device();
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
    let mut constants = first.constants.clone();
    // Two of a kind share theirs.
    constants.extend(second.constants.iter().filter(|constant| !first.constants.contains(constant)));
    let pipeline = device
        .create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            module: &shader.module(),
            sets: &[geometry.layout(), first.layout, second.layout, &layout],
            push_constant_bytes: size_of::<ParityTestConstants>() as u32,
            constants: &constants,
        })
        .expect("the kernel compiles");
    let words = |address: u64| [address as u32, (address >> 32) as u32];
    let pushed = ParityTestConstants {
        first: words(first.address),
        second: words(second.address),
        count: rays.len() as u32,
    };
    device
        .submit(|recorder| {
            recorder.bind_compute(&pipeline);
            recorder.bind_sets(0, &[geometry.set()]);
            for (index, trace) in [(1, first), (2, second)] {
                if let Some(set) = trace.set {
                    recorder.bind_sets(index, &[set]);
                }
            }
            recorder.bind_sets(3, &[&set]);
            recorder.push_constants(bytemuck::bytes_of(&pushed));
            recorder.dispatch([rays.len().div_ceil(64) as u32, 1, 1]);
        })
        .expect("the kernel runs");
    device.download_as::<[Hit; 2]>(&output, 0, rays.len()).expect("the device answers")
}

/// Rays for which an answer differs from what the structure's own kernels say.
fn differences(found: &[[Hit; 2]], expected: [&[Hit]; 2]) -> usize {
    (0..found.len()).filter(|&ray| (0..2).any(|k| bits(&found[ray][k]) != bits(&expected[k][ray]))).count()
}

/// A structure in a shader, and what the queue kernels find in it.
struct Traced {
    structure: Box<dyn Structure>,
    hits: Vec<Hit>,
}

impl Traced {
    fn new(bench: &Bench, geometry: &Geometry, spec: &Spec) -> Self {
        let mut structure = spec.create(bench.device(), geometry, None).expect("the options are valid");
        build_until_complete(bench.device(), &mut *structure, [0.0; 3], Timing::None).expect("it is built");
        let hits = bench.trace(&*structure, &rays()).hits;
        let hit = hits.iter().filter(|hit| hit.is_hit()).count();
        assert!((RAYS / 4..RAYS).contains(&hit), "{}: {hit} of {RAYS} rays hit", spec.system().name);
        Self { structure, hits }
    }
}

/// The default of every structure that can be called from another shader, by its folder of shaders, reached
/// as `addressing` says.
fn structures(bench: &Bench, geometry: &Geometry, addressing: &str) -> BTreeMap<&'static str, Traced> {
    let mut structures = BTreeMap::new();
    for system in SYSTEMS.iter().filter(|system| system.has("addressing")) {
        let options = [("addressing".to_owned(), addressing.to_owned())];
        let spec = Spec::new(system.name, "robust", options).expect("the options are valid");
        structures.entry(spec.structure()).or_insert_with(|| Traced::new(bench, geometry, &spec));
    }
    structures
}

fn shader(name: &str) -> &'static Shader {
    ALL.iter().find(|shader| shader.name == name).unwrap_or_else(|| panic!("{name} is no permutation"))
}

/// `geometry` is the one that both were built for: a shader has it once.
fn check(bench: &Bench, geometry: &Geometry, name: &str, traced: [&Traced; 2]) {
    let inline = traced.map(|one| one.structure.inline_trace().expect("it can be called"));
    let found = side_by_side(bench, shader(name), geometry, [&inline[0], &inline[1]], &rays());
    assert_eq!(differences(&found, [&traced[0].hits, &traced[1].hits]), 0, "{name}");
    // The comparison notices answers to other rays.
    let mut moved = traced[0].hits.clone();
    moved.rotate_left(1);
    assert_ne!(differences(&found, [&moved, &traced[1].hits]), 0, "{name}");
}

/// Every pair of structures, or but for the large counts these: all pairs compile, or there would be no
/// tests, and a driver takes seconds for each. The names of their shaders end in `suffix`.
fn check_pairs(
    (bench, geometry): (&Bench, &Geometry),
    structures: &BTreeMap<&str, Traced>,
    suffix: &str,
    quick: &[[&str; 2]],
) {
    assert!(structures.len() >= 6, "{:?}", structures.keys());
    for (first, one) in structures {
        for (second, other) in structures.iter().filter(|(second, _)| *second > first) {
            if is_full() || quick.contains(&[first, second]) {
                check(bench, geometry, &format!("ads/test_parity.{first}.{second}{suffix}"), [one, other]);
            }
        }
    }
}

#[test]
fn any_two_structures_share_a_shader() {
    let bench = Bench::new();
    let geometry = bench.geometry(&scene());
    check_pairs(
        (&bench, &geometry),
        &structures(&bench, &geometry, "descriptor"),
        "",
        &[["abuffer", "voxel"], ["bricks", "primitive"]],
    );
}

#[test]
fn by_address_any_two_and_two_of_a_kind_share_a_shader() {
    let bench = Bench::new();
    if !bench.device().has(Feature::BufferDeviceAddress) {
        println!("skipped: the device has no buffer device addresses");
        return;
    }
    let geometry = bench.geometry(&scene());
    let structures = structures(&bench, &geometry, "address");
    check_pairs((&bench, &geometry), &structures, ".address", &[["abuffer", "ldc"], ["primitive", "voxel"]]);
    // Two of a kind have the same constants: as many children per node.
    let [sah, lbvh] = [("children", "2"), ("builder", "lbvh")].map(|option| {
        let options = [("addressing", "address"), option];
        let options = options.map(|(name, value)| (name.to_owned(), value.to_owned()));
        let spec = Spec::new("bvh", "robust", options).expect("the options are valid");
        Traced::new(&bench, &geometry, &spec)
    });
    check(&bench, &geometry, "ads/test_parity.bvh.bvh.address", [&sah, &lbvh]);
}
