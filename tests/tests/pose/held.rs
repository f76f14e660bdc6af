//! A scene on the device, with the pass that poses it, and what the host makes of the same moment.

use glam::DVec3;
use rasray_ads::{Draw, GeometryHeader};
use rasray_gpu_scene::layout::{DrawShading, EmissiveTriangle, Frame, Light};
use rasray_gpu_scene::{GpuScene, Parts, PosePass, SceneTables, View};
use rasray_scene::{Camera, Moment, Projection, Scene};
use rasray_shaders_glsl::constants::scene::ATTRIBUTE_NONE;
use rasray_tests::harness::Bench;

/// Rounding of shares of lights that depend on the bounds, which the device computes in single precision.
const SHARE_ERROR: f32 = 4.0e-7;

/// A scene, its tables at rest on the device, and its pass.
pub struct DeviceScene<'a> {
    pub bench: &'a Bench,
    pub scene: Scene,
    pub gpu: GpuScene,
    pub pass: PosePass,
    origin: DVec3,
}

/// Largest differences between device and host.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// Difference of positions, in units in the last place of the largest coordinate of the draw.
    pub ulps: f64,
    /// Difference of a component of a normal.
    pub normal: f32,
    /// Difference of a component of a tangent.
    pub tangent: f32,
    /// Vertices of draws that move.
    pub vertices: usize,
    /// Normals and tangents that one of both does not have.
    pub absent: usize,
}

impl Figures {
    pub fn worst(self, other: Self) -> Self {
        Self {
            ulps: self.ulps.max(other.ulps),
            normal: self.normal.max(other.normal),
            tangent: self.tangent.max(other.tangent),
            vertices: self.vertices.max(other.vertices),
            absent: self.absent.max(other.absent),
        }
    }
}

pub fn view(eye: DVec3) -> View {
    let camera = Camera {
        name: "eye".to_owned(),
        world_from_camera: glam::DAffine3::from_translation(eye),
        projection: Projection::Perspective { fov_y: 1.0 },
        aspect_ratio: None,
        lens: None,
    };
    View { camera, width: 16, height: 8, seed: 4 }
}

impl<'a> DeviceScene<'a> {
    pub fn new(bench: &'a Bench, scene: Scene, origin: DVec3) -> Self {
        let tables = SceneTables::new(&scene, origin, &Parts::ALL).expect("the scene is whole");
        let gpu = GpuScene::upload(bench.device(), &tables, &view(origin)).expect("the scene fits");
        let pass = PosePass::new(bench.device(), &scene, &tables, &gpu).expect("the scene fits");
        Self { bench, scene, gpu, pass, origin }
    }

    /// Tables that the host makes of a moment.
    pub fn fresh(&self, moment: &Moment) -> SceneTables {
        SceneTables::new(&self.scene.at(moment).expect("a rig"), self.origin, &Parts::ALL)
            .expect("the scene is whole")
    }

    /// Poses the scene on the device.
    pub fn pose(&self, moment: &Moment) {
        let frame = self.pass.frame(&self.scene, moment).expect("the pass is of this scene");
        let cameras: Vec<_> = self
            .scene
            .at(moment)
            .expect("a rig")
            .cameras
            .iter()
            .map(|camera| camera.world_from_camera)
            .collect();
        assert_eq!(frame.cameras(), cameras);
        let submitted = self.bench.device().submit(|recorder| self.pass.record(recorder, 0, &frame));
        submitted.expect("the device works");
    }

    /// Poses the scene on the device and on the host, and holds all that is to be equal against each other.
    pub fn held(&self, moment: &Moment) -> Figures {
        self.pose(moment);
        let fresh = self.fresh(moment);
        let size_error = self.hold_bounds();
        self.hold_lights(&fresh, size_error);
        self.hold_vertices(&fresh)
    }

