//! Schedule of failing calls, and count of the objects that were made and not destroyed.

use std::cell::RefCell;
use std::collections::BTreeMap;

use ash::vk;

/// Selection of the call that fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum At {
    /// The call with this index among all calls that can fail, from 0.
    Call(usize),
    /// The call with this index among those of one function, from 0.
    Named(&'static str, usize),
}

/// Result that the failing call returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum With {
    /// One of the codes that the function may return, by index; an index beyond the last code wraps around.
    Code(usize),
    /// This code.
    Result(vk::Result),
}

/// A call that was made to fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Injected {
    /// Function of the call.
    pub call: &'static str,
    /// Result that the call returned.
    pub result: vk::Result,
}

#[derive(Default)]
struct State {
    /// True if calls are watched; otherwise they pass unnoticed.
    watched: bool,
    plan: Option<(At, With)>,
    /// Functions called since the watch began, in order.
    calls: Vec<&'static str>,
    injected: Option<Injected>,
    live: BTreeMap<&'static str, i64>,
}

thread_local! {
    static STATE: RefCell<State> = RefCell::default();
}

/// Runs `work`; returns its result and the functions that it called and that can fail, in order.
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

/// Runs `work`, in which one call fails. Returns its result and the failed call; `None` if no call matched.
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

/// Returns the number of objects that this thread has made and not destroyed, by type. Command buffers and
/// descriptor sets, which are freed with their pools, and objects of the driver are not counted.
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

/// Returns the result that a call shall return instead of being made; every call that can fail asks for it.
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

/// Adds `change` to the number of objects of a type: positive if made, negative if destroyed.
pub(super) fn note(kind: &'static str, change: i64) {
    STATE.with_borrow_mut(|state| *state.live.entry(kind).or_default() += change);
}
