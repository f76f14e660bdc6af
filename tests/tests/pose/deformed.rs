//! Meshes that the host deforms: a simulation, files, with other triangles refused.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use rasray_gpu_scene::{GpuSceneError, PosePass};
use rasray_scene::animation::{ChannelValues, Rig};
use rasray_scene::builtin::builtin;
use rasray_scene::deforming::{Deformation, Deformer, Shape, Topology};
use rasray_scene::{Instance, Material, Mesh, Moment, Scene, SceneError};
use rasray_tests::harness::Bench;

use crate::pose::held::{DeviceScene, Figures};
use crate::pose::shapes::{at, cloud, linear, node, scene, shape};

/// Lets a mesh grow from where it was; `says` makes of the mesh then what the deformer gives.
struct Growing {
    mesh: usize,
    rest: Mesh,
    says: fn(Mesh) -> Shape,
}

impl std::fmt::Debug for Growing {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("Growing")
    }
}

impl Deformer for Growing {
    fn topology(&self) -> Topology {
        Topology::Fixed
    }

    fn duration(&self) -> f64 {
        1.0
    }

    fn meshes(&self) -> &[usize] {
        std::slice::from_ref(&self.mesh)
    }

    fn at(&self, seconds: f64) -> Result<Deformation, SceneError> {
        let scale = (1.0 + seconds) as f32;
        let grown = |position: &[f32; 3]| [position[0] * scale, position[1] + 40.0 * scale, position[2]];
        let positions = self.rest.positions.iter().map(grown).collect();
        let mesh = Mesh { positions, tangents: None, ..self.rest.clone() };
        Ok(Deformation { shapes: vec![(self.mesh, (self.says)(mesh))], warnings: Vec::new() })
    }
}

fn vertices(mesh: Mesh) -> Shape {
    Shape::Vertices { positions: mesh.positions, normals: mesh.normals }
}

fn says(made: Scene, mesh: usize, says: fn(Mesh) -> Shape) -> Scene {
    let mut made = made;
    let rest = made.meshes[mesh].clone();
    made.animation.deformer = Some(Arc::new(Growing { mesh, rest, says }));
    made
}

/// The scene with a mesh that the host deforms.
pub fn deforming(made: Scene, mesh: usize) -> Scene {
    says(made, mesh, vertices)
}

fn worst(stage: &DeviceScene<'_>, times: &[f64]) -> Figures {
    let figures = times.iter().map(|&seconds| stage.held(&at(&stage.scene, seconds)));
    figures.fold(Figures::default(), Figures::worst)
}

fn assert_close(what: &str, figures: Figures, vertices: usize, absent: usize) {
    println!("{what}: {figures:?}");
    assert_eq!((figures.vertices, figures.absent), (vertices, absent), "{what}");
    assert!(figures.ulps <= 4.0 && figures.normal <= 1.0e-5, "{what}: {figures:?}");
}

#[test]
fn the_cloth_is_where_the_host_has_it() {
    let bench = Bench::new();
    for origin in [DVec3::ZERO, DVec3::new(2.3e6, -1.0e6, 0.5)] {
        let mut cloth = builtin("cloth-ball:1k").expect("built in").expect("a cloth");
        cloth.instances.iter_mut().for_each(|instance| instance.world_from_mesh.translation = origin);
        let stage = DeviceScene::new(&bench, cloth, origin);
        assert_eq!(stage.pass.moving_draws(), [true, false, false]);
        let vertices = stage.scene.meshes[0].positions.len();
        assert_close("cloth", worst(&stage, &[0.0, 0.6, 1.2, 0.3]), vertices, 0);
        let pose = stage.pass.frame(&stage.scene, &at(&stage.scene, 0.5)).expect("a cloth");
        assert_eq!(pose.shape_bytes(), 24 * vertices as u64);
    }
}

