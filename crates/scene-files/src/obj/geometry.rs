//! Reader of the OBJ file itself: from vertices and faces to meshes.

use std::collections::HashMap;
use std::path::Path;

use glam::DVec3;

use super::apart::{Group, divide};
use super::library::Library;
use super::skipped::Skipped;
use super::smoothing::Smoothing;
use super::statements::{Statement, number, statements};
use crate::Limits;
use crate::polygon::{Filling, Polygons};
use crate::recognise::{BINARY, RENAME};
use rasray_scene::{Mesh, SceneError};

/// Contents of an OBJ file.
pub(super) struct Geometry {
    /// Meshes, without positions; `Mesh::material` is an index into `material_names`.
    pub meshes: Vec<Mesh>,
    /// Positions of each mesh as the file has them.
    pub positions: Vec<Vec<DVec3>>,
    /// Texture coordinates of each mesh as the file has them, if there are any.
    pub uvs: Vec<Option<Vec<[f64; 2]>>>,
    /// Names of materials in the order of first use by a face; the empty name stands for faces without a
    /// material.
    pub material_names: Vec<String>,
    pub libraries: Vec<Library>,
    pub skipped: Skipped,
    /// Number of `v` statements.
    pub vertices: usize,
}

/// Reads the statements of an OBJ file. `divides` is true if meshes are divided where their groups lie far
/// apart.
pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    limits: &Limits,
    divides: bool,
) -> Result<Geometry, SceneError> {
    let mut reader = Reader {
        path,
        limits,
        positions: Vec::new(),
        uvs: Vec::new(),
        normals: Vec::new(),
        group: String::new(),
        smoothing: Smoothing::default(),
        material: String::new(),
        material_names: Vec::new(),
        material_index: HashMap::new(),
        libraries: Vec::new(),
        run: None,
        meshes: Vec::new(),
        groups: Vec::new(),
        mesh_positions: Vec::new(),
        mesh_uvs: Vec::new(),
        made_normals: Vec::new(),
        triangles: 0,
        known: false,
        face: Vec::new(),
        points: Vec::new(),
        polygons: Polygons::default(),
        skipped: Skipped::default(),
    };
    for statement in statements(bytes) {
        reader.take(&statement)?;
    }
    reader.end_run();
    reader.make_normals();
    if !reader.known {
        if let Some((word, place)) = &reader.skipped.first_unknown {
            return Err(SceneError::NotThisFormat {
                path: path.to_owned(),
                found: format!("no line is a statement of an OBJ file, {place} begins with `{word}`"),
                fix: RENAME,
            });
        }
        // A file of comments alone is a valid file that is not written yet, unless it is binary noise.
        if std::str::from_utf8(bytes).is_err() {
            return Err(BINARY.refuse(path, "an OBJ file"));
        }
    }
    let mut geometry = Geometry {
        meshes: reader.meshes,
        positions: reader.mesh_positions,
        uvs: reader.mesh_uvs,
        material_names: reader.material_names,
        libraries: reader.libraries,
        skipped: reader.skipped,
        vertices: reader.positions.len(),
    };
    if divides {
        divide(&mut geometry, &reader.groups);
    }
    Ok(geometry)
}

impl Geometry {
    /// Adds a mesh, with its positions and texture coordinates as the file has them.
    pub fn add(&mut self, mesh: Mesh, positions: Vec<DVec3>, uvs: Option<Vec<[f64; 2]>>) {
        self.meshes.push(mesh);
        self.positions.push(positions);
        self.uvs.push(uvs);
    }
}

/// Corner of a face: indices into the arrays of positions, texture coordinates and normals.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Corner {
    position: u32,
    uv: Option<u32>,
    /// Index into the file's normals, or into the computed ones.
    normal: Option<u32>,
}

/// Source of the normals of a face.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Normals {
    /// No normals: the face is flat.
    Absent,
    File,
    /// Computed normals: the face is in a smoothing group.
    Made,
}

/// Consecutive faces with one material and the same attributes.
struct Run {
    mesh: Mesh,
    groups: Vec<Group>,
    positions: Vec<DVec3>,
    uvs: Vec<[f64; 2]>,
    /// Normals from the file.
    file_normals: Vec<[f32; 3]>,
    /// Indices of computed normals in `Reader::smoothing`.
    made_normals: Vec<u32>,
    has_uvs: bool,
    normals: Normals,
    vertices: HashMap<Corner, u32>,
}

