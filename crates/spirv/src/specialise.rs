//! Removal of what the values of specialisation constants switch off.

use std::collections::{HashMap, HashSet};

use crate::flow::{Block, Function, functions};
use crate::fold::folded;
use crate::instruction::{HEADER_WORDS, annotated, instruction, instructions, op, operation, result};
use crate::reduce::only_reached;

const DECORATION_SPEC_ID: u32 = 1;

/// Returns a module without the branches that are never taken, and without the functions and variables that
/// only those reach, for these values of the specialisation constants: id and bits. Constants that are not
/// given have the values of the module. The constants themselves stay, so the values must be given to the
/// pipeline as well.
///
/// What runs is unchanged, instruction by instruction. Takes time linear in the words for each branch that
/// depends on another, in practice three to five passes.
pub fn specialised(words: &[u32], constants: &[(u32, u32)]) -> Vec<u32> {
    let all: Vec<&[u32]> = instructions(words).collect();
    if all.iter().any(|each| each.len() != (each[0] >> 16) as usize) {
        return words.to_vec();
    }
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
    only_reached(&narrowed)
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
        self.bound += 1;
        self.bound - 1
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
        let continues: HashMap<u32, &Block<'_>> = merges()
            .filter(|(_, merge)| operation(merge) == op::LOOP_MERGE)
            .filter_map(|(block, merge)| Some((*merge.get(2)?, block)))
            .collect();
        let dead = |label: &u32| function.blocks.iter().any(|block| block.label == *label && !block.is_live);
        // Values of the phis of loops that nothing continues: a loop must have an end that leads back.
        let mut undefined: HashMap<u32, (u32, u32)> = HashMap::new();
        for (at, first) in continues.iter().filter(|(at, _)| dead(at)) {
            for phi in first.phis() {
                let id = self.id();
                undefined.extend(result(phi).map(|result| (result, (id, *at))));
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
mod tests {
    use super::*;

    /// Operation and operands.
    type Line<'a> = (u32, &'a [u32]);
    /// Id of a function, and its instructions from the first label on.
    type Body<'a> = (u32, &'a [Line<'a>]);

    const VOID: u32 = 20;
    const BOOL: u32 = 21;
    const UINT: u32 = 22;
    /// Constant 7 of the pipeline: false, unless it is given.
    const SWITCH: u32 = 23;
    /// A value that nothing is known of.
    const UNKNOWN: u32 = 24;
    const ONE: u32 = 25;

    /// Makes a module of functions, the first of which is the entry point.
    fn module(functions: &[Body<'_>]) -> Vec<u32> {
        let mut words = vec![0x0723_0203, 0x0001_0500, 0, 100, 0];
        let mut add = |operation, operands: &[u32]| words.extend(instruction(operation, operands));
        add(op::ENTRY_POINT, &[5, functions[0].0, u32::from_le_bytes(*b"main"), 0, UNKNOWN]);
        add(op::DECORATE, &[SWITCH, DECORATION_SPEC_ID, 7]);
        add(op::TYPE_INT, &[UINT, 32, 0]);
        add(op::SPEC_CONSTANT_FALSE, &[BOOL, SWITCH]);
        add(op::CONSTANT, &[UINT, ONE, 1]);
        add(op::VARIABLE, &[BOOL, UNKNOWN, 12]);
        for (id, body) in functions {
            add(op::FUNCTION, &[VOID, *id, 0, VOID]);
            body.iter().for_each(|(operation, operands)| add(*operation, operands));
            add(op::FUNCTION_END, &[]);
        }
        words
    }

    const RETURN: Line<'_> = (253, &[]);

    fn body(words: &[u32], id: u32) -> Vec<(u32, Vec<u32>)> {
        let all: Vec<&[u32]> = instructions(words).collect();
        let functions = functions(&all);
        let function = functions.iter().find(|function| function.id == id);
        let blocks = function.into_iter().flat_map(|function| &function.blocks);
        blocks.flat_map(|block| &block.all).map(|each| (operation(each), each[1..].to_vec())).collect()
    }

    fn owned(all: &[Line<'_>]) -> Vec<(u32, Vec<u32>)> {
        all.iter().map(|(operation, operands)| (*operation, operands.to_vec())).collect()
    }

    /// The entry calls function 2 if `condition`, else 3, and takes a value from the side it came by.
    fn two_sides(condition: u32, before: &[Line<'_>], further: &[Body<'_>]) -> Vec<u32> {
        let branch: &[u32] = &[condition, 31, 32];
        let mut entry = vec![(op::LABEL, &[30][..])];
        entry.extend(before);
        entry.extend([
            (op::SELECTION_MERGE, &[33, 0][..]),
            (op::BRANCH_CONDITIONAL, branch),
            (op::LABEL, &[31]),
            (op::FUNCTION_CALL, &[UINT, 51, 2]),
            (op::BRANCH, &[33]),
            (op::LABEL, &[32]),
            (op::FUNCTION_CALL, &[UINT, 52, 3]),
            (op::BRANCH, &[33]),
            (op::LABEL, &[33]),
            (op::PHI, &[UINT, 53, 51, 31, 52, 32]),
            RETURN,
        ]);
        let called: [Body<'_>; 2] =
            [(2, &[(op::LABEL, &[34]), (254, &[ONE])]), (3, &[(op::LABEL, &[35]), (254, &[UNKNOWN])])];
        let mut functions: Vec<Body<'_>> = vec![(1, &entry)];
        functions.extend(called);
        functions.extend(further);
        module(&functions)
    }

    #[test]
    fn only_the_side_that_is_taken_is_left() {
        let words = two_sides(SWITCH, &[], &[]);
        for (constants, label, call, value, called, other) in
            [(&[][..], 32, 52, 52, 3, 2), (&[(7, 0)], 32, 52, 52, 3, 2), (&[(7, 1)], 31, 51, 51, 2, 3)]
        {
            let left = specialised(&words, constants);
            let expected: [Line<'_>; 8] = [
                (op::LABEL, &[30]),
                (op::BRANCH, &[label]),
                (op::LABEL, &[label]),
                (op::FUNCTION_CALL, &[UINT, call, called]),
                (op::BRANCH, &[33]),
                (op::LABEL, &[33]),
                (op::PHI, &[UINT, 53, value, label]),
                RETURN,
            ];
            assert_eq!(body(&left, 1), owned(&expected));
            assert_eq!((body(&left, called).len(), body(&left, other).len()), (2, 0));
            assert_eq!(specialised(&left, constants), left);
        }
    }

    #[test]
    fn a_branch_on_what_is_not_known_stays() {
        let words = two_sides(UNKNOWN, &[], &[]);
        assert_eq!(specialised(&words, &[(7, 1)]), words);
    }

    #[test]
    fn conditions_are_followed_through_operations_calls_and_meeting_paths() {
        let not = (op::LOGICAL_NOT, &[BOOL, 60, SWITCH][..]);
        let call = (op::FUNCTION_CALL, &[BOOL, 61, 4][..]);
        let and = (op::LOGICAL_AND, &[BOOL, 62, UNKNOWN, 61][..]);
        // Function 4 returns the switch by way of a selection on it.
        let of_switch: Body<'_> = (
            4,
            &[
                (op::LABEL, &[36]),
                (op::SELECTION_MERGE, &[38, 0]),
                (op::BRANCH_CONDITIONAL, &[SWITCH, 37, 38]),
                (op::LABEL, &[37]),
                (op::BRANCH, &[38]),
                (op::LABEL, &[38]),
                (op::PHI, &[BOOL, 63, SWITCH, 36, SWITCH, 37]),
                (254, &[63]),
            ],
        );
        let taken = |condition, constants: &[(u32, u32)]| {
            let left = specialised(&two_sides(condition, &[not, call, and], &[of_switch]), constants);
            [2, 3].map(|id| !body(&left, id).is_empty())
        };
        assert_eq!(taken(60, &[(7, 1)]), [false, true]);
        assert_eq!(taken(60, &[]), [true, false]);
        assert_eq!(taken(61, &[(7, 1)]), [true, false]);
        assert_eq!(taken(61, &[]), [false, true]);
        assert_eq!(taken(62, &[(7, 1)]), [true, true]);
        assert_eq!(taken(62, &[]), [false, true]);
    }

    #[test]
    fn a_place_where_no_side_arrives_is_kept_empty() {
        let words = module(&[(
            1,
            &[
                (op::LABEL, &[30]),
                (op::SELECTION_MERGE, &[33, 0]),
                (op::BRANCH_CONDITIONAL, &[UNKNOWN, 31, 32]),
                (op::LABEL, &[31]),
                RETURN,
                (op::LABEL, &[32]),
                RETURN,
                (op::LABEL, &[33]),
                (op::I_ADD, &[UINT, 53, ONE, ONE]),
                RETURN,
            ],
        )]);
        let left = body(&specialised(&words, &[]), 1);
        assert_eq!(left[left.len() - 2..], owned(&[(op::LABEL, &[33]), (op::UNREACHABLE, &[])]));
    }

    #[test]
    fn a_loop_that_nothing_continues_still_leads_back() {
        let words = module(&[(
            1,
            &[
                (op::LABEL, &[30]),
                (op::BRANCH, &[31]),
                (op::LABEL, &[31]),
                (op::PHI, &[UINT, 50, ONE, 30, 51, 33]),
                (op::LOOP_MERGE, &[34, 33, 0]),
                (op::BRANCH, &[32]),
                (op::LABEL, &[32]),
                (op::BRANCH_CONDITIONAL, &[SWITCH, 34, 33]),
                (op::LABEL, &[33]),
                (op::I_ADD, &[UINT, 51, 50, ONE]),
                (op::BRANCH, &[31]),
                (op::LABEL, &[34]),
                RETURN,
            ],
        )]);
        assert_eq!(specialised(&words, &[])[3], 100);
        assert_eq!(body(&specialised(&words, &[]), 1).len(), 13);
        let left = specialised(&words, &[(7, 1)]);
        let expected: [Line<'_>; 13] = [
            (op::LABEL, &[30]),
            (op::BRANCH, &[31]),
            (op::LABEL, &[31]),
            (op::PHI, &[UINT, 50, ONE, 30, 100, 33]),
            (op::LOOP_MERGE, &[34, 33, 0]),
            (op::BRANCH, &[32]),
            (op::LABEL, &[32]),
            (op::BRANCH, &[34]),
            (op::LABEL, &[33]),
            (op::UNDEF, &[UINT, 100]),
            (op::BRANCH, &[31]),
            (op::LABEL, &[34]),
            RETURN,
        ];
        assert_eq!((body(&left, 1), left[3]), (owned(&expected), 101));
    }

    #[test]
    fn words_that_are_no_module_are_no_panic() {
        let whole = two_sides(SWITCH, &[], &[]);
        for length in 0..whole.len() {
            specialised(&whole[..length], &[(7, 1)]);
        }
        for place in 0..whole.len() {
            for word in [0, u32::MAX, 31, 0x0001_00f8, 0x0003_00f5] {
                let mut words = whole.clone();
                words[place] = word;
                specialised(&words, &[(7, 1)]);
            }
        }
    }
}
