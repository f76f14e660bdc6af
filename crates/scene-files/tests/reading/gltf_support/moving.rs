//! Files with accessors of their own for moving parts, and the positions of these at a time.

use glam::DVec3;
use rasray_scene::{Moment, Scene};

use super::{assert_well_formed, data_uri, floats, load_bytes};

/// File whose accessors are made one by one.
#[derive(Default)]
pub struct File {
    pub buffers: Vec<String>,
    pub views: Vec<String>,
    pub accessors: Vec<String>,
}

impl File {
    /// Makes a file with the corners of a triangle as accessor 0.
    pub fn new() -> Self {
        let mut file = Self::default();
        file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        file
    }

    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let index = self.accessors.len();
        self.buffers.push(format!(r#"{{"byteLength":{},"uri":"{}"}}"#, bytes.len(), data_uri(bytes)));
        self.views.push(format!(r#"{{"buffer":{index},"byteLength":{}}}"#, bytes.len()));
        let accessor = format!(
            r#"{{"bufferView":{index},"componentType":{component},"count":{count},"type":"{kind}"}}"#
        );
        self.accessors.push(accessor);
        index
    }

    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        self.accessor(&floats(values), 5126, kind, values.len() / width)
    }

    pub fn load(&self, rest: &str) -> Scene {
        let Self { buffers, views, accessors } = self;
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{}],"bufferViews":[{}],"accessors":[{}],{rest}}}"#,
            buffers.join(","),
            views.join(","),
            accessors.join(",")
        );
        let scene = load_bytes(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {rest}"));
        assert_well_formed(&scene);
        scene
    }
}

pub const TRIANGLE: &str = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]"#;

/// Returns the messages of a scene's warnings of a kind.
pub fn messages(scene: &Scene, kind: &str) -> Vec<String> {
    let of = scene.warnings.iter().filter(|warning| warning.kind == kind);
    of.map(|warning| warning.message.clone()).collect()
}

/// Returns the corners of an instance at a time, with all clips.
pub fn corners(scene: &Scene, instance: usize, seconds: f64) -> Vec<DVec3> {
    let clips = (0..scene.animation.clips.len()).collect();
    let posed = scene.at(&Moment { seconds, clips }).expect("a rig");
    let instance = &posed.instances[instance];
    let place = |p: &[f32; 3]| instance.world_from_mesh.transform_point3(DVec3::from(p.map(f64::from)));
    posed.meshes[instance.mesh].positions.iter().map(place).collect()
}
