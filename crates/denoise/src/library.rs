//! Parts of the C interface of Open Image Denoise 2 that the crate uses, by the names and types of its header
//! `oidn.h`.

use crate::DenoiseError;
use libloading::Library;
use std::ffi::{CStr, OsStr, c_char, c_int, c_void};
use std::ptr::null;

/// Opaque handle of a device or a filter of the library.
type Handle = *mut c_void;

/// `OIDN_DEVICE_TYPE_CPU`: the device reads and writes memory of this process at any address.
const CPU: c_int = 1;
/// `OIDN_ERROR_NONE`.
const NO_ERROR: c_int = 0;
/// `OIDN_FORMAT_FLOAT3`: three floats, one after the other.
const FLOAT3: c_int = 3;

type NewDevice = unsafe extern "C" fn(c_int) -> Handle;
type NewFilter = unsafe extern "C" fn(Handle, *const c_char) -> Handle;
type OfHandle = unsafe extern "C" fn(Handle);
type GetInt = unsafe extern "C" fn(Handle, *const c_char) -> c_int;
type GetError = unsafe extern "C" fn(Handle, *mut *const c_char) -> c_int;
type SetBool = unsafe extern "C" fn(Handle, *const c_char, bool);
type SetImage =
    unsafe extern "C" fn(Handle, *const c_char, *mut c_void, c_int, usize, usize, usize, usize, usize);

/// Functions of a loaded library.
#[derive(Debug)]
pub(crate) struct Functions {
    new_device: NewDevice,
    commit_device: OfHandle,
    device_number: GetInt,
    device_error: GetError,
    release_device: OfHandle,
    new_filter: NewFilter,
    set_image: SetImage,
    set_bool: SetBool,
    commit_filter: OfHandle,
    execute_filter: OfHandle,
    release_filter: OfHandle,
    /// Handle of the library; the last field, so that it is closed when no function can be called any more.
    _library: Library,
}

impl Functions {
    /// Loads a library by file or by name.
    pub fn load(name: &OsStr) -> Result<Self, DenoiseError> {
        // SAFETY: a library runs its own code when it is loaded. The user named it, or it is the one that is
        // installed under this name; its initialisers have no preconditions.
        let library = unsafe { Library::new(name) }
            .map_err(|error| DenoiseError::Missing { reason: described(&error) })?;
        let lacks = |error: libloading::Error| DenoiseError::Unsuitable {
            name: name.to_owned(),
            reason: described(&error),
        };
        /// Looks up a function by its name in the header, with the type that it has there.
        macro_rules! function {
            ($name:literal) => {
                // SAFETY: `oidn.h` of version 2 declares the function with the type of the field that it is
                // assigned to, and functions keep their types within a version: a library with other types
                // has another file name. The pointer is used no longer than the library is loaded, since both
                // are in the same struct.
                *unsafe { library.get($name) }.map_err(lacks)?
            };
        }
        Ok(Self {
            new_device: function!(b"oidnNewDevice\0"),
            commit_device: function!(b"oidnCommitDevice\0"),
            device_number: function!(b"oidnGetDeviceInt\0"),
            device_error: function!(b"oidnGetDeviceError\0"),
            release_device: function!(b"oidnReleaseDevice\0"),
            new_filter: function!(b"oidnNewFilter\0"),
            set_image: function!(b"oidnSetSharedFilterImage\0"),
            set_bool: function!(b"oidnSetFilterBool\0"),
            commit_filter: function!(b"oidnCommitFilter\0"),
            execute_filter: function!(b"oidnExecuteFilter\0"),
            release_filter: function!(b"oidnReleaseFilter\0"),
            _library: library,
        })
    }

    /// Makes a device on this processor.
    pub fn device(&self) -> Result<Device<'_>, DenoiseError> {
        // SAFETY: the type is one that the header lists.
        let handle = unsafe { (self.new_device)(CPU) };
        let device = Device { functions: self, handle };
        if handle.is_null() {
            return Err(device.failed());
        }
        // SAFETY: the handle is a device that is not committed yet.
        unsafe { (self.commit_device)(handle) };
        device.check()?;
        Ok(device)
    }
}

