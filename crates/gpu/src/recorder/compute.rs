//! Commands that dispatch compute work.

use ash::vk;

use super::Recorder;
use crate::buffer::Buffer;

impl Recorder<'_> {
    /// Runs the bound compute pipeline on `groups` workgroups.
    pub fn dispatch(&mut self, groups: [u32; 3]) {
        if !self.outside_rendering("dispatch") || !self.has_pipeline(vk::PipelineBindPoint::COMPUTE) {
            return;
        }
        let limits = self.device.limits().max_workgroup_count;
        for (asked, limit) in groups.into_iter().zip(limits) {
            if asked > limit {
                return self.exceed("the number of workgroups", asked.into(), limit.into());
            }
        }
        // SAFETY: the command buffer is being recorded, outside of rendering, with a compute pipeline and
        // within the limits. The sets that the pipeline uses and its push constants were found bound.
        unsafe { self.raw_device().cmd_dispatch(self.command, groups[0], groups[1], groups[2]) };
        self.count(|pass| {
            pass.dispatches += 1;
            pass.workgroups += groups.into_iter().map(u64::from).product::<u64>();
        });
    }

    /// Runs the bound compute pipeline on a number of workgroups that the device reads as three u32 from a
    /// buffer, at an offset that is a multiple of 4. The numbers must be within
    /// [`crate::Limits::max_workgroup_count`].
    pub fn dispatch_indirect(&mut self, buffer: &Buffer, offset: u64) {
        if !self.outside_rendering("dispatch_indirect") || !self.has_pipeline(vk::PipelineBindPoint::COMPUTE)
        {
            return;
        }
        if !self.indirect_arguments(buffer, offset, 12) {
            return;
        }
        // SAFETY: as for `dispatch`; the arguments lie within a buffer made for them.
        unsafe { self.raw_device().cmd_dispatch_indirect(self.command, buffer.raw(), offset) };
        self.count(|pass| pass.indirect += 1);
    }
}
