//! Triangles and rays that change with every frame, as a host hands them over: copied from memory of its own,
//! with a frame in flight while the next is written.

use rasray_ads::{
    BoundsPass, Domain, Draw, Geometry, GeometryDesc, GeometryParts, Hit, QueueCounters, QueueHeader, Ray,
    RayQueue, Structure, Trace,
};
use rasray_gpu::{Access, Buffer, BufferDesc, BufferUsage, Device, MemoryLocation, Recorder};
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;

/// Eye, triangles and rays of one frame.
#[derive(Clone)]
pub struct Shown {
    pub eye: [f32; 3],
    pub triangles: Vec<Triangle>,
    pub rays: Vec<Ray>,
}

impl Shown {
    /// Triangles in a ball somewhere, and rays among them.
    pub fn random(random: &mut Random, count: usize, rays: usize) -> Self {
        let centre = random.point(-300.0, 300.0);
        let size = random.between(-2.0, 2.0).exp2();
        let triangles = (0..count)
            .map(|_| {
                let corner = random.near(centre, size);
                random.triangle(corner, 0.2 * size)
            })
            .collect();
        let rays = (0..rays).map(|_| Ray::new(random.near(centre, 1.5 * size), random.direction())).collect();
        Self { eye: centre, triangles, rays }
    }

    /// The same triangles sheared a little, and rays in other directions.
    pub fn sheared(&self, random: &mut Random) -> Self {
        let by = random.between(-0.01, 0.01);
        let place = |[x, y, z]: [f32; 3]| [x + by * (y - self.eye[1]), y, z];
        let triangles = self.triangles.iter().map(|triangle| triangle.map(place)).collect();
        let rays = self.rays.iter().map(|ray| Ray::new(place(ray.origin), random.direction())).collect();
        Self { eye: self.eye, triangles, rays }
    }

    pub fn bounds(&self) -> [[f32; 3]; 2] {
        let corners = || self.triangles.iter().flatten();
        let over = |with: fn(f32, f32) -> f32| {
            std::array::from_fn(|axis| corners().map(|corner| corner[axis]).reduce(with).unwrap_or(0.0))
        };
        [over(f32::min), over(f32::max)]
    }
}

/// Buffers that every frame writes, and per frame in flight what the host writes and reads.
pub struct Crowd {
    device: Device,
    positions: Buffer,
    indices: Buffer,
    draws: Buffer,
    bounds: BoundsPass,
    queue: RayQueue,
    slots: Vec<Slot>,
}

struct Slot {
    positions: Buffer,
    rays: Buffer,
    hits: Buffer,
    header: Buffer,
}

impl Crowd {
    pub fn new(device: &Device, slots: u32, most: usize, rays: usize) -> Self {
        let made = |name, size: usize, location| {
            let desc = BufferDesc { name, size: size as u64, usage: BufferUsage::ALL, location };
            device.create_buffer(&desc).expect("memory for a test")
        };
        let position_bytes = most * size_of::<Triangle>();
        let slot = |_| Slot {
            positions: made("new positions", position_bytes, MemoryLocation::Upload),
            rays: made("new rays", rays * size_of::<Ray>(), MemoryLocation::Upload),
            hits: made("hits of a frame", rays * size_of::<Hit>(), MemoryLocation::Readback),
            header: made("counters of a frame", size_of::<QueueHeader>(), MemoryLocation::Readback),
        };
        let indices: Vec<u32> = (0..3 * most as u32).collect();
        let draws = [Draw { triangle_count: most as u32, ..Draw::default() }];
        let filled = |name, bytes: &[u8]| {
            device.create_buffer_with(name, BufferUsage::ALL, bytes).expect("memory for a test")
        };
        Self {
            device: device.clone(),
            positions: made("positions", position_bytes, MemoryLocation::Device),
            indices: filled("indices", bytemuck::cast_slice(&indices)),
            draws: filled("draws", bytemuck::cast_slice(&draws)),
            bounds: BoundsPass::new(device).expect("the device works"),
            queue: RayQueue::new(device, "rays of a frame", rays as u32, false).expect("a queue fits"),
            slots: (0..slots).map(slot).collect(),
        }
    }

    /// The triangles of a frame as a geometry, in the one buffer of positions.
    pub fn geometry(&self, shown: &Shown) -> Geometry {
        let desc = GeometryDesc {
            positions: self.positions.clone().into(),
            indices: self.indices.clone().into(),
            draws: self.draws.clone().into(),
            vertex_count: 3 * shown.triangles.len() as u32,
            triangle_count: shown.triangles.len() as u32,
            count: None,
            draw_count: 1,
            bounds: shown.bounds(),
            frame_origin: [0.0; 3],
        };
        Geometry::new(&self.device, desc).expect("geometry fits")
    }

    /// Writes a frame's data on the host, into memory that no frame in flight reads.
    pub fn write(&self, slot: u32, shown: &Shown) {
        let slot = &self.slots[slot as usize];
        slot.positions.write(0, bytemuck::cast_slice(&shown.triangles)).expect("memory of the host");
        slot.rays.write(0, bytemuck::cast_slice(&shown.rays)).expect("memory of the host");
    }

    /// Records what puts the vertices where they are, and measures their bounds.
    pub fn record_move(&self, recorder: &mut Recorder<'_>, slot: u32, geometry: &Geometry) {
        let size = u64::from(geometry.triangle_count()) * size_of::<Triangle>() as u64;
        recorder.copy(&self.slots[slot as usize].positions, 0, &self.positions, 0, size);
        recorder.barrier(Access::TRANSFER_WRITE, Access::ALL);
        self.bounds.record(recorder, geometry);
    }

    /// [`Self::record_move`] where only one part moves.
    pub fn record_move_parts(&self, recorder: &mut Recorder<'_>, slot: u32, parts: &GeometryParts) {
        let triangles = parts.whole().triangle_count();
        let size = u64::from(triangles) * size_of::<Triangle>() as u64;
        recorder.copy(&self.slots[slot as usize].positions, 0, &self.positions, 0, size);
        recorder.barrier(Access::TRANSFER_WRITE, Access::ALL);
        self.bounds.record_parts(recorder, parts);
    }

    /// Records the rays of a frame and what the host reads of them.
    pub fn record_trace(&self, recorder: &mut Recorder<'_>, slot: u32, structure: &dyn Structure) {
        let slot = &self.slots[slot as usize];
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        recorder.copy(&slot.rays, 0, self.queue.rays(), 0, slot.rays.size());
        self.queue.record_reset(recorder);
        let all = Domain::First(self.queue.capacity());
        structure.record_trace(recorder, &self.queue, Trace::closest(all));
        recorder.barrier(Access::COMPUTE, Access::TRANSFER);
        recorder.copy(self.queue.hits(), 0, &slot.hits, 0, slot.hits.size());
        recorder.copy(self.queue.header(), 0, &slot.header, 0, slot.header.size());
    }

    /// Hits and counters of a frame.
    pub fn read(&self, slot: u32) -> (Vec<Hit>, QueueCounters) {
        let Slot { hits, header, .. } = &self.slots[slot as usize];
        let hits = hits.read(0, hits.size()).expect("memory of the host");
        let header = header.read(0, header.size()).expect("memory of the host");
        (bytemuck::pod_collect_to_vec(&hits), RayQueue::counters(&bytemuck::pod_read_unaligned(&header)))
    }
}
