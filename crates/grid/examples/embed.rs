//! A uniform grid in a plain ash program with its own device, on a queue that only computes: built, traced, compared with brute
//! force.

use std::error::Error;
use std::sync::atomic::{AtomicU32, Ordering};

use rasray_ads::{
    BruteForce, Check, Domain, Draw, Geometry, GeometryDesc, Hit, Ray, RayQueue, Structure, TraceMode,
};
use rasray_gpu::{BufferUsage, Device, RawDevice, Recorder, ash, vk};
use rasray_grid::{Config, Grid};
use vk::DebugUtilsMessageSeverityFlagsEXT as Severity;

const VALIDATION: &std::ffi::CStr = c"VK_LAYER_KHRONOS_validation";
static COMPLAINTS: AtomicU32 = AtomicU32::new(0);

/// Counts and prints what the validation layer says.
unsafe extern "system" fn complain(
    _severity: Severity,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    message: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    _user: *mut std::ffi::c_void,
) -> vk::Bool32 {
    COMPLAINTS.fetch_add(1, Ordering::Relaxed);
    // SAFETY: the layer hands in a message with a text that ends with zero.
    eprintln!("{:?}", unsafe { (*message).message_as_c_str() });
    vk::FALSE
}

/// Runs the program; an error where hits differ or the validation layer complains.
pub fn main() -> Result<(), Box<dyn Error>> {
    // SAFETY: every handle is used with the instance or device that it was made from, by this thread alone, and what
    // the calls point to outlives them. All that is said to be enabled is enabled above it. Every submission is waited
    // for. At the end all that was made from `adopted` is dropped, then pool, device, messenger and instance are
    // destroyed, each once and not used again; an early return destroys none of these four.
    unsafe {
        let entry = ash::Entry::load()?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
        let messenger = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(Severity::WARNING | Severity::ERROR)
            .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
            .pfn_user_callback(Some(complain));
        let info = vk::InstanceCreateInfo::default().application_info(&application);
        let (layers, extensions) = ([VALIDATION.as_ptr()], [ash::ext::debug_utils::NAME.as_ptr()]);
        let info = info.enabled_layer_names(&layers).enabled_extension_names(&extensions);
        let instance = entry.create_instance(&info, None)?;
        let watcher = ash::ext::debug_utils::Instance::new(&entry, &instance);
        let messenger = watcher.create_debug_utils_messenger(&messenger, None)?;
        let physical = *instance.enumerate_physical_devices()?.first().ok_or("no Vulkan device")?;
        let families = instance.get_physical_device_queue_family_properties(physical);
        let family = families.iter().position(|f| f.queue_flags.contains(vk::QueueFlags::COMPUTE));
        let family = family.ok_or("no queue computes")? as u32;
        let queues =
            [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&[1.0])];
        let mut features_12 = vk::PhysicalDeviceVulkan12Features::default().scalar_block_layout(true);
        let mut features_13 = vk::PhysicalDeviceVulkan13Features::default().synchronization2(true);
        let info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .push_next(&mut features_12)
            .push_next(&mut features_13);
        let device = instance.create_device(physical, &info, None)?;
        let queue = device.get_device_queue(family, 0);
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(family);
        let pool = device.create_command_pool(&info, None)?;
        let config = Config::new();
        let adopted = Device::from_raw(RawDevice {
            instance: instance.clone(),
            physical,
            device: device.clone(),
            queue,
            queue_family: family,
            api_version: vk::API_VERSION_1_3,
            enabled: Grid::requirements_of(&config).required,
            debug_utils: true,
            pipeline_cache: vk::PipelineCache::null(),
            memory: None,
            memory_limit: None,
        })?;
        let geometry = staircase(&adopted, 500)?;
        let mut grid = Grid::new(&adopted, config, &geometry, None)?;
        let mut judge = BruteForce::new(&adopted, &geometry, None, false)?;
        let host = (&device, queue, pool);
        let found = hits(&adopted, host, &mut grid)?;
        let expected = hits(&adopted, host, &mut judge)?;
        let hit = expected.iter().filter(|hit| hit.is_hit()).count();
        let same = found.iter().zip(&expected).filter(|(a, b)| a == b).count();
        println!("{hit} of {} rays hit, {same} answers are those of brute force", expected.len());
        drop((grid, judge, geometry, adopted));
        device.destroy_command_pool(pool, None);
        device.destroy_device(None);
        watcher.destroy_debug_utils_messenger(messenger, None);
        instance.destroy_instance(None);
        let sound = same == 1000 && hit > 100 && COMPLAINTS.load(Ordering::Relaxed) == 0;
        sound.then_some(()).ok_or("hits differ, or the validation layer complained".into())
    }
}

