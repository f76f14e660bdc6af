//! Vulkan functions, with a schedule around those that can fail.

use std::ffi::{CStr, CString, c_char, c_void};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicPtr, Ordering};

use ash::vk::{self, Handle, Result as Code};

use super::schedule::{note, verdict};

/// Functions of the loader, with the library that contains them, which stays loaded.
static LOADER: OnceLock<std::result::Result<ash::Entry, String>> = OnceLock::new();

/// Returns the functions of the loader, with `vkGetInstanceProcAddr` replaced.
pub(super) fn entry() -> std::result::Result<ash::Entry, String> {
    let loader = LOADER.get_or_init(|| {
        // SAFETY: the system's Vulkan loader is trusted to be one; its initialisers have no preconditions.
        unsafe { ash::Entry::load() }.map_err(|error| error.to_string())
    });
    loader.as_ref().map_err(Clone::clone)?;
    let functions = ash::StaticFn { get_instance_proc_addr: instance_function };
    // SAFETY: the function answers as the loader does, which stays loaded; functions that it does not hand
    // out are not used.
    Ok(unsafe { ash::Entry::from_static_fn(functions) })
}

/// Returns the loader's function with that name.
///
/// # Safety
/// `instance` is null or an instance that is not destroyed.
unsafe fn original(instance: vk::Instance, name: &CStr) -> vk::PFN_vkVoidFunction {
    let loader = LOADER.get()?.as_ref().ok()?;
    // SAFETY: the caller guarantees the instance, and the name is NUL-terminated.
    unsafe { (loader.static_fn().get_instance_proc_addr)(instance, name.as_ptr()) }
}

/// Returns the name of a handle's type, by which objects are counted.
fn kind_of<T>(_: *const T) -> &'static str {
    std::any::type_name::<T>().rsplit("::").next().unwrap_or("object")
}

/// Notes the objects that a call made; some handles may be null.
///
/// # Safety
/// `made` points to `count` handles, all of them written.
unsafe fn note_made<T: Handle + Copy>(made: *mut T, count: u32) {
    for index in 0..count as usize {
        // SAFETY: the caller guarantees `count` handles that the call has written.
        if !unsafe { *made.add(index) }.is_null() {
            note(kind_of(made), 1);
        }
    }
}

/// Writes null handles for objects that were not made, as Vulkan requires of pipelines.
///
/// # Safety
/// `made` points to space for `count` handles, to which nothing else has access.
unsafe fn leave_none<T: Handle>(made: *mut T, count: u32) {
    for index in 0..count as usize {
        // SAFETY: the caller guarantees space for `count` handles.
        unsafe { made.add(index).write(T::from_raw(0)) };
    }
}

/// Declares functions that return `VkResult`: for each, a function of the same type that asks the schedule
/// first. The list contains the codes that a function may return and, for functions that create objects, the
/// number of objects in the last argument.
macro_rules! fallible {
    ($($name:ident($($argument:ident: $type:ty),*) [$($code:ident),*] $(makes($made:ident, $count:expr))?;)*) => {
        /// Names of the functions that can fail.
        const FALLIBLE: &[&str] = &[$(stringify!($name)),*];

        /// Returns the wrapper of a function that can fail, by name, and the place of the loader's function.
        fn fallible(name: &CStr) -> Option<(&'static AtomicPtr<c_void>, vk::PFN_vkVoidFunction)> {
            $({
                /// Loader's function of this name.
                static ORIGINAL: AtomicPtr<c_void> = AtomicPtr::new(std::ptr::null_mut());
                #[allow(non_snake_case, unused_variables)]
                unsafe extern "system" fn $name($($argument: $type),*) -> Code {
                    let failed = verdict(stringify!($name), &[$(Code::$code),*]);
                    let is_lost_wait =
                        failed == Some(Code::ERROR_DEVICE_LOST) && stringify!($name).contains("Wait");
                    if let (Some(code), false) = (failed, is_lost_wait) {
                        // SAFETY: the caller provides space for `count` handles.
                        $(unsafe { leave_none($made, $count) };)?
                        return code;
                    }
                    type Function = unsafe extern "system" fn($($type),*) -> Code;
                    let original = ORIGINAL.load(Ordering::Acquire);
                    // SAFETY: this function is handed out only after the loader's function of the same name,
                    // which has this type, is stored.
                    let original = unsafe { std::mem::transmute::<*mut c_void, Function>(original) };
                    // SAFETY: the caller fulfils the conditions of the function of this name.
                    let code = unsafe { original($($argument),*) };
                    $(if code == Code::SUCCESS {
                        // SAFETY: after success the call has written `count` handles.
                        unsafe { note_made($made, $count) };
                    })?
                    failed.unwrap_or(code)
                }
                if name.to_bytes() == stringify!($name).as_bytes() {
                    let function: unsafe extern "system" fn($($type),*) -> Code = $name;
                    // SAFETY: Vulkan hands out functions as pointers without a type.
                    let untyped = unsafe {
                        std::mem::transmute::<
                            unsafe extern "system" fn($($type),*) -> Code,
                            unsafe extern "system" fn(),
                        >(function)
                    };
                    return Some((&ORIGINAL, Some(untyped)));
                }
            })*
            None
        }
    };
}

