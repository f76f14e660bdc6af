//! C interface of Embree 4, as far as the benches use it, by the names and types of its headers
//! `embree4/rtcore*.h`.

use super::packet::{Arguments, Packet};
use super::{EmbreeError, Quality, TreeOptions};
use libloading::Library;
use std::ffi::{CStr, CString, OsStr, c_char, c_int, c_uint, c_void};
use std::ptr::null_mut;
use std::sync::Arc;

/// Opaque handle of a device, a scene or a geometry of the library.
type Handle = *mut c_void;

/// `RTC_GEOMETRY_TYPE_TRIANGLE`.
const TRIANGLES: c_int = 0;
/// `RTC_BUFFER_TYPE_INDEX`.
const INDICES: c_int = 0;
/// `RTC_BUFFER_TYPE_VERTEX`.
const VERTICES: c_int = 1;
/// `RTC_FORMAT_UINT3`.
const UINT3: c_int = 0x5003;
/// `RTC_FORMAT_FLOAT3`.
const FLOAT3: c_int = 0x9003;
/// `RTC_SCENE_FLAG_ROBUST`.
const ROBUST: c_int = 1 << 2;
/// `RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS`.
const TAKES_FILTERS: c_int = 1 << 3;
/// `RTC_ERROR_NONE`.
const NO_ERROR: c_int = 0;
/// `RTC_DEVICE_PROPERTY_VERSION_MAJOR`, `_MINOR`, `_PATCH`.
const VERSION: [c_int; 3] = [1, 2, 3];
/// Widths of packets, and the `RTC_DEVICE_PROPERTY_NATIVE_RAY*_SUPPORTED` of each width.
const WIDTHS: [(usize, c_int); 3] = [(16, 34), (8, 33), (4, 32)];

type NewDevice = unsafe extern "C" fn(*const c_char) -> Handle;
type OfHandle = unsafe extern "C" fn(Handle);
type NewOfDevice = unsafe extern "C" fn(Handle) -> Handle;
type NewGeometry = unsafe extern "C" fn(Handle, c_int) -> Handle;
type GetError = unsafe extern "C" fn(Handle) -> c_int;
type GetProperty = unsafe extern "C" fn(Handle, c_int) -> isize;
type SetNumber = unsafe extern "C" fn(Handle, c_int);
type NewBuffer = unsafe extern "C" fn(Handle, c_int, c_uint, c_int, usize, usize) -> *mut c_void;
type Attach = unsafe extern "C" fn(Handle, Handle) -> c_uint;
type TraceOne = unsafe extern "C" fn(Handle, *mut c_void, *mut Arguments);
type TracePacket = unsafe extern "C" fn(*const c_int, Handle, *mut c_void, *mut Arguments);

/// Functions of a loaded library.
#[derive(Debug)]
pub(super) struct Functions {
    new_device: NewDevice,
    release_device: OfHandle,
    device_error: GetError,
    device_property: GetProperty,
    new_scene: NewOfDevice,
    set_scene_flags: SetNumber,
    set_scene_quality: SetNumber,
    commit_scene: OfHandle,
    release_scene: OfHandle,
    new_geometry: NewGeometry,
    set_geometry_quality: SetNumber,
    new_buffer: NewBuffer,
    commit_geometry: OfHandle,
    attach: Attach,
    release_geometry: OfHandle,
    intersect: TraceOne,
    occluded: TraceOne,
    /// Functions that trace 4, 8 and 16 rays at once: for nearest hits, and for occlusion.
    packets: [[TracePacket; 2]; 3],
}

impl Functions {
    /// Loads a library by file or by name.
    pub fn load(name: &OsStr) -> Result<Self, EmbreeError> {
        // SAFETY: the actions of a library at loading are its own responsibility. The user named the library,
        // or it is the one that is installed under this name; its initialisers have no preconditions.
        let library = unsafe { Library::new(name) }
            .map_err(|error| EmbreeError::Missing { reason: error.to_string() })?;
        let lacks = |error: libloading::Error| EmbreeError::Unsuitable {
            name: name.to_owned(),
            reason: error.to_string(),
        };
        /// Loads a function by its name in the header, with the type that it has there.
        macro_rules! function {
            ($name:literal) => {
                // SAFETY: the headers of version 4 declare the function with the type of the field that it
                // goes to (enums are ints, pointers to rays are untyped here), and functions keep their types
                // within a version. Version 3 has the names too; its devices and their properties are the
                // same, and it is refused by its version before any function that differs is called. A
                // library with all of the functions is never closed.
                *unsafe { library.get($name) }.map_err(lacks)?
            };
        }
        let functions = Self {
            new_device: function!(b"rtcNewDevice\0"),
            release_device: function!(b"rtcReleaseDevice\0"),
            device_error: function!(b"rtcGetDeviceError\0"),
            device_property: function!(b"rtcGetDeviceProperty\0"),
            new_scene: function!(b"rtcNewScene\0"),
            set_scene_flags: function!(b"rtcSetSceneFlags\0"),
            set_scene_quality: function!(b"rtcSetSceneBuildQuality\0"),
            commit_scene: function!(b"rtcCommitScene\0"),
            release_scene: function!(b"rtcReleaseScene\0"),
            new_geometry: function!(b"rtcNewGeometry\0"),
            set_geometry_quality: function!(b"rtcSetGeometryBuildQuality\0"),
            new_buffer: function!(b"rtcSetNewGeometryBuffer\0"),
            commit_geometry: function!(b"rtcCommitGeometry\0"),
            attach: function!(b"rtcAttachGeometry\0"),
            release_geometry: function!(b"rtcReleaseGeometry\0"),
            intersect: function!(b"rtcIntersect1\0"),
            occluded: function!(b"rtcOccluded1\0"),
            packets: [
                [function!(b"rtcIntersect4\0"), function!(b"rtcOccluded4\0")],
                [function!(b"rtcIntersect8\0"), function!(b"rtcOccluded8\0")],
                [function!(b"rtcIntersect16\0"), function!(b"rtcOccluded16\0")],
            ],
        };
        // The library's threads still run when its last device is gone, and would run in unloaded code if the
        // library was closed.
        std::mem::forget(library);
        Ok(functions)
    }
}

