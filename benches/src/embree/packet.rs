//! Packets of rays in the form of Embree 4, by the names of its headers `embree4/rtcore_ray.h` and
//! `rtcore_common.h`.

use rasray_ads::Ray;
use rasray_metrics::DeviceHit;
use std::ffi::{c_int, c_uint, c_void};
use std::ptr::null_mut;

/// `RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER`: the filter of the arguments is called for every geometry.
const FILTER: c_int = 1 << 1;
/// `RTC_FEATURE_FLAG_ALL`.
const ALL_FEATURES: c_int = -1;
/// `RTC_INVALID_GEOMETRY_ID`.
const NOTHING: u32 = u32::MAX;

/// `RTCFilterFunctionN`.
type Filter = unsafe extern "C" fn(*const FilterArguments);

/// `RTCIntersectArguments` and `RTCOccludedArguments`.
#[repr(C)]
pub(super) struct Arguments {
    flags: c_int,
    features: c_int,
    context: *mut c_void,
    filter: Option<Filter>,
    /// Function for geometries that are not triangles.
    function: *mut c_void,
    /// Width of curves; libraries that are built without curves read no further than `function`.
    width: f32,
}

impl Arguments {
    /// Makes arguments for triangles, without a context. If any ray excludes a triangle, the arguments have
    /// the filter that refuses excluded triangles.
    pub fn new(excludes: bool) -> Self {
        let filter: Filter = refuse_excluded;
        Self {
            flags: if excludes { FILTER } else { 0 },
            features: ALL_FEATURES,
            context: null_mut(),
            filter: excludes.then_some(filter),
            function: null_mut(),
            width: 0.0,
        }
    }
}

/// `RTCFilterFunctionNArguments`.
#[repr(C)]
pub(super) struct FilterArguments {
    valid: *mut c_int,
    user: *mut c_void,
    context: *mut c_void,
    ray: *mut c_void,
    hit: *mut c_void,
    count: c_uint,
}

/// Packet of N rays: `RTCRayHitN`, which begins with `RTCRayN`, followed by the flags of the lanes that hold
/// rays. The members are those of the header, which aligns packets to up to 64 bytes.
#[repr(C, align(64))]
pub(super) struct Packet<const N: usize> {
    origin: [[f32; N]; 3],
    near: [f32; N],
    direction: [[f32; N]; 3],
    time: [f32; N],
    far: [f32; N],
    mask: [u32; N],
    /// Triangle that the ray excludes; the library does not look at this id.
    id: [u32; N],
    flags: [u32; N],
    normal: [[f32; N]; 3],
    barycentrics: [[f32; N]; 2],
    primitive: [u32; N],
    geometry: [u32; N],
    /// Ids that the library fills in and nothing reads: two per level of instances where the library has
    /// arrays of them, otherwise one. The library is built for one level unless its builder chose another
    /// number (`RTC_MAX_INSTANCE_LEVEL_COUNT`); the array has room for four.
    instances: [[u32; N]; 8],
    /// Flags of the lanes, all ones for a lane with a ray.
    pub valid: [c_int; N],
}

/// Position of `id` in a ray, in arrays of as many words as there are rays.
const ID: usize = 10;
/// Position of `primitive` in a hit.
const PRIMITIVE: usize = 5;

impl<const N: usize> Packet<N> {
    /// Makes a packet of up to N rays; the remaining lanes hold no ray.
    pub fn new(rays: &[Ray]) -> Self {
        // Lanes without a ray hold valid numbers as well.
        let ray =
            |lane: usize| rays.get(lane).copied().unwrap_or_else(|| Ray::new([0.0; 3], [0.0, 0.0, 1.0]));
        let lanes = |value: &dyn Fn(Ray) -> f32| std::array::from_fn(|lane| value(ray(lane)));
        Self {
            origin: std::array::from_fn(|axis| lanes(&|ray| ray.origin[axis])),
            near: lanes(&|ray| ray.t_min),
            direction: std::array::from_fn(|axis| lanes(&|ray| ray.direction[axis])),
            time: [0.0; N],
            far: lanes(&|ray| ray.t_max),
            mask: [u32::MAX; N],
            id: std::array::from_fn(|lane| ray(lane).exclude_primitive),
            flags: [0; N],
            normal: [[0.0; N]; 3],
            barycentrics: [[0.0; N]; 2],
            primitive: [NOTHING; N],
            geometry: [NOTHING; N],
            instances: [[NOTHING; N]; 8],
            valid: std::array::from_fn(|lane| if lane < rays.len() { -1 } else { 0 }),
        }
    }

    /// Returns the hit of a lane after a search for nearest hits.
    pub fn hit(&self, lane: usize) -> Option<DeviceHit> {
        (self.geometry[lane] != NOTHING)
            .then(|| DeviceHit { t: self.far[lane], primitive: Some(self.primitive[lane]) })
    }

    /// Returns the hit of a lane without its t after a search for any hit: the end of a ray that hit is minus
    /// infinity.
    pub fn occlusion(&self, lane: usize) -> Option<DeviceHit> {
        (self.far[lane] == f32::NEG_INFINITY).then_some(DeviceHit { t: 0.0, primitive: None })
    }
}

/// Refuses the triangle that a ray excludes.
unsafe extern "C" fn refuse_excluded(arguments: *const FilterArguments) {
    // SAFETY: the library calls this function with its arguments, which live until it returns: arrays of
    // `count` flags, and packets of `count` rays and hits, each member of which is an array of `count` words.
    unsafe {
        let FilterArguments { valid, ray, hit, count, .. } = *arguments;
        let count = count as usize;
        let (excluded, primitives) =
            (ray.cast::<u32>().add(ID * count), hit.cast::<u32>().add(PRIMITIVE * count));
        for lane in 0..count {
            if *valid.add(lane) != 0 && *excluded.add(lane) == *primitives.add(lane) {
                *valid.add(lane) = 0;
            }
        }
    }
}
