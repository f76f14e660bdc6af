use rasray_shaders_glsl::constants::contract;

/// Amount of their own work that rays record. It does not change any hit. Each value includes those before
/// it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Counters {
    /// Rays record nothing.
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
    /// Returns the value of specialisation constant 0.
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
    /// Converts true to `Sums` and false to `Off`.
    fn from(sums: bool) -> Self {
        if sums { Self::Sums } else { Self::Off }
    }
}
