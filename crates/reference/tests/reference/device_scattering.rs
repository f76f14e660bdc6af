//! Scattering functions and random numbers of the device against those of this crate, call by call.

use std::mem::offset_of;

use glam::Vec3;
use rasray_gpu::{Access, BufferUsage, ComputePipelineDesc, Device, DeviceDesc};
use rasray_gpu_scene::{Parts, SceneTables};
use rasray_reference::shading::{
    BsdfSample, Surface, bsdf_evaluate, bsdf_pdf, bsdf_sample,
    random::{Numbers, RandomStream, random_dimension},
};
use rasray_scene::{Material, Sampler, Scene};
use rasray_shaders_glsl::constants::scene::{
    ATTRIBUTE_NONE, SAMPLE_DELTA, SAMPLE_TRANSMITTED, SAMPLE_VALID, SAMPLER_PCG, SAMPLER_SOBOL,
};
use rasray_shaders_glsl::records::Frame;

const SEED: u32 = 77;
const CASES: u32 = 6000;
/// Numbers of words of a case and of a result in the kernel.
const CASE_WORDS: usize = 41;
const RESULT_WORDS: usize = 16;
/// Number of words of the frame, and offsets of the fields that are read.
const FRAME_WORDS: usize = size_of::<Frame>() / size_of::<u32>();
const FRAME_SEED: usize = offset_of!(Frame, seed) / size_of::<u32>();
const FRAME_SAMPLING: usize = offset_of!(Frame, sampling) / size_of::<u32>();
const IORS: [f32; 5] = [1.0, 1.33, 1.5, 2.4, 0.7];
const SPECULARS: [f32; 3] = [0.0, 0.5, 1.0];
const SPECULAR_COLORS: [Vec3; 2] = [Vec3::ONE, Vec3::new(0.2, 0.9, 1.0)];

struct Case {
    surface: Surface,
    o: Vec3,
    i: Vec3,
    random: RandomStream,
    dimension: u32,
}

fn direction([_, _, u, v]: [f32; 4]) -> Vec3 {
    let cosine = 1.0 - 2.0 * u;
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let azimuth = 2.0 * std::f32::consts::PI * v;
    Vec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
}

fn cases() -> Vec<Case> {
    let make = |pixel: u32| {
        let random = RandomStream { seed: 5, pixel, sample: 0 };
        let pick = |dimension: u32, choices: &[f32]| {
            choices[(random.float(dimension) * choices.len() as f32) as usize]
        };
        let geometric_normal = direction(random.four(10));
        let towards = |dimension: u32| {
            let d = direction(random.four(dimension));
            if d.dot(geometric_normal) < 0.0 { -d } else { d }
        };
        let o = towards(20);
        let normal = if random.float(0) < 0.5 {
            geometric_normal
        } else {
            (geometric_normal * 2.0 + towards(30)).normalize()
        };
        let normal = if normal.dot(o) < 0.01 { geometric_normal } else { normal };
        let number = |dimension: u32, count: usize| (random.float(dimension) * count as f32) as usize;
        let [ior, specular, color] =
            [number(5, IORS.len()), number(7, SPECULARS.len()), number(1, SPECULAR_COLORS.len())];
        let surface = Surface {
            geometric_normal,
            normal,
            base_color: Vec3::from_slice(&random.four(40)[..3]),
            metallic: pick(2, &[0.0, 0.0, 0.4, 1.0]),
            roughness: pick(3, &[0.0, 0.1, 0.35, 0.7, 1.0]),
            transmission: pick(4, &[0.0, 0.5, 1.0]),
            ior: IORS[ior],
            thickness: pick(6, &[0.0, 0.3]),
            specular: SPECULARS[specular],
            specular_color: SPECULAR_COLORS[color],
            front: random.float(8) < 0.5,
            material: Some((ior * SPECULARS.len() + specular) * SPECULAR_COLORS.len() + color),
            ..Surface::default()
        };
        let stream = RandomStream { seed: SEED, pixel: pixel * 977, sample: pixel % 61 };
        let i = if pixel.is_multiple_of(2) { direction(random.four(50)) } else { towards(50) };
        Case { surface, o, i, random: stream, dimension: random_dimension(pixel % 5, 4) }
    };
    (0..CASES).map(make).collect()
}

