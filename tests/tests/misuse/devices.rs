//! Devices that have no more than a structure requires.

use rasray_ads::{Draw, Geometry, GeometryDesc, Hit, TraceMode};
use rasray_gpu::{BufferUsage, Device, DeviceDesc, Feature, Requirements, Timing};
use rasray_tests::invariance::Subject;
use rasray_tests::shapes::closed_box;
use rasray_tests::tier::first;
use rasray_tracer::{BatchTracer, build_until_complete};

use crate::misuse::unbuilt::{EYE, rays};

/// Structures that can be built by computing. The quick tier has those whose kernels other tests have as
/// well, and one more.
const COMPUTED: &[&str] = &["bricks", "bvh", "grid", "brute-force", "abuffer", "primitive", "voxel", "ldc"];

/// Number of [`COMPUTED`] tried in the quick tier.
const QUICK: usize = 5;

/// A box around the eye.
fn geometry(device: &Device) -> Geometry {
    let positions: Vec<[f32; 3]> = closed_box([-2.0; 3], [2.0; 3]).into_iter().flatten().collect();
    let indices: Vec<u32> = (0..36).collect();
    let draws = [Draw { triangle_count: 12, ..Draw::default() }];
    let buffer =
        |name, bytes: &[u8]| device.create_buffer_with(name, BufferUsage::ALL, bytes).expect("it fits");
    let desc = GeometryDesc {
        positions: buffer("positions", bytemuck::cast_slice(&positions)).into(),
        indices: buffer("indices", bytemuck::cast_slice(&indices)).into(),
        draws: buffer("draws", bytemuck::cast_slice(&draws)).into(),
        vertex_count: 36,
        triangle_count: 12,
        count: None,
        draw_count: 1,
        bounds: [[-2.0; 3], [2.0; 3]],
        frame_origin: [0.0; 3],
    };
    Geometry::new(device, desc).expect("the buffers hold it")
}

/// Structures built by computing need nothing to draw with.
#[test]
fn structures_that_compute_are_built_and_traced_without_dynamic_rendering() {
    let desc =
        DeviceDesc { requirements: Requirements::compute(), validation: true, ..DeviceDesc::default() };
    let device = Device::create(&desc).expect("a device that computes");
    assert!(!device.has(Feature::DynamicRendering) && !device.has(Feature::FragmentStoresAndAtomics));
    let geometry = geometry(&device);
    let tracer = BatchTracer::new(&device, 64).expect("a queue fits");
    let mut names = Vec::new();
    let structures = first(COMPUTED, QUICK);
    let is_wanted = |subject: &Subject| {
        subject.spec.preset().name() == "robust" && structures.contains(&subject.spec.structure())
    };
    for subject in Subject::all().into_iter().filter(is_wanted) {
        let subject = subject.with(&[("builder", "binning")]).unwrap_or(subject);
        let requirements = subject.spec.requirements().expect("valid options");
        if !device.supports(&requirements) {
            continue;
        }
        let mut structure = subject.spec.create(&device, &geometry, None).expect("it needs no more");
        build_until_complete(&device, structure.as_mut(), EYE, Timing::None).expect("it is built");
        let traced = tracer.trace(structure.as_ref(), &rays(), TraceMode::Closest, Timing::None);
        let hits = traced.expect("all rays finish").hits;
        let found = hits.iter().filter(|hit| Hit::is_hit(hit)).count();
        assert!(found > 60, "{}: {found} of 64 rays hit the box around them", subject.name());
        names.push(subject.spec.structure());
    }
    assert!(structures.iter().all(|structure| names.contains(structure)), "{structures:?}: {names:?}");
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}
