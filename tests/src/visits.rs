//! Cells that a march visits, on the device and in double precision.
//!
//! The exact side knows what single precision cannot resolve: parts of a ray that are shorter than
//! [`unresolved`] in t, or that lie within as much of a seam between faces or of the near region.

use bytemuck::{Pod, bytes_of};
use rasray_ads::Ray;
use rasray_gpu::{BufferDesc, BufferUsage, ComputePipelineDesc, Device, MemoryLocation};
use rasray_shaders_glsl::Shader;
pub use rasray_shaders_glsl::records::test_kernels::Visit;

/// Number of the face for visits to the near region, `SEGMENT_NEAR` of `ads/march_cube.glsl`.
pub const FACE_NEAR: u32 = 6;

/// Rounding of single precision that a march may lose along a ray, relative: 64 units of 2^-24.
pub const ROUNDING: f64 = 64.0 / (1_u64 << 24) as f64;

/// Largest relative number that double precision cannot tell from zero.
const EXACT: f64 = 1.0e-13;

/// Chord: the part of a ray that lies in one closed cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chord<C> {
    /// Cell of the chord.
    pub cell: C,
    /// Parameter t at which the ray enters.
    pub t_in: f64,
    /// Parameter t at which the ray leaves; may be infinite.
    pub t_out: f64,
}

impl<C> Chord<C> {
    /// Returns a t within the chord.
    pub fn middle(&self) -> f64 {
        middle(self.t_in, self.t_out)
    }
}

/// Returns a t between two others, the second of which may be infinite.
pub fn middle(t_in: f64, t_out: f64) -> f64 {
    if t_out.is_finite() { 0.5 * (t_in + t_out) } else { 2.0 * t_in.abs() + 1.0e6 }
}

/// Cell of a face: face, column, row.
pub type FaceCell = (u32, i32, i32);

fn largest(v: [f64; 3]) -> f64 {
    v.iter().fold(0.0, |far: f64, x| far.max(x.abs()))
}

/// Returns the length in t below which parts are lost in the rounding of single precision.
pub fn unresolved(ray: &Ray, t: f64) -> f64 {
    let size = largest(ray.origin.map(f64::from)) / largest(ray.direction.map(f64::from));
    ROUNDING * (t.abs() + size)
}

/// Returns the length in space below which parts are lost in the rounding of single precision.
pub fn unresolved_length(ray: &Ray, t: f64) -> f64 {
    unresolved(ray, t) * largest(ray.direction.map(f64::from))
}

/// Returns the point at t in double precision.
pub fn point(ray: &Ray, t: f64) -> [f64; 3] {
    std::array::from_fn(|axis| f64::from(ray.origin[axis]) + t * f64::from(ray.direction[axis]))
}

/// Transforms a point to the coordinates of a face: a permutation and a change of sign.
pub fn face_from_world(p: [f64; 3], face: u32) -> [f64; 3] {
    let mut q = match face / 2 {
        0 => [p[1], p[2], p[0]],
        1 => [p[2], p[0], p[1]],
        _ => p,
    };
    if face % 2 == 1 {
        q[2] = -q[2];
    }
    q
}

/// Inverts [`face_from_world`], in single precision.
pub fn world_from_face(q: [f32; 3], face: u32) -> [f32; 3] {
    let z = if face % 2 == 1 { -q[2] } else { q[2] };
    match face / 2 {
        0 => [z, q[0], q[1]],
        1 => [q[1], z, q[0]],
        _ => [q[0], q[1], z],
    }
}

/// Returns x/z of the boundary below a cell, the number that `cell_boundary` of `ads/views.glsl` gives.
pub fn cell_boundary(cell: i32, resolution: u32) -> f32 {
    (2 * cell - resolution as i32) as f32 * (1.0 / resolution as f32)
}

/// Returns x/z of the centre of a cell, the number that `cell_center` of `ads/views.glsl` gives.
pub fn cell_center(cell: i32, resolution: u32) -> f32 {
    (2 * cell + 1 - resolution as i32) as f32 * (1.0 / resolution as f32)
}

/// Returns half the side of the near region that a scene of this radius (rays included) needs, by the rule of
/// structures.
pub fn near_size(resolution: u32, radius: f32) -> f32 {
    4.8e-7 * resolution as f32 * radius
}

/// Clips [low, high] to the part where `at_zero + t * slope >= 0`; empty if low > high.
fn clip([low, high]: [f64; 2], at_zero: f64, slope: f64) -> [f64; 2] {
    if slope == 0.0 {
        return if at_zero >= 0.0 { [low, high] } else { [1.0, 0.0] };
    }
    let t = -at_zero / slope;
    if slope > 0.0 { [low.max(t), high] } else { [low, high.min(t)] }
}

