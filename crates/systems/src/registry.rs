//! Registry of all systems, which are found by name.

use crate::{
    Preset, Spec, System, SystemsError, bricks, brute_force, bvh, dirt, driver_rt, grid, hu, ldc, mmrt,
    selective,
};

/// All systems.
pub static SYSTEMS: &[System] = &[
    bricks::SYSTEM,
    mmrt::SYSTEM,
    dirt::SYSTEM,
    hu::SYSTEM,
    selective::SYSTEM,
    ldc::SYSTEM,
    bvh::SYSTEM,
    grid::SYSTEM,
    driver_rt::SYSTEM,
    brute_force::SYSTEM,
];

impl System {
    /// Returns the system with this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        SYSTEMS.iter().find(|row| row.name == name)
    }
}

impl Spec {
    /// Makes a spec from the names of a system and a preset, and checks options and their values.
    ///
    /// # Errors
    /// The system, the preset, an option or a value does not exist; the error names it.
    pub fn new(
        system: &str,
        preset: &str,
        options: impl IntoIterator<Item = (String, String)>,
    ) -> Result<Self, SystemsError> {
        let row = System::named(system).ok_or_else(|| SystemsError::UnknownSystem {
            name: system.to_owned(),
            known: SYSTEMS.iter().map(|row| row.name).collect::<Vec<_>>().join(", "),
        })?;
        let preset = Preset::named(preset)
            .ok_or_else(|| SystemsError::UnknownPreset { system: row.name, preset: preset.to_owned() })?;
        Self::of(row, preset, row.read(options)?.into_iter().collect())
    }
}
