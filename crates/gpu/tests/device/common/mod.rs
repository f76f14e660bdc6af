//! Helpers of the tests: a device with validation, and the objects of the smallest compute pass.

#![allow(dead_code, reason = "each test binary uses a part")]

pub mod shaders;

use rasray_gpu::*;

/// Returns the device floor and the features that the raster tests need.
pub fn requirements() -> Requirements {
    Requirements::floor()
        .merge(&Requirements { required: vec![Feature::FragmentStoresAndAtomics], ..Requirements::default() })
}

/// Makes a device with validation.
pub fn device() -> Device {
    device_with(requirements())
}

pub fn device_with(requirements: Requirements) -> Device {
    let desc = DeviceDesc { requirements, validation: true, ..DeviceDesc::default() };
    Device::create(&desc).expect("a Vulkan device and the validation layer")
}

/// Drops the last handle of a device and checks that validation reported nothing during its whole life.
pub fn finish(device: Device) {
    let log = device.validation_log();
    assert_eq!(device.allocated_bytes(), 0, "memory is left");
    drop(device);
    assert_eq!(log.messages(), Vec::<String>::new());
}

pub fn storage(device: &Device, name: &str, size: u64) -> Buffer {
    let desc = BufferDesc { name, size, usage: BufferUsage::ALL, location: MemoryLocation::Device };
    device.create_buffer(&desc).expect("memory for a test")
}

/// Pipeline of [`shaders::SCALE`] and a buffer of `count` values 0, 1, 2 …
pub struct Scale {
    pub pipeline: ComputePipeline,
    pub layout: SetLayout,
    pub set: BindingSet,
    pub buffer: Buffer,
    pub count: u32,
}

impl Scale {
    pub const BIAS: u32 = 5;

    pub fn new(device: &Device, count: u32) -> Self {
        let buffer = storage(device, "values", u64::from(count) * 4);
        let values: Vec<u32> = (0..count).collect();
        device.upload_slice(&buffer, 0, &values).expect("upload");
        let layout = device.create_set_layout("scale", 1).expect("set layout");
        let set = device.create_binding_set(&layout, "scale", &[&buffer]).expect("binding set");
        let pipeline = device
            .create_compute_pipeline(&ComputePipelineDesc {
                name: "scale",
                module: &module(shaders::SCALE),
                sets: &[&layout],
                push_constant_bytes: 8,
                constants: &[(7, Self::BIAS)],
            })
            .expect("pipeline");
        Self { pipeline, layout, set, buffer, count }
    }

    pub fn bind(&self, recorder: &mut Recorder<'_>, factor: u32) {
        recorder.bind_compute(&self.pipeline);
        recorder.bind_sets(0, &[&self.set]);
        recorder.push_constants(bytes_of(&[self.count, factor]));
    }

    pub fn dispatch(&self, recorder: &mut Recorder<'_>) {
        recorder.dispatch([self.count.div_ceil(64), 1, 1]);
    }

    pub fn values(&self, device: &Device) -> Vec<u32> {
        device.download_as(&self.buffer, 0, self.count as usize).expect("download")
    }
}

/// Vouches for one of [`shaders`].
pub fn module(words: &'static [u32]) -> TrustedModule {
    // SAFETY: these shaders end, and index their buffers below the counts that tests give them.
    unsafe { TrustedModule::new(words.into()) }
}

pub fn bytes_of(words: &[u32]) -> &[u8] {
    bytemuck::cast_slice(words)
}
