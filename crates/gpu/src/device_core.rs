//! State that all objects of a device share: handles, functions, memory accounting, and the order of
//! destruction.

use std::collections::BTreeSet;
use std::ffi::{CStr, CString};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use ash::vk;

use crate::error::{GpuError, Result};
use crate::features::Feature;
use crate::instance::Instance;
use crate::limits::Limits;
use crate::memory::{Allocation, Ledger, Memory};
use crate::messages::ValidationLog;
use crate::pipeline_store::PipelineStore;
use crate::set_parts::SetLayouts;

/// Commands that are core in Vulkan 1.3 and part of an extension in earlier versions.
pub(crate) struct Commands {
    pub(crate) pipeline_barrier: vk::PFN_vkCmdPipelineBarrier2,
    pub(crate) begin_rendering: Option<vk::PFN_vkCmdBeginRendering>,
    pub(crate) end_rendering: Option<vk::PFN_vkCmdEndRendering>,
}

impl Commands {
    /// Loads the commands under the names of the given version; `None` if the command for barriers is
    /// missing.
    pub(crate) fn load(instance: &ash::Instance, device: &ash::Device, api_version: u32) -> Option<Self> {
        let find = |core: &CStr, extension: &CStr| {
            let name = if api_version >= vk::API_VERSION_1_3 { core } else { extension };
            // SAFETY: the device belongs to the instance, and the name is NUL-terminated.
            unsafe { instance.get_device_proc_addr(device.handle(), name.as_ptr()) }
        };
        let barrier = find(c"vkCmdPipelineBarrier2", c"vkCmdPipelineBarrier2KHR")?;
        let begin = find(c"vkCmdBeginRendering", c"vkCmdBeginRenderingKHR");
        let end = find(c"vkCmdEndRendering", c"vkCmdEndRenderingKHR");
        type Untyped = unsafe extern "system" fn();
        Some(Self {
            // SAFETY: Vulkan returned this pointer for the command of exactly this type (the extension's
            // command is an alias of the core one); the same holds for the two below.
            pipeline_barrier: unsafe {
                std::mem::transmute::<Untyped, vk::PFN_vkCmdPipelineBarrier2>(barrier)
            },
            // SAFETY: see above.
            begin_rendering: begin
                .map(|begin| unsafe { std::mem::transmute::<Untyped, vk::PFN_vkCmdBeginRendering>(begin) }),
            // SAFETY: see above.
            end_rendering: end
                .map(|end| unsafe { std::mem::transmute::<Untyped, vk::PFN_vkCmdEndRendering>(end) }),
        })
    }
}

/// Names that identify the device, for people and reports.
pub(crate) struct Identity {
    pub(crate) name: String,
    pub(crate) driver: String,
    pub(crate) software: bool,
    pub(crate) why_chosen: String,
}

/// State that all handles of a device share.
pub(crate) struct Core {
    pub(crate) instance: ash::Instance,
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) device: ash::Device,
    /// Queue of the device; locked during each submission.
    pub(crate) queue: Mutex<vk::Queue>,
    pub(crate) queue_family: u32,
    /// True if the queue supports drawing.
    pub(crate) graphics: bool,
    pub(crate) api_version: u32,
    pub(crate) commands: Commands,
    /// Functions that name objects, if `VK_EXT_debug_utils` is enabled.
    pub(crate) names: Option<ash::ext::debug_utils::Device>,
    /// Functions that label passes, if `VK_EXT_debug_utils` is enabled and labels are safe.
    pub(crate) labels: Option<ash::ext::debug_utils::Device>,
    /// Functions for the driver's trees, if [`Feature::AccelerationStructure`] is enabled.
    pub(crate) trees: Option<ash::khr::acceleration_structure::Device>,
    pub(crate) pipeline_cache: vk::PipelineCache,
    pub(crate) pipelines: PipelineStore,
    pub(crate) set_layouts: SetLayouts,
    pub(crate) enabled: BTreeSet<Feature>,
    pub(crate) limits: Limits,
    pub(crate) identity: Identity,
    pub(crate) ledger: Ledger,
    pub(crate) log: ValidationLog,
    /// Source of memory; taken out before the device is destroyed.
    pub(crate) memory: Option<Arc<dyn Memory>>,
    /// The instance, if this crate made both instance and device; dropped after the device.
    pub(crate) owned: Option<Instance>,
    pub(crate) abandoned: AtomicBool,
}