/// Steps of two triangles each.
fn staircase(device: &Device, steps: u32) -> Result<Geometry, Box<dyn Error>> {
    let y = |k: u32| k as f32 / steps as f32;
    let corner = |k: u32, x: f32, up: f32| [x, y(k) + up, y(k)];
    let step = |k| [corner(k, 0.0, 0.0), corner(k, 1.0, 0.0), corner(k, 0.0, 0.003), corner(k, 1.0, 0.003)];
    let positions: Vec<[f32; 3]> = (0..steps).flat_map(step).collect();
    let indices: Vec<u32> =
        (0..6 * steps).map(|k| 4 * (k / 6) + [0, 1, 2, 2, 1, 3][k as usize % 6]).collect();
    let draws = [Draw { first_triangle: 0, triangle_count: 2 * steps, instance: 0, flags: 0 }];
    let desc = GeometryDesc {
        positions: device.create_buffer_with("positions", BufferUsage::STORAGE, &positions)?,
        indices: device.create_buffer_with("indices", BufferUsage::STORAGE, &indices)?,
        draws: device.create_buffer_with("draws", BufferUsage::STORAGE, &draws)?,
        vertex_count: 4 * steps,
        triangle_count: 2 * steps,
        draw_count: 1,
        bounds: [[0.0; 3], [1.0, 1.003, 1.0]],
        frame_origin: [0.0; 3],
    };
    Ok(Geometry::new(device, desc)?)
}

/// Builds and traces in one command buffer of the host; once more where a build asks for more room.
///
/// # Safety
/// Device, queue and pool belong together and to this thread alone, and `adopted` was made from that device.
unsafe fn hits(
    adopted: &Device,
    (device, queue, pool): (&ash::Device, vk::Queue, vk::CommandPool),
    structure: &mut dyn Structure,
) -> Result<Vec<Hit>, Box<dyn Error>> {
    let origin = |k: u32| [0.1 + 0.0007 * k as f32, 0.0003 + 0.00099 * k as f32, -1.0];
    let rays: Vec<_> = (0..1000).map(|k| Ray::new(origin(k), [0.05, 0.01, 1.0])).collect();
    let queued = RayQueue::new(adopted, "rays", rays.len() as u32, false)?;
    adopted.upload_slice(queued.rays(), 0, &rays)?;
    loop {
        structure.prepare_build(adopted)?;
        // SAFETY: the command buffer is the host's alone, and what is recorded outlives the wait below.
        unsafe {
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
            let commands = device.allocate_command_buffers(&info)?;
            device.begin_command_buffer(commands[0], &vk::CommandBufferBeginInfo::default())?;
            let mut recorder = Recorder::from_raw(adopted, commands[0]);
            queued.record_reset(&mut recorder);
            structure.record_build(&mut recorder, 0, [0.5, 0.5, -0.5].into())?;
            structure.record_trace(
                &mut recorder,
                &queued,
                Domain::First(1000),
                TraceMode::Closest,
                structure.rounds(),
            );
            let recorded = recorder.finish()?;
            device.end_command_buffer(commands[0])?;
            let submit = vk::SubmitInfo::default().command_buffers(&commands);
            device.queue_submit(queue, &[submit], vk::Fence::null())?;
            device.queue_wait_idle(queue)?;
            drop(recorded);
        }
        match structure.check(&structure.status(0)?, 0)? {
            Check::Complete => return Ok(adopted.download_as(queued.hits(), 0, rays.len())?),
            Check::Grow(sizes) => structure.resize(adopted, &sizes)?,
        }
    }
}
