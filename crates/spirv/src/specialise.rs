//! Removal of what the values of specialisation constants switch off.

use std::collections::{HashMap, HashSet};

use crate::flow::{Block, Function, functions};
use crate::fold::folded;
use crate::instruction::{
    HEADER_WORDS, annotated, instruction, instructions, is_understood, op, operation, result,
};
use crate::reduce::reduced;

const DECORATION_SPEC_ID: u32 = 1;

/// Returns a module without the branches that are never taken, and without the functions and variables that
/// only those reach, for these values of the specialisation constants: id and bits. Constants that are not
/// given have the values of the module. The constants themselves stay, so the values must be given to the
/// pipeline as well.
///
/// What runs is unchanged, instruction by instruction. A module keeps all its branches where the rest would
/// not have the form that SPIR-V asks for, and stays as it is with instructions that this crate does not
/// know. Takes time linear in the words for each branch that depends on another, in practice three to five
/// passes.
pub fn specialised(words: &[u32], constants: &[(u32, u32)]) -> Vec<u32> {
    if !is_understood(words) {
        return words.to_vec();
    }
    let all: Vec<&[u32]> = instructions(words).collect();
    let mut known = values(&all, constants);
    let mut functions = functions(&all);
    let mut returns = HashMap::new();
    let mut changed = true;
    while changed {
        changed = false;
        for function in &mut functions {
            changed |= function.narrow(&mut known, &mut returns);
        }
    }
    if !functions.iter().all(Function::is_whole) {
        return reduced(words);
    }
    let head = functions.first().map_or(all.len(), |first| first.first);
    let mut written = Written { bound: words.get(3).copied().unwrap_or_default(), ..Written::default() };
    functions.iter().for_each(|function| written.function(function));
    let mut narrowed = words[..HEADER_WORDS.min(words.len())].to_vec();
    let is_gone = |id: u32| written.gone.contains(&id) && !written.kept.contains(&id);
    for each in &all[..head] {
        if !annotated(each).is_some_and(is_gone) {
            narrowed.extend_from_slice(each);
        }
    }
    narrowed.extend(written.bodies);
    if let Some(bound) = narrowed.get_mut(3) {
        *bound = written.bound;
    }
    reduced(&narrowed)
}

/// Returns the values of the module's scalar constants of 32 bits.
fn values(all: &[&[u32]], constants: &[(u32, u32)]) -> HashMap<u32, u32> {
    let given: HashMap<u32, u32> = constants.iter().copied().collect();
    let mut chosen = HashMap::new();
    let mut known = HashMap::new();
    let mut of_32_bits = HashSet::new();
    for each in all.iter().take_while(|each| operation(each) != op::FUNCTION) {
        let value = match (operation(each), *each) {
            (op::DECORATE, [_, id, DECORATION_SPEC_ID, number]) => {
                chosen.extend(given.get(number).map(|bits| (*id, *bits)));
                continue;
            }
            (op::TYPE_INT | op::TYPE_FLOAT, [_, kind, 32, ..]) => {
                of_32_bits.insert(*kind);
                continue;
            }
            (op::CONSTANT_TRUE, [_, _, _]) => Some(1),
            (op::CONSTANT_FALSE, [_, _, _]) => Some(0),
            (op::CONSTANT, [_, kind, _, bits]) if of_32_bits.contains(kind) => Some(*bits),
            (op::SPEC_CONSTANT_TRUE, [_, _, id]) => Some(chosen.get(id).map_or(1, |bits| (*bits).min(1))),
            (op::SPEC_CONSTANT_FALSE, [_, _, id]) => Some(chosen.get(id).map_or(0, |bits| (*bits).min(1))),
            (op::SPEC_CONSTANT, [_, kind, id, bits]) if of_32_bits.contains(kind) => {
                Some(chosen.get(id).copied().unwrap_or(*bits))
            }
            (op::SPEC_CONSTANT_OP, _) => folded(each, |id| known.get(&id).copied()),
            _ => None,
        };
        if let (Some(value), [_, _, id, ..]) = (value, *each) {
            known.insert(*id, value);
        }
    }
    known
}

