//! Poses and views in recordings that are pending at the same time, and structures that are built after a
//! pose.

use ash::vk;
use glam::DVec3;
use rasray_ads::Ray;
use rasray_gpu::{Access, BufferDesc, BufferUsage, GpuError, MemoryLocation, Recorder, Timing};
use rasray_gpu_scene::layout::Frame;
use rasray_gpu_scene::{GpuSceneError, PosePass, Sampling};
use rasray_reference::oracle::Oracle;
use rasray_scene::animation::{ChannelValues, Rig};
use rasray_scene::{Sampler, Scene};
use rasray_tests::harness::{Bench, oracle_ray};
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tracer::build_until_complete;

use crate::pose::deformed::deforming;
use crate::pose::held::{DeviceScene, view};
use crate::pose::shapes::{at, binding, cloud, linear, node, scene, shape, skin};

/// A turning and a skinned mesh beside one that stays, and one that the host deforms.
fn moving() -> Scene {
    let mesh = cloud(40, [0.0; 3], 52);
    let (joint_nodes, skin, mut channels) = skin(5, 3, DVec3::X, DVec3::ZERO);
    let mut skinned = shape(1, &mesh);
    skinned.skin = Some(binding(mesh.positions.len(), 4, 5, 53));
    let still = (0..3).map(|number| node(None, DVec3::new(2.0 * f64::from(number), 0.0, 0.0)));
    let rig = Rig {
        nodes: still.chain(joint_nodes).collect(),
        skins: vec![skin],
        deformed: vec![skinned],
        ..Rig::default()
    };
    channels.push(linear(0, ChannelValues::Translation(vec![[0.0; 3], [0.0, 4.0, 1.0]])));
    let meshes = vec![cloud(40, [0.0; 3], 51), mesh, cloud(40, [0.0; 3], 54), cloud(30, [0.0; 3], 55)];
    deforming(scene(meshes, rig, channels), 3)
}

/// Two command buffers are recorded before either is submitted; each copies what it posed, and its frame.
#[test]
fn pending_recordings_have_poses_and_views_of_their_own() {
    let bench = Bench::new();
    let device = bench.device();
    let mut stage = DeviceScene::new(&bench, moving(), DVec3::ZERO);
    stage.pass.set_slots(device, 2).expect("it fits");
    let positions = &stage.gpu.geometry().desc().positions.buffer;
    let moments = [at(&stage.scene, 0.25), at(&stage.scene, 0.8)];
    let expected = moments.each_ref().map(|moment| {
        stage.pose(moment);
        stage.gpu.geometry().download(device).expect("readable").0
    });
    assert_ne!(expected[0], expected[1]);
    let frame_bytes = size_of::<Frame>() as u64;
    let copies = [(); 2].map(|()| {
        let desc = BufferDesc {
            name: "copy",
            size: positions.size() + frame_bytes,
            usage: BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Device,
        };
        device.create_buffer(&desc).expect("it fits")
    });
    let views = [DVec3::X, DVec3::Y].map(view);
    let (raw, queue) = (device.raw(), device.raw_queue());
    // SAFETY: pool and command buffers are this test's alone, and what was recorded is dropped after the
    // wait.
    unsafe {
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(device.queue_family());
        let pool = raw.create_command_pool(&info, None).expect("a pool");
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(2);
        let commands = raw.allocate_command_buffers(&info).expect("command buffers");
        let recorded: Vec<_> = (0..2)
            .map(|number| {
                let command = commands[number];
                raw.begin_command_buffer(command, &vk::CommandBufferBeginInfo::default()).expect("begun");
                let mut recorder = Recorder::from_raw(device, command);
                let pose = stage.pass.frame(&stage.scene, &moments[number]).expect("it is whole");
                stage.pass.record(&mut recorder, number as u32, &pose);
                let sampling =
                    Sampling { sampler: Sampler::Pcg, samples: 1 + number as u32, ..Sampling::default() };
                let frame = stage.gpu.record_frame(&mut recorder, &views[number], sampling);
                assert_eq!(frame.camera_position, views[number].eye().as_vec3().to_array());
                let (copy, size) = (&copies[number], positions.size());
                recorder.copy(positions, 0, copy, 0, size);
                recorder.copy(&stage.gpu.posed_buffers().frame, 0, copy, size, frame_bytes);
                recorder.barrier(Access::TRANSFER, Access::ALL);
                let recorded = recorder.finish().expect("no mistake");
                raw.end_command_buffer(command).expect("ended");
                (recorded, frame)
            })
            .collect();
        let submit = vk::SubmitInfo::default().command_buffers(&commands);
        raw.queue_submit(queue, &[submit], vk::Fence::null()).expect("submitted");
        raw.queue_wait_idle(queue).expect("done");
        for (number, (recorded, frame)) in recorded.into_iter().enumerate() {
            drop(recorded);
            let count = expected[number].len();
            let found: Vec<[f32; 3]> = device.download_as(&copies[number], 0, count).expect("readable");
            assert_eq!(found, expected[number], "recording {number}");
            let found: Frame = device.download_as(&copies[number], positions.size(), 1).expect("readable")[0];
            assert_eq!(found, frame, "recording {number}");
        }
        raw.destroy_command_pool(pool, None);
    }
}