/// Declares functions that destroy objects: for each, a function of the same type that notes the destruction.
macro_rules! destroying {
    ($($name:ident[$($parent:ty)?] $object:ty;)*) => {
        /// Names of the functions that destroy.
        const DESTROYING: &[&str] = &[$(stringify!($name)),*];

        /// Returns the wrapper of a function that destroys, by name, and the place of the loader's function.
        fn destroying(name: &CStr) -> Option<(&'static AtomicPtr<c_void>, vk::PFN_vkVoidFunction)> {
            $({
                static ORIGINAL: AtomicPtr<c_void> = AtomicPtr::new(std::ptr::null_mut());
                type Function =
                    unsafe extern "system" fn($($parent,)? $object, *const vk::AllocationCallbacks<'_>);
                #[allow(non_snake_case)]
                unsafe extern "system" fn $name(
                    $(parent: $parent,)?
                    object: $object,
                    callbacks: *const vk::AllocationCallbacks<'_>,
                ) {
                    if !object.is_null() {
                        note(kind_of(&raw const object), -1);
                    }
                    // SAFETY: handed out only after the loader's function of this name and type is stored.
                    let original = unsafe {
                        std::mem::transmute::<*mut c_void, Function>(ORIGINAL.load(Ordering::Acquire))
                    };
                    // SAFETY: the caller fulfils the conditions of the function of this name.
                    unsafe { original($({ let parent: $parent = parent; parent },)? object, callbacks) }
                }
                if name.to_bytes() == stringify!($name).as_bytes() {
                    let function: Function = $name;
                    // SAFETY: Vulkan hands out functions as pointers without a type.
                    let untyped = unsafe {
                        std::mem::transmute::<Function, unsafe extern "system" fn()>(function)
                    };
                    return Some((&ORIGINAL, Some(untyped)));
                }
            })*
            None
        }
    };
}

#[rustfmt::skip]
fallible! {
    vkEnumerateInstanceVersion(version: *mut u32) [ERROR_OUT_OF_HOST_MEMORY];
    vkEnumerateInstanceLayerProperties(count: *mut u32, found: *mut vk::LayerProperties) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkEnumerateInstanceExtensionProperties(layer: *const c_char, count: *mut u32, found: *mut vk::ExtensionProperties) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkCreateInstance(info: *const vk::InstanceCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::Instance) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_INITIALIZATION_FAILED] makes(made, 1);
    vkCreateDebugUtilsMessengerEXT(instance: vk::Instance, info: *const vk::DebugUtilsMessengerCreateInfoEXT<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::DebugUtilsMessengerEXT) [ERROR_OUT_OF_HOST_MEMORY] makes(made, 1);
    vkEnumeratePhysicalDevices(instance: vk::Instance, count: *mut u32, found: *mut vk::PhysicalDevice) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_INITIALIZATION_FAILED];
    vkEnumerateDeviceExtensionProperties(physical: vk::PhysicalDevice, layer: *const c_char, count: *mut u32, found: *mut vk::ExtensionProperties) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkCreateDevice(physical: vk::PhysicalDevice, info: *const vk::DeviceCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::Device) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_INITIALIZATION_FAILED, ERROR_TOO_MANY_OBJECTS, ERROR_DEVICE_LOST] makes(made, 1);
    vkSetDebugUtilsObjectNameEXT(device: vk::Device, info: *const vk::DebugUtilsObjectNameInfoEXT<'_>) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkCreateBuffer(device: vk::Device, info: *const vk::BufferCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::Buffer) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkAllocateMemory(device: vk::Device, info: *const vk::MemoryAllocateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::DeviceMemory) [ERROR_OUT_OF_DEVICE_MEMORY, ERROR_OUT_OF_HOST_MEMORY, ERROR_TOO_MANY_OBJECTS] makes(made, 1);
    vkMapMemory(device: vk::Device, memory: vk::DeviceMemory, offset: u64, size: u64, flags: vk::MemoryMapFlags, address: *mut *mut c_void) [ERROR_MEMORY_MAP_FAILED, ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkBindBufferMemory(device: vk::Device, buffer: vk::Buffer, memory: vk::DeviceMemory, offset: u64) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkCreateDescriptorSetLayout(device: vk::Device, info: *const vk::DescriptorSetLayoutCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::DescriptorSetLayout) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkCreateDescriptorPool(device: vk::Device, info: *const vk::DescriptorPoolCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::DescriptorPool) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkAllocateDescriptorSets(device: vk::Device, info: *const vk::DescriptorSetAllocateInfo<'_>, found: *mut vk::DescriptorSet) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_FRAGMENTED_POOL, ERROR_OUT_OF_POOL_MEMORY];
    vkCreateShaderModule(device: vk::Device, info: *const vk::ShaderModuleCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::ShaderModule) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkCreatePipelineLayout(device: vk::Device, info: *const vk::PipelineLayoutCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::PipelineLayout) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkCreateComputePipelines(device: vk::Device, cache: vk::PipelineCache, count: u32, infos: *const vk::ComputePipelineCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::Pipeline) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, count);
    vkCreateGraphicsPipelines(device: vk::Device, cache: vk::PipelineCache, count: u32, infos: *const vk::GraphicsPipelineCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::Pipeline) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, count);
    vkCreatePipelineCache(device: vk::Device, info: *const vk::PipelineCacheCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::PipelineCache) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkCreateQueryPool(device: vk::Device, info: *const vk::QueryPoolCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::QueryPool) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkGetQueryPoolResults(device: vk::Device, pool: vk::QueryPool, first: u32, count: u32, size: usize, data: *mut c_void, stride: u64, flags: vk::QueryResultFlags) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_DEVICE_LOST];
    vkCreateCommandPool(device: vk::Device, info: *const vk::CommandPoolCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::CommandPool) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkResetCommandPool(device: vk::Device, pool: vk::CommandPool, flags: vk::CommandPoolResetFlags) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkAllocateCommandBuffers(device: vk::Device, info: *const vk::CommandBufferAllocateInfo<'_>, found: *mut vk::CommandBuffer) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkBeginCommandBuffer(command: vk::CommandBuffer, info: *const vk::CommandBufferBeginInfo<'_>) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkEndCommandBuffer(command: vk::CommandBuffer) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkCreateFence(device: vk::Device, info: *const vk::FenceCreateInfo<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::Fence) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY] makes(made, 1);
    vkResetFences(device: vk::Device, count: u32, fences: *const vk::Fence) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY];
    vkWaitForFences(device: vk::Device, count: u32, fences: *const vk::Fence, all: vk::Bool32, timeout: u64) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_DEVICE_LOST];
    vkCreateAccelerationStructureKHR(device: vk::Device, info: *const vk::AccelerationStructureCreateInfoKHR<'_>, callbacks: *const vk::AllocationCallbacks<'_>, made: *mut vk::AccelerationStructureKHR) [ERROR_OUT_OF_HOST_MEMORY] makes(made, 1);
    vkQueueWaitIdle(queue: vk::Queue) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_DEVICE_LOST];
    vkDeviceWaitIdle(device: vk::Device) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_DEVICE_LOST];
    vkQueueSubmit(queue: vk::Queue, count: u32, submits: *const vk::SubmitInfo<'_>, fence: vk::Fence) [ERROR_OUT_OF_HOST_MEMORY, ERROR_OUT_OF_DEVICE_MEMORY, ERROR_DEVICE_LOST];
}

