//! The scene's binding set, for structures that read the scene.

use rasray_gpu::{BindingSet, SetLayout};

use crate::AdsError;

/// Binding set of a scene, from which surfaces and alpha masks are read.
#[derive(Clone, Debug)]
pub struct SceneBinding {
    /// Layout of the set.
    pub layout: SetLayout,
    /// Set of the scene's buffers and images.
    pub set: BindingSet,
    /// True if any draw is alpha-masked.
    pub alpha_masked: bool,
    /// Specialisation constants of modules that read the scene: id and bits. The constants disable code for
    /// features that the scene does not have.
    pub constants: Vec<(u32, u32)>,
}

impl SceneBinding {
    /// Returns the scene that a structure with the payload `payload` reads while it is built.
    ///
    /// # Errors
    /// There is no scene.
    pub fn for_payload<'a>(scene: Option<&'a Self>, payload: &str) -> Result<&'a Self, AdsError> {
        scene.ok_or(AdsError::Option {
            option: "payload",
            value: payload.to_owned(),
            expected: "surface attributes of fragments are read from a scene; without one use `index`",
        })
    }

    /// Returns the suffix of modules that test alpha masks: `.alpha` if a draw is masked, else the empty
    /// string.
    pub fn mask_suffix(scene: Option<&Self>) -> &'static str {
        if scene.is_some_and(|scene| scene.alpha_masked) { ".alpha" } else { "" }
    }

    /// Returns the property that pipelines for this scene are compiled for and `other` does not have; `None`
    /// if the pipelines can read `other` as well.
    pub fn difference(&self, other: &Self) -> Option<&'static str> {
        if self.layout.storage_buffers() != other.layout.storage_buffers() {
            Some("buffers")
        } else if self.alpha_masked != other.alpha_masked {
            Some("alpha masks")
        } else if self.constants != other.constants {
            Some("specialisation constants")
        } else {
            None
        }
    }
}
