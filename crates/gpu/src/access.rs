//! Kinds of memory access, for barriers.

use std::ops::{BitOr, BitOrAssign};

use ash::vk;

/// Set of memory accesses: the stages that access memory, and the kinds of access. Values combine with `|`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Access(u32);

impl Access {
    /// No access: a barrier orders execution only.
    pub const NONE: Access = Access(0);
    /// Reads of storage buffers by compute shaders.
    pub const COMPUTE_READ: Access = Access(1);
    /// Writes to storage buffers by compute shaders, atomics included.
    pub const COMPUTE_WRITE: Access = Access(1 << 1);
    /// Reads of storage buffers by vertex shaders.
    pub const VERTEX_READ: Access = Access(1 << 2);
    /// Writes to storage buffers by vertex shaders, atomics included.
    pub const VERTEX_WRITE: Access = Access(1 << 3);
    /// Reads of storage buffers by fragment shaders.
    pub const FRAGMENT_READ: Access = Access(1 << 4);
    /// Writes to storage buffers by fragment shaders, atomics included.
    pub const FRAGMENT_WRITE: Access = Access(1 << 5);
    /// Reads of buffers as sources of copies.
    pub const TRANSFER_READ: Access = Access(1 << 6);
    /// Writes to buffers as targets of copies and fills.
    pub const TRANSFER_WRITE: Access = Access(1 << 7);
    /// Reads of arguments of indirect dispatches and draws.
    pub const INDIRECT_READ: Access = Access(1 << 8);
    /// Reads by the host after it waited for the device.
    pub const HOST_READ: Access = Access(1 << 9);
    /// Writes by the host.
    pub const HOST_WRITE: Access = Access(1 << 10);
    /// Reads and writes by builds of the driver's trees. Valid only if
    /// [`crate::Feature::AccelerationStructure`] is enabled.
    pub const TREE_BUILD: Access = Access(1 << 11);
    /// Reads by ray queries of compute shaders. Valid only if [`crate::Feature::RayQuery`] is enabled.
    pub const TREE_TRACE: Access = Access(1 << 12);
    /// All accesses.
    pub const ALL: Access = Access((1 << 13) - 1);

    /// Reads and writes of compute shaders.
    pub const COMPUTE: Access = Access(Self::COMPUTE_READ.0 | Self::COMPUTE_WRITE.0);
    /// Reads and writes of fragment shaders.
    pub const FRAGMENT: Access = Access(Self::FRAGMENT_READ.0 | Self::FRAGMENT_WRITE.0);
    /// Reads and writes of copies and fills.
    pub const TRANSFER: Access = Access(Self::TRANSFER_READ.0 | Self::TRANSFER_WRITE.0);

    /// Returns true if this set contains every access of `other`.
    pub const fn contains(self, other: Access) -> bool {
        self.0 & other.0 == other.0
    }

    /// Returns the union of both sets, for constants, in which `|` is not available.
    pub const fn union(self, other: Access) -> Access {
        Access(self.0 | other.0)
    }

    /// Returns the Vulkan stages and accesses. `graphics` states whether the queue supports the stages of
    /// drawing.
    pub(crate) fn scope(self, graphics: bool) -> (vk::PipelineStageFlags2, vk::AccessFlags2) {
        use vk::{AccessFlags2 as Flags, PipelineStageFlags2 as Stages};
        if self == Self::ALL {
            return (Stages::ALL_COMMANDS | Stages::HOST, Flags::MEMORY_READ | Flags::MEMORY_WRITE);
        }
        let vertex = if graphics { Stages::VERTEX_SHADER } else { Stages::NONE };
        let fragment = if graphics { Stages::FRAGMENT_SHADER } else { Stages::NONE };
        let table = [
            (Self::COMPUTE_READ, Stages::COMPUTE_SHADER, Flags::SHADER_STORAGE_READ),
            (
                Self::COMPUTE_WRITE,
                Stages::COMPUTE_SHADER,
                Flags::SHADER_STORAGE_READ | Flags::SHADER_STORAGE_WRITE,
            ),
            (Self::VERTEX_READ, vertex, Flags::SHADER_STORAGE_READ),
            (Self::VERTEX_WRITE, vertex, Flags::SHADER_STORAGE_READ | Flags::SHADER_STORAGE_WRITE),
            (Self::FRAGMENT_READ, fragment, Flags::SHADER_STORAGE_READ),
            (Self::FRAGMENT_WRITE, fragment, Flags::SHADER_STORAGE_READ | Flags::SHADER_STORAGE_WRITE),
            (Self::TRANSFER_READ, Stages::ALL_TRANSFER, Flags::TRANSFER_READ),
            (Self::TRANSFER_WRITE, Stages::ALL_TRANSFER, Flags::TRANSFER_WRITE),
            (Self::INDIRECT_READ, Stages::DRAW_INDIRECT, Flags::INDIRECT_COMMAND_READ),
            (Self::HOST_READ, Stages::HOST, Flags::HOST_READ),
            (Self::HOST_WRITE, Stages::HOST, Flags::HOST_WRITE),
            (
                Self::TREE_BUILD,
                Stages::ACCELERATION_STRUCTURE_BUILD_KHR,
                // Builds read boxes and instances with the accesses of shader reads.
                Flags::ACCELERATION_STRUCTURE_READ_KHR
                    | Flags::ACCELERATION_STRUCTURE_WRITE_KHR
                    | Flags::SHADER_READ,
            ),
            (Self::TREE_TRACE, Stages::COMPUTE_SHADER, Flags::ACCELERATION_STRUCTURE_READ_KHR),
        ];
        let mut scope = (Stages::NONE, Flags::NONE);
        for (access, stages, flags) in table {
            if self.contains(access) && stages != Stages::NONE {
                scope.0 |= stages;
                scope.1 |= flags;
            }
        }
        scope
    }
}

impl BitOr for Access {
    type Output = Access;

    fn bitor(self, other: Access) -> Access {
        self.union(other)
    }
}

impl BitOrAssign for Access {
    fn bitor_assign(&mut self, other: Access) {
        self.0 |= other.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accesses_combine_and_leave_out_stages_the_queue_lacks() {
        let access = Access::COMPUTE_WRITE | Access::FRAGMENT_READ;
        let (stages, flags) = access.scope(true);
        assert_eq!(
            stages,
            vk::PipelineStageFlags2::COMPUTE_SHADER | vk::PipelineStageFlags2::FRAGMENT_SHADER
        );
        assert!(flags.contains(vk::AccessFlags2::SHADER_STORAGE_WRITE));
        let (stages, _) = access.scope(false);
        assert_eq!(stages, vk::PipelineStageFlags2::COMPUTE_SHADER);
        let (stages, flags) = Access::VERTEX_READ.scope(false);
        assert_eq!((stages, flags), (vk::PipelineStageFlags2::NONE, vk::AccessFlags2::NONE));
    }
}