/// Functions of a module as they are written.
#[derive(Default)]
struct Written {
    bodies: Vec<u32>,
    /// Ids that are defined.
    kept: HashSet<u32>,
    /// Ids of blocks that are left out.
    gone: HashSet<u32>,
    /// The least number that is no id.
    bound: u32,
}

impl Written {
    fn instruction(&mut self, each: &[u32]) {
        self.kept.extend(result(each));
        self.bodies.extend_from_slice(each);
    }

    fn id(&mut self) -> u32 {
        let id = self.bound;
        self.bound = id.saturating_add(1);
        id
    }

    fn function(&mut self, function: &Function<'_>) {
        let edges = function.edges();
        let live = || function.blocks.iter().filter(|block| block.is_live);
        let merges = || live().filter_map(|block| Some((block, block.merge()?)));
        let needed: HashSet<u32> = merges()
            .filter(|(block, merge)| !block.drops(merge))
            .filter_map(|(_, merge)| merge.get(1).copied())
            .collect();
        // Where loops continue, with their first blocks.
        let continues: HashMap<u32, &Block<'_>> =
            live().filter_map(|block| Some((block.continues_at()?, block))).collect();
        // Values of the phis of loops that nothing continues: a loop must have an end that leads back. They
        // are numbered in the order of blocks, so that equal modules give equal words.
        let mut undefined: HashMap<u32, (u32, u32)> = HashMap::new();
        for block in function.blocks.iter().filter(|block| !block.is_live) {
            for phi in continues.get(&block.label).iter().flat_map(|first| first.phis()) {
                let id = self.id();
                undefined.extend(result(phi).map(|result| (result, (id, block.label))));
            }
        }
        function.head.iter().for_each(|each| self.instruction(each));
        for block in &function.blocks {
            if block.is_live {
                self.block(block, &edges, &undefined);
                continue;
            }
            self.gone.extend(block.all.iter().filter_map(|each| result(each)));
            let label = instruction(op::LABEL, &[block.label]);
            if let Some(first) = continues.get(&block.label) {
                self.instruction(&label);
                for phi in first.phis() {
                    let made = result(phi).and_then(|id| undefined.get(&id));
                    if let (Some((id, _)), [_, kind, ..]) = (made, phi) {
                        self.instruction(&instruction(op::UNDEF, &[*kind, *id]));
                    }
                }
                self.instruction(&instruction(op::BRANCH, &[first.label]));
            } else if needed.contains(&block.label) {
                self.instruction(&label);
                self.instruction(&instruction(op::UNREACHABLE, &[]));
            }
        }
        self.instruction(&instruction(op::FUNCTION_END, &[]));
    }

    fn block(
        &mut self,
        block: &Block<'_>,
        edges: &HashSet<(u32, u32)>,
        undefined: &HashMap<u32, (u32, u32)>,
    ) {
        let last = block.all.len() - 1;
        for (place, each) in block.all.iter().enumerate() {
            match (block.only, operation(each), *each) {
                (Some(only), _, _) if place == last => self.instruction(&instruction(op::BRANCH, &[only])),
                _ if block.drops(each) => {}
                (_, op::PHI, [_, kind, id, pairs @ ..]) => {
                    let live = pairs.chunks_exact(2).filter(|pair| edges.contains(&(pair[1], block.label)));
                    let mut operands = vec![*kind, *id];
                    operands.extend(live.flatten());
                    operands.extend(undefined.get(id).iter().flat_map(|(value, from)| [value, from]));
                    self.instruction(&instruction(op::PHI, &operands));
                }
                _ => self.instruction(each),
            }
        }
    }
}

#[cfg(test)]
mod tests;