/// Describes an error of the loader with the system's message.
fn described(error: &libloading::Error) -> String {
    use std::error::Error;
    error.source().map_or_else(|| error.to_string(), ToString::to_string)
}

/// Device of the library; it is released on drop.
pub(crate) struct Device<'a> {
    functions: &'a Functions,
    /// Handle of the device; null if none could be made, in which case only the error is queried.
    handle: Handle,
}

impl Drop for Device<'_> {
    fn drop(&mut self) {
        if !self.handle.is_null() {
            // SAFETY: the handle is a device, and this is the only reference that is counted.
            unsafe { (self.functions.release_device)(self.handle) };
        }
    }
}

/// Filter of the library; it is released on drop, before its device.
struct Filter<'a> {
    device: &'a Device<'a>,
    handle: Handle,
}

impl Drop for Filter<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle is a filter, and this is the only reference that is counted.
        unsafe { (self.device.functions.release_filter)(self.handle) };
    }
}

impl Device<'_> {
    /// Returns a number that the device has by name; 0 if it has none.
    pub fn number(&self, name: &CStr) -> i32 {
        // SAFETY: the handle is a committed device, and the name ends in 0.
        unsafe { (self.functions.device_number)(self.handle, name.as_ptr()) }
    }

    /// Returns the error, if any, since the last query.
    fn check(&self) -> Result<(), DenoiseError> {
        let mut message = null();
        // SAFETY: the handle is a device, or null, which stands for the error of this thread; the message is
        // written by the call.
        let code = unsafe { (self.functions.device_error)(self.handle, &raw mut message) };
        if code == NO_ERROR {
            return Ok(());
        }
        let message = match message.is_null() {
            true => format!("error {code}"),
            // SAFETY: a message ends in 0 and stays valid until the next call for this device, which comes
            // after this copy.
            false => unsafe { CStr::from_ptr(message) }.to_string_lossy().into_owned(),
        };
        Err(DenoiseError::Failed(message))
    }

    /// Returns the error of a call that failed.
    fn failed(&self) -> DenoiseError {
        let unknown = || DenoiseError::Failed("it does not say why".to_owned());
        self.check().err().unwrap_or_else(unknown)
    }

    /// Returns the first image, which is linear, without noise; the others are albedo and normal. All have as
    /// many pixels as the size says, above 0.
    pub fn filtered(
        &self,
        [width, height]: [usize; 2],
        images: [&[[f32; 3]]; 3],
    ) -> Result<Vec<[f32; 3]>, DenoiseError> {
        assert!(images.iter().all(|image| image.len() == width * height), "sizes were checked");
        let functions = self.functions;
        let mut output = vec![[0.0_f32; 3]; width * height];
        // SAFETY: the handle is a committed device, the name is that of a filter that the header lists, and
        // it ends in 0.
        let handle = unsafe { (functions.new_filter)(self.handle, c"RT".as_ptr()) };
        if handle.is_null() {
            return Err(self.failed());
        }
        let filter = Filter { device: self, handle };
        let inputs = [c"color", c"albedo", c"normal"].into_iter().zip(images);
        // The library does not write to inputs; the header has one function for inputs and outputs.
        let inputs = inputs.map(|(name, image)| (name, image.as_ptr().cast_mut()));
        for (name, pixels) in inputs.chain([(c"output", output.as_mut_ptr())]) {
            // SAFETY: the filter is live, the name ends in 0; the pixels are width * height of three floats
            // without gaps, as strides of 0 say, and keep their addresses until the filter is released below:
            // inputs are borrowed, and `output` is neither moved nor read before.
            unsafe {
                (functions.set_image)(
                    filter.handle,
                    name.as_ptr(),
                    pixels.cast(),
                    FLOAT3,
                    width,
                    height,
                    0,
                    0,
                    0,
                );
            }
        }
        // SAFETY: the filter is live, its device is on this processor and so reads and writes memory of this
        // process; a filter has finished when the call returns.
        unsafe {
            (functions.set_bool)(filter.handle, c"hdr".as_ptr(), true);
            (functions.commit_filter)(filter.handle);
            (functions.execute_filter)(filter.handle);
        }
        drop(filter);
        self.check()?;
        Ok(output)
    }
}