    fn hold_vertices(&self, fresh: &SceneTables) -> Figures {
        let device = self.bench.device();
        let (positions, indices) = self.gpu.geometry().download(device).expect("readable");
        assert_eq!(indices, fresh.posed.indices);
        let draws = fresh.draw_shadings.len();
        let buffers = self.gpu.posed_buffers();
        let shadings: Vec<DrawShading> =
            device.download_as(&buffers.draw_shadings, 0, draws).expect("readable");
        let in_geometry: Vec<Draw> =
            device.download_as(&self.gpu.geometry().desc().draws.buffer, 0, draws).expect("readable");
        assert_eq!(in_geometry, fresh.posed.draws, "which side of a draw is its front");
        let words = (buffers.attributes.size() / 4) as usize;
        let attributes: Vec<f32> = device.download_as(&buffers.attributes, 0, words).expect("readable");
        let mut figures = Figures::default();
        for (draw, (found, expected)) in shadings.iter().zip(&fresh.draw_shadings).enumerate() {
            let own = |shading: &DrawShading| DrawShading {
                normals: 0,
                tangents: 0,
                uv0: 0,
                uv1: 0,
                colors: 0,
                ..*shading
            };
            assert_eq!(own(found), own(expected), "draw {draw}");
            let mesh = &self.scene.meshes[self.scene.instances[found.instance as usize].mesh];
            let (first, count) = (found.first_vertex as usize, mesh.positions.len());
            let [posed, placed] =
                [&positions, &fresh.posed.positions].map(|positions| &positions[first..first + count]);
            if !self.pass.moving_draws()[draw] {
                assert_eq!(posed, placed, "draw {draw} is still");
                continue;
            }
            figures.vertices += count;
            figures.ulps = figures.ulps.max(worst_ulps(posed, placed));
            let pairs = |[found, expected]: [u32; 2], width: usize| {
                let [found, expected] = [found, expected]
                    .map(|word| if word == ATTRIBUTE_NONE { None } else { Some(word as usize) });
                let range = |word: usize| word..word + width * count;
                Some((&attributes[range(found?)], &fresh.posed_attributes[range(expected?)]))
            };
            let normals = pairs([found.normals, expected.normals], 3);
            let tangents = pairs([found.tangents, expected.tangents], 4);
            let is_absent = (normals.is_none() && found.normals != expected.normals)
                || (tangents.is_none() && found.tangents != expected.tangents);
            figures.absent += usize::from(is_absent) * count;
            let of = |pair: Option<(&[f32], &[f32])>, width, worst: &mut f32, absent: &mut usize| {
                let Some((found, expected)) = pair else { return };
                for (found, expected) in found.chunks_exact(width).zip(expected.chunks_exact(width)) {
                    if found[..3] == [0.0; 3] {
                        *absent += 1;
                        continue;
                    }
                    let errors = found.iter().zip(expected).map(|(found, expected)| (found - expected).abs());
                    *worst = errors.fold(*worst, f32::max);
                }
            };
            of(normals, 3, &mut figures.normal, &mut figures.absent);
            of(tangents, 4, &mut figures.tangent, &mut figures.absent);
        }
        figures
    }

    /// `size_error`: relative, of the size of the bounds.
    fn hold_lights(&self, fresh: &SceneTables, size_error: f32) {
        let device = self.bench.device();
        let buffers = self.gpu.posed_buffers();
        let frame: Frame = device.download_as(&buffers.frame, 0, 1).expect("readable")[0];
        let expected = fresh.frame(&view(self.origin));
        assert_eq!(frame.emissive_count, expected.emissive_count);
        let lights: Vec<Light> =
            device.download_as(&buffers.lights, 0, fresh.lights.len()).expect("readable");
        // Where nothing shines from far away, nothing depends on the bounds.
        let is_directional =
            |light: &rasray_scene::Light| matches!(light, rasray_scene::Light::Directional { .. });
        let is_far = fresh.environment.emits || self.scene.lights.iter().any(is_directional);
        let error = if is_far { SHARE_ERROR + size_error } else { 0.0 };
        for (found, expected) in lights.iter().zip(&fresh.lights) {
            assert_eq!(Light { cumulative: 0.0, ..*found }, Light { cumulative: 0.0, ..*expected });
            assert!((found.cumulative - expected.cumulative).abs() <= error, "{found:?} {expected:?}");
        }
        for (found, expected) in frame.kind_shares.iter().zip(expected.kind_shares) {
            assert!((found - expected).abs() <= error, "{frame:?} {expected}");
        }
        let count = fresh.emissive_triangles.len();
        let emissive: Vec<EmissiveTriangle> =
            device.download_as(&buffers.emissive, 0, count).expect("readable");
        assert_eq!(emissive, fresh.emissive_triangles);
    }

    /// Bounds on the device are those of the vertices there that triangles name, to the bit. Answers what a
    /// unit in the last place of either corner makes of their size, relatively.
    fn hold_bounds(&self) -> f32 {
        let device = self.bench.device();
        let (positions, indices) = self.gpu.geometry().download(device).expect("readable");
        let header: GeometryHeader =
            device.download_as(self.gpu.geometry().header(), 0, 1).expect("readable")[0];
        let corner = |with: fn(f32, f32) -> f32| -> [f32; 3] {
            std::array::from_fn(|axis| {
                let of = indices.iter().map(|&index| positions[index as usize][axis]);
                of.filter(|x| x.is_finite()).reduce(with).unwrap_or(0.0)
            })
        };
        assert_eq!([header.lower, header.upper], [corner(f32::min), corner(f32::max)]);
        let largest = [header.lower, header.upper].as_flattened().iter().fold(0.0_f32, |a, x| a.max(x.abs()));
        let size = (0..3).map(|axis| header.upper[axis] - header.lower[axis]).fold(0.0, f32::max);
        if size > 0.0 { 2.0 * (largest.next_up() - largest) / size } else { 0.0 }
    }
}

/// The largest difference of a coordinate, in units in the last place of the largest coordinate.
pub fn worst_ulps(found: &[[f32; 3]], expected: &[[f32; 3]]) -> f64 {
    let scale = expected.as_flattened().iter().fold(0.0_f32, |scale, x| scale.max(x.abs()));
    let ulp = f64::from(scale.next_up()) - f64::from(scale);
    let pairs = found.as_flattened().iter().zip(expected.as_flattened());
    pairs.map(|(a, b)| (f64::from(*a) - f64::from(*b)).abs() / ulp).fold(0.0, f64::max)
}