/// A lamp that grows, shown at a node that moves, at one that stays and, without a rig, where its instances
/// are.
#[test]
fn a_shape_goes_where_its_nodes_go() {
    let bench = Bench::new();
    let moves = ChannelValues::Translation(vec![[0.0; 3], [0.0, 4.0, 1.0]]);
    let nodes = vec![node(None, DVec3::X), node(None, DVec3::Y), node(None, DVec3::Z)];
    let rig = Rig { nodes, ..Rig::default() };
    let mut made = scene(vec![cloud(40, [0.0; 3], 71), cloud(20, [0.0; 3], 72)], rig, vec![linear(0, moves)]);
    made.meshes[0].material = 1;
    made.materials.push(Material { emission: [2.0; 3], ..Material::default() });
    let more = |mesh| Instance { mesh, ..made.instances[0].clone() };
    made.instances = vec![more(0), more(1), more(0)];
    let placements = &mut made.animation.rig.placements;
    placements.push(rasray_scene::animation::Placement { node: 2, node_from_mesh: DAffine3::IDENTITY });
    let made = deforming(made.at(&Moment::default()).expect("a rig"), 0);
    let mut alone = made.clone();
    alone.animation.rig = Rig::default();
    alone.instances[2].world_from_mesh = DAffine3::from_scale(DVec3::new(2.0, -1.0, 1.0));
    for made in [made, alone] {
        let stage = DeviceScene::new(&bench, made, DVec3::ZERO);
        assert_eq!(stage.pass.moving_draws(), [true, false, true]);
        // Fresh tables have no tangents of what is deformed.
        assert_close("lamps", worst(&stage, &[0.0, 1.0, 0.5]), 240, 240);
        let buffer = &stage.gpu.posed_buffers().attributes;
        let words = (buffer.size() / 4) as usize;
        let found: Vec<f32> = bench.device().download_as(buffer, 0, words).expect("readable");
        let first = stage.fresh(&at(&stage.scene, 0.0)).draw_shadings.len();
        assert_eq!(first, 3);
        let shadings: Vec<rasray_gpu_scene::layout::DrawShading> =
            bench.device().download_as(&stage.gpu.posed_buffers().draw_shadings, 0, 3).expect("readable");
        let tangents = &found[shadings[0].tangents as usize..][..4 * 120];
        assert!(tangents.chunks_exact(4).all(|tangent| tangent[..3] == [0.0; 3] && tangent[3].abs() == 1.0));
    }
}

/// Whole meshes with the same triangles, as numbered files have them, and without normals.
#[test]
fn whole_meshes_are_shapes_where_their_triangles_stay() {
    let bench = Bench::new();
    let made = |shape: fn(Mesh) -> Shape| {
        let rig = Rig { nodes: vec![node(None, DVec3::X)], ..Rig::default() };
        says(scene(vec![cloud(30, [0.0; 3], 73)], rig, Vec::new()), 0, shape)
    };
    let stage = DeviceScene::new(&bench, made(Shape::Mesh), DVec3::ZERO);
    assert_close("meshes", worst(&stage, &[0.5, 0.0]), 90, 90);
    let flat = made(|mesh| Shape::Vertices { positions: mesh.positions, normals: None });
    let stage = DeviceScene::new(&bench, flat, DVec3::ZERO);
    let figures = stage.held(&at(&stage.scene, 0.5));
    // Fresh tables have no normals, which those on the device, without a direction, stand for.
    assert_eq!((figures.absent, figures.ulps <= 4.0), (90, true), "{figures:?}");

    let others: [fn(Mesh) -> Shape; 5] = [
        |mesh| Shape::Vertices { positions: mesh.positions[3..].to_vec(), normals: None },
        |mesh| Shape::Mesh(Mesh { indices: mesh.indices[3..].to_vec(), ..mesh }),
        |mesh| Shape::Mesh(Mesh { indices: mesh.indices.iter().rev().copied().collect(), ..mesh }),
        |mesh| Shape::Mesh(Mesh { colors: Some(vec![[1.0; 4]; mesh.positions.len()]), ..mesh }),
        |mesh| Shape::Mesh(Mesh { tangents: Some(vec![[1.0; 4]; mesh.positions.len()]), ..mesh }),
    ];
    for other in others {
        let stage = DeviceScene::new(&bench, made(other), DVec3::ZERO);
        let refused = stage.pass.frame(&stage.scene, &at(&stage.scene, 0.5));
        assert!(
            matches!(&refused, Err(GpuSceneError::OtherTriangles { scene, mesh: 0, seconds: 0.5 }) if scene == "made"),
            "{refused:?}"
        );
    }
}

#[test]
fn what_a_rig_deforms_as_well_is_refused() {
    let bench = Bench::new();
    let mesh = cloud(10, [0.0; 3], 74);
    let deformed = vec![shape(0, &mesh)];
    let rig = Rig { nodes: vec![node(None, DVec3::X)], deformed, ..Rig::default() };
    let twice = scene(vec![mesh], rig, Vec::new());
    let stage = DeviceScene::new(&bench, twice.clone(), DVec3::ZERO);
    let tables = stage.fresh(&at(&twice, 0.0));
    let twice = deforming(twice, 0);
    let refused = PosePass::new(bench.device(), &twice, &tables, &stage.gpu);
    assert!(
        matches!(&refused, Err(GpuSceneError::DeformedTwice { mesh, .. }) if mesh == "cloud"),
        "{refused:?}"
    );
}
