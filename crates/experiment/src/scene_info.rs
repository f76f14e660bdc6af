//! Facts of a scene: its contents, the defaults of view and light, and the data that an image of the scene
//! can show.

use crate::backend::TexelCapacity;
use crate::error::ExperimentError;
use crate::jobs::Frame;
use crate::texels::TexelInfo;
use glam::DVec3;
use rasray_gpu_scene::{Parts, SceneTables, left_out_bytes};
use rasray_report::{CameraRecord, PoseRecord};
use rasray_scene::facing::Facing;
use rasray_scene::needs::Needs;
use rasray_scene::{Camera, Environment, Motion, Scene, default_view};
use rasray_scene_source::{ChosenCamera, LoadedScene};
use serde_json::{Value, json};

/// Counts the bytes of a scene that are not uploaded if `needs` are those of an image from `camera`.
pub fn count_not_uploaded(loaded: &mut LoadedScene, camera: &Camera, needs: &Needs) {
    let eye = camera.world_from_camera.translation;
    let origin = SceneTables::default_frame_origin(&loaded.scene, eye);
    loaded.not_uploaded_bytes = left_out_bytes(&loaded.scene, origin, &Parts::from(needs)).ok();
}

/// Facts of a scene in numbers.
#[derive(Clone, Debug)]
pub struct SceneInfo {
    /// Name: file stem, or built-in name with its parameters.
    pub name: String,
    /// Names and numbers of triangles, instances, meshes, materials, textures, lights and clips.
    pub counts: [(&'static str, u64); 7],
    /// Clips: name and duration in seconds.
    pub clips: Vec<(String, f32)>,
    /// Pose in which the scene is shown; absent at rest.
    pub pose: Option<PoseRecord>,
    /// Kind of the scene's change with time.
    pub motion: Motion,
    /// Time after which nothing changes, seconds.
    pub duration_s: f64,
    /// Environment in words.
    pub environment: String,
    /// True if the scene gets the default light.
    pub unlit: bool,
    /// Least and greatest corner, metres; absent without triangles.
    pub bounds: Option<(DVec3, DVec3)>,
    /// Share of fragments that one view instead of three saves.
    pub one_view_saves: Option<f64>,
    /// SHA-256 of the scene file, in hexadecimal; absent for built-in scenes.
    pub sha256: Option<String>,
    /// Cameras of the scene.
    pub cameras: Vec<CameraRecord>,
    /// Camera from which the scene is seen.
    pub view: ChosenCamera,
    /// Name of the integrator for which the needs are.
    pub integrator: &'static str,
    /// Data of the scene that an image can show.
    pub needs: Needs,
    /// Bytes that are not uploaded because no image can show them; see [`LoadedScene::not_uploaded_bytes`].
    pub not_uploaded_bytes: Option<u64>,
    /// Texels that an image can show.
    pub texels: TexelInfo,
}

impl SceneInfo {
    /// Collects the facts of a scene as it is posed. The scene is lit as for a render, since the needs depend
    /// on its lights. `capacity` opens the device, if there is one; it is called only if the facts depend on
    /// the device.
    ///
    /// # Errors
    /// The scene refers to data that it does not have, or has more texels than can be made to fit the device.
    pub fn of(
        loaded: &mut LoadedScene,
        view: &ChosenCamera,
        frame: &Frame,
        capacity: impl FnOnce() -> Option<TexelCapacity>,
    ) -> Result<Self, ExperimentError> {
        let environment = environment(&loaded.scene.environment);
        loaded.relight();
        let unlit = loaded.has_default_light();
        let needs = Needs::of(&loaded.scene, frame.workload());
        count_not_uploaded(loaded, &view.camera, &needs);
        let scene = &loaded.scene;
        let camera = |(index, camera): (usize, &Camera)| {
            ChosenCamera { camera: camera.clone(), index: Some(index) }.record()
        };
        let texels = TexelInfo::of(scene, &needs, capacity)?;
        Ok(Self {
            name: scene.name.clone(),
            counts: counts(scene, loaded.triangles),
            clips: scene.animation.rig.clips.iter().map(|clip| (clip.name.clone(), clip.duration)).collect(),
            pose: loaded.pose.clone(),
            motion: scene.motion(),
            duration_s: scene
                .animation
                .deformer
                .as_ref()
                .map_or(f64::from(scene.animation.duration), |deformer| deformer.duration()),
            environment,
            unlit,
            bounds: default_view::bounds(scene),
            one_view_saves: Facing::of(scene).saved_by_one_view(),
            sha256: loaded.sha256.clone(),
            cameras: scene.cameras.iter().enumerate().map(camera).collect(),
            view: view.clone(),
            integrator: frame.integrator.name(),
            needs,
            not_uploaded_bytes: loaded.not_uploaded_bytes,
            texels,
        })
    }

    /// Returns the fields of `rasray info --json`.
    pub fn json(&self) -> Value {
        let clips = self.clips.iter().map(|(name, seconds)| json!({ "name": name, "duration_s": seconds }));
        let mut scene = json!({
            "name": self.name,
            "environment": self.environment,
            "default_light": self.unlit,
            "cameras": self.cameras,
            "default_view": self.view.record(),
            "texels": self.texels.json(),
            "animation": clips.collect::<Vec<_>>(),
            "motion": { "kind": self.motion.name(), "duration_s": self.duration_s },
        });
        for (name, count) in self.counts {
            scene[name] = count.into();
        }
        if let Some(pose) = &self.pose {
            scene["pose"] = json!(pose);
        }
        if let Some((low, high)) = self.bounds {
            scene["bounds_m"] = json!([low.to_array(), high.to_array()]);
        }
        if let Some(saved) = self.one_view_saves {
            scene["one_view_of_three_saves"] = saved.into();
        }
        if let Some(sha256) = &self.sha256 {
            scene["sha256"] = sha256.as_str().into();
        }
        let terms = self.needs.verdicts().iter().map(
            |verdict| json!({ "term": verdict.term.name(), "needed": verdict.needed, "why": verdict.why }),
        );
        let mut needs = json!({ "integrator": self.integrator, "terms": terms.collect::<Vec<_>>() });
        if let Some(bytes) = self.not_uploaded_bytes {
            needs["not_uploaded_bytes"] = bytes.into();
        }
        json!({ "scene": scene, "needs": needs })
    }
}

fn counts(scene: &Scene, triangles: u64) -> [(&'static str, u64); 7] {
    let count = |length: usize| length as u64;
    [
        ("triangles", triangles),
        ("instances", count(scene.instances.len())),
        ("meshes", count(scene.meshes.len())),
        ("materials", count(scene.materials.len())),
        ("textures", count(scene.textures.len())),
        ("lights", count(scene.lights.len())),
        ("clips", count(scene.animation.clips.len())),
    ]
}

fn environment(environment: &Environment) -> String {
    match environment {
        Environment::Constant(color) if color.iter().all(|channel| *channel == 0.0) => "none".to_owned(),
        Environment::Constant([r, g, b]) => format!("constant {r},{g},{b}"),
        Environment::LatLong { width, height, .. } => format!("map of {width}x{height}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_scene::needs::Workload;
    use rasray_scene_source::load;

    #[test]
    fn what_no_image_can_show_is_counted_as_not_uploaded() {
        let mut loaded = load("cornell".as_ref()).expect("built in");
        assert_eq!(loaded.record().not_uploaded_bytes, None);
        let camera = loaded.scene.cameras[0].clone();
        count_not_uploaded(&mut loaded, &camera, &Needs::all());
        assert_eq!(loaded.record().not_uploaded_bytes, Some(0));
        let occlusion = Workload::VISIBILITY;
        let needs = Needs::of(&loaded.scene, occlusion);
        count_not_uploaded(&mut loaded, &camera, &needs);
        let normals: usize = loaded
            .scene
            .instances
            .iter()
            .map(|instance| {
                let normals = loaded.scene.meshes[instance.mesh].normals.as_ref();
                normals.map_or(0, |normals| size_of_val(&normals[..]))
            })
            .sum();
        // One zero word stands in for a table without words.
        assert!(loaded.not_uploaded_bytes.is_some_and(|count| count >= normals as u64 - 4), "{normals}");
        // Faulty data that is not needed is not counted, and is not an error.
        loaded.scene.meshes[0].normals = Some(Vec::new());
        count_not_uploaded(&mut loaded, &camera, &needs);
        assert_eq!(loaded.not_uploaded_bytes, None);
    }
}
