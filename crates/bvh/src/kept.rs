//! Decides which builds keep the tree of an earlier one.

use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::Header;

/// Sum over builds that kept a tree of the growth of its cost, relative to its cost when it was made, at
/// which it is given up: about the traces of so many frames are what a new tree is taken to cost.
const MOST_GROWTH: f64 = 3.0;

/// Growth that is added by each build in which the cost differs at all from that when the tree was made: a
/// new tree might cost less than this one ever did.
const AGEING: f64 = 0.02;

/// Number of builds that keep a tree from which on keeping it was worth while.
const WORTH: u32 = 8;

/// Largest number of builds that make new trees before one is kept again.
const LONGEST_PAUSE: u32 = 64;

/// Largest number of levels that a build which keeps a tree computes one by one.
const MOST_LEVELS: u32 = 64;

/// Decision about kept trees. Each tree that may be kept has a number, from 1, which builds carry in their
/// headers. Once the host has read that a build which made such a tree was complete, builds recorded later
/// may keep it. A build that is merely recorded does not count: it may never be submitted, or be incomplete.
///
/// A tree is given up when the growth of its cost has added up to what a new tree costs. So a tree that is
/// much worse than when it was made is given up at once, one that is a little worse after many builds. While
/// triangles rest, it is kept. If a tree is given up soon after it was made, a pause follows in which none is
/// kept. The pause doubles each time, so that triangles which move without order cost few traces of bad
/// trees.
#[derive(Debug, Default)]
pub(crate) struct KeptTrees(Mutex<State>);

#[derive(Debug)]
struct State {
    /// Number that builds carry now. Triangles or pools that had another number no longer exist.
    current: u32,
    /// What the host last saw of a complete build that made a tree with the current number.
    made: Option<Made>,
    /// Number of builds recorded that keep this tree.
    kept: u32,
    /// Sum of the growth of its cost over the builds that the host has seen.
    growth: f64,
    /// Number of builds that are still to make new trees, and the length of the last pause.
    pause: u32,
    last_pause: u32,
}

/// Tree that may be kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Made {
    /// Number of levels of nodes, 1 to [`MOST_LEVELS`]. The tree in the pools may have more: if there are so
    /// many, or if a build in flight made it later.
    pub(crate) levels: u32,
    /// Number of nodes.
    pub(crate) nodes: u32,
    /// Cost by surface area (`bvh/cost.glsl`).
    cost: f64,
}

impl Default for State {
    fn default() -> Self {
        Self { current: 1, made: None, kept: 0, growth: 0.0, pause: 0, last_pause: 0 }
    }
}

impl State {
    /// Starts a new number, after a pause.
    fn give_up(&mut self, pause: u32) {
        *self = Self { current: self.current.wrapping_add(1), pause, last_pause: pause, ..Self::default() };
    }
}

impl KeptTrees {
    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the number for the header of a build.
    pub(crate) fn number(&self) -> u32 {
        self.state().current
    }

    /// Returns the tree that the next build keeps; none if it makes one.
    pub(crate) fn next(&self) -> Option<Made> {
        let mut state = self.state();
        if state.pause > 0 {
            state.pause -= 1;
            return None;
        }
        state.kept += u32::from(state.made.is_some());
        state.made
    }

    /// Notes the header of a complete build that has ended.
    pub(crate) fn see(&self, header: &Header) {
        let mut state = self.state();
        if header.tree != state.current {
            return;
        }
        let cost = cost_of(header);
        // Builds that make a tree read the order of its triangles from the sort.
        let is_kept = header.order_stride == 0;
        match state.made {
            Some(made) if is_kept => {
                if cost != made.cost {
                    state.growth += (cost / made.cost - 1.0).max(0.0) + AGEING;
                }
                if state.growth >= MOST_GROWTH {
                    let was_worth = state.kept >= WORTH;
                    let pause = if was_worth { 0 } else { (2 * state.last_pause).clamp(1, LONGEST_PAUSE) };
                    state.give_up(pause);
                }
            }
            _ if is_kept => {}
            _ => {
                let levels = header.level_count.clamp(1, MOST_LEVELS);
                state.made = Some(Made { levels, nodes: header.node_count, cost });
            }
        }
    }

    /// Gives up the tree, since triangles or pools have changed.
    pub(crate) fn forget(&self) {
        self.state().give_up(0);
    }
}

fn cost_of(header: &Header) -> f64 {
    let [low, high] = header.cost.map(f64::from);
    low / 4_294_967_296.0 + high
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Header of a build that makes (stride 2) or keeps (stride 0) a tree.
    fn header(number: u32, order_stride: u32, cost: f64) -> Header {
        let cost = [(cost.fract() * 4_294_967_296.0) as u32, cost as u32];
        Header { tree: number, order_stride, cost, level_count: 3, node_count: 9, ..Header::default() }
    }

    #[test]
    fn only_a_complete_build_of_the_same_triangles_is_kept() {
        let trees = KeptTrees::default();
        assert_eq!(trees.next(), None);
        let first = trees.number();
        trees.see(&header(first, 2, 4.0));
        assert_eq!(trees.next().map(|made| (made.levels, made.nodes)), Some((3, 9)));
        trees.forget();
        assert_eq!(trees.next(), None);
        // A frame in flight that was recorded before the change ends after it.
        trees.see(&header(first, 2, 4.0));
        trees.see(&header(first, 0, 4.0));
        assert_eq!(trees.next(), None);
        trees.see(&header(trees.number(), 2, 4.0));
        assert!(trees.next().is_some());
    }

    /// Runs builds whose kept trees cost `growth` times as much with each build, and returns which of them
    /// kept a tree.
    fn run(trees: &KeptTrees, builds: usize, growth: f64) -> Vec<bool> {
        let mut cost = 4.0;
        let mut build = || {
            let made = trees.next();
            cost = if made.is_some() { cost * growth } else { 4.0 };
            trees.see(&header(trees.number(), if made.is_some() { 0 } else { 2 }, cost));
            made.is_some()
        };
        (0..builds).map(|_| build()).collect()
    }

    #[test]
    fn a_tree_is_given_up_when_it_costs_too_much() {
        assert_eq!(run(&KeptTrees::default(), 100, 1.0).iter().filter(|kept| !**kept).count(), 1);
        // With ageing the growth of 22 builds adds up to 3.
        let slow = run(&KeptTrees::default(), 100, 1.01);
        assert!((0..100).all(|build| slow[build] == (build % 23 != 0)), "{slow:?}");
        // A tree that was never cheaper than when it was made still ages.
        let age = 1 + (MOST_GROWTH / AGEING) as usize;
        let cheaper = run(&KeptTrees::default(), 300, 0.9999);
        assert!((0..300).all(|build| cheaper[build] == (build % age != 0)), "{cheaper:?}");
    }

    #[test]
    fn trees_that_are_bad_at_once_are_kept_less_and_less() {
        let trees = KeptTrees::default();
        let wild = run(&trees, 400, 4.0);
        let kept: Vec<usize> = (0..400).filter(|build| wild[*build]).collect();
        // Between two that keep a tree lies a pause.
        let gaps: Vec<usize> = kept.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert_eq!(gaps, [2, 3, 5, 9, 17, 33, 65, 65, 65, 65, 65]);
        // Calm again: after the pause trees are kept for good.
        let calm = run(&trees, 200, 1.0);
        assert!(calm[70..].iter().all(|kept| *kept), "{calm:?}");
        assert_eq!(trees.state().last_pause, 64);
    }
}