/// Returns the parts of a ray outside the near region and outside the margin that rounding adds to it.
fn outside_of_near_region(ray: &Ray, size: f64) -> Vec<[f64; 2]> {
    let all = [f64::from(ray.t_min), f64::from(ray.t_max)];
    let mut near = [f64::NEG_INFINITY, f64::INFINITY];
    for axis in 0..3 {
        let (o, d) = (f64::from(ray.origin[axis]), f64::from(ray.direction[axis]));
        near = clip(near, size - o, -d);
        near = clip(near, size + o, d);
    }
    if near[0] > near[1] {
        return vec![all];
    }
    let before = [all[0], all[1].min(near[0] - unresolved(ray, near[0]))];
    let after = [all[0].max(near[1] + unresolved(ray, near[1])), all[1]];
    [before, after].into_iter().filter(|[low, high]| low < high).collect()
}

/// Returns the cells that share a point of a ray: the one that contains it, and the one beyond a boundary on
/// which it lies.
fn cells_at(position: f64, tolerance: f64, boundary: impl Fn(i32) -> f64, guess: i32) -> Vec<i32> {
    (guess - 1..=guess + 1)
        .filter(|&cell| boundary(cell) - position <= tolerance && position - boundary(cell + 1) <= tolerance)
        .collect()
}

/// Returns all chords of a ray in the cells of the six faces, without [`unresolved`] ones. The origin is
/// relative to the eye. A march that promises a superset of the exact cells must visit every chord.
pub fn exact_face_chords(ray: &Ray, resolution: u32, near_size: f32) -> Vec<Chord<FaceCell>> {
    let side = f64::from(resolution);
    let mut chords = Vec::new();
    for part in outside_of_near_region(ray, f64::from(near_size)) {
        for face in 0..6 {
            let o = face_from_world(ray.origin.map(f64::from), face);
            let d = face_from_world(ray.direction.map(f64::from), face);
            // The pyramid excludes everything within rounding of a seam, where either face is right.
            let guard = ROUNDING * largest(o);
            let mut range = part;
            for axis in 0..2 {
                for sign in [1.0, -1.0] {
                    let shrink = 1.0 - ROUNDING;
                    range =
                        clip(range, o[2] * shrink - guard + sign * o[axis], d[2] * shrink + sign * d[axis]);
                }
            }
            let [begin, end] = range;
            if begin >= end {
                continue;
            }
            let boundary = |cell: i32| f64::from(cell_boundary(cell, resolution));
            let mut crossings = vec![begin];
            for axis in 0..2 {
                for cell in 1..resolution as i32 {
                    let c = boundary(cell);
                    let t = (c * o[2] - o[axis]) / (d[axis] - c * d[2]);
                    if begin < t && t < end {
                        crossings.push(t);
                    }
                }
            }
            crossings.push(end);
            crossings.sort_unstable_by(f64::total_cmp);
            for pair in crossings.windows(2) {
                let [t_in, t_out] = [pair[0], pair[1]];
                if t_out.is_finite() && t_out - t_in <= unresolved(ray, t_out) {
                    continue;
                }
                let t = middle(t_in, t_out);
                let p: [f64; 3] = std::array::from_fn(|axis| o[axis] + t * d[axis]);
                let tolerance = EXACT * (largest(o) + t.abs() * largest(d));
                let along = |axis: usize| {
                    let guess = ((p[axis] / p[2] + 1.0) * 0.5 * side).floor() as i32;
                    cells_at(p[axis], tolerance, |cell| boundary(cell) * p[2], guess)
                };
                for x in along(0) {
                    for y in along(1) {
                        let inside = |cell| (0..resolution as i32).contains(&cell);
                        if inside(x) && inside(y) {
                            chords.push(Chord { cell: (face, x, y), t_in, t_out });
                        }
                    }
                }
            }
        }
    }
    chords
}

