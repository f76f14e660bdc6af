//! Loading of a scene that can be rendered, by its name.

use crate::camera::{ChosenCamera, default_view, named_view};
use crate::error::LoadError;
use crate::key_hash::KeyHash;
use crate::lighting::Lighting;
use rasray_report::{PoseRecord, SceneRecord, SmallerImageRecord};
use rasray_scene::nearest::nearest;
use rasray_scene::pose::Pose;
use rasray_scene::{AlphaMode, Camera, Moment, Scene, builtin};
use rasray_scene_files::LoadOptions;
use sha2::{Digest, Sha256};
use std::borrow::Cow;
use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Scene with the data that reports give about it.
#[derive(Clone, Debug)]
pub struct LoadedScene {
    /// Scene as it is shown, or at rest where there is a moment.
    pub scene: Scene,
    /// Moment at which the device shows the scene ([`Self::show`]).
    pub moment: Option<Moment>,
    /// Number of triangles over all instances.
    pub triangles: u64,
    /// SHA-256 of the scene file in hexadecimal, for a sequence of the file that is shown; absent for
    /// built-in scenes.
    pub sha256: Option<String>,
    /// SHA-256 in hexadecimal of all sources of the scene: the contents of all files read for it, or the
    /// built-in's name with parameters as given; the environment that was asked for; and whether its holes
    /// were closed.
    pub content: String,
    /// Bytes of the scene's tables that are not uploaded because no image can show their contents. Absent
    /// until code that knows the image counts them, and if the scene has a fault in the omitted parts.
    pub not_uploaded_bytes: Option<u64>,
    /// Time at which the scene is shown; absent at rest.
    pub pose: Option<PoseRecord>,
    /// Images that were made smaller for the device.
    pub smaller_images: Vec<SmallerImageRecord>,
    /// True if every surface was made opaque.
    pub(crate) holes_closed: bool,
    /// Source of the scene's light.
    pub(crate) lighting: Lighting,
}

impl LoadedScene {
    /// Returns the record of the scene in reports.
    pub fn record(&self) -> SceneRecord {
        SceneRecord {
            name: self.scene.name.clone(),
            triangles: self.triangles,
            sha256: self.sha256.clone(),
            not_uploaded_bytes: self.not_uploaded_bytes,
            pose: self.pose.clone(),
            environment: Some(self.lighting.name().to_owned()),
            alpha: self.holes_closed.then(|| "off".to_owned()),
            smaller_images: self.smaller_images.clone(),
        }
    }
}

/// Extensions of names that stand for files.
const EXTENSIONS: [&str; 4] = ["gltf", "glb", "obj", "ply"];

/// Loads the file or makes the built-in scene that `name` stands for.
///
/// # Errors
/// An error for a name that is neither, and for any fault of a file or a parameter.
pub fn load(name: &OsStr) -> Result<LoadedScene, LoadError> {
    load_with(name, &LoadOptions::default())
}

/// Loads a scene as [`load`] does, with other options than the defaults.
///
/// # Errors
/// Errors of [`load`].
pub fn load_with(name: &OsStr, options: &LoadOptions) -> Result<LoadedScene, LoadError> {
    let path = Path::new(name);
    let extension = path.extension().and_then(|text| text.to_str()).map(str::to_ascii_lowercase);
    let is_file = extension.is_some_and(|extension| EXTENSIONS.contains(&extension.as_str()));
    if is_file {
        let scene = rasray_scene_files::load(path, options)?;
        let shown = scene.animation.deformer.as_ref().and_then(|deformer| deformer.file(0.0));
        let sha256 = digest(shown.unwrap_or(path))?;
        // The shown one of numbered files changes with the time: keys of pictures hold that file by its
        // digest.
        let first = if shown.is_none() { sha256.as_str() } else { "" };
        let mut content = KeyHash::default().with("file", first);
        for file in &scene.files {
            content = content.with("file", digest(file)?);
        }
        return Ok(loaded(scene, Some(sha256), content));
    }
    if let Some(made) = name.to_str().and_then(builtin::builtin) {
        let scene = made?;
        return Ok(loaded(scene, None, KeyHash::default().with("built-in", name.as_encoded_bytes())));
    }
    let path = path.to_owned();
    if path.exists() {
        return Err(LoadError::NoSceneFile { path });
    }
    Err(LoadError::NoSuchScene { path, meant: name.to_str().and_then(meant) })
}

/// Returns the built-in scene that was probably meant, with the given parameters.
fn meant(name: &str) -> Option<String> {
    let (word, parameters) = name.split_once(':').map_or((name, None), |(word, rest)| (word, Some(rest)));
    let known = nearest(word, builtin::NAMES)?;
    Some(parameters.map_or(known.to_owned(), |parameters| format!("{known}:{parameters}")))
}