/// Makes tables for every index, strength and colour of the dielectric's reflection; each may be a rough
/// volume.
fn tables() -> SceneTables {
    let mut scene = Scene::default();
    for ior in IORS {
        for specular in SPECULARS {
            for specular_color in SPECULAR_COLORS.map(|color| color.to_array()) {
                let volume = Material { transmission: 1.0, thickness: 0.3, ior, ..Material::default() };
                scene.materials.push(Material { specular, specular_color, ..volume });
            }
        }
    }
    SceneTables::new(&scene, glam::DVec3::ZERO, &Parts::ALL).expect("valid")
}

fn words(case: &Case) -> Vec<u32> {
    let s = &case.surface;
    let mut words = Vec::with_capacity(CASE_WORDS);
    let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    words.extend(bits(&[s.position.x, s.position.y, s.position.z, s.position_error]));
    words.extend(bits(&s.geometric_normal.to_array()));
    words.push(u32::MAX);
    words.extend(bits(&s.normal.to_array()));
    words.push(31);
    words.extend(bits(&s.base_color.to_array()));
    words.extend(bits(&[s.metallic]));
    words.extend(bits(&s.emission.to_array()));
    words.extend(bits(&[s.roughness, s.transmission, s.ior, s.opacity, s.thickness]));
    words.extend(bits(&[1.0, 1.0, 1.0, f32::INFINITY, s.specular]));
    words.push(u32::from(s.front));
    words.extend(bits(&[s.t]));
    words.push(s.material.map_or(u32::MAX, |material| material as u32));
    words.extend(bits(&case.o.to_array()));
    words.push(case.random.pixel);
    words.extend(bits(&case.i.to_array()));
    words.extend([case.random.sample, case.dimension]);
    assert_eq!(words.len(), CASE_WORDS);
    words
}

fn run(cases: &[Case], sampler: Sampler, packed: &SceneTables) -> Vec<u32> {
    let desc = DeviceDesc { validation: true, ..DeviceDesc::default() };
    let device = Device::create(&desc).expect("this test needs a Vulkan device and the validation layer");
    let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC;
    let input: Vec<u32> = cases.iter().flat_map(words).collect();
    let input = device.create_buffer_with("cases", usage, &input).expect("buffer");
    let output = vec![0_u32; cases.len() * RESULT_WORDS];
    let output = device.create_buffer_with("results", usage, &output).expect("buffer");
    let mut frame = vec![0_u32; FRAME_WORDS];
    frame[FRAME_SEED] = SEED;
    frame[FRAME_SAMPLING] = match sampler {
        Sampler::Sobol => SAMPLER_SOBOL,
        Sampler::Pcg => SAMPLER_PCG,
    };
    let frame = device.create_buffer_with("frame", usage, &frame).expect("buffer");
    let attributes =
        device.create_buffer_with("attributes", usage, &packed.vertex_attributes).expect("buffer");
    let materials = device.create_buffer_with("materials", usage, &packed.materials).expect("buffer");
    let empty = device.create_buffer_with("empty", usage, &[0_u32; 64]).expect("buffer");

    let own_layout = device.create_set_layout("cases", 2).expect("layout");
    let scene_layout = device.create_set_layout("scene", 12).expect("layout");
    let own = device.create_binding_set(&own_layout, "cases", &[&input, &output]).expect("set");
    let mut tables = [&empty; 12];
    tables[0] = &frame;
    tables[4] = &attributes;
    tables[5] = &materials;
    let scene = device.create_binding_set(&scene_layout, "scene", &tables).expect("set");
    let shader = rasray_shaders_glsl::shader("scene/test_scattering").expect("a kernel of tests");
    let pipeline = device
        .create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            module: &shader.module(),
            sets: &[&own_layout, &scene_layout],
            push_constant_bytes: 0,
            constants: &[],
        })
        .expect("pipeline");
    device
        .submit(|recorder| {
            recorder.bind_compute(&pipeline);
            recorder.bind_sets(0, &[&own, &scene]);
            recorder.dispatch([(cases.len() as u32).div_ceil(64), 1, 1]);
            recorder.barrier(Access::COMPUTE_WRITE, Access::TRANSFER_READ);
        })
        .expect("dispatch");
    let results = device.download_as::<u32>(&output, 0, cases.len() * RESULT_WORDS).expect("results");
    assert_eq!(device.validation_messages(), Vec::<String>::new());
    results
}

