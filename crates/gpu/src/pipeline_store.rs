//! The pipelines of a device: one of a kind, however many handles there are.
//!
//! Compiling is what most of the time of making a structure goes to, and structures of one device share
//! passes: what was made of the same modules, constants and layouts is the same pipeline.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

use crate::raster_options::RasterOptions;
use crate::set_parts::Mask;

/// Everything that a pipeline is made of but its name.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(crate) struct Recipe {
    /// One module computes; two draw: vertex, fragment.
    pub(crate) modules: Vec<Box<[u32]>>,
    pub(crate) constants: Box<[(u32, u32)]>,
    /// Storage buffers of each set: layouts of the same content are compatible, even if made twice.
    pub(crate) sets: Box<[u32]>,
    pub(crate) push_constant_bytes: u32,
    pub(crate) options: RasterOptions,
}

/// Vulkan objects of a pipeline.
#[derive(Clone, Debug)]
pub(crate) struct PipelineObjects {
    pub(crate) raw: vk::Pipeline,
    pub(crate) layout: vk::PipelineLayout,
    /// The bindings of each set that its layout has.
    pub(crate) used: Arc<[Mask]>,
}

impl PipelineObjects {
    /// # Safety
    /// Nothing uses the pipeline any more, and it is destroyed once.
    unsafe fn destroy(&self, device: &ash::Device) {
        // SAFETY: the caller vouches for it.
        unsafe {
            device.destroy_pipeline(self.raw, None);
            device.destroy_pipeline_layout(self.layout, None);
        }
    }
}

struct Entry {
    made: PipelineObjects,
    /// Handles that are out; idle at 0.
    handles: usize,
    /// When it became idle; a key of [`Books::idle`] while it is.
    since: u64,
}

#[derive(Default)]
struct Books {
    entries: HashMap<Arc<Recipe>, Entry>,
    /// Pipelines without handles, the longest idle first.
    idle: BTreeMap<u64, Arc<Recipe>>,
    /// Counts releases.
    clock: u64,
    /// Number of idle pipelines kept.
    kept: usize,
}

/// The pipelines of a device. Every handle to one was given out by [`PipelineStore::find`] or
/// [`PipelineStore::insert`] and goes back by [`PipelineStore::release`]. Where nothing may be destroyed any
/// more, its device is `None`.
#[derive(Default)]
pub(crate) struct PipelineStore {
    books: Mutex<Books>,
}

impl PipelineStore {
    fn books(&self) -> MutexGuard<'_, Books> {
        self.books.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A handle to what was made by this recipe, if anything was.
    pub(crate) fn find(&self, recipe: &Recipe) -> Option<(Arc<Recipe>, PipelineObjects)> {
        self.books().find(recipe)
    }

    /// The first handle to what was just made. Where another thread was faster, its pipeline is given out and
    /// this one destroyed.
    pub(crate) fn insert(
        &self,
        device: &ash::Device,
        recipe: Recipe,
        made: PipelineObjects,
    ) -> (Arc<Recipe>, PipelineObjects) {
        let mut books = self.books();
        if let Some(found) = books.find(&recipe) {
            // SAFETY: it was made for this call and given to nobody.
            unsafe { made.destroy(device) };
            return found;
        }
        let recipe = Arc::new(recipe);
        books.entries.insert(recipe.clone(), Entry { made: made.clone(), handles: 1, since: 0 });
        (recipe, made)
    }

    /// Takes a handle back; of idle pipelines the longest idle are destroyed beyond those that are kept.
    pub(crate) fn release(&self, device: Option<&ash::Device>, recipe: &Arc<Recipe>) {
        let mut books = self.books();
        books.clock += 1;
        let now = books.clock;
        let Some(entry) = books.entries.get_mut(recipe) else { return };
        entry.handles -= 1;
        if entry.handles == 0 {
            entry.since = now;
            books.idle.insert(now, recipe.clone());
            books.trim(device);
        }
    }

    /// Sets how many pipelines without handles are kept from now on.
    pub(crate) fn keep(&self, device: Option<&ash::Device>, count: usize) {
        let mut books = self.books();
        books.kept = count;
        books.trim(device);
    }

    /// Destroys all; for a device that goes.
    pub(crate) fn clear(&self, device: &ash::Device) {
        self.keep(Some(device), 0);
    }
}

impl Books {
    fn find(&mut self, recipe: &Recipe) -> Option<(Arc<Recipe>, PipelineObjects)> {
        let recipe = self.entries.get_key_value(recipe)?.0.clone();
        let entry = self.entries.get_mut(&recipe)?;
        if entry.handles == 0 {
            self.idle.remove(&entry.since);
        }
        entry.handles += 1;
        Some((recipe, entry.made.clone()))
    }

    fn trim(&mut self, device: Option<&ash::Device>) {
        while self.idle.len() > self.kept {
            let Some((_, recipe)) = self.idle.pop_first() else { return };
            let Some(entry) = self.entries.remove(&recipe) else { continue };
            if let Some(device) = device {
                // SAFETY: there is no handle to it. Submissions that use a pipeline hold one, so none is
                // pending; embedders keep what they record alive.
                unsafe { entry.made.destroy(device) };
            }
        }
    }
}
