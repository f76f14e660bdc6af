//! Requirements of a device: features that are required, and optional ones with what they buy.

use crate::error::GpuError;
use crate::features::Feature;

/// Features that a device must have, and those that it may have.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Requirements {
    /// A device without one of these is not chosen.
    pub required: Vec<Feature>,
    /// Enabled where present; with each what it buys.
    pub optional: Vec<(Feature, &'static str)>,
    /// Storage buffers that one shader stage must be able to use, all sets together; 0 where any device will
    /// do.
    pub storage_buffers: u32,
}

impl Requirements {
    /// The needs of everything that draws nothing: scalar block layout and synchronization2. A queue that
    /// computes will do.
    pub fn compute() -> Self {
        Self { required: vec![Feature::ScalarBlockLayout, Feature::Synchronization2], ..Self::default() }
    }

    /// The device floor: [`Requirements::compute`] and dynamic rendering.
    pub fn floor() -> Self {
        let mut requirements = Self::compute();
        requirements.required.push(Feature::DynamicRendering);
        requirements
    }

    /// These requirements and the other ones. What either requires is required, and no longer optional.
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

/// Something of [`Requirements`] that a device lacks.
pub(crate) enum Missing {
    /// A feature that is not enabled.
    Feature(Feature),
    /// More storage buffers than a shader stage can reach.
    StorageBuffers { asked: u32, limit: u32 },
}

impl Missing {
    /// The lack as words of a message.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Feature(feature) => feature.name().to_owned(),
            Self::StorageBuffers { asked, limit } => {
                format!("{asked} storage buffers per shader stage (it has {limit})")
            }
        }
    }

    /// The error of `what`, which cannot do without it.
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
