//! Hits of rays at their ends.

use crate::words;
use rasray_shaders_glsl::constants::ads::{ENDS_CLEAR, ENDS_TOUCHING};

/// Rule for fragments that are as close to an end of a ray as those of the surface there, in structures whose
/// fragments do not say which triangle they are of, or where it is hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// They count: rays hit what they leave and what they end on.
    Touching,
    /// A ray starts beyond those of the triangle that it leaves, and those where it ends do not count.
    Clear,
}

words! { Ends { Touching "touching", Clear "clear" } }

impl Ends {
    /// The number of specialisation constants.
    pub fn number(self) -> u32 {
        match self {
            Self::Touching => ENDS_TOUCHING,
            Self::Clear => ENDS_CLEAR,
        }
    }
}