destroying! {
    vkDestroyInstance[] vk::Instance;
    vkDestroyDevice[] vk::Device;
    vkDestroyDebugUtilsMessengerEXT[vk::Instance] vk::DebugUtilsMessengerEXT;
    vkDestroyBuffer[vk::Device] vk::Buffer;
    vkDestroyDescriptorSetLayout[vk::Device] vk::DescriptorSetLayout;
    vkDestroyDescriptorPool[vk::Device] vk::DescriptorPool;
    vkDestroyShaderModule[vk::Device] vk::ShaderModule;
    vkDestroyPipelineLayout[vk::Device] vk::PipelineLayout;
    vkDestroyPipeline[vk::Device] vk::Pipeline;
    vkDestroyPipelineCache[vk::Device] vk::PipelineCache;
    vkDestroyQueryPool[vk::Device] vk::QueryPool;
    vkDestroyCommandPool[vk::Device] vk::CommandPool;
    vkDestroyFence[vk::Device] vk::Fence;
    vkDestroyAccelerationStructureKHR[vk::Device] vk::AccelerationStructureKHR;
    vkFreeMemory[vk::Device] vk::DeviceMemory;
}

/// Returns true for functions without a result whose calls need not be noted.
fn harmless(name: &CStr) -> bool {
    const NAMES: [&str; 14] = [
        "vkGetPhysicalDeviceProperties",
        "vkGetPhysicalDeviceProperties2",
        "vkGetPhysicalDeviceFeatures",
        "vkGetPhysicalDeviceFeatures2",
        "vkGetPhysicalDeviceMemoryProperties",
        "vkGetPhysicalDeviceQueueFamilyProperties",
        "vkGetDeviceQueue",
        "vkGetBufferMemoryRequirements",
        "vkGetBufferDeviceAddress",
        "vkGetAccelerationStructureBuildSizesKHR",
        "vkGetAccelerationStructureDeviceAddressKHR",
        "vkUpdateDescriptorSets",
        "vkUnmapMemory",
        "vkFreeCommandBuffers",
    ];
    name.to_str().is_ok_and(|name| name.starts_with("vkCmd") || NAMES.contains(&name))
}

