//! Fault injection, for tests only: Vulkan calls that fail, and features and limits that a device pretends to
//! lack.
//!
//! This module replaces the loader's `vkGetInstanceProcAddr`, from which all function pointers of instance,
//! device, extensions and memory allocator are obtained. A function that returns `VkResult` is handed out
//! only with a schedule around it. A function that this module does not know is not handed out at all, so
//! that a call that could fail without passing the schedule ends the test program at once. Calls that the
//! driver makes internally are not seen.
//!
//! Schedules belong to the thread that makes them, so tests of one program do not disturb each other.
//!
//! A call that is made to fail is not forwarded, so the driver does not see it. The exception is a wait that
//! reports a lost device: it is forwarded first, because the work of a device that is really lost does not
//! continue either.

mod commands;
mod schedule;

pub use schedule::{At, Injected, With, calls_of, inject, live_objects};

use std::cell::RefCell;

use crate::error::{GpuError, Result};
use crate::features::Feature;
use crate::limits::Limits;

/// Function that changes limits.
type Lower = Box<dyn Fn(&mut Limits)>;

thread_local! {
    static HIDDEN: RefCell<Vec<Feature>> = const { RefCell::new(Vec::new()) };
    static LOWERED: RefCell<Option<Lower>> = const { RefCell::new(None) };
}

/// Returns the functions of the system's loader, with the schedule around each.
pub(crate) fn entry() -> Result<ash::Entry> {
    commands::entry().map_err(|reason| GpuError::LoaderMissing { reason })
}

/// Runs `work`; every device made in it lacks `features`.
pub fn without<R>(features: &[Feature], work: impl FnOnce() -> R) -> R {
    let before = HIDDEN.replace(features.to_vec());
    let answer = work();
    HIDDEN.set(before);
    answer
}

/// Runs `work`; every device made in it has the limits that `change` leaves. Limits may only become smaller
/// than those of the device, because promising more than the device has is of no use.
pub fn with_limits<R>(change: impl Fn(&mut Limits) + 'static, work: impl FnOnce() -> R) -> R {
    let before = LOWERED.replace(Some(Box::new(change)));
    let answer = work();
    LOWERED.set(before);
    answer
}

/// Returns true if [`without`] hides the feature.
pub(crate) fn hides(feature: Feature) -> bool {
    HIDDEN.with_borrow(|hidden| hidden.contains(&feature))
}

/// Changes limits by the function of [`with_limits`], if there is one.
pub(crate) fn lower(mut limits: Limits) -> Limits {
    LOWERED.with_borrow(|change| {
        if let Some(change) = change {
            change(&mut limits);
        }
    });
    limits
}
