//! Store of the pipelines of a device: one pipeline per description, with any number of handles.
//!
//! Compilation takes most of the time of making a structure, and structures of one device share passes: equal
//! modules, constants and layouts give the same pipeline.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

use crate::raster_options::RasterOptions;
use crate::set_parts::Mask;

/// Everything that determines a pipeline, except its name.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(crate) struct Recipe {
    /// Modules: one for compute, or two for drawing (vertex, fragment).
    pub(crate) modules: Vec<Box<[u32]>>,
    pub(crate) constants: Box<[(u32, u32)]>,
    /// Number of storage buffers of each set: layouts with equal contents are compatible, even if made twice.
    pub(crate) sets: Box<[u32]>,
    pub(crate) push_constant_bytes: u32,
    pub(crate) options: RasterOptions,
}

/// Vulkan objects of a pipeline.
#[derive(Clone, Debug)]
pub(crate) struct PipelineObjects {
    pub(crate) raw: vk::Pipeline,
    pub(crate) layout: vk::PipelineLayout,
    /// Bindings of each set that the pipeline layout contains.
    pub(crate) used: Arc<[Mask]>,
}

impl PipelineObjects {
    /// Destroys the pipeline and its layout.
    ///
    /// # Safety
    /// Nothing uses the pipeline any more, and it is destroyed once.
    unsafe fn destroy(&self, device: &ash::Device) {
        // SAFETY: the caller guarantees the conditions.
        unsafe {
            device.destroy_pipeline(self.raw, None);
            device.destroy_pipeline_layout(self.layout, None);
        }
    }
}

struct Entry {
    made: PipelineObjects,
    /// Number of existing handles; the pipeline is idle at 0.
    handles: usize,
    /// Time at which the pipeline became idle; a key of [`Books::idle`] while it is idle.
    since: u64,
}

#[derive(Default)]
struct Books {
    entries: HashMap<Arc<Recipe>, Entry>,
    /// Pipelines without handles, the longest idle first.
    idle: BTreeMap<u64, Arc<Recipe>>,
    /// Number of handles released so far, which serves as time.
    clock: u64,
    /// Maximum number of idle pipelines that are kept.
    kept: usize,
}

/// Store of the pipelines of a device. [`PipelineStore::find`] and [`PipelineStore::insert`] give out the
/// handles, and [`PipelineStore::release`] takes them back. If objects may not be destroyed any more, the
/// device argument is `None`.
#[derive(Default)]
pub(crate) struct PipelineStore {
    books: Mutex<Books>,
}

impl PipelineStore {
    fn books(&self) -> MutexGuard<'_, Books> {
        self.books.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns a handle to the pipeline that was made by this recipe, if there is one.
    pub(crate) fn find(&self, recipe: &Recipe) -> Option<(Arc<Recipe>, PipelineObjects)> {
        self.books().find(recipe)
    }

    /// Stores a pipeline that was just made, and returns its first handle. If another thread stored the same
    /// pipeline earlier, returns a handle to that one and destroys `made`.
    pub(crate) fn insert(
        &self,
        device: &ash::Device,
        recipe: Recipe,
        made: PipelineObjects,
    ) -> (Arc<Recipe>, PipelineObjects) {
        let mut books = self.books();
        if let Some(found) = books.find(&recipe) {
            // SAFETY: the pipeline was made for this call, and no other code has a handle to it.
            unsafe { made.destroy(device) };
            return found;
        }
        let recipe = Arc::new(recipe);
        books.entries.insert(recipe.clone(), Entry { made: made.clone(), handles: 1, since: 0 });
        (recipe, made)
    }

    /// Takes a handle back. If more pipelines are idle than are kept, destroys those that have been idle for
    /// longest.
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

    /// Sets the number of pipelines without handles that are kept from now on.
    pub(crate) fn keep(&self, device: Option<&ash::Device>, count: usize) {
        let mut books = self.books();
        books.kept = count;
        books.trim(device);
    }

    /// Destroys all idle pipelines, before the device is destroyed.
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
                // SAFETY: no handle to the pipeline is left. Submissions that use a pipeline hold a handle,
                // so none is pending; embedders keep the objects that they record alive.
                unsafe { entry.made.destroy(device) };
            }
        }
    }
}
