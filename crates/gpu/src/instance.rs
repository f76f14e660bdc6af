//! The Vulkan instance, with the loader, the validation layer and the messenger.

use std::ffi::{CStr, CString};

use ash::vk;

use crate::error::{During, GpuError, Result};
use crate::messages::{ValidationLog, messenger_info};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// First version of the validation layer whose queue thread locks the labels of command buffers. Earlier
/// versions, such as 1.3.239 of Debian 12, delete the labels of a destroyed command buffer without a lock,
/// some time after a wait for its fence ended. If the handle is in use again by then, labels are written to
/// freed memory (Vulkan-ValidationLayers, issue 5172).
const LABELS_ARE_LOCKED: u32 = vk::make_api_version(0, 1, 3, 242);

/// An instance that this crate made, with the library that it came from.
pub(crate) struct Instance {
    pub(crate) raw: ash::Instance,
    /// True if `VK_EXT_debug_utils` is enabled.
    pub(crate) debug_utils: bool,
    /// True if passes may have labels.
    pub(crate) labels: bool,
    /// Log of the validation messages; boxed because the messenger holds its address.
    log: Box<ValidationLog>,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    /// Owner of the loaded library; must be dropped last.
    _entry: ash::Entry,
}

impl Instance {
    /// Loads Vulkan and creates an instance for version 1.3 (which also lists devices of version 1.2).
    pub(crate) fn create(application: &str, validation: bool) -> Result<Self> {
        let entry = load()?;
        // SAFETY: global-level command of a loaded library.
        let version = unsafe { entry.try_enumerate_instance_version() }
            .during("vkEnumerateInstanceVersion", "the version of the loader")?
            .unwrap_or(vk::API_VERSION_1_0);
        if version < vk::API_VERSION_1_2 {
            let found = format!("{}.{}", vk::api_version_major(version), vk::api_version_minor(version));
            return Err(GpuError::LoaderTooOld { found });
        }
        let extensions = extension_names(&entry, None)?;
        let mut enabled: Vec<&CStr> = Vec::new();
        let mut layers: Vec<*const std::ffi::c_char> = Vec::new();
        let (mut debug_utils, mut labels) = (false, false);
        if validation {
            let version = validation_layer(&entry)?.ok_or(GpuError::ValidationLayerMissing)?;
            labels = version >= LABELS_ARE_LOCKED;
            layers.push(VALIDATION_LAYER.as_ptr());
            let of_layer = extension_names(&entry, Some(VALIDATION_LAYER))?;
            let name = ash::ext::debug_utils::NAME;
            debug_utils = extensions.iter().chain(&of_layer).any(|extension| extension.as_c_str() == name);
            if !debug_utils {
                return Err(GpuError::ValidationLayerMissing);
            }
            enabled.push(name);
        }
        let mut flags = vk::InstanceCreateFlags::empty();
        let portability = ash::khr::portability_enumeration::NAME;
        if extensions.iter().any(|extension| extension.as_c_str() == portability) {
            // Without this extension the loader hides drivers that layer Vulkan over another interface.
            enabled.push(portability);
            flags |= vk::InstanceCreateFlags::ENUMERATE_PORTABILITY_KHR;
        }

        let application = CString::new(application.replace('\0', " ")).unwrap_or_default();
        let description = vk::ApplicationInfo::default()
            .application_name(&application)
            .engine_name(c"rasray")
            .api_version(vk::API_VERSION_1_3);
        let enabled: Vec<_> = enabled.iter().map(|name| name.as_ptr()).collect();
        let log = Box::new(ValidationLog::default());
        let mut messages = messenger_info(&log);
        let mut info = vk::InstanceCreateInfo::default()
            .flags(flags)
            .application_info(&description)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&enabled);
        if debug_utils {
            info = info.push_next(&mut messages);
        }
        // SAFETY: all pointers in `info` are to values that live until the end of this function.
        let raw = unsafe { entry.create_instance(&info, None) }.map_err(|result| match result {
            vk::Result::ERROR_INCOMPATIBLE_DRIVER => GpuError::NoDevice,
            vk::Result::ERROR_LAYER_NOT_PRESENT => GpuError::ValidationLayerMissing,
            other => GpuError::from_vulkan(other, "vkCreateInstance", &application.to_string_lossy()),
        })?;
        let mut instance = Self { raw, debug_utils, labels, log, messenger: None, _entry: entry };
        if debug_utils {
            let functions = ash::ext::debug_utils::Instance::new(&instance._entry, &instance.raw);
            let info = messenger_info(&instance.log);
            // SAFETY: the extension is enabled, and the log is boxed in the value that destroys the
            // messenger.
            let messenger = unsafe { functions.create_debug_utils_messenger(&info, None) }
                .during("vkCreateDebugUtilsMessengerEXT", "the messages of the validation layer")?;
            instance.messenger = Some((functions, messenger));
        }
        Ok(instance)
    }

    /// Returns the log of the validation layer's messages.
    pub(crate) fn log(&self) -> &ValidationLog {
        &self.log
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if let Some((functions, messenger)) = self.messenger.take() {
            // SAFETY: the messenger was created from this instance, and nothing else refers to it.
            unsafe { functions.destroy_debug_utils_messenger(messenger, None) };
        }
        // SAFETY: the device made from this instance is already destroyed (it is owned next to the instance
        // and dropped first), and the library is still loaded.
        unsafe { self.raw.destroy_instance(None) };
    }
}

/// Loads the functions of the system's Vulkan loader.
#[cfg(not(feature = "fault-injection"))]
fn load() -> Result<ash::Entry> {
    // SAFETY: the library is trusted to be the system's Vulkan loader, whose initialisers have no
    // preconditions.
    unsafe { ash::Entry::load() }.map_err(|error| GpuError::LoaderMissing { reason: error.to_string() })
}

/// Loads the functions of the system's Vulkan loader, each behind the schedule of tests.
#[cfg(feature = "fault-injection")]
fn load() -> Result<ash::Entry> {
    crate::faults::entry()
}

/// Returns the version of the validation layer, if it is installed.
fn validation_layer(entry: &ash::Entry) -> Result<Option<u32>> {
    // SAFETY: global-level command of a loaded library.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .during("vkEnumerateInstanceLayerProperties", "the list of layers")?;
    let layer = layers.iter().find(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
    Ok(layer.map(|layer| layer.spec_version))
}

fn extension_names(entry: &ash::Entry, layer: Option<&CStr>) -> Result<Vec<CString>> {
    // SAFETY: global-level command of a loaded library.
    let extensions = unsafe { entry.enumerate_instance_extension_properties(layer) }
        .during("vkEnumerateInstanceExtensionProperties", "the list of instance extensions")?;
    Ok(extensions.iter().filter_map(|each| each.extension_name_as_c_str().ok()).map(CStr::to_owned).collect())
}