/// Device of the library, which is released when the last reference is dropped.
#[derive(Debug)]
pub(super) struct Device(Arc<Owned>);

/// Handle of a device with the functions that take it. Scenes share it, since the library counts the
/// references to a device.
#[derive(Debug)]
struct Owned {
    functions: Functions,
    handle: Handle,
}

// SAFETY: the handle is a pointer that only the library dereferences, and the library's functions that take a
// device by a shared reference here (errors, properties, new scenes) may be called from any thread (the
// library's manual, "Embree API").
unsafe impl Send for Owned {}
// SAFETY: as above.
unsafe impl Sync for Owned {}

impl Drop for Owned {
    fn drop(&mut self) {
        // SAFETY: the handle is a device, and this value holds the only reference that is counted here.
        unsafe { (self.functions.release_device)(self.handle) };
    }
}

impl Owned {
    fn property(&self, property: c_int) -> isize {
        // SAFETY: the handle is a device, and the property one that the header lists.
        unsafe { (self.functions.device_property)(self.handle, property) }
    }

    /// Takes the error of this thread since the last call.
    fn check(&self) -> Result<(), EmbreeError> {
        // SAFETY: the handle is a device.
        described(unsafe { (self.functions.device_error)(self.handle) })
    }
}

/// Converts an `RTCError` into a result.
fn described(code: c_int) -> Result<(), EmbreeError> {
    let reason = match code {
        NO_ERROR => return Ok(()),
        2 => "an argument is not valid",
        3 => "an operation is not valid",
        4 => "out of memory",
        5 => "it does not run on this processor",
        _ => "it does not say why",
    };
    Err(EmbreeError::Failed(format!("{reason} (error {code})")))
}

impl Device {
    /// Makes a device that builds on that many threads.
    pub fn new(functions: Functions, threads: usize) -> Result<Self, EmbreeError> {
        let config = CString::new(format!("threads={threads}")).unwrap_or_default();
        let config: &CStr = &config;
        // SAFETY: the text ends in 0 and is read before the call returns.
        let handle = unsafe { (functions.new_device)(config.as_ptr()) };
        if handle.is_null() {
            // SAFETY: for a null handle the function returns the error of the last device that could not be
            // made.
            let code = unsafe { (functions.device_error)(null_mut()) };
            return Err(described(code).err().unwrap_or_else(|| EmbreeError::Failed("no device".to_owned())));
        }
        Ok(Self(Arc::new(Owned { functions, handle })))
    }

    pub fn version(&self) -> [isize; 3] {
        VERSION.map(|property| self.0.property(property))
    }

    pub fn packet_width(&self) -> usize {
        let native = WIDTHS.into_iter().find(|(_, property)| self.0.property(*property) > 0);
        native.map_or(1, |(width, _)| width)
    }

    /// Makes a scene of one geometry, ready to be committed. Indices are less than the number of positions.
    pub fn scene(
        &self,
        positions: &[[f32; 3]],
        triangles: &[[u32; 3]],
        TreeOptions { quality, robust }: TreeOptions,
    ) -> Result<Scene, EmbreeError> {
        let functions = &self.0.functions;
        let quality = match quality {
            Quality::Low => 0,
            Quality::Medium => 1,
            Quality::High => 2,
        };
        // SAFETY: the handle is a device.
        let handle = unsafe { (functions.new_scene)(self.0.handle) };
        if handle.is_null() {
            return Err(self.failed());
        }
        let mut scene = Scene { device: Arc::clone(&self.0), handle, geometry: null_mut() };
        // SAFETY: the scene is live and not committed, the flags and the quality are values of the header;
        // the device is.
        scene.geometry = unsafe {
            (functions.set_scene_flags)(handle, if robust { ROBUST } else { 0 } | TAKES_FILTERS);
            (functions.set_scene_quality)(handle, quality);
            (functions.new_geometry)(self.0.handle, TRIANGLES)
        };
        if scene.geometry.is_null() {
            return Err(self.failed());
        }
        scene.fill(VERTICES, FLOAT3, positions)?;
        scene.fill(INDICES, UINT3, triangles)?;
        // SAFETY: the geometry is live, and has both buffers.
        unsafe {
            (functions.set_geometry_quality)(scene.geometry, quality);
            (functions.attach)(handle, scene.geometry);
        }
        self.0.check()?;
        Ok(scene)
    }

