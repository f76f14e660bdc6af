//! What a scene holds, how it is seen and lit where nothing is said of it, and what of it an image can show.

use super::rows::pair;
use super::texels::TexelInfo;
use crate::error::AppError;
use glam::DVec3;
use rasray_experiment::{Chosen, Frame, LoadedScene, TexelRoom};
use rasray_report::in_line;
use rasray_report::{CameraRecord, bytes, columns, grouped};
use rasray_scene::facing::Facing;
use rasray_scene::needs::Needs;
use rasray_scene::{Environment, Scene, default_view};
use serde_json::{Value, json};

/// A scene in numbers.
pub(super) struct SceneInfo {
    name: String,
    /// What there are how many of.
    counts: [(&'static str, u64); 7],
    environment: String,
    /// Whether it gets the default light.
    unlit: bool,
    bounds: Option<(DVec3, DVec3)>,
    /// Share of fragments that one view of three saves.
    one_view_saves: Option<f64>,
    sha256: Option<String>,
    cameras: Vec<CameraRecord>,
    view: Chosen,
    integrator: &'static str,
    needs: Needs,
    texels: TexelInfo,
}

impl SceneInfo {
    /// Looks a scene over. It is lit as a render would light it: what it needs then is what counts.
    pub(super) fn of(
        loaded: &mut LoadedScene,
        view: &Chosen,
        frame: &Frame,
        room: impl FnOnce() -> Result<TexelRoom, AppError>,
    ) -> Result<Self, AppError> {
        let environment = environment(&loaded.scene.environment);
        let unlit = default_view::ensure_lit(&mut loaded.scene);
        let scene = &loaded.scene;
        let camera = |(index, camera): (usize, &rasray_scene::Camera)| {
            Chosen { camera: camera.clone(), index: Some(index) }.record()
        };
        let needs = Needs::of(scene, frame.workload());
        let texels = TexelInfo::of(scene, &needs, room)?;
        Ok(Self {
            name: scene.name.clone(),
            counts: counts(scene, loaded.triangles),
            environment,
            unlit,
            bounds: default_view::bounds(scene),
            one_view_saves: Facing::of(scene).saved_by_one_view(),
            sha256: loaded.sha256.clone(),
            cameras: scene.cameras.iter().enumerate().map(camera).collect(),
            view: view.clone(),
            integrator: frame.integrator.name(),
            needs,
            texels,
        })
    }

    pub(super) fn json(&self) -> Value {
        let mut scene = json!({
            "name": self.name,
            "environment": self.environment,
            "default_light": self.unlit,
            "cameras": self.cameras,
            "default_view": self.view.record(),
            "texels": self.texels.json(),
        });
        for (name, count) in self.counts {
            scene[name] = count.into();
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
        let needs = json!({
            "integrator": self.integrator,
            "not_uploaded_bytes": self.needs.saved_bytes(),
            "terms": terms.collect::<Vec<_>>(),
        });
        json!({ "scene": scene, "needs": needs })
    }

    pub(super) fn text(&self) -> String {
        let mut rows: Vec<_> = self.counts.iter().map(|(name, count)| pair(name, grouped(*count))).collect();
        let added = if self.unlit { "; the default light is added" } else { "" };
        rows.push(pair("environment", format!("{}{added}", self.environment)));
        rows.extend(self.texels.rows());
        if let Some((low, high)) = self.bounds {
            let size = high - low;
            rows.push(pair("bounds", format!("{low:.3} to {high:.3} m")));
            rows.push(pair("size", format!("{:.3} x {:.3} x {:.3} m", size.x, size.y, size.z)));
        }
        if let Some(saved) = self.one_view_saves {
            rows.push(pair(
                "one view of three",
                format!("saves {:.2} % of fragments at most", 100.0 * saved),
            ));
        }
        if let Some(sha256) = &self.sha256 {
            rows.push(pair("sha256", sha256));
        }
        rows.push(pair("default view", self.view.described()));
        let mut text = format!("scene {}\n{}", in_line(&self.name), columns(&rows, 2));
        if !self.cameras.is_empty() {
            text += "cameras\n";
            text += &columns(&self.cameras.iter().map(camera_row).collect::<Vec<_>>(), 4);
        }
        text + &self.needs_text()
    }

    fn needs_text(&self) -> String {
        let rows: Vec<_> = self
            .needs
            .verdicts()
            .iter()
            .map(|verdict| {
                let word = if verdict.needed { "needed" } else { "-" };
                vec![verdict.term.name().to_owned(), word.to_owned(), verdict.why.clone()]
            })
            .collect();
        let saved = bytes(self.needs.saved_bytes());
        format!("needs of --integrator {}; not uploaded: {saved}\n{}", self.integrator, columns(&rows, 3))
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

/// Position, name, kind and what of the world is in the picture.
fn camera_row(camera: &CameraRecord) -> Vec<String> {
    let seen = match (camera.fov_y_degrees, camera.height_m) {
        (Some(angle), _) => format!("{angle:.1} degrees"),
        (_, height) => format!("{:.3} m high", height.unwrap_or_default()),
    };
    vec![camera.index.unwrap_or_default().to_string(), camera.name.clone(), camera.kind.clone(), seen]
}
