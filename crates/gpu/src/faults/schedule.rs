//! Schedule of failing calls, and account of what has been made and not destroyed.

use std::cell::RefCell;
use std::collections::BTreeMap;

use ash::vk;

/// The failing call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum At {
    /// The call of this index among all that can fail, from 0.
    Call(usize),
    /// The call of this index among those of one function, from 0.
    Named(&'static str, usize),
}

/// Failure of a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum With {
    /// With one of the codes that the function may return; beyond their number it begins again.
    Code(usize),
    /// With this code.
    Result(vk::Result),
}

/// A call that was failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Injected {
    /// Its function.
    pub call: &'static str,
    /// Result that it was made to return.
    pub result: vk::Result,
}

#[derive(Default)]
struct State {
    /// True if calls are watched at all; elsewhere they pass without a trace.
    watched: bool,
    plan: Option<(At, With)>,
    /// Functions called since the watch began.
    calls: Vec<&'static str>,
    injected: Option<Injected>,
    live: BTreeMap<&'static str, i64>,
}

thread_local! {
    static STATE: RefCell<State> = RefCell::default();
}

/// Runs `work` and returns the functions that it called and that can fail, in order.
pub fn calls_of<R>(work: impl FnOnce() -> R) -> (R, Vec<&'static str>) {
    begin(None);
    let answer = work();
    (
        answer,
        STATE.with_borrow_mut(|state| {
            state.watched = false;
            std::mem::take(&mut state.calls)
        }),
    )
}

/// Runs `work`, in which one call fails. Tells which; `None` if there was no such call.
pub fn inject<R>(at: At, with: With, work: impl FnOnce() -> R) -> (R, Option<Injected>) {
    begin(Some((at, with)));
    let answer = work();
    let injected = STATE.with_borrow_mut(|state| {
        state.watched = false;
        state.plan = None;
        state.injected.take()
    });
    (answer, injected)
}

/// Objects that this thread has made less those that it has destroyed, by their type. Command buffers and
/// descriptor sets, which go with their pools, and objects of the driver are not counted.
pub fn live_objects() -> BTreeMap<&'static str, i64> {
    STATE.with_borrow(|state| {
        state.live.iter().filter(|(_, count)| **count != 0).map(|(name, count)| (*name, *count)).collect()
    })
}

fn begin(plan: Option<(At, With)>) {
    STATE.with_borrow_mut(|state| {
        state.watched = true;
        state.plan = plan;
        state.calls.clear();
        state.injected = None;
    });
}

/// Asked by every call that can fail: what it shall return instead of being made.
pub(super) fn verdict(call: &'static str, codes: &[vk::Result]) -> Option<vk::Result> {
    STATE.with_borrow_mut(|state| {
        if !state.watched {
            return None;
        }
        let index = state.calls.len();
        let of_function = state.calls.iter().filter(|made| **made == call).count();
        state.calls.push(call);
        let (at, with) = state.plan?;
        let hit = match at {
            At::Call(wanted) => wanted == index,
            At::Named(name, wanted) => name == call && wanted == of_function,
        };
        if !hit {
            return None;
        }
        let result = match with {
            With::Code(code) => codes[code % codes.len()],
            With::Result(result) => result,
        };
        state.injected = Some(Injected { call, result });
        Some(result)
    })
}

/// Notes objects made (positive) or destroyed (negative).
pub(super) fn note(kind: &'static str, change: i64) {
    STATE.with_borrow_mut(|state| *state.live.entry(kind).or_default() += change);
}