    /// Returns the error of a call that failed.
    fn failed(&self) -> EmbreeError {
        self.0.check().err().unwrap_or_else(|| EmbreeError::Failed("it does not say why".to_owned()))
    }
}

/// Scene with its geometry, both of which are released when the scene is dropped.
#[derive(Debug)]
pub(super) struct Scene {
    device: Arc<Owned>,
    handle: Handle,
    /// Geometry, null until it is made.
    geometry: Handle,
}

// SAFETY: the handles are pointers that only the library dereferences. `commit` is called before rays are
// traced, by the one thread that owns the scene then, and traces of a committed scene may be called from any
// number of threads at a time (the library's manual, `rtcIntersect1`).
unsafe impl Send for Scene {}
// SAFETY: as above.
unsafe impl Sync for Scene {}

impl Drop for Scene {
    fn drop(&mut self) {
        let functions = &self.device.functions;
        // SAFETY: the handles are live, and this value holds the only reference to each that is counted here;
        // the scene counts its own reference to the geometry.
        unsafe {
            if !self.geometry.is_null() {
                (functions.release_geometry)(self.geometry);
            }
            (functions.release_scene)(self.handle);
        }
    }
}

impl Scene {
    /// Copies elements of three words each into a new buffer of the geometry.
    fn fill<T: Copy>(&self, kind: c_int, format: c_int, elements: &[[T; 3]]) -> Result<(), EmbreeError> {
        let stride = size_of::<[T; 3]>();
        // SAFETY: the geometry is live and not committed; kind and format are values of the header, and the
        // library allocates room for its reads beyond the last element.
        let place = unsafe {
            (self.device.functions.new_buffer)(self.geometry, kind, 0, format, stride, elements.len())
        };
        self.device.check()?;
        if place.is_null() && !elements.is_empty() {
            return Err(EmbreeError::Failed("it gave no memory and does not say why".to_owned()));
        }
        if !elements.is_empty() {
            // SAFETY: the library gave memory of its own for as many elements of that stride, aligned to 16
            // bytes, which nothing else refers to.
            unsafe { place.cast::<[T; 3]>().copy_from_nonoverlapping(elements.as_ptr(), elements.len()) };
        }
        Ok(())
    }

    /// Builds the tree.
    pub fn commit(&self) -> Result<(), EmbreeError> {
        // SAFETY: geometry and scene are live, and no other thread uses them before this call returns.
        unsafe {
            (self.device.functions.commit_geometry)(self.geometry);
            (self.device.functions.commit_scene)(self.handle);
        }
        self.device.check()
    }

    /// Takes the error of this thread since the last call.
    pub fn check(&self) -> Result<(), EmbreeError> {
        self.device.check()
    }

    /// Finds the nearest hits of a packet's rays.
    pub fn intersect<const N: usize>(&self, packet: &mut Packet<N>, excludes: bool) {
        self.trace::<N>(packet, excludes, 0);
    }

    /// Tests whether a packet's rays hit anything.
    pub fn occluded<const N: usize>(&self, packet: &mut Packet<N>, excludes: bool) {
        self.trace::<N>(packet, excludes, 1);
    }

    /// Traces a packet; `occlusion` is 0 for nearest hits and 1 for occlusion.
    fn trace<const N: usize>(&self, packet: &mut Packet<N>, excludes: bool, occlusion: usize) {
        let mut arguments = Arguments::new(excludes);
        let functions = &self.device.functions;
        const { assert!(matches!(N, 1 | 4 | 8 | 16), "packets are of 1, 4, 8 or 16 rays") };
        let rays: *mut Packet<N> = packet;
        // SAFETY: the pointer is to a packet, of which this is a member.
        let valid: *const c_int = unsafe { (&raw const (*rays).valid).cast() };
        let (rays, arguments) = (rays.cast::<c_void>(), &raw mut arguments);
        // SAFETY: the scene is committed; the packet is one of the header's for N rays, at least as long and
        // as aligned, and no other thread has it. The flags of lanes are in it at 108 N bytes, a multiple of
        // the 4 N that the header asks them to be aligned to, behind what the library writes. Arguments live
        // until the call returns.
        unsafe {
            match N {
                1 => [functions.intersect, functions.occluded][occlusion](self.handle, rays, arguments),
                4 => functions.packets[0][occlusion](valid, self.handle, rays, arguments),
                8 => functions.packets[1][occlusion](valid, self.handle, rays, arguments),
                _ => functions.packets[2][occlusion](valid, self.handle, rays, arguments),
            }
        }
    }
}
