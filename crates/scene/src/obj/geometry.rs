//! The OBJ file itself: vertices and faces to meshes.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::reference::resolve;
use super::skipped::Skipped;
use super::statements::{Statement, statements};
use crate::recognise::{BINARY, RENAME};
use crate::{Limits, Mesh, SceneError};

/// What an OBJ file holds.
pub(super) struct Geometry {
    /// `Mesh::material` indexes `material_names`.
    pub meshes: Vec<Mesh>,
    /// In the order of first use by a face; the empty name stands for faces without a material.
    pub material_names: Vec<String>,
    pub libraries: Vec<Library>,
    pub skipped: Skipped,
    /// Number of `v` statements.
    pub vertices: usize,
}

/// A `mtllib` statement.
pub(super) struct Library {
    /// All that follows the word.
    pub name: String,
    place: String,
}

impl Library {
    /// The statement may name one file with spaces or several files: one if that exists.
    pub fn files(&self, path: &Path, folder: &Path) -> Result<Vec<PathBuf>, SceneError> {
        let whole = resolve(path, &self.place, folder, &self.name)?;
        if whole.is_file() {
            return Ok(vec![whole]);
        }
        self.name.split_whitespace().map(|name| resolve(path, &self.place, folder, name)).collect()
    }
}

/// Reads the statements of an OBJ file.
pub(super) fn read(path: &Path, bytes: &[u8], limits: &Limits) -> Result<Geometry, SceneError> {
    let mut reader = Reader {
        path,
        limits,
        positions: Vec::new(),
        uvs: Vec::new(),
        normals: Vec::new(),
        group: String::new(),
        material: String::new(),
        material_names: Vec::new(),
        material_index: HashMap::new(),
        libraries: Vec::new(),
        run: None,
        meshes: Vec::new(),
        triangles: 0,
        known: false,
        face: Vec::new(),
        skipped: Skipped::default(),
    };
    for statement in statements(bytes) {
        reader.take(&statement)?;
    }
    reader.end_run();
    if !reader.known {
        if let Some((word, place)) = &reader.skipped.first_unknown {
            return Err(SceneError::NotThisFormat {
                path: path.to_owned(),
                found: format!("no line is a statement of an OBJ file, {place} begins with `{word}`"),
                fix: RENAME,
            });
        }
        // Comments alone are a file that is not written yet, unless they are noise.
        if std::str::from_utf8(bytes).is_err() {
            return Err(BINARY.refuse(path, "an OBJ file"));
        }
    }
    Ok(Geometry {
        meshes: reader.meshes,
        material_names: reader.material_names,
        libraries: reader.libraries,
        skipped: reader.skipped,
        vertices: reader.positions.len(),
    })
}

/// A corner of a face: places in the arrays of positions, texture coordinates and normals.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Corner {
    position: u32,
    uv: Option<u32>,
    normal: Option<u32>,
}

/// Faces in a row with one material and the same attributes.
struct Run {
    mesh: Mesh,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    has_uvs: bool,
    has_normals: bool,
    vertices: HashMap<Corner, u32>,
}

struct Reader<'a> {
    path: &'a Path,
    limits: &'a Limits,
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    group: String,
    material: String,
    material_names: Vec<String>,
    material_index: HashMap<String, usize>,
    libraries: Vec<Library>,
    run: Option<Run>,
    meshes: Vec<Mesh>,
    triangles: u64,
    /// Whether any statement was one of an OBJ file.
    known: bool,
    /// Corners of the current face, kept to save an allocation for each.
    face: Vec<Corner>,
    skipped: Skipped,
}

