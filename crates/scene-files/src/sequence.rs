//! Numbered OBJ and PLY files that form one scene over time.

use std::path::{Path, PathBuf};

use glam::DVec3;

use crate::LoadOptions;
use crate::origin::Origins;
use rasray_scene::deforming::{Deformation, Deformer, Shape, Topology};
use rasray_scene::{Mesh, Scene, SceneError, Warning};

/// Files whose names differ only in a number, such as `cloth.####.ply`: file n is shown from n / fps seconds
/// on, until the next one. Before the first time the first file is shown, after the last time the last.
///
/// Vertices and triangles may be others in every file. Materials, textures and instances are those of the
/// first file with triangles; a later file may have fewer meshes (the others are empty then), but not more,
/// and no other materials. Each mesh stays where the instance of the first file places it, and positions are
/// relative to that place.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// All files, without a gap in their numbers.
    files: Vec<PathBuf>,
    /// Number of the first file.
    first: u64,
    options: LoadOptions,
}

/// Pattern of a file name: the text before and after the number, and its least number of digits.
struct Pattern<'a> {
    before: &'a str,
    behind: &'a str,
    digits: usize,
}

impl<'a> Pattern<'a> {
    /// Reads a pattern; the last run of `#` in a name is the number.
    fn of(name: &'a str) -> Option<Self> {
        let end = name.rfind('#')? + 1;
        let before = name[..end].trim_end_matches('#');
        Some(Self { before, behind: &name[end..], digits: end - before.len() })
    }

    /// Returns the number of a file with such a name.
    fn number(&self, name: &str) -> Option<u64> {
        let digits = name.strip_prefix(self.before)?.strip_suffix(self.behind)?;
        let number: u64 = digits.parse().ok()?;
        // The number has no sign, and no more leading zeros than the pattern asks for.
        (self.name(number) == name).then_some(number)
    }

    fn name(&self, number: u64) -> String {
        format!("{}{number:0width$}{}", self.before, self.behind, width = self.digits)
    }
}

/// True if a path is a pattern of a sequence: its file name has a `#`, and no file has just that name.
pub fn is_pattern(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str());
    name.is_some_and(|name| name.contains('#')) && !path.is_file()
}

impl Sequence {
    /// Finds the files of a pattern.
    ///
    /// # Errors
    /// [`SceneError::Read`] for a folder that cannot be read, [`SceneError::Sequence`] if no such file exists
    /// or one between the first and the last is missing, and [`SceneError::UnknownFormat`] for formats other
    /// than OBJ and PLY.
    pub fn find(pattern: &Path, options: &LoadOptions) -> Result<Self, SceneError> {
        let problem = |problem: String| SceneError::Sequence { path: pattern.to_owned(), problem };
        let extension = pattern.extension().and_then(|text| text.to_str()).unwrap_or_default();
        if !["obj", "ply"].iter().any(|known| extension.eq_ignore_ascii_case(known)) {
            return Err(problem("a sequence of files is of .obj or .ply files".to_owned()));
        }
        let name = pattern.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let Some(parts) = Pattern::of(name) else {
            return Err(problem("the file name has no run of # for the number".to_owned()));
        };
        let folder = match pattern.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let failed = |source| SceneError::Read { path: folder.to_owned(), source };
        let mut numbers = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            numbers.extend(entry.file_name().to_str().and_then(|name| parts.number(name)));
        }
        numbers.sort_unstable();
        let (Some(&first), Some(&last)) = (numbers.first(), numbers.last()) else {
            return Err(problem(format!("there is no such file, such as {}", parts.name(1))));
        };
        if let Some(missing) = (first..=last).zip(&numbers).find(|(wanted, found)| wanted != *found) {
            return Err(problem(format!(
                "{} is missing between {} and {}",
                parts.name(missing.0),
                parts.name(first),
                parts.name(last)
            )));
        }
        let files = numbers.iter().map(|&number| pattern.with_file_name(parts.name(number))).collect();
        Ok(Self { files, first, options: options.clone() })
    }

    /// Returns all files, in the order of their numbers.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Returns the index in `files` of the file that is shown at a time: the last one that has begun.
    fn index(&self, seconds: f64) -> usize {
        let number = rasray_scene::time::frame(seconds, self.options.fps);
        ((number - self.first as f64).max(0.0) as usize).min(self.files.len() - 1)
    }
}

