//! Errors; each names the object or pass that it concerns, and the remedy if there is one.

use ash::vk;

use crate::features::Feature;

/// Result of this crate. The error type can be replaced, so that code with a glob import can still write
/// `Result<T, E>`.
pub type Result<T, E = GpuError> = std::result::Result<T, E>;

/// An error of the Vulkan layer.
#[derive(Debug, Clone, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// The Vulkan loader library could not be opened.
    #[error("the Vulkan loader could not be loaded ({reason}): install it (Debian package libvulkan1)")]
    LoaderMissing {
        /// Message of the dynamic linker.
        reason: String,
    },
    /// The loader knows only Vulkan 1.0 or 1.1.
    #[error("the Vulkan loader supports version {found} only: install a loader for Vulkan 1.2 or newer")]
    LoaderTooOld {
        /// The version found, as `major.minor`.
        found: String,
    },
    /// Validation was requested, but its layer is not installed.
    #[error(
        "validation was asked for, but VK_LAYER_KHRONOS_validation is not installed: \
         install the Debian package vulkan-validationlayers or switch validation off"
    )]
    ValidationLayerMissing,
    /// There is no Vulkan driver or no device.
    #[error(
        "no Vulkan device was found: install a driver (a software one is in the Debian package \
         mesa-vulkan-drivers)"
    )]
    NoDevice,
    /// No device has the requested index or name.
    #[error(
        "no Vulkan device matches `{preference}`: give an index or a part of a name from this list\n{devices}"
    )]
    NoMatchingDevice {
        /// The preference as given.
        preference: String,
        /// List of devices, one per line.
        devices: String,
    },
    /// Devices exist, but none fulfils the requirements.
    #[error("no Vulkan device has everything that is required:\n{devices}")]
    NoSuitableDevice {
        /// List of devices with the requirements that each lacks, one per line.
        devices: String,
    },
    /// An object or call needs a feature that was not enabled.
    #[error(
        "{what} needs the device feature {feature}: add it to the requirements the device is created with"
    )]
    FeatureNotEnabled {
        /// Feature that is needed.
        feature: Feature,
        /// Object or call that needs the feature.
        what: String,
    },
    /// A buffer exceeds the maximum size of a storage buffer binding. Pools of structures can be reached by
    /// device address instead (`addressing` of their configurations); other buffers cannot.
    #[error(
        "buffer `{name}` has {size} bytes, but a storage buffer binding ends at {limit} bytes on this device"
    )]
    TooLarge {
        /// Name of the buffer.
        name: String,
        /// Size of the binding in bytes.
        size: u64,
        /// Maximum size of a binding in bytes.
        limit: u64,
    },
    /// Memory is exhausted, or the memory limit given for this device would be exceeded.
    #[error(
        "no memory for `{name}`, says {refused_by}: {asked} bytes asked for, {limit} bytes are the limit, \
         {allocated} are in use"
    )]
    OutOfDeviceMemory {
        /// Name of the buffer.
        name: String,
        /// Requested bytes.
        asked: u64,
        /// Limit in bytes: the limit given for the device, else the capacity of the device.
        limit: u64,
        /// Bytes in use through this device at the time of the error.
        allocated: u64,
        /// Origin of the refusal: a Vulkan call, or the name of a limit.
        refused_by: &'static str,
    },
    /// Memory could not be allocated although some is left: no memory type fits, or the driver refused to
    /// allocate or map it.
    #[error("memory for `{name}` could not be had: {reason}")]
    Memory {
        /// Name of the buffer, or "memory pool".
        name: String,
        /// Report of the allocator.
        reason: String,
    },
    /// The driver has no device memory left for an object other than the memory of a buffer.
    #[error(
        "the device ran out of memory in {call} for `{during}`: free memory or give it less work at once"
    )]
    DeviceMemoryExhausted {
        /// Vulkan call that reported the error.
        call: &'static str,
        /// Name of the object or pass.
        during: String,
    },
    /// The driver has no host memory left.
    #[error("there was no host memory in {call} for `{during}`: free memory or make it smaller")]
    OutOfHostMemory {
        /// Vulkan call that reported the error.
        call: &'static str,
        /// Name of the object or pass.
        during: String,
    },
    /// A device limit would be exceeded.
    #[error("`{name}`: {what} is {asked}, but this device allows at most {limit}")]
    LimitExceeded {
        /// Name of the object or pass.
        name: String,
        /// Quantity that exceeds the limit.
        what: &'static str,
        /// Requested value.
        asked: u64,
        /// Maximum value.
        limit: u64,
    },
    /// A range lies outside its buffer.
    #[error("{size} bytes at offset {offset} do not lie within buffer `{name}` of {buffer_size} bytes")]
    OutOfRange {
        /// Name of the buffer.
        name: String,
        /// Start of the range in bytes.
        offset: u64,
        /// Length of the range in bytes.
        size: u64,
        /// Size of the buffer in bytes.
        buffer_size: u64,
    },
    /// The words of a shader are not a SPIR-V module.
    #[error("shader of `{name}` is no SPIR-V module: {reason}")]
    InvalidShader {
        /// Name of the pipeline.
        name: String,
        /// Fault of the words.
        reason: &'static str,
    },
    /// A call that the contract of this crate forbids.
    #[error("`{name}`: {reason}")]
    InvalidUse {
        /// Name of the object or pass.
        name: String,
        /// Fault of the call, in words.
        reason: String,
    },
    /// The device was lost, usually by a fault in a shader or by the watchdog of the system.
    #[error(
        "the device was lost, says {call} for `{during}`: a shader ran too long or touched memory it may not; \
         create a new device"
    )]
    DeviceLost {
        /// Vulkan call that reported the error.
        call: &'static str,
        /// Name of the object or pass.
        during: String,
    },
    /// The device did not finish in time.
    #[error(
        "the device did not finish `{pass}` within {seconds} s: give it less work at once or a longer timeout"
    )]
    Timeout {
        /// Label of the pass, or of all passes of the submission.
        pass: String,
        /// Timeout in seconds.
        seconds: f64,
    },
    /// The device accepts no more work, because an earlier submission timed out.
    #[error("`{during}` was not submitted: an earlier submission timed out, create a new device")]
    Abandoned {
        /// Work that was to be submitted.
        during: String,
    },
    /// Any other failure reported by Vulkan.
    #[error("{call} reported {result} for `{during}`")]
    Vulkan {
        /// Vulkan call that reported the error.
        call: &'static str,
        /// Name of the object or pass.
        during: String,
        /// Result code of the call.
        result: vk::Result,
    },
}

