//! Requirements on a device: required features, and optional features with their benefits.

use crate::error::GpuError;
use crate::features::Feature;

/// Features that a device must have, and features that it may have.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Requirements {
    /// Required features; a device that lacks one of them is not chosen.
    pub required: Vec<Feature>,
    /// Optional features, enabled if present, with the benefit of each.
    pub optional: Vec<(Feature, &'static str)>,
    /// Number of storage buffers that one shader stage must be able to use, over all sets; 0 if any device
    /// suffices.
    pub storage_buffers: u32,
}

impl Requirements {
    /// Returns the requirements of passes that do not draw: scalar block layout and synchronization2. A queue
    /// that supports compute suffices.
    pub fn compute() -> Self {
        Self { required: vec![Feature::ScalarBlockLayout, Feature::Synchronization2], ..Self::default() }
    }

    /// Returns the requirements of the device floor: [`Requirements::compute`] and dynamic rendering.
    pub fn floor() -> Self {
        let mut requirements = Self::compute();
        requirements.required.push(Feature::DynamicRendering);
        requirements
    }

    /// Merges these requirements with others. A feature that either requires is required, and no longer
    /// optional.
    #[must_use]
    pub fn merge(mut self, other: &Requirements) -> Self {
        self.required.extend_from_slice(&other.required);
        self.required.sort_unstable();
        self.required.dedup();
        self.optional.extend_from_slice(&other.optional);
        self.optional.sort_unstable();
        self.optional.dedup();
        let required = &self.required;
        self.optional.retain(|(feature, _)| !required.contains(feature));
        self.storage_buffers = self.storage_buffers.max(other.storage_buffers);
        self
    }
}

/// A requirement that a device does not fulfil.
pub(crate) enum Missing {
    /// A feature that is not enabled.
    Feature(Feature),
    /// More storage buffers than a shader stage can reach.
    StorageBuffers { asked: u32, limit: u32 },
}

impl Missing {
    /// Returns the missing requirement as words of a message.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Feature(feature) => feature.name().to_owned(),
            Self::StorageBuffers { asked, limit } => {
                format!("{asked} storage buffers per shader stage (it has {limit})")
            }
        }
    }

    /// Returns the error of `what`, which needs the requirement.
    pub(crate) fn error(self, what: &str) -> GpuError {
        match self {
            Self::Feature(feature) => GpuError::FeatureNotEnabled { feature, what: what.to_owned() },
            Self::StorageBuffers { asked, limit } => GpuError::LimitExceeded {
                name: what.to_owned(),
                what: "the number of storage buffers that a shader stage uses",
                asked: asked.into(),
                limit: limit.into(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merging_prefers_required_over_optional_and_removes_duplicates() {
        let first = Requirements {
            required: vec![Feature::BufferDeviceAddress],
            optional: vec![(Feature::Multiview, "one draw for all views")],
            storage_buffers: 12,
        };
        let second = Requirements {
            required: vec![Feature::Multiview, Feature::BufferDeviceAddress],
            optional: vec![
                (Feature::BufferDeviceAddress, "large pools"),
                (Feature::FragmentStoresAndAtomics, "raster builds"),
            ],
            storage_buffers: 8,
        };
        let both = first.merge(&second);
        assert_eq!(both.required, [Feature::Multiview, Feature::BufferDeviceAddress]);
        assert_eq!(both.optional, [(Feature::FragmentStoresAndAtomics, "raster builds")]);
        assert_eq!(both.storage_buffers, 12);
    }
}