fn loaded(scene: Scene, sha256: Option<String>, content: KeyHash) -> LoadedScene {
    LoadedScene {
        triangles: triangles(&scene),
        scene,
        moment: None,
        sha256,
        content: content.finish(),
        not_uploaded_bytes: None,
        pose: None,
        smaller_images: Vec::new(),
        holes_closed: false,
        lighting: Lighting::default(),
    }
}

impl LoadedScene {
    /// Notes that the scene is shown at a time, as [`Self::pose`] does, and leaves it at rest: the code that
    /// uploads it to a device poses it there. A scene whose triangles may be others at every time, as in
    /// numbered files, is posed here.
    ///
    /// # Errors
    /// Errors of [`Self::pose`].
    pub fn show(&mut self, seconds: f64, clip: Option<&str>) -> Result<(), LoadError> {
        if !self.scene.is_posed_in_place() {
            return self.pose(seconds, clip);
        }
        let clips = self.clips(clip)?;
        self.scene.warn_while_playing(&clips);
        self.pose = Some(self.record_of(seconds, &clips, None));
        self.moment = Some(Moment { seconds, clips });
        Ok(())
    }

    /// Returns the scene as it is shown, without images if it is posed for this call.
    ///
    /// # Errors
    /// Errors of the scene's deformer.
    pub fn shown(&mut self) -> Result<Cow<'_, Scene>, LoadError> {
        let Some(moment) = &self.moment else { return Ok(Cow::Borrowed(&self.scene)) };
        // Images do not change, and may be most of the memory.
        let images = std::mem::take(&mut self.scene.images);
        let posed = self.scene.at(moment);
        self.scene.images = images;
        Ok(Cow::Owned(posed?))
    }

    /// Returns a camera of the scene as it is shown.
    pub fn camera(&self, index: usize) -> Option<Camera> {
        let camera = self.scene.cameras.get(index)?.clone();
        let Some(moment) = &self.moment else { return Some(camera) };
        let rig = &self.scene.animation.rig;
        let world_from_camera = Pose::new(rig, moment).cameras(rig, &self.scene.cameras)[index];
        Some(Camera { world_from_camera, ..camera })
    }

    fn moved(&self, chosen: ChosenCamera) -> ChosenCamera {
        let camera = chosen.index.and_then(|index| self.camera(index));
        ChosenCamera { camera: camera.unwrap_or(chosen.camera), ..chosen }
    }

    /// Returns the view of [`default_view()`], of the scene as it is shown.
    ///
    /// # Errors
    /// Errors of the deformer, if the scene has no camera.
    pub fn default_view(&mut self) -> Result<ChosenCamera, LoadError> {
        if self.scene.cameras.is_empty() {
            return Ok(default_view(self.shown()?.as_ref()));
        }
        Ok(self.moved(default_view(&self.scene)))
    }

    /// Returns the view of [`named_view()`], of the scene as it is shown.
    ///
    /// # Errors
    /// An error if the scene has no such camera.
    pub fn named_view(&self, name: &str) -> Result<ChosenCamera, LoadError> {
        Ok(self.moved(named_view(&self.scene, name)?))
    }

    /// Makes the record of a time in reports.
    fn record_of(&self, seconds: f64, clips: &[usize], file: Option<&Path>) -> PoseRecord {
        let clips = clips.iter().map(|clip| self.scene.animation.clips[*clip].clone()).collect();
        let file = file.and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        PoseRecord { time_s: seconds, clips, frame: None, frames: None, file }
    }

    /// Shows the scene at a time of its animation, seconds. A rig is moved by the clip of that name, or else
    /// at that index from 0; without a clip, by all clips that can be played at once. A deformer shows its
    /// simulation or its file at that time.
    ///
    /// # Errors
    /// An error if the scene has no motion, has no such clip, or the file of that time cannot be read.
    pub fn pose(&mut self, seconds: f64, clip: Option<&str>) -> Result<(), LoadError> {
        let clips = self.clips(clip)?;
        // Images do not change, and may be most of the memory.
        let images = std::mem::take(&mut self.scene.images);
        let moment = Moment { seconds, clips };
        let posed = self.scene.at(&moment)?;
        self.scene = Scene { images, ..posed };
        self.triangles = triangles(&self.scene);
        let deformer = self.scene.animation.deformer.clone();
        let file = deformer.as_ref().and_then(|deformer| deformer.file(seconds));
        if let Some(file) = file {
            self.sha256 = Some(digest(file)?);
        }
        self.pose = Some(self.record_of(seconds, &moment.clips, file));
        self.moment = None;
        Ok(())
    }

    /// True if the scene changes with time.
    pub fn moves(&self) -> bool {
        !self.scene.animation.clips.is_empty() || self.scene.animation.deformer.is_some()
    }

    /// Returns the clips that move the scene: the one that is wanted, else all that can be played at once.
    pub(crate) fn clips(&self, clip: Option<&str>) -> Result<Vec<usize>, LoadError> {
        let names = &self.scene.animation.clips;
        if !self.moves() {
            return Err(LoadError::NothingMoves { scene: self.scene.name.clone() });
        }
        if names.is_empty() && clip.is_some() {
            return Err(LoadError::NoClips { scene: self.scene.name.clone() });
        }
        Ok(match clip {
            None => self.scene.animation.rig.compatible_clips(),
            Some(wanted) => {
                let named = names.iter().position(|name| name == wanted);
                let counted = || wanted.parse().ok().filter(|index: &usize| *index < names.len());
                let index = named.or_else(counted).ok_or_else(|| LoadError::NoSuchClip {
                    scene: self.scene.name.clone(),
                    wanted: wanted.to_owned(),
                    clips: names.clone(),
                })?;
                vec![index]
            }
        })
    }

    /// Makes every surface opaque.
    pub fn close_holes(&mut self) {
        self.holes_closed = true;
        self.content = KeyHash::default().with("scene", &self.content).with("holes", "closed").finish();
        for material in &mut self.scene.materials {
            material.alpha_mode = AlphaMode::Opaque;
        }
    }
}

