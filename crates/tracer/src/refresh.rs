//! Structures over frames, and the parts of them that a frame builds.

use rasray_ads::{AdsError, Combined, Geometry, GeometryParts, SceneBinding, Structure};
use rasray_gpu::Device;

/// A structure over frames, and the part of it that a frame builds if triangles have moved.
pub enum Refresh {
    /// A structure over all triangles, all of which a frame builds.
    All(Box<dyn Structure>),
    /// A structure in parts, of which a frame builds those that moved. The static part and the parts that did
    /// not move are built only if they are stale themselves: for the first time, after their pools grew, for
    /// new triangles, and for another viewpoint if the structure depends on it.
    Parts(Box<Combined>),
}

impl Refresh {
    /// Returns the structure through which rays are traced.
    pub fn structure(&self) -> &dyn Structure {
        match self {
            Self::All(structure) => structure.as_ref(),
            Self::Parts(combined) => combined.as_ref(),
        }
    }

    /// Returns the structure, for changes that concern all of its parts.
    pub(crate) fn structure_mut(&mut self) -> &mut dyn Structure {
        match self {
            Self::All(structure) => structure.as_mut(),
            Self::Parts(combined) => combined.as_mut(),
        }
    }

    /// Returns the number of parts that are built independently; all parts but the first move.
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::All(_) => 1,
            Self::Parts(combined) => combined.count(),
        }
    }

    pub(crate) fn part(&self, part: usize) -> &dyn Structure {
        match self {
            Self::All(structure) => structure.as_ref(),
            Self::Parts(combined) => combined.part(part),
        }
    }

    pub(crate) fn change_part<T>(
        &mut self,
        part: usize,
        change: impl FnOnce(&mut dyn Structure) -> Result<T, AdsError>,
    ) -> Result<T, AdsError> {
        match self {
            Self::All(structure) => change(structure.as_mut()),
            Self::Parts(combined) => combined.change_part(part, change),
        }
    }

    pub(crate) fn set_parts(&mut self, device: &Device, parts: &GeometryParts) -> Result<(), AdsError> {
        match self {
            Self::All(structure) => structure.set_geometry(device, parts.whole()),
            Self::Parts(combined) => combined.set_parts(device, parts),
        }
    }

    pub(crate) fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        self.structure_mut().set_geometry(device, geometry)
    }

    pub(crate) fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        self.structure_mut().set_scene(scene)
    }
}

impl From<Box<dyn Structure>> for Refresh {
    fn from(structure: Box<dyn Structure>) -> Self {
        Self::All(structure)
    }
}

impl<S: Structure + 'static> From<Box<S>> for Refresh {
    fn from(structure: Box<S>) -> Self {
        Self::All(structure)
    }
}

impl From<Combined> for Refresh {
    fn from(combined: Combined) -> Self {
        Self::Parts(Box::new(combined))
    }
}
