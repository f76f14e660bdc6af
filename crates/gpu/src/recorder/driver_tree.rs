//! Commands that build the driver's trees.

use super::Recorder;
use crate::access::Access;
use crate::buffer::{Buffer, BufferUsage};
use crate::driver_tree::{DRIVER_BOX_BYTES, DriverTree};

impl Recorder<'_> {
    /// Builds a tree over the first `count` boxes of a buffer, [`DRIVER_BOX_BYTES`] each. The boxes must be
    /// visible to [`Access::TREE_BUILD`], and no upper corner may be below the lower one. The tree is visible
    /// to ray queries of compute shaders afterwards.
    pub fn build_driver_tree(&mut self, tree: &DriverTree, boxes: &Buffer, count: u32) {
        if !self.outside_rendering("build_driver_tree") {
            return;
        }
        let core = &self.device.core;
        let checked = tree
            .check_device(core)
            .and_then(|()| boxes.check_use(core, BufferUsage::default(), "boxes of a tree"))
            .and_then(|()| boxes.check_range(0, u64::from(count) * DRIVER_BOX_BYTES));
        if let Err(error) = checked {
            return self.fail(error);
        }
        if count > tree.boxes() {
            return self.exceed("the number of boxes of the tree", count.into(), tree.boxes().into());
        }
        let Some(address) = boxes.input_address() else {
            return self.misuse("boxes of a tree are in a storage buffer that was made here");
        };
        self.keep(tree.kept());
        self.keep_buffer(boxes);
        let command = self.command;
        // SAFETY: the command buffer is being recorded, outside of rendering; the boxes lie within their
        // buffer, which was made for builds, and the recorder keeps buffer and tree.
        let recorded = unsafe {
            tree.record(command, address, count, || self.emit_barrier(Access::TREE_BUILD, Access::TREE_BUILD))
        };
        if let Err(error) = recorded {
            return self.fail(error);
        }
        self.emit_barrier(Access::TREE_BUILD, Access::TREE_TRACE);
        self.count(|pass| pass.trees += 1);
    }
}
