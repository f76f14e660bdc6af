//! [Embree](https://www.embree.org) 4 over the triangles of a scene: the alternative for a user without a
//! GPU. The library is loaded at run time: nothing is linked, and benches run without it.

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

/// Name of the environment variable that gives the file of the library or its folder.
pub const LIBRARY_VARIABLE: &str = "RASRAY_EMBREE";

/// Names of the library's files on this system: the beginning, a part that each name contains, and the name
/// for the system's search of libraries.
const FILE: (&str, &str, &str) = if cfg!(target_os = "windows") {
    ("embree4", ".dll", "embree4.dll")
} else if cfg!(target_os = "macos") {
    ("libembree4", ".dylib", "libembree4.4.dylib")
} else {
    ("libembree4", ".so", "libembree4.so.4")
};

/// Number of packets that a thread takes at a time: enough to make the cost of taking them negligible, few
/// enough for the threads to end together.
const TURN: usize = 128;

/// Reason for which Embree cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EmbreeError {
    /// No library of that name exists, or it needs other libraries that are missing.
    #[error(
        "Embree 4 is not installed: {reason}; `pip install embreex` has it, and RASRAY_EMBREE names its folder \
         `embreex.libs`, or the file of another one"
    )]
    Missing {
        /// Message of the system.
        reason: String,
    },
    /// The library is not of version 4, whose functions differ from those of other versions.
    #[error("{} is not version 4 of Embree: {reason}", name.display())]
    Unsuitable {
        /// Name of the library.
        name: OsString,
        /// Reason: the part that the library lacks.
        reason: String,
    },
    /// The library refused the triangles or this processor.
    #[error("Embree failed: {0}")]
    Failed(String),
}

/// Quality of a tree, the work that its build takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// Tree by Morton codes, as for scenes that move.
    Low,
    /// Tree by surface area, the library's default.
    Medium,
    /// Tree by surface area, with triangles that are split; in robust trees equal to [`Quality::Medium`].
    High,
}

/// Options of the build of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TreeOptions {
    /// Quality of the tree.
    pub quality: Quality,
    /// `RTC_SCENE_FLAG_ROBUST`: boxes and triangles are tested so that rays do not slip through shared edges.
    pub robust: bool,
}

/// Loaded library, ready for triangles.
#[derive(Debug)]
pub struct Embree {
    device: Device,
    pool: ThreadPool,
    version: String,
}

/// Tree over triangles. A ray excludes a triangle through a filter function, which is given to the library
/// only if one of the rays to trace excludes any. Backs and alpha masks are hit like fronts.
#[derive(Debug)]
pub struct Tree<'a> {
    embree: &'a Embree,
    scene: Scene,
    build_milliseconds: f64,
}

/// Hits of rays, and the time of their trace.
#[derive(Clone, Debug)]
pub struct Traced {
    /// Hits, one per ray; for occlusion t is 0 and the triangle unknown.
    pub hits: Vec<Option<DeviceHit>>,
    /// Wall time of the traces, milliseconds, without the time to convert rays into the library's form and
    /// hits back.
    pub milliseconds: f64,
}

impl Embree {
    /// Loads the library that [`LIBRARY_VARIABLE`] names, or else the installed one. It builds and traces on
    /// `threads` threads.
    ///
    /// # Errors
    /// [`EmbreeError::Missing`], [`EmbreeError::Unsuitable`], or [`EmbreeError::Failed`] on a processor that
    /// the library does not support.
    pub fn find(threads: usize) -> Result<Self, EmbreeError> {
        match std::env::var_os(LIBRARY_VARIABLE).filter(|name| !name.is_empty()) {
            Some(name) => Self::load(Path::new(&name), threads),
            None => Self::load(Path::new(FILE.2), threads),
        }
    }

    /// Loads a library by its file, by its folder, or by the name with which the system searches for it.
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

    /// Returns name and version, such as `Embree 4.4.0`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Returns the number of threads that build and trace.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Returns the number of rays in the largest packets for which this processor has instructions: 1, 4, 8
    /// or 16.
    pub fn packet_width(&self) -> usize {
        self.device.packet_width()
    }

    /// Builds a tree over triangles: positions (metres) and three indices each. A triangle's id is its index.
    ///
    /// # Errors
    /// [`EmbreeError::Failed`]: an index has no position, or the library refuses the triangles.
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
    /// Returns the wall time of the build, milliseconds, without the copy of the triangles.
    pub fn build_milliseconds(&self) -> f64 {
        self.build_milliseconds
    }

    /// Traces rays in packets of 1, 4, 8 or 16 on all threads. Rays are valid: finite, with a direction that
    /// is not zero.
    ///
    /// # Errors
    /// [`EmbreeError::Failed`]: no packets of that width exist, or the library reports an error.
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
                // The library keeps an error for the thread in which it occurs.
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

/// Finds the library in a folder, whatever follows `libembree4` in its name: packages put a version or a hash
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
