//! The scene's set, for structures that read it.

use rasray_gpu::{BindingSet, SetLayout};

use crate::AdsError;

/// The scene's set, which surfaces and alpha masks are read from.
#[derive(Clone, Debug)]
pub struct SceneBinding {
    /// Layout of the set.
    pub layout: SetLayout,
    /// The set.
    pub set: BindingSet,
    /// True if any draw is alpha-masked.
    pub alpha_masked: bool,
    /// Specialisation constants of modules that read the scene: id and bits. They disable code for features
    /// that the scene does not have.
    pub constants: Vec<(u32, u32)>,
}

impl SceneBinding {
    /// The scene that a structure with such a `payload` reads while it is built.
    ///
    /// # Errors
    /// There is none.
    pub fn for_payload<'a>(scene: Option<&'a Self>, payload: &str) -> Result<&'a Self, AdsError> {
        scene.ok_or(AdsError::Option {
            option: "payload",
            value: payload.to_owned(),
            expected: "surface attributes of fragments are read from a scene; without one use `index`",
        })
    }

    /// The suffix of modules that test alpha masks: `.alpha` where a draw is masked, else nothing.
    pub fn mask_suffix(scene: Option<&Self>) -> &'static str {
        if scene.is_some_and(|scene| scene.alpha_masked) { ".alpha" } else { "" }
    }

    /// Returns what pipelines for this scene are compiled for and another scene does not have; `None`: they
    /// read that one as well.
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
