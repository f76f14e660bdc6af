//! Probabilities of lights that depend on the bounds, which only the device knows.

use bytemuck::bytes_of;
use rasray_ads::Geometry;
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferUsage, ComputePipeline, ComputePipelineDesc, Device, Recorder, Stage,
};
use rasray_scene::{Light, Scene};
use rasray_shaders_glsl::SCENE_POSE_LIGHTS;
use rasray_shaders_glsl::records::{PoseLightConstants, PoseLightPower};

use crate::kinds::punctual_power;
use crate::{GpuScene, GpuSceneError, SceneTables};

/// Pass `scene/pose_lights`: directional lights and the environment are weighted by the circle around the
/// bounds.
#[derive(Debug)]
pub struct FarLights {
    pipeline: ComputePipeline,
    set: BindingSet,
    powers: Buffer,
    constants: PoseLightConstants,
}

impl FarLights {
    /// Makes the pass; `None` if no light shines from far away, or if there is no other light to choose from.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(
        device: &Device,
        scene: &Scene,
        tables: &SceneTables,
        gpu: &GpuScene,
    ) -> Result<Option<Self>, GpuSceneError> {
        let lights = if tables.lights.is_empty() { &[] } else { &scene.lights[..] };
        let emits = tables.environment.emits;
        let is_far = emits || lights.iter().any(|light| matches!(light, Light::Directional { .. }));
        let choices = lights.len() + tables.emissive_triangles.len() + usize::from(emits);
        if !is_far || choices < 2 {
            return Ok(None);
        }
        let (mut near, mut far) = (0.0, 0.0);
        let powers: Vec<PoseLightPower> = lights
            .iter()
            .map(|light| {
                match light {
                    Light::Directional { .. } => far += punctual_power(light, 1.0),
                    Light::Point { .. } | Light::Spot { .. } => near += punctual_power(light, 0.0),
                }
                PoseLightPower { near: near as f32, far: far as f32 }
            })
            .collect();
        let powers = gpu.staging().buffer(device, "pose light powers", BufferUsage::STORAGE, &powers)?;
        let posed = gpu.posed_buffers();
        let layout = device.create_set_layout("pose lights", 3)?;
        let bound = [&powers, &posed.frame, &posed.lights];
        let set = device.create_binding_set(&layout, "pose lights", &bound)?;
        let pipeline = device.create_compute_pipeline(&ComputePipelineDesc {
            name: SCENE_POSE_LIGHTS.name,
            module: &SCENE_POSE_LIGHTS.module(),
            sets: &[gpu.geometry().layout(), &layout],
            push_constant_bytes: size_of::<PoseLightConstants>() as u32,
            constants: &[],
        })?;
        let constants = PoseLightConstants {
            light_count: lights.len() as u32,
            emissive: 0,
            emissive_power: 0.0,
            environment: emits.into(),
            irradiance: tables.environment.irradiance as f32,
        };
        Ok(Some(Self { pipeline, set, powers, constants }))
    }

    /// Returns the name and bytes of the buffer.
    pub fn bytes(&self) -> (&'static str, u64) {
        ("pose light powers", self.powers.size())
    }

    /// Records the computation of the probabilities from the bounds on the device and the power of emissive
    /// triangles, W.
    pub fn record(&self, recorder: &mut Recorder<'_>, geometry: &Geometry, emissive_power: f64) {
        let constants = PoseLightConstants {
            emissive: u32::from(emissive_power > 0.0),
            emissive_power: emissive_power.min(1.0e38) as f32,
            ..self.constants
        };
        recorder.begin_pass(Stage::Pose, SCENE_POSE_LIGHTS.name);
        recorder.bind_compute(&self.pipeline);
        recorder.bind_sets(0, &[geometry.set(), &self.set]);
        recorder.push_constants(bytes_of(&constants));
        recorder.dispatch([1; 3]);
        recorder.barrier(Access::COMPUTE, Access::ALL);
        recorder.end_pass();
    }
}
