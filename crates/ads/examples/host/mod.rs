//! Host of the examples: a small renderer with its own Vulkan instance, device, queue, command buffers and
//! buffers, and some triangles. [`Host::raw_device`] and [`Host::geometry`] show the objects that rasray is
//! handed; `hits.rs` is the loop that builds and traces.

#![allow(dead_code)] // Each example uses some of it.

pub mod hits;

use std::cell::RefCell;
use std::error::Error;

use rasray_ads::{Draw, Geometry, GeometryDesc, Hit, Ray};
use rasray_gpu::{Buffer, BufferUsage, Device, Feature, RawBuffer, RawDevice, ValidationLog, ash, vk};

pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

const VALIDATION: &std::ffi::CStr = c"VK_LAYER_KHRONOS_validation";
/// Maximum number of frames that the host has in flight.
pub const FRAMES: usize = 2;

/// A renderer with its own device, queue and frames. Every object made from it is destroyed before it.
pub struct Host {
    _entry: ash::Entry,
    instance: ash::Instance,
    /// Messenger of the validation layer, where the layer is installed.
    watcher: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    log: Box<ValidationLog>,
    physical: vk::PhysicalDevice,
    pub device: ash::Device,
    api_version: u32,
    queue: vk::Queue,
    family: u32,
    /// True if buffers have device addresses.
    addresses: bool,
    pool: vk::CommandPool,
    frames: Vec<(vk::CommandBuffer, vk::Fence)>,
    made: RefCell<Vec<Made>>,
}

/// Objects that are destroyed with the host.
enum Made {
    Buffer(vk::Buffer, vk::DeviceMemory),
    SetLayout(vk::DescriptorSetLayout),
    Pool(vk::DescriptorPool),
    Pipeline(vk::ShaderModule, vk::PipelineLayout, vk::Pipeline),
}

/// A buffer of the host in host-visible memory.
#[derive(Clone, Copy)]
pub struct HostBuffer {
    pub raw: vk::Buffer,
    pub size: u64,
    mapped: *mut u8,
}

