//! [Embree](https://www.embree.org) 4 over the triangles of a scene: what a user without a GPU would take.
//! The library is found when it is asked for: nothing is linked, and benches run without it.

mod library;
mod packet;

use library::{Device, Functions, Scene};
use packet::Packet;
use rasray_ads::{PRIMITIVE_NONE, Ray, TraceMode};
use rasray_metrics::DeviceHit;
use rayon::ThreadPool;
use rayon::prelude::*;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Names a file of the library, or the folder that it is in.
pub const LIBRARY_VARIABLE: &str = "RASRAY_EMBREE";

/// Beginning of its files' names, a part that they hold, and the name to look it up by as all libraries are,
/// on this system.
const FILE: (&str, &str, &str) = if cfg!(target_os = "windows") {
    ("embree4", ".dll", "embree4.dll")
} else if cfg!(target_os = "macos") {
    ("libembree4", ".dylib", "libembree4.4.dylib")
} else {
    ("libembree4", ".so", "libembree4.so.4")
};

/// Packets that a thread takes at a time: enough that taking them costs nothing, few enough that threads end
/// together.
const TURN: usize = 128;

/// Why there is no Embree.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EmbreeError {
    /// There is no library of that name, or it needs others that are not there.
    #[error(
        "Embree 4 is not installed: {reason}; `pip install embreex` has it, and RASRAY_EMBREE names its folder \
         `embreex.libs`, or the file of another one"
    )]
    Missing {
        /// Message of the system.
        reason: String,
    },
    /// It is of another version than 4, whose functions are other ones.
    #[error("{} is not version 4 of Embree: {reason}", name.display())]
    Unsuitable {
        /// The library.
        name: OsString,
        /// Part that it lacks.
        reason: String,
    },
    /// It refused the triangles or this processor.
    #[error("Embree failed: {0}")]
    Failed(String),
}

/// Work put into a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// By Morton codes, as for scenes that move.
    Low,
    /// By surface area: the library's default.
    Medium,
    /// By surface area, with triangles that are split; in robust trees as [`Quality::Medium`].
    High,
}

/// Options of making a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TreeOptions {
    /// Work put into it.
    pub quality: Quality,
    /// `RTC_SCENE_FLAG_ROBUST`: boxes and triangles are tested so that rays do not slip through shared edges.
    pub robust: bool,
}

/// The library, ready for triangles.
#[derive(Debug)]
pub struct Embree {
    device: Device,
    pool: ThreadPool,
    version: String,
}

/// A tree over triangles. Rays exclude a triangle each through a filter function, which is given to the
/// library only where one of the rays at hand excludes any; backs and alpha masks are hit as fronts are.
#[derive(Debug)]
pub struct Tree<'a> {
    embree: &'a Embree,
    scene: Scene,
    build_milliseconds: f64,
}

/// Hits of rays, and the time that they took.
#[derive(Clone, Debug)]
pub struct Traced {
    /// One a ray; of occlusion t is 0 and the triangle unknown.
    pub hits: Vec<Option<DeviceHit>>,
    /// Milliseconds of the traces on the wall, without those of putting rays into the library's form and hits
    /// out of it.
    pub milliseconds: f64,
}

impl Embree {
    /// Loads the library that [`LIBRARY_VARIABLE`] names, or else the one that is installed. It builds and
    /// traces on that many threads.
    ///
    /// # Errors
    /// [`EmbreeError::Missing`], [`EmbreeError::Unsuitable`], or [`EmbreeError::Failed`] on a processor that
    /// it does not run on.
    pub fn find(threads: usize) -> Result<Self, EmbreeError> {
        match std::env::var_os(LIBRARY_VARIABLE).filter(|name| !name.is_empty()) {
            Some(name) => Self::load(Path::new(&name), threads),
            None => Self::load(Path::new(FILE.2), threads),
        }
    }

    /// Loads a library by its file, by the folder that it is in, or by its name where it is looked up as all
    /// libraries are.
    ///
    /// # Errors
    /// As [`Embree::find`].
    pub fn load(name: &Path, threads: usize) -> Result<Self, EmbreeError> {
        let name = if name.is_dir() { file_in(name)? } else { name.to_owned() };
        let functions = Functions::load(name.as_os_str())?;
        let threads = threads.max(1);
        let device = Device::new(functions, threads)?;
        let [major, minor, patch] = device.version();
        if major != 4 {
            let reason = format!("it says that it is {major}.{minor}.{patch}");
            return Err(EmbreeError::Unsuitable { name: name.into(), reason });
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|error| EmbreeError::Failed(error.to_string()))?;
        Ok(Self { device, pool, version: format!("Embree {major}.{minor}.{patch}") })
    }