impl GpuError {
    /// Returns the error for the shader of a pipeline whose words are not a module.
    pub(crate) fn of_shader(name: &str, error: rasray_spirv::NotAModule) -> Self {
        Self::InvalidShader { name: name.to_owned(), reason: error.reason }
    }

    /// Makes the typed error for a result of a Vulkan call; `during` names the object or pass that the call
    /// concerned.
    pub(crate) fn from_vulkan(result: vk::Result, call: &'static str, during: &str) -> Self {
        let during = during.to_owned();
        match result {
            vk::Result::ERROR_DEVICE_LOST => Self::DeviceLost { call, during },
            vk::Result::ERROR_OUT_OF_HOST_MEMORY => Self::OutOfHostMemory { call, during },
            vk::Result::ERROR_OUT_OF_DEVICE_MEMORY => Self::DeviceMemoryExhausted { call, during },
            _ => Self::Vulkan { call, during, result },
        }
    }
}

/// Conversion of results of `ash` to results of this crate.
pub(crate) trait During<T> {
    /// Adds the name of the call that failed, and of the object or pass that it concerned.
    fn during(self, call: &'static str, what: &str) -> Result<T>;
}

impl<T> During<T> for std::result::Result<T, vk::Result> {
    fn during(self, call: &'static str, what: &str) -> Result<T> {
        self.map_err(|result| GpuError::from_vulkan(result, call, what))
    }
}
