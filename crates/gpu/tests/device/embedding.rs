//! Use of a device and a command buffer of a host.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::device::common::{Scale, finish};
use rasray_gpu::*;

fn raw(host: &Device) -> RawDevice {
    RawDevice {
        instance: host.raw_instance().clone(),
        physical: host.raw_physical(),
        device: host.raw().clone(),
        queue: host.raw_queue(),
        queue_family: host.queue_family(),
        api_version: host.api_version(),
        enabled: host.enabled(),
        debug_utils: true,
        pipeline_cache: vk::PipelineCache::null(),
        memory: None,
        memory_limit: None,
    }
}

fn adopt(raw: RawDevice) -> Result<Device> {
    // SAFETY: `raw` describes a device that this crate made; the tests keep it until the adopted device is
    // dropped and do not use its queue meanwhile.
    unsafe { Device::from_raw(raw) }
}

/// Memory source that counts the pieces that it gives out.
struct Counted {
    pool: PooledMemory,
    alive: Arc<AtomicUsize>,
}

// SAFETY: the pool does all the work.
unsafe impl Memory for Counted {
    fn allocate(
        &self,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        name: &str,
    ) -> Result<Allocation> {
        let piece = self.pool.allocate(requirements, location, name)?;
        self.alive.fetch_add(1, Ordering::SeqCst);
        Ok(piece)
    }

    unsafe fn free(&self, allocation: Allocation) {
        self.alive.fetch_sub(1, Ordering::SeqCst);
        // SAFETY: the caller guarantees the conditions of `free`.
        unsafe { self.pool.free(allocation) };
    }
}

#[test]
fn an_adopted_device_runs_the_same_work_and_destroys_nothing_of_the_host() {
    let host = crate::device::common::device();
    let device = adopt(raw(&host)).expect("adoption");
    assert_eq!((device.name(), device.why_chosen()), (host.name(), "handed in by the host"));
    let scale = Scale::new(&device, 100);
    device
        .submit_passes(Timing::Host, |recorder| {
            scale.bind(recorder, 4);
            recorder.begin_pass(Stage::Build, "scale");
            scale.dispatch(recorder);
            recorder.end_pass();
        })
        .expect("submission");
    assert_eq!(scale.values(&device), (0..100).map(|i| i * 4 + Scale::BIAS).collect::<Vec<u32>>());
    drop(device);
    drop(scale);

    let scale = Scale::new(&host, 10);
    host.submit(|recorder| {
        scale.bind(recorder, 1);
        scale.dispatch(recorder);
    })
    .expect("the host's device still works");
    drop(scale);
    finish(host);
}

#[test]
fn memory_cache_and_limit_of_the_host_are_used() {
    let host = crate::device::common::device();
    let alive = Arc::new(AtomicUsize::new(0));
    let pool = PooledMemory::new(host.raw_instance(), host.raw_physical(), host.raw(), false).expect("pool");
    // SAFETY: a cache without initial data has no conditions.
    let cache = unsafe { host.raw().create_pipeline_cache(&vk::PipelineCacheCreateInfo::default(), None) }
        .expect("pipeline cache");
    let device = adopt(RawDevice {
        pipeline_cache: cache,
        memory: Some(Arc::new(Counted { pool, alive: alive.clone() })),
        memory_limit: Some(1 << 20),
        ..raw(&host)
    })
    .expect("adoption");
    let scale = Scale::new(&device, 1000);
    assert_eq!(alive.load(Ordering::SeqCst), 1);
    let desc = BufferDesc {
        name: "over the limit",
        size: 2 << 20,
        usage: BufferUsage::STORAGE,
        location: MemoryLocation::Device,
    };
    assert!(matches!(device.create_buffer(&desc), Err(GpuError::OutOfDeviceMemory { .. })));
    assert_eq!(host.allocated_bytes(), 0, "the books of the two are separate");
    drop((scale, device));
    assert_eq!(alive.load(Ordering::SeqCst), 0);
    // SAFETY: the device that used the cache is destroyed.
    unsafe { host.raw().destroy_pipeline_cache(cache, None) };
    finish(host);
}