struct Reader<'a> {
    path: &'a Path,
    limits: &'a Limits,
    positions: Vec<DVec3>,
    uvs: Vec<[f64; 2]>,
    normals: Vec<[f32; 3]>,
    group: String,
    smoothing: Smoothing,
    material: String,
    material_names: Vec<String>,
    material_index: HashMap<String, usize>,
    libraries: Vec<Library>,
    run: Option<Run>,
    meshes: Vec<Mesh>,
    groups: Vec<Vec<Group>>,
    mesh_positions: Vec<Vec<DVec3>>,
    mesh_uvs: Vec<Option<Vec<[f64; 2]>>>,
    /// Meshes with computed normals, and the indices of these.
    made_normals: Vec<(usize, Vec<u32>)>,
    triangles: u64,
    /// True if any statement is one of an OBJ file.
    known: bool,
    /// Corners of the current face, kept to save an allocation for each face.
    face: Vec<Corner>,
    /// Positions of these corners.
    points: Vec<DVec3>,
    polygons: Polygons,
    skipped: Skipped,
}

impl Reader<'_> {
    fn take(&mut self, statement: &Statement<'_>) -> Result<(), SceneError> {
        match &*statement.word {
            b"v" => {
                let (position, count) = statement.wide_numbers::<3>(self.path, 3)?;
                self.check_count(self.positions.len())?;
                self.positions.push(DVec3::from_array(position));
                self.skipped.colors += usize::from(count >= 6);
                // A weight stands after the coordinates, before a colour.
                let weight = statement.words().nth(3).filter(|_| matches!(count, 4 | 7));
                self.skipped.weights += usize::from(weight.is_some_and(|word| number(word) != Some(1.0)));
            }
            b"vt" => {
                let (uv, _) = statement.wide_numbers::<2>(self.path, 1)?;
                self.check_count(self.uvs.len())?;
                self.uvs.push(uv);
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
            b"mtllib" => self.libraries.push(Library { name: statement.name() }),
            b"o" | b"g" => {
                self.group = statement.name();
                let name = self.mesh_name();
                if let Some(run) = &mut self.run {
                    // A group without faces is left out.
                    let first = run.mesh.indices.len();
                    run.groups.pop_if(|group| group.first == first);
                    run.groups.push(Group { name, first });
                }
            }
            b"s" => self.smoothing.take(statement),
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
            self.add_face(&mut face)?;
        }
        self.face = face;
        Ok(())
    }

    /// Adds a face of at least three corners.
    fn add_face(&mut self, face: &mut [Corner]) -> Result<(), SceneError> {
        let has_uvs = face.iter().all(|corner| corner.uv.is_some());
        let has_normals = face.iter().all(|corner| corner.normal.is_some());
        let some_have = |of: fn(&Corner) -> Option<u32>| face.iter().any(|corner| of(corner).is_some());
        let is_partial =
            !has_uvs && some_have(|corner| corner.uv) || !has_normals && some_have(|corner| corner.normal);
        self.skipped.partial += usize::from(is_partial);
        let normals = match (has_normals, self.smoothing.is_on()) {
            (true, _) => Normals::File,
            (false, false) => Normals::Absent,
            (false, true) => Normals::Made,
        };
        let mut points = std::mem::take(&mut self.points);
        points.clear();
        points.extend(face.iter().map(|corner| self.positions[corner.position as usize]));
        for corner in face.iter_mut() {
            // An attribute that only some corners of a face have cannot be interpolated.
            corner.uv = corner.uv.filter(|_| has_uvs);
            corner.normal = corner.normal.filter(|_| has_normals);
        }
        if normals == Normals::Made {
            let sides = points[1..].windows(2);
            let normal: DVec3 = sides.map(|pair| (pair[0] - points[0]).cross(pair[1] - points[0])).sum();
            for corner in face.iter_mut() {
                corner.normal = Some(self.smoothing.add(corner.position, normal));
            }
        }
        let filling = self.polygons.fill(&points);
        self.points = points;
        self.add_filled(face, filling, has_uvs, normals)
    }

    fn add_filled(
        &mut self,
        face: &[Corner],
        filling: Filling,
        has_uvs: bool,
        normals: Normals,
    ) -> Result<(), SceneError> {
        if self.run.as_ref().is_some_and(|run| (run.has_uvs, run.normals) != (has_uvs, normals)) {
            self.end_run();
        }
        let mut run = match self.run.take() {
            Some(run) => run,
            None => self.begin_run(has_uvs, normals),
        };
        let first = self.vertex(&mut run, face[0]);
        let mut previous = self.vertex(&mut run, face[1]);
        let start = run.mesh.indices.len();
        for &corner in &face[2..] {
            let next = self.vertex(&mut run, corner);
            run.mesh.indices.extend([first, previous, next]);
            previous = next;
        }
        match filling {
            Filling::Fan => {}
            Filling::Crossing => self.skipped.crossing += 1,
            Filling::Cut(triangles) => {
                // The triangles of the ears are as many as those of the fan.
                run.mesh.indices.truncate(start);
                for corner in triangles.into_iter().flatten() {
                    let vertex = self.vertex(&mut run, face[corner as usize]);
                    run.mesh.indices.push(vertex);
                }
            }
        }
        self.check_count(run.positions.len())?;
        self.run = Some(run);
        Ok(())
    }

    /// Returns the index of a corner in the run's mesh; corners that agree in all three indices are one
    /// vertex.
    fn vertex(&self, run: &mut Run, corner: Corner) -> u32 {
        let Run { positions, uvs, file_normals, made_normals, vertices, normals, .. } = run;
        *vertices.entry(corner).or_insert_with(|| {
            positions.push(self.positions[corner.position as usize]);
            uvs.extend(corner.uv.map(|index| self.uvs[index as usize]));
            match normals {
                Normals::Absent => {}
                Normals::File => {
                    file_normals.extend(corner.normal.map(|index| self.normals[index as usize]));
                }
                Normals::Made => made_normals.extend(corner.normal),
            }
            (positions.len() - 1) as u32
        })
    }

    fn begin_run(&mut self, has_uvs: bool, normals: Normals) -> Run {
        let material = *self.material_index.entry(self.material.clone()).or_insert_with(|| {
            self.material_names.push(self.material.clone());
            self.material_names.len() - 1
        });
        let name = self.mesh_name();
        Run {
            groups: vec![Group { name: name.clone(), first: 0 }],
            mesh: Mesh { name, material, ..Mesh::default() },
            positions: Vec::new(),
            uvs: Vec::new(),
            file_normals: Vec::new(),
            made_normals: Vec::new(),
            has_uvs,
            normals,
            vertices: HashMap::new(),
        }
    }

    fn mesh_name(&self) -> String {
        match (self.group.is_empty(), self.material.is_empty()) {
            (false, _) => self.group.clone(),
            (true, false) => self.material.clone(),
            (true, true) => "mesh".to_owned(),
        }
    }

    fn end_run(&mut self) {
        let Some(run) = self.run.take() else { return };
        let Run { mut mesh, groups, positions, uvs, file_normals, made_normals, has_uvs, normals, .. } = run;
        self.mesh_uvs.push(has_uvs.then_some(uvs));
        match normals {
            Normals::Absent => {}
            Normals::File => mesh.normals = Some(file_normals),
            Normals::Made => self.made_normals.push((self.meshes.len(), made_normals)),
        }
        self.meshes.push(mesh);
        self.groups.push(groups);
        self.mesh_positions.push(positions);
    }

    /// Gives the meshes of smoothing groups their normals, now that all faces are known.
    fn make_normals(&mut self) {
        for (mesh, made) in std::mem::take(&mut self.made_normals) {
            self.meshes[mesh].normals = Some(self.smoothing.normals(&made));
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

    /// Returns the index into an array of `count` elements: numbers count from 1, or from -1 backwards.
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

    /// Returns an error if an array of `count` elements must not grow.
    fn check_count(&self, count: usize) -> Result<(), SceneError> {
        // Indices are u32, whatever the limit says.
        let limit = self.limits.vertices.min(u64::from(u32::MAX) - 1);
        Limits::check(self.path, "the number of vertices", count as u64 + 1, limit, "vertices")
    }
}