    /// Name and version: `Embree 4.4.0`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Threads that build and trace.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Rays of the largest packets that this processor has instructions for: 1, 4, 8 or 16.
    pub fn packet_width(&self) -> usize {
        self.device.packet_width()
    }

    /// Builds a tree over triangles: positions (metres) and three indices each. A triangle's id is its place.
    ///
    /// # Errors
    /// [`EmbreeError::Failed`]: an index has no position, or the library refuses them.
    pub fn build(
        &self,
        positions: &[[f32; 3]],
        indices: &[u32],
        options: TreeOptions,
    ) -> Result<Tree<'_>, EmbreeError> {
        let (triangles, rest) = indices.as_chunks::<3>();
        if !rest.is_empty() || indices.iter().any(|&index| index as usize >= positions.len()) {
            return Err(EmbreeError::Failed("an index has no position, or a triangle no three".to_owned()));
        }
        let scene = self.device.scene(positions, triangles, options)?;
        let started = Instant::now();
        scene.commit()?;
        Ok(Tree { embree: self, scene, build_milliseconds: started.elapsed().as_secs_f64() * 1.0e3 })
    }
}

impl Tree<'_> {
    /// Milliseconds of the build on the wall, without the copy of the triangles.
    pub fn build_milliseconds(&self) -> f64 {
        self.build_milliseconds
    }

    /// Traces rays in packets of 1, 4, 8 or 16 on all threads. Rays are valid: finite, with a direction that
    /// is not zero.
    ///
    /// # Errors
    /// [`EmbreeError::Failed`]: there are no packets of that width, or what the library says.
    pub fn trace(&self, rays: &[Ray], mode: TraceMode, width: usize) -> Result<Traced, EmbreeError> {
        match width {
            1 => self.trace_packets::<1>(rays, mode),
            4 => self.trace_packets::<4>(rays, mode),
            8 => self.trace_packets::<8>(rays, mode),
            16 => self.trace_packets::<16>(rays, mode),
            _ => Err(EmbreeError::Failed(format!("there are no packets of {width} rays"))),
        }
    }

    fn trace_packets<const N: usize>(&self, rays: &[Ray], mode: TraceMode) -> Result<Traced, EmbreeError> {
        let mut packets: Vec<_> = rays.chunks(N).map(Packet::<N>::new).collect();
        let excludes = rays.iter().any(|ray| ray.exclude_primitive != PRIMITIVE_NONE);
        let started = Instant::now();
        self.embree.pool.install(|| {
            packets.par_chunks_mut(TURN).try_for_each(|turn| {
                for packet in turn {
                    match mode {
                        TraceMode::Closest => self.scene.intersect(packet, excludes),
                        TraceMode::Occluded => self.scene.occluded(packet, excludes),
                    }
                }
                // Errors are of the thread that they occur in.
                self.scene.check()
            })
        })?;
        let milliseconds = started.elapsed().as_secs_f64() * 1.0e3;
        let hit = |index: usize| match mode {
            TraceMode::Closest => packets[index / N].hit(index % N),
            TraceMode::Occluded => packets[index / N].occlusion(index % N),
        };
        Ok(Traced { hits: (0..rays.len()).map(hit).collect(), milliseconds })
    }
}

/// The library in a folder, whatever is in its name behind `libembree4`: packages put a version or a hash
/// there.
fn file_in(folder: &Path) -> Result<PathBuf, EmbreeError> {
    let (beginning, ending, _) = FILE;
    let is_library = |name: &str| name.starts_with(beginning) && name.contains(ending);
    let missing = |reason| EmbreeError::Missing { reason };
    let entries =
        std::fs::read_dir(folder).map_err(|error| missing(format!("{}: {error}", folder.display())))?;
    let mut files: Vec<_> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.file_name().and_then(|name| name.to_str()).is_some_and(is_library))
        .collect();
    files.sort();
    files
        .into_iter()
        .next()
        .ok_or_else(|| missing(format!("{} has no file {beginning}*{ending}*", folder.display())))
}

#[cfg(test)]
mod tests;