fn close(a: f32, b: f32, relative: f32) -> bool {
    (a - b).abs() <= relative * a.abs().max(b.abs()) + 1.0e-5
}

fn flags(sample: &BsdfSample) -> u32 {
    SAMPLE_VALID
        | if sample.delta { SAMPLE_DELTA } else { 0 }
        | if sample.transmitted { SAMPLE_TRANSMITTED } else { 0 }
}

/// Returns the cases whose results are not those of the reference for `change`d surfaces; also the number of
/// scattered cases, and how many of these went through the surface.
fn compare(
    cases: &[Case],
    results: &[u32],
    sampler: Sampler,
    change: impl Fn(Surface) -> Surface,
) -> (Vec<usize>, u32, u32) {
    let (mut differ, mut sampled, mut transmitted) = (Vec::new(), 0, 0);
    for (index, (case, result)) in cases.iter().zip(results.chunks_exact(RESULT_WORDS)).enumerate() {
        let float = |word: usize| f32::from_bits(result[word]);
        let vec3 = |word: usize| Vec3::new(float(word), float(word + 1), float(word + 2));
        let random = Numbers { sampler, stream: case.random }.four(case.dimension);
        assert_eq!(random.map(f32::to_bits), result[12..16], "random numbers are exact");

        let surface = change(case.surface);
        let value = bsdf_evaluate(&surface, case.o, case.i);
        let same_value = (0..3).all(|channel| close(value[channel], vec3(8)[channel], 2.0e-3));
        let same_pdf = close(bsdf_pdf(&surface, case.o, case.i), float(11), 2.0e-3);
        let same_sample = match bsdf_sample(&surface, case.o, random) {
            None => result[7] == 0,
            Some(sample) => {
                sampled += 1;
                transmitted += u32::from(sample.transmitted);
                flags(&sample) == result[7]
                    && (sample.direction - vec3(0)).length() < 1.0e-3
                    && close(sample.pdf, float(3), 2.0e-2)
                    && (0..3).all(|channel| close(sample.weight[channel], vec3(4)[channel], 5.0e-3))
            }
        };
        if !(same_value && same_pdf && same_sample) {
            differ.push(index);
        }
    }
    (differ, sampled, transmitted)
}

#[test]
fn scattering_on_the_device_is_that_of_the_reference() {
    let (cases, mut packed) = (cases(), tables());
    for sampler in [Sampler::Pcg, Sampler::Sobol] {
        let (differ, ..) = compare(&cases, &run(&cases, sampler, &packed), sampler, |surface| surface);
        assert!(differ.len() < 12, "{sampler:?}: {} cases differ", differ.len());
    }
    let sampler = Sampler::default();
    let results = run(&cases, sampler, &packed);
    let (differ, sampled, transmitted) = compare(&cases, &results, sampler, |surface| surface);
    assert!(sampled > CASES / 2 && transmitted > CASES / 10, "{sampled} {transmitted}: too few to tell");
    // A number next to a threshold, or a half vector near zero, may be decided either way.
    assert!(differ.len() < 12, "{} cases differ: {:?}", differ.len(), &differ[..differ.len().min(8)]);

    // The comparison detects surfaces that are one percent off.
    type Change = fn(Surface) -> Surface;
    let mutants: [Change; 4] = [
        |surface| Surface { roughness: surface.roughness * 0.99, ..surface },
        |surface| Surface { ior: surface.ior * 1.01, ..surface },
        |surface| Surface { base_color: surface.base_color * 0.99, ..surface },
        |surface| Surface { front: !surface.front, ..surface },
    ];
    for (number, mutant) in mutants.into_iter().enumerate() {
        let (differ, ..) = compare(&cases, &results, sampler, mutant);
        assert!(differ.len() > 200, "mutant {number}: only {} cases differ", differ.len());
    }
    // The comparison also detects rough glass without its tables.
    packed.materials.iter_mut().for_each(|material| material.albedo = ATTRIBUTE_NONE);
    let (differ, ..) = compare(&cases, &run(&cases, sampler, &packed), sampler, |surface| surface);
    assert!(differ.len() > 200, "only {} cases differ without tables", differ.len());
}