/// Replaces `vkGetInstanceProcAddr`.
///
/// # Safety
/// `instance` is null or an instance that is not destroyed, and `name` points to a NUL-terminated string.
unsafe extern "system" fn instance_function(
    instance: vk::Instance,
    name: *const c_char,
) -> vk::PFN_vkVoidFunction {
    // SAFETY: Vulkan's names are NUL-terminated.
    let name = unsafe { CStr::from_ptr(name) };
    // SAFETY: the caller guarantees the instance.
    unsafe { wrapped(instance, name) }
}

/// The loader's `vkGetDeviceProcAddr`.
static DEVICE_LOOKUP: AtomicPtr<c_void> = AtomicPtr::new(std::ptr::null_mut());

/// Replaces `vkGetDeviceProcAddr`. Functions with a schedule forward to the loader's own functions, which
/// find the device by the handle they are called with: they serve every device, with layers or without.
///
/// # Safety
/// `device` is a device that is not destroyed, and `name` points to a NUL-terminated string.
unsafe extern "system" fn device_function(device: vk::Device, name: *const c_char) -> vk::PFN_vkVoidFunction {
    // SAFETY: this function is handed out only after the loader's function is stored, which has this type.
    let lookup = unsafe {
        std::mem::transmute::<*mut c_void, vk::PFN_vkGetDeviceProcAddr>(DEVICE_LOOKUP.load(Ordering::Acquire))
    };
    // SAFETY: the caller guarantees device and name.
    let own = unsafe { lookup(device, name) }?;
    // SAFETY: Vulkan's names are NUL-terminated.
    let name = unsafe { CStr::from_ptr(name) };
    if harmless(name) {
        return Some(own);
    }
    let (slot, function) = known(name)?;
    if slot.load(Ordering::Acquire).is_null() { None } else { function }
}

/// Returns the wrapper of a function that can fail or that destroys, and the place of the loader's function.
fn known(name: &CStr) -> Option<(&'static AtomicPtr<c_void>, vk::PFN_vkVoidFunction)> {
    fallible(name).or_else(|| destroying(name))
}

/// Returns the function with that name, with the schedule around it; `None` for names that this module does
/// not know.
///
/// # Safety
/// As [`original`].
unsafe fn wrapped(instance: vk::Instance, name: &CStr) -> vk::PFN_vkVoidFunction {
    // SAFETY: the caller guarantees the instance.
    let own = unsafe { original(instance, name) }?;
    if name == c"vkGetDeviceProcAddr" {
        DEVICE_LOOKUP.store(own as *mut c_void, Ordering::Release);
        // Devices of this instance will look these functions up, possibly after the instance is destroyed.
        for name in FALLIBLE.iter().chain(DESTROYING) {
            let name = CString::new(*name).unwrap_or_default();
            // SAFETY: as above.
            if let (Some(own), Some((slot, _))) = (unsafe { original(instance, &name) }, known(&name)) {
                slot.store(own as *mut c_void, Ordering::Release);
            }
        }
        // SAFETY: Vulkan hands out functions as pointers without a type.
        return Some(unsafe {
            std::mem::transmute::<vk::PFN_vkGetDeviceProcAddr, unsafe extern "system" fn()>(device_function)
        });
    }
    if harmless(name) {
        return Some(own);
    }
    let (slot, function) = known(name)?;
    slot.store(own as *mut c_void, Ordering::Release);
    function
}
