//! Blocks of functions, and which of them follow each other.

use std::collections::{HashMap, HashSet};

use crate::fold::folded;
use crate::instruction::{op, operation, result};

/// Opcodes of the instructions of understood modules that end a block: OpBranch to OpUnreachable,
/// OpTerminateInvocation.
const TERMINATORS: [u32; 8] = [249, 250, 251, 252, 253, 254, 255, 4416];

/// A function of a module.
pub(crate) struct Function<'a> {
    /// Place of its first instruction in the module.
    pub(crate) first: usize,
    pub(crate) id: u32,
    /// Instructions before the first block: the function and its parameters.
    pub(crate) head: Vec<&'a [u32]>,
    pub(crate) blocks: Vec<Block<'a>>,
}

/// A block of a function.
pub(crate) struct Block<'a> {
    pub(crate) label: u32,
    /// All instructions, from the label to the terminator.
    pub(crate) all: Vec<&'a [u32]>,
    /// The only block that follows, where the condition of its branch is known.
    pub(crate) only: Option<u32>,
    pub(crate) is_live: bool,
}

/// Finds the functions of a module.
pub(crate) fn functions<'a>(all: &[&'a [u32]]) -> Vec<Function<'a>> {
    let mut functions: Vec<Function<'a>> = Vec::new();
    for (place, each) in all.iter().enumerate() {
        match (operation(each), *each) {
            (op::FUNCTION, [_, _, id, ..]) => {
                functions.push(Function { first: place, id: *id, head: vec![each], blocks: Vec::new() });
            }
            (op::LABEL, [_, label]) => {
                let Some(function) = functions.last_mut() else { continue };
                function.blocks.push(Block { label: *label, all: vec![each], only: None, is_live: true });
            }
            (op::FUNCTION_END, _) => {}
            _ => {
                let Some(function) = functions.last_mut() else { continue };
                match function.blocks.last_mut() {
                    None => function.head.push(each),
                    // Lines of source text may stand between blocks.
                    Some(block) if TERMINATORS.contains(&operation(block.terminator())) => {}
                    Some(block) => block.all.push(each),
                }
            }
        }
    }
    functions
}