/// Scenes, tables and poses that do not belong together are errors, not pictures.
#[test]
fn what_was_made_for_another_scene_is_refused() {
    let bench = Bench::new();
    let device = bench.device();
    let rig = Rig { nodes: vec![node(None, DVec3::ZERO)], ..Rig::default() };
    let moves = ChannelValues::Translation(vec![[0.0; 3], [1.0; 3]]);
    let other = scene(vec![cloud(3, [0.0; 3], 60)], rig, vec![linear(0, moves)]);
    let (stage, other) =
        (DeviceScene::new(&bench, moving(), DVec3::ZERO), DeviceScene::new(&bench, other, DVec3::ZERO));
    let moment = at(&other.scene, 0.5);
    let pose = other.pass.frame(&other.scene, &moment).expect("it is of this scene");
    let submitted = device.submit(|recorder| stage.pass.record(recorder, 0, &pose));
    assert!(matches!(submitted, Err(GpuError::InvalidUse { .. })), "{submitted:?}");
    let frame = stage.pass.frame(&other.scene, &moment);
    assert!(matches!(frame, Err(GpuSceneError::Malformed { limit: 1, .. })), "{frame:?}");
    let pass = PosePass::new(device, &other.scene, &stage.fresh(&moment), &stage.gpu);
    assert!(matches!(pass, Err(GpuSceneError::Malformed { limit: 1, .. })), "{pass:?}");
}

/// One structure, built again after each pose, answers as the oracle does on the positions that are on the
/// device.
#[test]
fn structures_are_built_from_what_was_posed() {
    let bench = Bench::new();
    let device = bench.device();
    let stage = DeviceScene::new(&bench, moving(), DVec3::ZERO);
    let geometry = stage.gpu.geometry();
    let mut random = Random::new(61);
    let rays: Vec<Ray> = (0..400)
        .map(|_| {
            let from = random.point(-6.0, 9.0);
            towards(from, random.point(-2.0, 4.0))
        })
        .collect();
    let subjects = Subject::all();
    for name in ["bvh robust", "bricks robust"] {
        let subject = subjects.iter().find(|subject| subject.name() == name).expect("it is there");
        let mut structure = subject.structure(&bench, geometry);
        for seconds in [0.0, 0.5, 1.0] {
            stage.pose(&at(&stage.scene, seconds));
            let (positions, indices) = geometry.download(device).expect("readable");
            let oracle = Oracle::new(&positions, &indices, None).expect("the indices are in range");
            build_until_complete(device, structure.as_mut(), [0.0; 3], Timing::None).expect("it completes");
            let hits = bench.trace(structure.as_ref(), &rays).hits;
            let mut sure = 0;
            for (ray, hit) in rays.iter().zip(&hits) {
                let verdict = oracle.closest(&oracle_ray(ray));
                if verdict.ambiguous {
                    continue;
                }
                let expected = verdict.outcome.hit();
                let found = hit.is_hit().then_some(hit.primitive);
                assert_eq!(found, expected.map(|(primitive, _)| primitive), "{name} at {seconds} s: {ray:?}");
                if let Some((_, t)) = expected {
                    let [low, high] = verdict.t_range;
                    let range = low.min(t)..=high.max(t);
                    assert!(range.contains(&f64::from(hit.t)), "{name} at {seconds} s: {ray:?} {hit:?}");
                    sure += 1;
                }
            }
            println!("{name} at {seconds} s: {sure} hits");
            assert!(sure > 80, "{name} at {seconds} s: {sure}");
        }
    }
}
