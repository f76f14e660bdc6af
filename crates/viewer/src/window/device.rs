//! Vulkan instance and device that draw the window.
//!
//! The window has a device of its own: on a shared queue its frames would wait behind waves of rays, which
//! take seconds on a software driver, and if the renderer's device is lost, the window still reports it.
//! Pictures come through the host.

use std::ffi::CStr;

use crate::error::ViewerError;
use rasray_gpu::{ValidationLog, ash, vk};
use winit::raw_window_handle::{HasDisplayHandle, HasWindowHandle};
use winit::window::Window;

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Makes an error of the window's device.
pub(super) fn window_error(
    during: &'static str,
    source: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> ViewerError {
    ViewerError::Window { during, source: source.into() }
}

/// Instance and surface of a window. Everything made from them must be gone before they are dropped.
pub(super) struct WindowInstance {
    pub(super) surface: vk::SurfaceKHR,
    pub(super) surfaces: ash::khr::surface::Instance,
    pub(super) instance: ash::Instance,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    /// Log of validation messages, boxed because the messenger holds its address.
    log: Box<ValidationLog>,
    /// Loaded Vulkan library, which is dropped last because the other fields use it.
    _entry: ash::Entry,
}

impl WindowInstance {
    fn new(window: &Window, validation: bool) -> Result<Self, ViewerError> {
        let display = window.display_handle().map_err(|error| window_error("display", error))?.as_raw();
        let handle = window.window_handle().map_err(|error| window_error("window", error))?.as_raw();
        // SAFETY: the system's Vulkan loader is trusted to be one; its initialisers have no preconditions.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| window_error("loader", error))?;
        let mut extensions = ash_window::enumerate_required_extensions(display)
            .map_err(|error| window_error("surface extensions", error))?
            .to_vec();
        let mut layers = Vec::new();
        let log = Box::new(ValidationLog::default());
        // SAFETY: the log is boxed in the value that destroys messenger and instance.
        let mut messages = unsafe { log.messenger() };
        let application =
            vk::ApplicationInfo::default().application_name(c"rasray view").api_version(vk::API_VERSION_1_2);
        if validation {
            layers.push(VALIDATION_LAYER.as_ptr());
            extensions.push(ash::ext::debug_utils::NAME.as_ptr());
        }
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&extensions);
        if validation {
            info = info.push_next(&mut messages);
        }
        // SAFETY: all pointers in `info` are to values that live until the call returns.
        let instance = unsafe { entry.create_instance(&info, None) }
            .map_err(|error| window_error("vkCreateInstance", error))?;
        // From here on, dropping the value destroys everything made so far; null handles are ignored.
        let mut made = Self {
            surface: vk::SurfaceKHR::null(),
            surfaces: ash::khr::surface::Instance::new(&entry, &instance),
            instance,
            messenger: None,
            log,
            _entry: entry,
        };
        if validation {
            let functions = ash::ext::debug_utils::Instance::new(&made._entry, &made.instance);
            // SAFETY: the extension is enabled, and the log is boxed in the value that destroys the
            // messenger.
            let messenger = unsafe { functions.create_debug_utils_messenger(&made.log.messenger(), None) }
                .map_err(|error| window_error("vkCreateDebugUtilsMessengerEXT", error))?;
            made.messenger = Some((functions, messenger));
        }
        // SAFETY: the handles are of a window that outlives this value.
        made.surface =
            unsafe { ash_window::create_surface(&made._entry, &made.instance, display, handle, None) }
                .map_err(|error| window_error("surface", error))?;
        Ok(made)
    }

    /// Chooses the device of that name with a queue family that draws and presents, otherwise the first
    /// device with one.
    fn choose(&self, name: &str) -> Result<(vk::PhysicalDevice, u32), ViewerError> {
        // SAFETY: the instance is live.
        let all = unsafe { self.instance.enumerate_physical_devices() }
            .map_err(|error| window_error("vkEnumeratePhysicalDevices", error))?;
        let able = all.into_iter().filter_map(|physical| Some((physical, self.presenting_family(physical)?)));
        let able: Vec<_> = able.collect();
        let is_named = |physical: vk::PhysicalDevice| {
            // SAFETY: the physical device belongs to the instance.
            let properties = unsafe { self.instance.get_physical_device_properties(physical) };
            properties.device_name_as_c_str().is_ok_and(|own| own.to_string_lossy() == name)
        };
        let named = able.iter().find(|(physical, _)| is_named(*physical));
        named
            .or(able.first())
            .copied()
            .ok_or_else(|| window_error("devices", "no device of this machine can draw to this display"))
    }

    fn presenting_family(&self, physical: vk::PhysicalDevice) -> Option<u32> {
        // SAFETY: the physical device belongs to the instance.
        let families = unsafe { self.instance.get_physical_device_queue_family_properties(physical) };
        (0..).zip(families).find_map(|(index, family): (u32, _)| {
            let draws = family.queue_flags.contains(vk::QueueFlags::GRAPHICS);
            // SAFETY: device, family and surface belong to the instance.
            let presents =
                unsafe { self.surfaces.get_physical_device_surface_support(physical, index, self.surface) };
            (draws && presents == Ok(true)).then_some(index)
        })
    }

    fn open(&self, physical: vk::PhysicalDevice, family: u32) -> Result<ash::Device, ViewerError> {
        let priorities = [1.0];
        let queues =
            [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&priorities)];
        let extensions = [ash::khr::swapchain::NAME.as_ptr()];
        let info =
            vk::DeviceCreateInfo::default().queue_create_infos(&queues).enabled_extension_names(&extensions);
        // SAFETY: the physical device belongs to the instance and has the queue family; pointers live until
        // the call returns.
        unsafe { self.instance.create_device(physical, &info, None) }
            .map_err(|error| window_error("vkCreateDevice", error))
    }
}

impl Drop for WindowInstance {
    fn drop(&mut self) {
        // SAFETY: everything that was made from instance and surface is gone, and the library is still
        // loaded.
        unsafe {
            self.surfaces.destroy_surface(self.surface, None);
            if let Some((functions, messenger)) = self.messenger.take() {
                functions.destroy_debug_utils_messenger(messenger, None);
            }
            self.instance.destroy_instance(None);
        }
    }
}

/// Device that draws to a window. Everything made from it must be gone before it is dropped.
pub(super) struct WindowDevice {
    pub(super) physical: vk::PhysicalDevice,
    pub(super) device: ash::Device,
    pub(super) queue: vk::Queue,
    pub(super) family: u32,
    pub(super) owner: WindowInstance,
}

impl WindowDevice {
    /// Makes the device for a window, on the physical device of this name if that can present, otherwise on
    /// the first that can.
    pub(super) fn new(window: &Window, name: &str, validation: bool) -> Result<Self, ViewerError> {
        let owner = WindowInstance::new(window, validation)?;
        let (physical, family) = owner.choose(name)?;
        let device = owner.open(physical, family)?;
        // SAFETY: the device was made with one queue of this family.
        let queue = unsafe { device.get_device_queue(family, 0) };
        Ok(Self { physical, device, queue, family, owner })
    }

    /// Returns the messages of the validation layer so far, and later ones; the log outlives the device. It
    /// is empty without validation.
    pub(super) fn validation_log(&self) -> ValidationLog {
        ValidationLog::clone(&self.owner.log)
    }
}

impl Drop for WindowDevice {
    fn drop(&mut self) {
        // SAFETY: everything that was made from the device is gone.
        unsafe { self.device.destroy_device(None) };
    }
}
