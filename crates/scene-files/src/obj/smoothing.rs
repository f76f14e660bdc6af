//! Smoothing groups: normals for faces that have none.

use std::collections::HashMap;

use glam::DVec3;

use super::statements::Statement;

/// Current group, and the normals of all groups so far.
#[derive(Default)]
pub(super) struct Smoothing {
    /// Number of the current group; 0 for none.
    group: u32,
    /// Index in `sums` of a vertex of the file in a group.
    places: HashMap<(u32, u32), u32>,
    /// Sums of the normals of the faces at each such vertex, weighted by area.
    sums: Vec<DVec3>,
}

impl Smoothing {
    /// Reads a statement `s`: the number of a group, or `off`. A word that is no number is a group of its
    /// own.
    pub fn take(&mut self, statement: &Statement<'_>) {
        self.group = match statement.words().next() {
            None | Some(b"off") => 0,
            Some(word) => {
                std::str::from_utf8(word).ok().and_then(|word| word.parse().ok()).unwrap_or(u32::MAX)
            }
        };
    }

    /// True if faces are in a group.
    pub fn is_on(&self) -> bool {
        self.group != 0
    }

    /// Adds the normal of a face, whose length is twice the face's area, to that of a vertex in the group.
    /// Returns the index of the sum.
    pub fn add(&mut self, vertex: u32, normal: DVec3) -> u32 {
        let Self { group, places, sums } = self;
        let place = *places.entry((vertex, *group)).or_insert_with(|| {
            sums.push(DVec3::ZERO);
            (sums.len() - 1) as u32
        });
        // Triangles of a face without a normal are dropped or never hit.
        if normal.is_finite() {
            sums[place as usize] += normal;
        }
        place
    }

    /// Returns the unit normals of vertices, once all faces are known.
    pub fn normals(&self, places: &[u32]) -> Vec<[f32; 3]> {
        let normal = |place: &u32| self.sums[*place as usize].normalize_or(DVec3::Z).as_vec3().to_array();
        places.iter().map(normal).collect()
    }
}