/// Counts the triangles over all instances.
fn triangles(scene: &Scene) -> u64 {
    let of = |mesh: usize| scene.meshes.get(mesh).map_or(0, |mesh| mesh.triangle_count() as u64);
    scene.instances.iter().map(|instance| of(instance.mesh)).sum()
}

/// Computes the digest of a file that was read before, in hexadecimal.
fn digest(path: &Path) -> Result<String, LoadError> {
    let failed = |source| LoadError::Gone { path: path.to_owned(), source };
    let mut file = File::open(path).map_err(failed)?;
    let mut hash = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        let length = file.read(&mut buffer).map_err(failed)?;
        if length == 0 {
            return Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect());
        }
        hash.update(&buffer[..length]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_scene::Environment;
    use std::collections::BTreeSet;

    #[test]
    fn the_digest_is_sha256() {
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), b"abc").expect("bytes");
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(digest(file.path()).expect("readable"), expected);
    }

    #[test]
    fn a_built_in_scene_has_no_digest_and_counts_its_triangles() {
        let loaded = load(OsStr::new("cornell")).expect("built in");
        assert!(loaded.triangles > 0 && loaded.sha256.is_none());
    }

    #[test]
    fn a_scene_is_known_by_all_that_it_is_made_from() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
        write("a.obj", "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write("a.mtl", "newmtl red\nKd 1 0 0\n");
        let content = |name: &Path, change: &dyn Fn(&mut LoadedScene)| {
            let mut loaded = load(name.as_os_str()).expect("a scene");
            change(&mut loaded);
            loaded.content
        };
        let place = folder.path().join("a.obj");
        let first = content(&place, &|_| ());
        assert_eq!(content(&place, &|loaded| loaded.light(None)), first, "light that follows from the scene");
        let mut seen = BTreeSet::from([first.clone()]);
        let mut is_new = |content: String| assert!(seen.insert(content));
        is_new(content(&place, &LoadedScene::close_holes));
        is_new(content(&place, &|loaded| loaded.light(Some(Environment::Constant([0.5; 3])))));
        for radiance in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
            let map = Environment::LatLong { width: 1, height: 1, radiance: vec![radiance] };
            is_new(content(&place, &|loaded| loaded.light(Some(map.clone()))));
        }
        write("a.mtl", "newmtl red\nKd 0 1 0\n");
        is_new(content(&place, &|_| ()));
        write("a.mtl", "newmtl red\nKd 1 0 0\n");
        assert_eq!(content(&place, &|_| ()), first);
        std::fs::rename(&place, folder.path().join("b.obj")).expect("another name");
        assert_eq!(content(&folder.path().join("b.obj"), &|_| ()), first, "names are no content");
        is_new(content(Path::new("spheres:10k"), &|_| ()));
        is_new(content(Path::new("spheres:10001"), &|_| ()));
    }
    #[test]
    fn a_name_that_is_nothing_lists_what_there_is() {
        for bad in ["cornel", "missing.glb", "cornell:walls=7", "Cargo.toml"] {
            let error = load(OsStr::new(bad)).expect_err(bad);
            assert!(
                matches!(
                    error,
                    LoadError::NoSceneFile { .. } | LoadError::NoSuchScene { .. } | LoadError::Scene(_)
                ),
                "{error:?}"
            );
            assert!(error.to_string().contains(bad.split(':').next().unwrap_or(bad)), "{error}");
        }
        for (bad, meant) in [
            ("cornel", Some("cornell")),
            ("sphere:10k", Some("spheres:10k")),
            ("cloth_ball:triangles=1k", Some("cloth-ball:triangles=1k")),
            ("Atrium", Some("atrium")),
            ("kitchen", None),
        ] {
            let error = load(OsStr::new(bad)).expect_err("misspelt");
            match &error {
                LoadError::NoSuchScene { meant: told, .. } => assert_eq!(told.as_deref(), meant, "{bad}"),
                other => panic!("{bad}: {other:?}"),
            }
        }
    }
}