impl Core {
    /// Returns true if objects may still be destroyed and work submitted; false after a timeout.
    pub(crate) fn is_usable(&self) -> bool {
        !self.abandoned.load(Ordering::Acquire)
    }

    /// Returns the Vulkan device if objects may still be destroyed.
    pub(crate) fn usable_device(&self) -> Option<&ash::Device> {
        self.is_usable().then_some(&self.device)
    }

    /// Stops all destruction and submission from now on, because the device may be using the objects.
    pub(crate) fn abandon(&self) {
        self.abandoned.store(true, Ordering::Release);
    }

    /// Returns an error unless the feature is enabled.
    pub(crate) fn require(&self, feature: Feature, what: &str) -> Result<()> {
        if self.enabled.contains(&feature) {
            return Ok(());
        }
        Err(GpuError::FeatureNotEnabled { feature, what: what.to_owned() })
    }

    /// Allocates memory and adds it to the accounting.
    pub(crate) fn allocate(
        &self,
        requirements: vk::MemoryRequirements,
        location: crate::memory::MemoryLocation,
        name: &str,
    ) -> Result<Allocation> {
        let memory = self.memory.as_ref().expect("memory is taken out only when the device is dropped");
        self.ledger.reserve(name, requirements.size)?;
        memory.allocate(requirements, location, name).map_err(|error| {
            self.ledger.release(requirements.size);
            match error {
                GpuError::OutOfDeviceMemory { name, asked, limit, refused_by, .. } => {
                    let allocated = self.ledger.allocated();
                    GpuError::OutOfDeviceMemory { name, asked, limit, allocated, refused_by }
                }
                other => other,
            }
        })
    }

    /// Frees memory that [`Core::allocate`] allocated for `bytes`.
    ///
    /// # Safety
    /// Nothing uses the memory any more, and it is freed once.
    pub(crate) unsafe fn free(&self, allocation: Allocation, bytes: u64) {
        let memory = self.memory.as_ref().expect("memory is taken out only when the device is dropped");
        // SAFETY: the caller guarantees the conditions of `free`.
        unsafe { memory.free(allocation) };
        self.ledger.release(bytes);
    }

    /// Gives an object the name under which tools and the validation layer show it.
    pub(crate) fn name_object<H: vk::Handle>(&self, handle: H, name: &str) {
        let Some(names) = &self.names else { return };
        let name = c_name(name);
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
        // SAFETY: the handle was just made from this device and is not shared yet. A name that could not be
        // stored is a loss for debugging only.
        let _ = unsafe { names.set_debug_utils_object_name(&info) };
    }
}

impl Drop for Core {
    fn drop(&mut self) {
        let memory = self.memory.take();
        let owned = self.owned.take();
        if !self.is_usable() {
            // The device may still be running work that reads this memory.
            std::mem::forget(memory);
            std::mem::forget(owned);
            return;
        }
        self.pipelines.clear(&self.device);
        // SAFETY: pipelines are destroyed, and every set keeps this value alive, so none is left.
        unsafe { self.set_layouts.clear(&self.device) };
        drop(memory);
        if owned.is_some() {
            // SAFETY: every object made from the device keeps this value alive, so all are destroyed; every
            // submission was waited for (otherwise the device is abandoned); and the device was made by this
            // crate.
            unsafe { self.device.destroy_device(None) };
        }
        drop(owned);
    }
}

/// Converts a name to a C string. Vulkan's strings end at the first NUL, so NULs inside are replaced by
/// spaces.
pub(crate) fn c_name(name: &str) -> CString {
    CString::new(name.replace('\0', " ")).unwrap_or_default()
}