#[test]
fn a_false_description_of_a_device_is_refused() {
    let host = crate::device::common::device();
    let error = adopt(RawDevice { enabled: vec![Feature::ScalarBlockLayout], ..raw(&host) })
        .expect_err("no barriers");
    assert!(
        matches!(error, GpuError::FeatureNotEnabled { feature: Feature::Synchronization2, .. }),
        "{error}"
    );
    let error = adopt(RawDevice { queue_family: 1000, ..raw(&host) }).expect_err("no such family");
    assert!(matches!(error, GpuError::InvalidUse { .. }), "{error}");
    let error = adopt(RawDevice { api_version: vk::API_VERSION_1_1, ..raw(&host) }).expect_err("too old");
    assert!(error.to_string().contains("Vulkan 1.2"), "{error}");
    finish(host);
}

#[test]
fn a_command_buffer_of_the_host_is_recorded_into() {
    let device = crate::device::common::device();
    let scale = Scale::new(&device, 64);
    let timers = device.create_timers(1).expect("timers");
    let raw = device.raw();
    let info = vk::CommandPoolCreateInfo::default().queue_family_index(device.queue_family());
    // SAFETY: these are plain Vulkan calls of a host: every handle is made from this device, the recording
    // ends before the submission, which is waited for before anything is destroyed, and nothing else uses the
    // queue.
    unsafe {
        let pool = raw.create_command_pool(&info, None).expect("command pool");
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        let command = raw.allocate_command_buffers(&info).expect("command buffer")[0];
        raw.begin_command_buffer(command, &vk::CommandBufferBeginInfo::default()).expect("begin");
        // The host wraps a buffer that it already has.
        let buffer = device.buffer_from_raw(&RawBuffer {
            name: "the host's values",
            raw: scale.buffer.raw(),
            size: scale.buffer.size(),
            usage: BufferUsage::STORAGE,
        });
        let set = device.create_binding_set(&scale.layout, "of the host", &[&buffer]).expect("binding set");
        let mut recorder = Recorder::from_raw(&device, command);
        recorder.set_timers(&timers);
        recorder.bind_compute(&scale.pipeline);
        recorder.bind_sets(0, &[&set]);
        recorder.push_constants(crate::device::common::bytes_of(&[64, 10]));
        recorder.begin_pass(Stage::Build, "timed");
        scale.dispatch(&mut recorder);
        recorder.end_pass();
        recorder.begin_pass(Stage::Build, "beyond the capacity");
        recorder.end_pass();
        recorder.barrier(Access::COMPUTE_WRITE, Access::TRANSFER_READ | Access::HOST_READ);
        let recorded = recorder.finish().expect("no mistake");
        // Recorded resources live until the device has finished, even if all owners drop them.
        drop((set, buffer));
        raw.end_command_buffer(command).expect("end");
        let commands = [command];
        let submit = vk::SubmitInfo::default().command_buffers(&commands);
        raw.queue_submit(device.raw_queue(), &[submit], vk::Fence::null()).expect("submit");
        raw.queue_wait_idle(device.raw_queue()).expect("wait");
        drop(recorded);
        raw.destroy_command_pool(pool, None);
    }
    let passes = timers.read().expect("waited for");
    assert_eq!(passes.len(), 1);
    assert_eq!(passes[0].label, "timed");
    assert!(timers.read().expect("nothing left").is_empty());
    assert_eq!(scale.values(&device), (0..64).map(|i| i * 10 + Scale::BIAS).collect::<Vec<u32>>());
    drop((scale, timers));
    finish(device);
}

#[test]
fn a_device_without_a_queue_records_but_does_not_submit() {
    let host = crate::device::common::device();
    let device = adopt(RawDevice { queue: vk::Queue::null(), ..raw(&host) }).expect("adoption");
    let error = device.submit(|_| ()).expect_err("no queue");
    assert!(error.to_string().contains("without a queue"), "{error}");
    drop(device);
    finish(host);
}