impl Reader<'_> {
    fn take(&mut self, statement: &Statement<'_>) -> Result<(), SceneError> {
        match &*statement.word {
            b"v" => {
                let (position, count) = statement.numbers::<3>(self.path, 3)?;
                self.check_count(self.positions.len())?;
                self.positions.push(position);
                if count >= 6 {
                    self.skipped.colors += 1;
                }
            }
            b"vt" => {
                let ([u, v], _) = statement.numbers::<2>(self.path, 1)?;
                self.check_count(self.uvs.len())?;
                self.uvs.push([u, 1.0 - v]);
            }
            b"vn" => {
                let (normal, _) = statement.numbers::<3>(self.path, 3)?;
                self.check_count(self.normals.len())?;
                self.normals.push(normal);
            }
            b"f" | b"fo" => self.take_face(statement)?,
            b"usemtl" => {
                let name = statement.name();
                if name != self.material {
                    self.end_run();
                    self.material = name;
                }
            }
            b"mtllib" => self.libraries.push(Library { name: statement.name(), place: statement.place() }),
            b"o" | b"g" => self.group = statement.name(),
            // Smoothing groups only matter where normals have to be made up.
            b"s" => {}
            b"p" | b"l" => self.skipped.points_and_lines += 1,
            _ => {
                self.skipped.note_unknown(statement);
                return Ok(());
            }
        }
        self.known = true;
        Ok(())
    }

    fn take_face(&mut self, statement: &Statement<'_>) -> Result<(), SceneError> {
        let mut face = std::mem::take(&mut self.face);
        face.clear();
        for word in statement.words() {
            face.push(self.corner(statement, word)?);
        }
        if face.len() < 3 {
            self.skipped.faces += 1;
        } else {
            self.triangles += face.len() as u64 - 2;
            let limit = self.limits.triangles;
            Limits::check(self.path, "the number of triangles", self.triangles, limit, "triangles")?;
            let has_uvs = face.iter().all(|corner| corner.uv.is_some());
            let has_normals = face.iter().all(|corner| corner.normal.is_some());
            for corner in &mut face {
                // An attribute that only some corners of a face have cannot be interpolated.
                corner.uv = corner.uv.filter(|_| has_uvs);
                corner.normal = corner.normal.filter(|_| has_normals);
            }
            self.add_fan(&face, has_uvs, has_normals)?;
        }
        self.face = face;
        Ok(())
    }

    fn add_fan(&mut self, face: &[Corner], has_uvs: bool, has_normals: bool) -> Result<(), SceneError> {
        if self.run.as_ref().is_some_and(|run| (run.has_uvs, run.has_normals) != (has_uvs, has_normals)) {
            self.end_run();
        }
        let mut run = match self.run.take() {
            Some(run) => run,
            None => self.begin_run(has_uvs, has_normals),
        };
        let first = self.vertex(&mut run, face[0]);
        let mut previous = self.vertex(&mut run, face[1]);
        for &corner in &face[2..] {
            let next = self.vertex(&mut run, corner);
            run.mesh.indices.extend([first, previous, next]);
            previous = next;
        }
        self.check_count(run.mesh.positions.len())?;
        self.run = Some(run);
        Ok(())
    }

    /// Index in the run's mesh of a corner; corners that agree in all three indices are one vertex.
    fn vertex(&self, run: &mut Run, corner: Corner) -> u32 {
        let Run { mesh, uvs, normals, vertices, .. } = run;
        *vertices.entry(corner).or_insert_with(|| {
            mesh.positions.push(self.positions[corner.position as usize]);
            uvs.extend(corner.uv.map(|index| self.uvs[index as usize]));
            normals.extend(corner.normal.map(|index| self.normals[index as usize]));
            (mesh.positions.len() - 1) as u32
        })
    }

    fn begin_run(&mut self, has_uvs: bool, has_normals: bool) -> Run {
        let material = *self.material_index.entry(self.material.clone()).or_insert_with(|| {
            self.material_names.push(self.material.clone());
            self.material_names.len() - 1
        });
        let name = match (self.group.is_empty(), self.material.is_empty()) {
            (false, _) => self.group.clone(),
            (true, false) => self.material.clone(),
            (true, true) => "mesh".to_owned(),
        };
        Run {
            mesh: Mesh { name, material, ..Mesh::default() },
            uvs: Vec::new(),
            normals: Vec::new(),
            has_uvs,
            has_normals,
            vertices: HashMap::new(),
        }
    }

    fn end_run(&mut self) {
        if let Some(Run { mut mesh, uvs, normals, has_uvs, has_normals, .. }) = self.run.take() {
            mesh.uvs[0] = has_uvs.then_some(uvs);
            mesh.normals = has_normals.then_some(normals);
            self.meshes.push(mesh);
        }
    }

    /// Reads `v`, `v/t`, `v//n` or `v/t/n`; a number after a slash may be left out.
    fn corner(&self, statement: &Statement<'_>, word: &[u8]) -> Result<Corner, SceneError> {
        let mut parts = word.split(|byte| *byte == b'/');
        let mut next = |count: usize, what: &str| match parts.next() {
            None | Some(b"") => Ok(None),
            Some(part) => self.index(statement, word, part, count, what).map(Some),
        };
        let position = next(self.positions.len(), "vertex")?;
        let uv = next(self.uvs.len(), "texture coordinate")?;
        let normal = next(self.normals.len(), "normal")?;
        match position {
            Some(position) if parts.next().is_none() => Ok(Corner { position, uv, normal }),
            _ => Err(self.bad_corner(statement, word)),
        }
    }

    /// Place in an array of `count` elements: from 1, or from -1 backwards.
    fn index(
        &self,
        statement: &Statement<'_>,
        word: &[u8],
        part: &[u8],
        count: usize,
        what: &str,
    ) -> Result<u32, SceneError> {
        let written: i64 = std::str::from_utf8(part)
            .ok()
            .and_then(|text| text.parse().ok())
            .ok_or_else(|| self.bad_corner(statement, word))?;
        let place = if written < 0 { written.saturating_add(count as i64) } else { written - 1 };
        if (0..count as i64).contains(&place) {
            // `check_count` keeps all counts below the end of u32.
            return Ok(place as u32);
        }
        if what == "vertex" && written > 0 {
            return Err(SceneError::IndexOutOfRange {
                path: self.path.to_owned(),
                mesh: statement.place(),
                index: written as u64,
                vertices: count as u64,
            });
        }
        let reason =
            format!("{what} {written} does not exist; {count} are defined above this line, counted from 1");
        Err(SceneError::invalid(self.path, statement.place(), reason))
    }

    fn bad_corner(&self, statement: &Statement<'_>, word: &[u8]) -> SceneError {
        let shown: String = String::from_utf8_lossy(word).chars().take(40).collect();
        let reason = format!("{}: `{shown}` is not a corner; write v, v/t, v//n or v/t/n", statement.place());
        SceneError::syntax(self.path, reason)
    }

    /// Refuses to let an array of `count` elements grow.
    fn check_count(&self, count: usize) -> Result<(), SceneError> {
        // Indices are u32, whatever the limit says.
        let limit = self.limits.vertices.min(u64::from(u32::MAX) - 1);
        Limits::check(self.path, "the number of vertices", count as u64 + 1, limit, "vertices")
    }
}
