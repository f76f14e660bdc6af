//! Structures over frames, of which a frame builds all or parts anew.

use rasray_ads::{AdsError, Combined, Geometry, GeometryParts, SceneBinding, Structure};
use rasray_gpu::Device;

/// A structure over frames, and what of it a frame builds where triangles have moved.
pub enum Refresh {
    /// All triangles.
    All(Box<dyn Structure>),
    /// The parts that moved. The static part, and those that did not move, are built where they are stale
    /// themselves: the first time, where their pools grew, for other triangles, and from another view where
    /// the structure depends on it.
    Parts(Box<Combined>),
}

impl Refresh {
    /// The structure that rays are traced through.
    pub fn structure(&self) -> &dyn Structure {
        match self {
            Self::All(structure) => structure.as_ref(),
            Self::Parts(combined) => combined.as_ref(),
        }
    }

    /// The structure, to be changed as a whole.
    pub(crate) fn structure_mut(&mut self) -> &mut dyn Structure {
        match self {
            Self::All(structure) => structure.as_mut(),
            Self::Parts(combined) => combined.as_mut(),
        }
    }

    /// Parts that are built apart; all but the first move.
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