impl Host {
    /// Makes a device with the given features and a queue for compute, and also for graphics if a feature
    /// concerns drawing.
    pub fn new(features: &[Feature]) -> Result<Self> {
        let draws = features.contains(&Feature::DynamicRendering);
        // SAFETY: every handle is used with the instance or device that it was made from, by this thread
        // alone, and the data that the calls point to outlives them.
        unsafe {
            let entry = ash::Entry::load()?;
            let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
            let info = vk::InstanceCreateInfo::default().application_info(&application);
            let layers = entry.enumerate_instance_layer_properties()?;
            let is_watched = layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION));
            let (layers, extensions) = ([VALIDATION.as_ptr()], [ash::ext::debug_utils::NAME.as_ptr()]);
            let watched = info.enabled_layer_names(&layers).enabled_extension_names(&extensions);
            let instance = entry.create_instance(if is_watched { &watched } else { &info }, None)?;
            // Messages of the validation layer; boxed, because the log must keep its address.
            let log = Box::<ValidationLog>::default();
            let watcher = if is_watched {
                let watcher = ash::ext::debug_utils::Instance::new(&entry, &instance);
                let messenger = watcher.create_debug_utils_messenger(&log.messenger(), None)?;
                Some((watcher, messenger))
            } else {
                eprintln!("the validation layer is not installed: calls are not checked");
                None
            };
            let physical = *instance.enumerate_physical_devices()?.first().ok_or("no Vulkan device")?;
            let mut wanted = vk::QueueFlags::COMPUTE;
            if draws {
                wanted |= vk::QueueFlags::GRAPHICS;
            }
            let families = instance.get_physical_device_queue_family_properties(physical);
            let family = families.iter().position(|family| family.queue_flags.contains(wanted));
            let family = family.ok_or("no queue has these capabilities")? as u32;
            let queues = vk::DeviceQueueCreateInfo::default().queue_family_index(family);
            let queues = [queues.queue_priorities(&[1.0])];
            let has = |feature| features.contains(&feature);
            let core = vk::PhysicalDeviceFeatures::default()
                .fragment_stores_and_atomics(has(Feature::FragmentStoresAndAtomics));
            let mut features_12 = vk::PhysicalDeviceVulkan12Features::default()
                .scalar_block_layout(has(Feature::ScalarBlockLayout))
                .buffer_device_address(has(Feature::BufferDeviceAddress));
            let mut synchronization = vk::PhysicalDeviceSynchronization2Features::default()
                .synchronization2(has(Feature::Synchronization2));
            let mut rendering =
                vk::PhysicalDeviceDynamicRenderingFeatures::default().dynamic_rendering(draws);
            // Extensions of Vulkan 1.2 that 1.3 has without a name.
            let version = instance.get_physical_device_properties(physical).api_version;
            let api_version = version.min(vk::API_VERSION_1_3);
            let mut names = Vec::new();
            if api_version < vk::API_VERSION_1_3 {
                names.push(ash::khr::synchronization2::NAME.as_ptr());
                names.extend(draws.then_some(ash::khr::dynamic_rendering::NAME.as_ptr()));
            }
            // Features of ray queries, if a structure asks for them.
            let mut trees =
                vk::PhysicalDeviceAccelerationStructureFeaturesKHR::default().acceleration_structure(true);
            let mut queries = vk::PhysicalDeviceRayQueryFeaturesKHR::default().ray_query(true);
            let names_of_queries = [
                ash::khr::acceleration_structure::NAME.as_ptr(),
                ash::khr::deferred_host_operations::NAME.as_ptr(),
                ash::khr::ray_query::NAME.as_ptr(),
            ];
            let mut info = vk::DeviceCreateInfo::default()
                .queue_create_infos(&queues)
                .enabled_features(&core)
                .push_next(&mut features_12)
                .push_next(&mut synchronization);
            if draws {
                info = info.push_next(&mut rendering);
            }
            if has(Feature::RayQuery) {
                names.extend(names_of_queries);
                info = info.push_next(&mut trees).push_next(&mut queries);
            }
            let info = info.enabled_extension_names(&names);
            let device = instance.create_device(physical, &info, None)?;
            let queue = device.get_device_queue(family, 0);
            let info = vk::CommandPoolCreateInfo::default()
                .queue_family_index(family)
                .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
            let pool = device.create_command_pool(&info, None)?;
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool);
            let commands = device.allocate_command_buffers(&info.command_buffer_count(FRAMES as u32))?;
            let signaled = vk::FenceCreateInfo::default().flags(vk::FenceCreateFlags::SIGNALED);
            let mut frames = Vec::new();
            for commands in commands {
                frames.push((commands, device.create_fence(&signaled, None)?));
            }
            let made = RefCell::default();
            Ok(Self {
                _entry: entry,
                instance,
                watcher,
                log,
                physical,
                device,
                api_version,
                queue,
                family,
                addresses: has(Feature::BufferDeviceAddress),
                pool,
                frames,
                made,
            })
        }
    }

    /// Describes the device to rasray. `enabled` are the features with which the device was made.
    pub fn raw_device(&self, enabled: &[Feature]) -> RawDevice {
        RawDevice {
            instance: self.instance.clone(),
            physical: self.physical,
            device: self.device.clone(),
            queue: self.queue,
            queue_family: self.family,
            api_version: self.api_version,
            enabled: enabled.to_vec(),
            // The validation layer may be older than 1.3.242, with which labels are not allowed.
            debug_utils: false,
            pipeline_cache: vk::PipelineCache::null(),
            memory: None,
            memory_limit: None,
        }
    }

    /// Waits until the device has finished a frame.
    pub fn wait(&self, frame: usize) -> Result<()> {
        // SAFETY: the fence is of this device and waited for by this thread alone.
        Ok(unsafe { self.device.wait_for_fences(&[self.frames[frame].1], true, u64::MAX) }?)
    }

    /// Waits until the device has finished all work.
    pub fn wait_for_all(&self) -> Result<()> {
        // SAFETY: nothing else submits to the device.
        Ok(unsafe { self.device.device_wait_idle() }?)
    }

    /// Records a frame that has been waited for, and submits it.
    pub fn submit<R>(&self, frame: usize, record: impl FnOnce(vk::CommandBuffer) -> Result<R>) -> Result<R> {
        let (commands, fence) = self.frames[frame];
        // SAFETY: the device has finished using the command buffer and the fence, which this thread alone
        // uses.
        unsafe {
            self.device.begin_command_buffer(commands, &vk::CommandBufferBeginInfo::default())?;
            let recorded = record(commands)?;
            self.device.end_command_buffer(commands)?;
            self.device.reset_fences(&[fence])?;
            let commands = [commands];
            self.device.queue_submit(
                self.queue,
                &[vk::SubmitInfo::default().command_buffers(&commands)],
                fence,
            )?;
            Ok(recorded)
        }
    }

    /// Makes a storage buffer that contains the values.
    pub fn buffer<T: bytemuck::NoUninit>(&self, values: &[T]) -> Result<HostBuffer> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        let mut usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::TRANSFER_DST
            | vk::BufferUsageFlags::TRANSFER_SRC;
        let mut flags = vk::MemoryAllocateFlagsInfo::default();
        if self.addresses {
            usage |= vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS;
            flags = flags.flags(vk::MemoryAllocateFlags::DEVICE_ADDRESS);
        }
        let info = vk::BufferCreateInfo::default().size(bytes.len() as u64).usage(usage);
        let seen = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        // SAFETY: the memory is of a type that suits the buffer, and stays mapped as long as the buffer
        // exists.
        let buffer = unsafe {
            let raw = self.device.create_buffer(&info, None)?;
            let needs = self.device.get_buffer_memory_requirements(raw);
            let memories = self.instance.get_physical_device_memory_properties(self.physical);
            let mut types = memories.memory_types_as_slice().iter().enumerate();
            let kind = types.position(|(k, memory)| {
                needs.memory_type_bits >> k & 1 != 0 && memory.property_flags.contains(seen)
            });
            let kind = kind.ok_or("no host-visible memory")? as u32;
            let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(kind);
            let info = info.push_next(&mut flags);
            let memory = self.device.allocate_memory(&info, None)?;
            self.device.bind_buffer_memory(raw, memory, 0)?;
            self.made.borrow_mut().push(Made::Buffer(raw, memory));
            let mapped = self.device.map_memory(memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())?;
            HostBuffer { raw, size: bytes.len() as u64, mapped: mapped.cast() }
        };
        buffer.write(values);
        Ok(buffer)
    }

    /// Makes a compute pipeline, its layout, and a set with number 0 with one buffer; `sets` are the layouts
    /// of sets 1 and up.
    pub fn pipeline(
        &self,
        spirv: &[u32],
        sets: &[vk::DescriptorSetLayout],
        constants: &[(u32, u32)],
        buffer: HostBuffer,
    ) -> Result<(vk::Pipeline, vk::PipelineLayout, vk::DescriptorSet)> {
        let device = &self.device;
        let binding = vk::DescriptorSetLayoutBinding::default()
            .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
            .descriptor_count(1)
            .stage_flags(vk::ShaderStageFlags::COMPUTE);
        let entries: Vec<_> = (0..constants.len())
            .map(|k| vk::SpecializationMapEntry {
                constant_id: constants[k].0,
                offset: 4 * k as u32,
                size: 4,
            })
            .collect();
        let values: Vec<u8> = constants.iter().flat_map(|(_, bits)| bits.to_ne_bytes()).collect();
        let constants = vk::SpecializationInfo::default().map_entries(&entries).data(&values);
        // SAFETY: all handles are of this device, and the data that the calls point to outlives them.
        unsafe {
            let bindings = [binding];
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let own = device.create_descriptor_set_layout(&info, None)?;
            self.made.borrow_mut().push(Made::SetLayout(own));
            let layouts: Vec<_> = std::iter::once(own).chain(sets.iter().copied()).collect();
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts);
            let layout = device.create_pipeline_layout(&info, None)?;
            let module =
                device.create_shader_module(&vk::ShaderModuleCreateInfo::default().code(spirv), None)?;
            let stage = vk::PipelineShaderStageCreateInfo::default()
                .stage(vk::ShaderStageFlags::COMPUTE)
                .module(module)
                .name(c"main")
                .specialization_info(&constants);
            let info = vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout);
            let pipelines = device
                .create_compute_pipelines(vk::PipelineCache::null(), &[info], None)
                .map_err(|(_, error)| error)?;
            self.made.borrow_mut().push(Made::Pipeline(module, layout, pipelines[0]));
            let sizes =
                [vk::DescriptorPoolSize { ty: vk::DescriptorType::STORAGE_BUFFER, descriptor_count: 1 }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            let pool = device.create_descriptor_pool(&info, None)?;
            self.made.borrow_mut().push(Made::Pool(pool));
            let owns = [own];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&owns);
            let set = device.allocate_descriptor_sets(&info)?[0];
            let info = [vk::DescriptorBufferInfo { buffer: buffer.raw, offset: 0, range: vk::WHOLE_SIZE }];
            let write = vk::WriteDescriptorSet::default()
                .dst_set(set)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .buffer_info(&info);
            device.update_descriptor_sets(&[write], &[]);
            Ok((pipelines[0], layout, set))
        }
    }

    /// Returns an error if the validation layer complained, or if the hits differ from the expected ones.
    pub fn compare(&self, found: &[Hit], expected: &[Hit]) -> Result<()> {
        let same = found.iter().zip(expected).filter(|(found, expected)| found == expected).count();
        let hit = expected.iter().filter(|hit| hit.is_hit()).count();
        println!("{hit} of {} rays hit, {same} answers are those of brute force", expected.len());
        self.is_silent()?;
        (same == expected.len() && hit > 100).then_some(()).ok_or("hits differ".into())
    }

    /// Returns an error if the validation layer complained.
    pub fn is_silent(&self) -> Result<()> {
        let complaints = self.log.messages();
        if complaints.is_empty() { Ok(()) } else { Err(complaints.join("\n").into()) }
    }

    /// Describes triangles in buffers of the host as a rasray geometry.
    pub fn geometry(&self, device: &Device, mesh: &Mesh, positions: HostBuffer) -> Result<Geometry> {
        let triangle_count = mesh.indices.len() as u32 / 3;
        let draws = [Draw { first_triangle: 0, triangle_count, ..Draw::default() }];
        let desc = GeometryDesc {
            positions: self.adopted(device, "positions", positions).into(),
            indices: self.adopted(device, "indices", self.buffer(&mesh.indices)?).into(),
            draws: self.adopted(device, "draws", self.buffer(&draws)?).into(),
            vertex_count: mesh.positions.len() as u32,
            triangle_count,
            count: None,
            draw_count: 1,
            bounds: mesh.bounds,
            frame_origin: [0.0; 3],
        };
        Ok(Geometry::new(device, desc)?)
    }

    /// Wraps a buffer of the host in a rasray buffer.
    pub fn adopted(&self, device: &Device, name: &str, buffer: HostBuffer) -> Buffer {
        let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_DST | BufferUsage::TRANSFER_SRC;
        // SAFETY: `buffer` made it with this usage and size, and it is destroyed with the host, after all
        // objects made from `device`.
        unsafe { device.buffer_from_raw(&RawBuffer { name, raw: buffer.raw, size: buffer.size, usage }) }
    }
}

