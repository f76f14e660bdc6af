//! Rule for hits at the ends of rays.

use crate::words;
use rasray_shaders_glsl::constants::ads::{ENDS_CLEAR, ENDS_TOUCHING};

/// Rule for fragments that are as close to an end of a ray as the fragments of the surface at that end. It
/// applies to structures whose fragments do not store their triangle, or the point at which it is hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Such fragments are hits: rays hit the surface that they leave and the surface that they end on.
    Touching,
    /// Such fragments are not hits: a ray starts beyond the fragments of the triangle that it leaves, and the
    /// fragments at its far end do not count.
    Clear,
}

words! { Ends { Touching "touching", Clear "clear" } }

impl Ends {
    /// Returns the number that stands for the rule in specialisation constants.
    pub fn number(self) -> u32 {
        match self {
            Self::Touching => ENDS_TOUCHING,
            Self::Clear => ENDS_CLEAR,
        }
    }
}