/// Loads the scene of a pattern as its first file has it, with a [`Deformer`] that shows the others.
///
/// # Errors
/// Errors of [`Sequence::find`], and of the first files up to one with triangles.
pub fn load(pattern: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let sequence = Sequence::find(pattern, options)?;
    let mut model = crate::formats::load_file(&sequence.files[0], options, Origins::First)?;
    let warnings = std::mem::take(&mut model.warnings);
    for file in &sequence.files[1..] {
        if !model.meshes.is_empty() {
            break;
        }
        model = crate::formats::load_file(file, options, Origins::First)?;
        // The scene at rest shows none of these triangles yet.
        for mesh in &mut model.meshes {
            *mesh = empty(mesh);
        }
        model.warnings.clear();
    }
    let frames = Frames {
        meshes: (0..model.meshes.len()).collect(),
        templates: model.meshes.iter().map(empty).collect(),
        materials: model.materials.iter().map(|material| material.name.clone()).collect(),
        origins: model.instances.iter().map(|instance| instance.world_from_mesh.translation).collect(),
        sequence,
    };
    model.name = crate::finish::scene_name(pattern);
    model.warnings.clone_from(&warnings);
    model.animation.deformer_warnings = warnings;
    model.animation.duration = frames.duration() as f32;
    model.animation.deformer = Some(std::sync::Arc::new(frames));
    Ok(model)
}

/// Makes a mesh of the same name and material without triangles.
fn empty(mesh: &Mesh) -> Mesh {
    Mesh { name: mesh.name.clone(), material: mesh.material, ..Mesh::default() }
}

/// Files of the sequence, and the data that they must have in common.
#[derive(Debug)]
struct Frames {
    sequence: Sequence,
    meshes: Vec<usize>,
    /// Meshes of the scene, without triangles.
    templates: Vec<Mesh>,
    /// Names of the scene's materials.
    materials: Vec<String>,
    /// Origins of the scene's meshes, metres, world; one per instance, of which each mesh has one.
    origins: Vec<DVec3>,
}

impl Frames {
    /// Returns the meshes of a file, with the materials of the scene.
    fn adapted(&self, file: &Path, scene: Scene) -> Result<Deformation, SceneError> {
        let problem = |problem: String| SceneError::Sequence { path: file.to_owned(), problem };
        let first = self.sequence.files[0].file_name().unwrap_or_default().display();
        if scene.meshes.len() > self.templates.len() {
            return Err(problem(format!(
                "it has {} meshes, and {first} has {}: the number of meshes of a sequence may not grow",
                scene.meshes.len(),
                self.templates.len()
            )));
        }
        let mut shapes = Vec::with_capacity(self.templates.len());
        for mut mesh in scene.meshes {
            let name = &scene.materials[mesh.material].name;
            mesh.material = self.materials.iter().position(|known| known == name).ok_or_else(|| {
                problem(format!(
                    "it has the material `{}`, which {first} does not have: the materials of a sequence are those of its first file",
                    rasray_scene::text::shown(name)
                ))
            })?;
            shapes.push((shapes.len(), Shape::Mesh(mesh)));
        }
        for template in &self.templates[shapes.len()..] {
            shapes.push((shapes.len(), Shape::Mesh(template.clone())));
        }
        let named = |warning: Warning| Warning {
            message: format!("{}: {}", file.display(), warning.message),
            ..warning
        };
        Ok(Deformation { shapes, warnings: scene.warnings.into_iter().map(named).collect() })
    }
}

impl Deformer for Frames {
    fn topology(&self) -> Topology {
        Topology::Changing
    }

    fn duration(&self) -> f64 {
        let last = self.sequence.first + self.sequence.files.len() as u64 - 1;
        last as f64 / self.sequence.options.fps
    }

    fn meshes(&self) -> &[usize] {
        &self.meshes
    }

    fn at(&self, seconds: f64) -> Result<Deformation, SceneError> {
        let file = &self.sequence.files[self.sequence.index(seconds)];
        let origins = Origins::Given(&self.origins);
        self.adapted(file, crate::formats::load_file(file, &self.sequence.options, origins)?)
    }

    fn file(&self, seconds: f64) -> Option<&Path> {
        Some(&self.sequence.files[self.sequence.index(seconds)])
    }
}
