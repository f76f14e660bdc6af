//! State shared by every object of a device: handles, functions, books about memory, and the order of
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

/// Commands that are core in Vulkan 1.3 and an extension before.
pub(crate) struct Commands {
    pub(crate) pipeline_barrier: vk::PFN_vkCmdPipelineBarrier2,
    pub(crate) begin_rendering: Option<vk::PFN_vkCmdBeginRendering>,
    pub(crate) end_rendering: Option<vk::PFN_vkCmdEndRendering>,
}

impl Commands {
    /// Loads the commands under the name that fits the version; `None` if barriers are missing.
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
            // command is an alias of the core one); so in the two below.
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

/// Who the device is, for people and reports.
pub(crate) struct Identity {
    pub(crate) name: String,
    pub(crate) driver: String,
    pub(crate) software: bool,
    pub(crate) why_chosen: String,
}

/// The shared part of a device.
pub(crate) struct Core {
    pub(crate) instance: ash::Instance,
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) device: ash::Device,
    /// Locked while something is submitted.
    pub(crate) queue: Mutex<vk::Queue>,
    pub(crate) queue_family: u32,
    /// True if the queue can draw.
    pub(crate) graphics: bool,
    pub(crate) api_version: u32,
    pub(crate) commands: Commands,
    /// Names of objects, where `VK_EXT_debug_utils` is enabled.
    pub(crate) names: Option<ash::ext::debug_utils::Device>,
    /// Labels of passes, where it is and they do no harm.
    pub(crate) labels: Option<ash::ext::debug_utils::Device>,
    /// Trees of the driver, where [`Feature::AccelerationStructure`] is enabled.
    pub(crate) trees: Option<ash::khr::acceleration_structure::Device>,
    pub(crate) pipeline_cache: vk::PipelineCache,
    pub(crate) pipelines: PipelineStore,
    pub(crate) set_layouts: SetLayouts,
    pub(crate) enabled: BTreeSet<Feature>,
    pub(crate) limits: Limits,
    pub(crate) identity: Identity,
    pub(crate) ledger: Ledger,
    pub(crate) log: ValidationLog,
    /// Taken out before the device is destroyed.
    pub(crate) memory: Option<Arc<dyn Memory>>,
    /// The instance, if this crate made instance and device; dropped after the device.
    pub(crate) owned: Option<Instance>,
    pub(crate) abandoned: AtomicBool,
}

impl Core {
    /// True if objects may still be destroyed and work submitted; false after a timeout.
    pub(crate) fn is_usable(&self) -> bool {
        !self.abandoned.load(Ordering::Acquire)
    }

    /// The Vulkan device while objects may still be destroyed.
    pub(crate) fn usable_device(&self) -> Option<&ash::Device> {
        self.is_usable().then_some(&self.device)
    }

    /// From now on nothing is destroyed or submitted, as the device may be using it.
    pub(crate) fn abandon(&self) {
        self.abandoned.store(true, Ordering::Release);
    }

    /// An error unless the feature is enabled.
    pub(crate) fn require(&self, feature: Feature, what: &str) -> Result<()> {
        if self.enabled.contains(&feature) {
            return Ok(());
        }
        Err(GpuError::FeatureNotEnabled { feature, what: what.to_owned() })
    }

    /// Allocates memory and enters it into the books.
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

    /// Gives memory back that was allocated here for `bytes`.
    ///
    /// # Safety
    /// Nothing uses the memory any more, and it is given back once.
    pub(crate) unsafe fn free(&self, allocation: Allocation, bytes: u64) {
        let memory = self.memory.as_ref().expect("memory is taken out only when the device is dropped");
        // SAFETY: the caller vouches for it.
        unsafe { memory.free(allocation) };
        self.ledger.release(bytes);
    }

    /// Gives an object the name under which tools and validation show it.
    pub(crate) fn name_object<H: vk::Handle>(&self, handle: H, name: &str) {
        let Some(names) = &self.names else { return };
        let name = c_name(name);
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
        // SAFETY: the handle was just made from this device and is not shared yet. A name that could not be
        // stored is only a loss for debugging.
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
        // SAFETY: pipelines are gone, and every set keeps this value alive.
        unsafe { self.set_layouts.clear(&self.device) };
        drop(memory);
        if owned.is_some() {
            // SAFETY: every object made from the device keeps this value alive, so all are destroyed; every
            // submission was waited for (else the device is abandoned); and the device was made here.
            unsafe { self.device.destroy_device(None) };
        }
        drop(owned);
    }
}

/// A name as Vulkan takes it. Vulkan's strings end at the first NUL, so none may be inside.
pub(crate) fn c_name(name: &str) -> CString {
    CString::new(name.replace('\0', " ")).unwrap_or_default()
}
