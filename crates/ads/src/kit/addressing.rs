//! Addressing of a structure's pools by shaders, and the shader modules that a structure uses for it.

use crate::words;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use rasray_gpu::{Device, Feature, Requirements, storage_buffers_used};
use rasray_shaders_glsl::Shader;

use crate::{AdsError, SceneBinding};

/// Way in which shaders reach the pools. It does not change any hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Addressing {
    /// Storage-buffer descriptors; a pool is limited to `maxStorageBufferRange`.
    #[default]
    Descriptor,
    /// Device addresses in the header; needs `bufferDeviceAddress`.
    Address,
}

words! { Addressing { Descriptor "descriptor", Address "address" } }

impl Addressing {
    /// Adds the device features that the addressing needs.
    pub fn add_to(self, requirements: &mut Requirements) {
        if self == Self::Address {
            requirements.required.push(Feature::BufferDeviceAddress);
        }
    }

    /// Checks that a device supports the addressing.
    ///
    /// # Errors
    /// Addresses on a device without `bufferDeviceAddress`.
    pub fn check(self, device: &Device) -> Result<(), AdsError> {
        if self == Self::Address && !device.has(Feature::BufferDeviceAddress) {
            return Err(AdsError::Option {
                option: "addressing",
                value: self.name().to_owned(),
                expected: "device addresses need the feature bufferDeviceAddress, which was not enabled on this device",
            });
        }
        Ok(())
    }
}

/// Splits a device address into the two words that shaders take, low word first.
pub(crate) fn halves(address: u64) -> [u32; 2] {
    [address as u32, (address >> 32) as u32]
}

/// Finds the shader modules of one structure for one addressing.
#[derive(Clone, Copy, Debug)]
pub struct Modules {
    /// Name of the structure, for errors.
    pub structure: &'static str,
    /// Folder of the structure's shaders.
    pub prefix: &'static str,
    /// Addressing of the pools by the structure's shaders.
    pub addressing: Addressing,
}

/// Shader modules that trace a queue.
#[derive(Clone, Copy, Debug)]
pub struct TraceModules {
    /// Module for nearest hits and occlusion.
    pub trace: &'static Shader,
    /// Module for surfaces; absent if the scene's shaders are not compiled in.
    pub surfaces: Option<&'static Shader>,
    /// Module for first hits of camera rays; absent if the structure has no first hits.
    pub first_hits: Option<&'static Shader>,
}

impl Modules {
    /// Adds the device features and limits that the modules need.
    pub fn add_to(&self, requirements: &mut Requirements) {
        self.addressing.add_to(requirements);
        requirements.storage_buffers = requirements.storage_buffers.max(self.storage_buffers());
    }

    /// Returns the maximum number of storage buffers that one of the modules uses.
    fn storage_buffers(&self) -> u32 {
        type Known = BTreeMap<(&'static str, bool), u32>;
        // Each module is read only once, because reading takes some milliseconds.
        static KNOWN: Mutex<Known> = Mutex::new(BTreeMap::new());
        let by_address = self.addressing == Addressing::Address;
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        *known.entry((self.prefix, by_address)).or_insert_with(|| {
            let own = rasray_shaders_glsl::ALL.iter().filter(|shader| {
                let name = shader.name.strip_prefix(self.prefix);
                name.is_some_and(|name| name.starts_with('/') && name.ends_with(".address") == by_address)
            });
            own.filter_map(|shader| storage_buffers_used(&shader.words()).ok()).max().unwrap_or(0)
        })
    }

    /// Returns the module with that name in the folder of the structure's shaders.
    ///
    /// # Errors
    /// [`AdsError::ModuleMissing`]: the module is not compiled in.
    pub fn find(&self, name: &str) -> Result<&'static Shader, AdsError> {
        let suffix = match self.addressing {
            Addressing::Descriptor => "",
            Addressing::Address => ".address",
        };
        let module = format!("{}/{name}{suffix}", self.prefix);
        rasray_shaders_glsl::shader(&module)
            .ok_or(AdsError::ModuleMissing { structure: self.structure, module })
    }

    /// Returns the modules that trace.
    ///
    /// # Errors
    /// The scene has alpha masks, and the scene's shaders are not compiled in.
    pub fn trace(&self, scene: Option<&SceneBinding>) -> Result<TraceModules, AdsError> {
        self.trace_variant("", scene)
    }

    /// Returns the modules of [`Modules::trace`] for a structure whose trace modules are compiled once per
    /// option value: `variant` is the suffix of their names, such as `.cells`.
    ///
    /// # Errors
    /// As [`Modules::trace`].
    pub fn trace_variant(
        &self,
        variant: &str,
        scene: Option<&SceneBinding>,
    ) -> Result<TraceModules, AdsError> {
        let masked = SceneBinding::mask_suffix(scene);
        Ok(TraceModules {
            trace: self.find(&format!("trace{variant}{masked}"))?,
            surfaces: self.find("surfaces").ok(),
            first_hits: None,
        })
    }
}
