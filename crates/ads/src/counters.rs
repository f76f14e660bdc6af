use rasray_shaders_glsl::constants::contract;

/// Amount of their work that rays record. Changes no hit. Each value includes those before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Counters {
    /// Nothing.
    #[default]
    Off,
    /// Sums over all rays, in [`crate::QueueHeader`].
    Sums,
    /// A [`crate::RayWork`] per slot, where the queue has a buffer for it.
    PerRay,
    /// Every step of the logged slot of a queue that was made with [`crate::QueueParts::steps`].
    Steps,
}

impl Counters {
    /// The value of specialisation constant 0.
    pub fn constant(self) -> u32 {
        match self {
            Self::Off => contract::COUNTERS_OFF,
            Self::Sums => contract::COUNTERS_SUMS,
            Self::PerRay => contract::COUNTERS_PER_RAY,
            Self::Steps => contract::COUNTERS_STEPS,
        }
    }
}

impl From<bool> for Counters {
    /// Sums, or nothing.
    fn from(sums: bool) -> Self {
        if sums { Self::Sums } else { Self::Off }
    }
}