/// Returns all chords of a ray in the cells [i, i + 1] of a cubic grid, without [`unresolved`] ones.
pub fn exact_grid_chords(ray: &Ray, size: u32) -> Vec<Chord<[i32; 3]>> {
    let (o, d) = (ray.origin.map(f64::from), ray.direction.map(f64::from));
    let mut range = [f64::from(ray.t_min), f64::from(ray.t_max)];
    for axis in 0..3 {
        range = clip(range, o[axis], d[axis]);
        range = clip(range, f64::from(size) - o[axis], -d[axis]);
    }
    let [begin, end] = range;
    if begin >= end || largest(d) == 0.0 {
        return Vec::new();
    }
    let mut crossings = vec![begin, end];
    for axis in 0..3 {
        crossings.extend(
            (1..size).map(|plane| (f64::from(plane) - o[axis]) / d[axis]).filter(|&t| begin < t && t < end),
        );
    }
    crossings.sort_unstable_by(f64::total_cmp);
    let mut chords = Vec::new();
    for pair in crossings.windows(2) {
        let [t_in, t_out] = [pair[0], pair[1]];
        if t_out - t_in <= unresolved(ray, t_out) {
            continue;
        }
        let t = middle(t_in, t_out);
        let tolerance = EXACT * (largest(o) + t.abs() * largest(d));
        let along: [Vec<i32>; 3] = std::array::from_fn(|axis| {
            let p = o[axis] + t * d[axis];
            cells_at(p, tolerance, f64::from, p.floor() as i32)
        });
        for &x in &along[0] {
            for &y in &along[1] {
                for &z in &along[2] {
                    if [x, y, z].iter().all(|cell| (0..size as i32).contains(cell)) {
                        chords.push(Chord { cell: [x, y, z], t_in, t_out });
                    }
                }
            }
        }
    }
    chords
}

/// True if a visited cell contains the ray's point at t, up to rounding.
pub fn visit_holds(visit: &Visit, ray: &Ray, t: f64, resolution: u32, near_size: f32) -> bool {
    let slack = unresolved_length(ray, t);
    let p = point(ray, t);
    if visit.face == FACE_NEAR {
        return largest(p) <= f64::from(near_size) + slack;
    }
    let q = face_from_world(p, visit.face);
    let between = |cell: i32, x: f64| {
        f64::from(cell_boundary(cell, resolution)) * q[2] - slack <= x
            && x <= f64::from(cell_boundary(cell + 1, resolution)) * q[2] + slack
    };
    q[2] >= -slack && between(visit.x, q[0]) && between(visit.y, q[1])
}

/// Runs a kernel with buffers of input, output and counts, one thread per input, and its push constants.
///
/// # Panics
/// If the device fails.
pub fn run_kernel<T: Pod, C: Pod>(
    device: &Device,
    shader: &Shader,
    inputs: &[u8],
    outputs: usize,
    counts: Option<usize>,
    threads: usize,
    constants: &C,
) -> (Vec<T>, Vec<u32>) {
    let input = device.create_buffer_with("inputs", BufferUsage::ALL, inputs).expect("test buffers fit");
    let output = device
        .create_buffer(&BufferDesc {
            name: "outputs",
            size: (outputs * size_of::<T>()).max(4) as u64,
            usage: BufferUsage::ALL,
            location: MemoryLocation::Device,
        })
        .expect("test buffers fit");
    let counter = counts.map(|count| {
        let zeros = vec![0_u32; count.max(1)];
        device.create_buffer_with("counts", BufferUsage::ALL, &zeros).expect("test buffers fit")
    });
    let mut buffers = vec![&input, &output];
    buffers.extend(counter.as_ref());
    let layout = device.create_set_layout(shader.name, buffers.len() as u32).expect("a set layout");
    let set = device.create_binding_set(&layout, shader.name, &buffers).expect("a set");
    let pipeline = device
        .create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            module: &shader.module(),
            sets: &[&layout],
            push_constant_bytes: size_of::<C>() as u32,
            constants: &[],
        })
        .expect("the kernel compiles");
    device
        .submit(|recorder| {
            recorder.bind_compute(&pipeline);
            recorder.bind_sets(0, &[&set]);
            recorder.push_constants(bytes_of(constants));
            recorder.dispatch([threads.div_ceil(64) as u32, 1, 1]);
        })
        .expect("the kernel runs");
    let found = device.download_as::<T>(&output, 0, outputs).expect("the device answers");
    let counted = counter.map(|buffer| {
        device.download_as::<u32>(&buffer, 0, counts.unwrap_or(0)).expect("the device answers")
    });
    (found, counted.unwrap_or_default())
}

/// Splits the output of threads into runs of `limit`; `None` for a thread that had more to write.
pub fn runs<T: Clone>(found: &[T], counts: &[u32], limit: usize) -> Vec<Option<Vec<T>>> {
    found
        .chunks(limit)
        .zip(counts)
        .map(|(run, &count)| run.get(..count as usize).map(<[T]>::to_vec))
        .collect()
}