impl HostBuffer {
    /// Overwrites the buffer from its start; the device must not be using it.
    pub fn write<T: bytemuck::NoUninit>(&self, values: &[T]) {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        assert!(bytes.len() as u64 <= self.size);
        // SAFETY: the mapping is as long as the buffer, and `values` cannot overlap it.
        unsafe { std::ptr::copy_nonoverlapping(bytes.as_ptr(), self.mapped, bytes.len()) };
    }

    /// Returns the complete contents of the buffer; the device must have finished with it.
    pub fn read<T: bytemuck::AnyBitPattern>(&self) -> Vec<T> {
        // SAFETY: the mapping is as long as the buffer, and every bit pattern is valid for bytes.
        let bytes = unsafe { std::slice::from_raw_parts(self.mapped, self.size as usize) };
        bytes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned).collect()
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: the device is idle, all objects that rasray made from it are gone, and each handle is
        // destroyed once.
        unsafe {
            let _ = self.device.device_wait_idle();
            for made in self.made.take() {
                match made {
                    Made::Buffer(buffer, memory) => {
                        self.device.destroy_buffer(buffer, None);
                        self.device.free_memory(memory, None);
                    }
                    Made::SetLayout(layout) => self.device.destroy_descriptor_set_layout(layout, None),
                    Made::Pool(pool) => self.device.destroy_descriptor_pool(pool, None),
                    Made::Pipeline(module, layout, pipeline) => {
                        self.device.destroy_pipeline(pipeline, None);
                        self.device.destroy_pipeline_layout(layout, None);
                        self.device.destroy_shader_module(module, None);
                    }
                }
            }
            for (_, fence) in &self.frames {
                self.device.destroy_fence(*fence, None);
            }
            self.device.destroy_command_pool(self.pool, None);
            self.device.destroy_device(None);
            if let Some((watcher, messenger)) = &self.watcher {
                watcher.destroy_debug_utils_messenger(*messenger, None);
            }
            self.instance.destroy_instance(None);
        }
    }
}

/// Triangles of the host: positions and indices.
pub struct Mesh {
    pub positions: Vec<[f32; 3]>,
    pub indices: Vec<u32>,
    pub bounds: [[f32; 3]; 2],
}

/// Makes upright steps of two triangles each, each step behind the one below it.
pub fn staircase(steps: u32) -> Mesh {
    let (y, up) = (|k: u32| k as f32 / steps as f32, 1.0 / steps as f32);
    let step = |k| [[0.0, y(k), y(k)], [1.0, y(k), y(k)], [0.0, y(k) + up, y(k)], [1.0, y(k) + up, y(k)]];
    let positions = (0..steps).flat_map(step).collect();
    let indices = (0..6 * steps).map(|k| 4 * (k / 6) + [0, 1, 2, 2, 1, 3][k as usize % 6]).collect();
    Mesh { positions, indices, bounds: [[0.0; 3], [1.0, 1.001, 1.0]] }
}

/// Makes rays, many of which hit the stairs.
pub fn rays() -> Vec<Ray> {
    let origin = |k: u32| [0.1 + 0.0007 * k as f32, 0.0003 + 0.00099 * k as f32, -1.0];
    (0..1000).map(|k| Ray::new(origin(k), [0.05, 0.01, 1.0])).collect()
}
