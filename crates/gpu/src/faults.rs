//! Faults on demand, for tests only: Vulkan calls that fail, features and limits that a device pretends not
//! to have.
//!
//! The loader's `vkGetInstanceProcAddr` is replaced by one of this module, from which every other function
//! pointer of instance, device, extensions and memory allocator is got. A function that returns `VkResult` is
//! handed out only with a schedule around it; one that this module does not know is not handed out at all, so
//! that a call that could fail without passing the schedule ends the test program at once. What the driver
//! calls within itself is not seen.
//!
//! Schedules belong to the thread that makes them: tests of one program do not disturb each other.
//!
//! A failed call is not forwarded: the driver sees nothing of it. The exception is a wait that reports a lost
//! device: it is forwarded first, as the work of a device that is really lost does not run on.

mod commands;
mod schedule;

pub use schedule::{At, Injected, With, calls_of, inject, live_objects};

use std::cell::RefCell;

use crate::error::{GpuError, Result};
use crate::features::Feature;
use crate::limits::Limits;

/// A change of limits.
type Lower = Box<dyn Fn(&mut Limits)>;

thread_local! {
    static HIDDEN: RefCell<Vec<Feature>> = const { RefCell::new(Vec::new()) };
    static LOWERED: RefCell<Option<Lower>> = const { RefCell::new(None) };
}

/// The functions of the system's loader, each behind the schedule.
pub(crate) fn entry() -> Result<ash::Entry> {
    commands::entry().map_err(|reason| GpuError::LoaderMissing { reason })
}

/// Runs `work`, in which every device made lacks `features`.
pub fn without<R>(features: &[Feature], work: impl FnOnce() -> R) -> R {
    let before = HIDDEN.replace(features.to_vec());
    let answer = work();
    HIDDEN.set(before);
    answer
}

/// Runs `work`, in which every device made has limits as `change` leaves them. They may only become smaller
/// than those of the device: nothing is gained by promising more than it has.
pub fn with_limits<R>(change: impl Fn(&mut Limits) + 'static, work: impl FnOnce() -> R) -> R {
    let before = LOWERED.replace(Some(Box::new(change)));
    let answer = work();
    LOWERED.set(before);
    answer
}

/// True if [`without`] asks for a device without the feature.
pub(crate) fn hides(feature: Feature) -> bool {
    HIDDEN.with_borrow(|hidden| hidden.contains(&feature))
}

/// Changes limits as [`with_limits`] asks for.
pub(crate) fn lower(mut limits: Limits) -> Limits {
    LOWERED.with_borrow(|change| {
        if let Some(change) = change {
            change(&mut limits);
        }
    });
    limits
}