impl<'a> Block<'a> {
    fn terminator(&self) -> &'a [u32] {
        // A block has its label at least.
        self.all[self.all.len() - 1]
    }

    /// Returns the merge instruction in front of the terminator.
    pub(crate) fn merge(&self) -> Option<&'a [u32]> {
        let before = self.all.len().checked_sub(2)?;
        let merge = self.all[before];
        [op::LOOP_MERGE, op::SELECTION_MERGE].contains(&operation(merge)).then_some(merge)
    }

    /// Returns the labels of the blocks that may follow.
    fn next(&self) -> Vec<u32> {
        if let Some(only) = self.only {
            return vec![only];
        }
        let terminator = self.terminator();
        match (operation(terminator), terminator) {
            (op::BRANCH, [_, target]) => vec![*target],
            (op::BRANCH_CONDITIONAL, [_, _, yes, no, ..]) => vec![*yes, *no],
            (op::SWITCH, [_, _, default, cases @ ..]) => {
                [*default].into_iter().chain(cases.chunks_exact(2).map(|case| case[1])).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Returns the place where the loop that begins here continues.
    pub(crate) fn continues_at(&self) -> Option<u32> {
        let merge = self.merge().filter(|merge| operation(merge) == op::LOOP_MERGE)?;
        merge.get(2).copied()
    }

    /// True if a merge instruction is dropped: a branch that is decided needs no place where its sides meet.
    pub(crate) fn drops(&self, each: &[u32]) -> bool {
        operation(each) == op::SELECTION_MERGE && self.only.is_some()
    }

    /// Iterates over its phi instructions.
    pub(crate) fn phis(&self) -> impl Iterator<Item = &'a [u32]> {
        self.all.iter().copied().filter(|each| operation(each) == op::PHI)
    }
}

impl Function<'_> {
    /// Marks the blocks that can be reached.
    fn reach(&mut self) {
        let places: HashMap<u32, usize> =
            self.blocks.iter().enumerate().map(|(place, block)| (block.label, place)).collect();
        self.blocks.iter_mut().for_each(|block| block.is_live = false);
        let mut left = Vec::from_iter(self.blocks.first().map(|block| block.label));
        while let Some(label) = left.pop() {
            let Some(block) = places.get(&label).map(|place| &mut self.blocks[*place]) else { continue };
            if !std::mem::replace(&mut block.is_live, true) {
                left.extend(block.next());
            }
        }
    }

    /// Returns the pairs of blocks of which the second may follow the first.
    pub(crate) fn edges(&self) -> HashSet<(u32, u32)> {
        let live = self.blocks.iter().filter(|block| block.is_live);
        live.flat_map(|block| block.next().into_iter().map(|next| (block.label, next))).collect()
    }

    /// True if what is left has the form of a function: it has [whole loops](Self::has_whole_loops), each
    /// block follows one that leads to it, and no branch leaves a selection whose merge instruction is
    /// dropped.
    pub(crate) fn is_whole(&self) -> bool {
        let live = || self.blocks.iter().filter(|block| block.is_live);
        let mut led_to: HashSet<u32> = HashSet::from_iter(self.blocks.first().map(|block| block.label));
        let is_in_order = live().all(|block| {
            let follows = led_to.contains(&block.label);
            led_to.extend(block.next());
            follows
        });
        let merges = live().filter_map(|block| Some((block, block.merge()?)));
        let dropped: HashSet<u32> = merges
            .filter(|(block, merge)| block.drops(merge))
            .filter_map(|(_, merge)| merge.get(1).copied())
            .collect();
        let mut leaving = live().filter(|block| block.only.is_none() && block.merge().is_none());
        let leaves = leaving.any(|block| {
            operation(block.terminator()) == op::BRANCH_CONDITIONAL
                && block.next().iter().any(|next| dropped.contains(next))
        });
        is_in_order && !leaves && self.has_whole_loops()
    }

    /// True if a block leads back to each loop that can be continued.
    fn has_whole_loops(&self) -> bool {
        let live = || self.blocks.iter().enumerate().filter(|(_, block)| block.is_live);
        let is_live = |label: u32| live().any(|(_, block)| block.label == label);
        let mut loops = live().filter_map(|(place, block)| Some((place, block.label, block.continues_at()?)));
        loops.all(|(first, label, continues)| {
            !is_live(continues)
                || live().any(|(place, block)| place >= first && block.next().contains(&label))
        })
    }

    /// Finds values of instructions, decides the branches that depend on them, and finds the value that the
    /// function returns. Returns whether anything was found. What has been found stays true in later calls,
    /// as only further blocks go.
    pub(crate) fn narrow(&mut self, known: &mut HashMap<u32, u32>, returns: &mut HashMap<u32, u32>) -> bool {
        self.reach();
        let edges = self.edges();
        let before = (known.len(), returns.len());
        let mut decided = false;
        let mut returned = Vec::new();
        // Loops that have begun: a branch back to one stays, as each needs one.
        let mut begun = HashSet::new();
        for block in self.blocks.iter_mut().filter(|block| block.is_live) {
            begun.extend(block.continues_at().map(|_| block.label));
            for each in &block.all {
                let value = |id: u32| known.get(&id).copied();
                let found = match (operation(each), *each) {
                    (op::PHI, [_, _, _, pairs @ ..]) => {
                        let live =
                            pairs.chunks_exact(2).filter(|pair| edges.contains(&(pair[1], block.label)));
                        one(live.map(|pair| value(pair[0])))
                    }
                    (op::FUNCTION_CALL, [_, _, _, called, ..]) => returns.get(called).copied(),
                    (op::RETURN_VALUE, [_, id]) => {
                        returned.push(value(*id));
                        None
                    }
                    _ => folded(each, value),
                };
                if let (Some(found), Some(id)) = (found, result(each)) {
                    known.insert(id, found);
                }
            }
            if let (None, [_, condition, yes, no, ..]) = (block.only, block.terminator())
                && operation(block.terminator()) == op::BRANCH_CONDITIONAL
                && !begun.contains(yes)
                && !begun.contains(no)
                && let Some(value) = known.get(condition)
            {
                block.only = Some(if *value != 0 { *yes } else { *no });
                decided = true;
            }
        }
        if let Some(found) = one(returned) {
            returns.insert(self.id, found);
        }
        decided || before != (known.len(), returns.len())
    }
}

/// Returns the value that all are, if all are known.
fn one(values: impl IntoIterator<Item = Option<u32>>) -> Option<u32> {
    let mut values = values.into_iter();
    let first = values.next()??;
    values.all(|value| value == Some(first)).then_some(first)
}
