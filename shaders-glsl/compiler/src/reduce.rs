//! Removal of unused parts of a module: functions that nothing calls, variables that nothing uses, debug
//! text.
//!
//! GLSL files that are included whole leave most of their functions unused, and a compiler that does not
//! optimise keeps all of them. Drivers would drop them, but an unused variable counts as used where a device
//! limits the buffers of a stage, and every byte is part of the program.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

const HEADER_WORDS: usize = 5;
const OP_NAME: u32 = 5;
const OP_EXT_INST: u32 = 12;
const OP_ENTRY_POINT: u32 = 15;
const OP_FUNCTION: u32 = 54;
const OP_FUNCTION_END: u32 = 56;
const OP_FUNCTION_CALL: u32 = 57;
const OP_VARIABLE: u32 = 59;
const OP_DECORATE: u32 = 71;
const OP_LABEL: u32 = 248;
/// Opcodes of debug text: OpSourceContinued, OpSource, OpSourceExtension, OpName, OpMemberName, OpString,
/// OpLine, OpNoLine, OpModuleProcessed.
const DEBUG: [u32; 9] = [2, 3, 4, 5, 6, 7, 8, 317, 330];
/// Opcodes of instructions of functions that have no result: OpNop, OpLine, OpFunctionEnd, OpStore,
/// OpCopyMemory, OpImageWrite, OpControlBarrier, OpMemoryBarrier, OpAtomicStore, OpLoopMerge,
/// OpSelectionMerge, OpBranch, OpBranchConditional, OpSwitch, OpKill, OpReturn, OpReturnValue, OpUnreachable,
/// OpNoLine, OpTerminateInvocation.
const WITHOUT_RESULT: [u32; 20] =
    [0, 8, 56, 62, 63, 99, 224, 225, 228, 246, 247, 249, 250, 251, 252, 253, 254, 255, 317, 4416];
/// Opcodes of instructions of functions whose operands are not variables, or are numbers that could be
/// mistaken for one: OpVectorShuffle, OpCompositeExtract, OpCompositeInsert, OpLoopMerge, OpSelectionMerge,
/// OpBranchConditional, OpSwitch, OpLine.
const NAMES_NO_VARIABLE: [u32; 8] = [8, 79, 81, 82, 246, 247, 250, 251];

/// Iterates over the instructions of a module; the last one is cut where the module is cut.
fn instructions(words: &[u32]) -> impl Iterator<Item = &[u32]> {
    let mut rest = words.get(HEADER_WORDS..).unwrap_or_default();
    std::iter::from_fn(move || {
        let first = *rest.first()?;
        let (instruction, after) = rest.split_at(((first >> 16) as usize).clamp(1, rest.len()));
        rest = after;
        Some(instruction)
    })
}

fn operation(instruction: &[u32]) -> u32 {
    instruction[0] & 0xffff
}

/// Returns the module with only the instructions for which `keep` returns one, in the form that it returns.
fn filtered<'a>(words: &'a [u32], keep: impl FnMut(&'a [u32]) -> Option<Cow<'a, [u32]>>) -> Vec<u32> {
    let mut kept = words[..HEADER_WORDS.min(words.len())].to_vec();
    for instruction in instructions(words).filter_map(keep) {
        kept.extend_from_slice(&instruction);
    }
    kept
}

/// Returns a module without names, source text and lines, none of which changes its effect.
pub fn without_debug_text(words: &[u32]) -> Vec<u32> {
    filtered(words, |instruction| (!DEBUG.contains(&operation(instruction))).then(|| instruction.into()))
}

/// Returns a module without the functions that its entry points do not reach, and without the variables that
/// only those functions use.
pub(crate) fn only_reached(words: &[u32]) -> Vec<u32> {
    let functions = Functions::of(words);
    let reached = functions.reached();
    let mut named = HashSet::new();
    let mut gone = HashSet::new();
    for (id, body) in &functions.bodies {
        for instruction in body {
            if reached.contains(id) {
                named.extend(variables_named(instruction));
            } else {
                gone.extend(result(instruction));
            }
        }
    }
    // Variables of the module precede its functions.
    for instruction in instructions(words).take_while(|instruction| operation(instruction) != OP_FUNCTION) {
        if operation(instruction) == OP_VARIABLE {
            gone.extend(result(instruction).filter(|id| !named.contains(id)));
        }
    }
    let mut function = None;
    filtered(words, |instruction| {
        let operation = operation(instruction);
        if operation == OP_FUNCTION {
            function = result(instruction);
        }
        let unreached = function.is_some_and(|id| !reached.contains(&id));
        if operation == OP_FUNCTION_END {
            function = None;
        }
        let dropped = match operation {
            OP_NAME | OP_DECORATE => instruction.get(1).is_some_and(|id| gone.contains(id)),
            OP_VARIABLE => result(instruction).is_some_and(|id| gone.contains(&id)),
            _ => false,
        };
        if unreached || dropped {
            None
        } else if operation == OP_ENTRY_POINT {
            Some(entry_point(instruction, &gone).into())
        } else {
            Some(instruction.into())
        }
    })
}

/// Functions of a module.
#[derive(Default)]
struct Functions<'a> {
    bodies: HashMap<u32, Vec<&'a [u32]>>,
    entries: Vec<u32>,
}

impl<'a> Functions<'a> {
    fn of(words: &'a [u32]) -> Self {
        let mut functions = Self::default();
        let mut function = None;
        for instruction in instructions(words) {
            match (operation(instruction), instruction) {
                (OP_ENTRY_POINT, [_, _, id, ..]) => functions.entries.push(*id),
                (OP_FUNCTION, [_, _, id, ..]) => function = Some(*id),
                _ => {}
            }
            if let Some(id) = function {
                functions.bodies.entry(id).or_default().push(instruction);
            }
            if operation(instruction) == OP_FUNCTION_END {
                function = None;
            }
        }
        functions
    }

    /// Returns the ids of the functions that run.
    fn reached(&self) -> HashSet<u32> {
        let mut reached = HashSet::new();
        let mut left = self.entries.clone();
        while let Some(id) = left.pop() {
            if !reached.insert(id) {
                continue;
            }
            for instruction in self.bodies.get(&id).into_iter().flatten() {
                if let (OP_FUNCTION_CALL, [_, _, _, called, ..]) = (operation(instruction), *instruction) {
                    left.push(*called);
                }
            }
        }
        reached
    }
}

/// Returns the id that an instruction of a function, or a global variable, defines.
fn result(instruction: &[u32]) -> Option<u32> {
    match operation(instruction) {
        operation if WITHOUT_RESULT.contains(&operation) => None,
        OP_LABEL => instruction.get(1).copied(),
        _ => instruction.get(2).copied(),
    }
}

/// Iterates over the ids in an instruction of a function, which include all variables that it uses.
fn variables_named(instruction: &[u32]) -> impl Iterator<Item = u32> {
    let operation = operation(instruction);
    let operands = if NAMES_NO_VARIABLE.contains(&operation) { &[] } else { &instruction[1..] };
    // The number of an extended instruction is not an id.
    let number = if operation == OP_EXT_INST { Some(3) } else { None };
    operands.iter().enumerate().filter(move |(place, _)| Some(*place) != number).map(|(_, id)| *id)
}

/// Returns an entry point without the removed variables in its interface.
fn entry_point(instruction: &[u32], gone: &HashSet<u32>) -> Vec<u32> {
    // The operands are execution model and function, then a name that ends in the first word with a zero
    // byte.
    let name = &instruction[3.min(instruction.len())..];
    let name_words =
        name.iter().position(|word| word.to_le_bytes().contains(&0)).map_or(name.len(), |last| last + 1);
    let (head, interface) = instruction.split_at(3.min(instruction.len()) + name_words);
    let mut kept = head.to_vec();
    kept.extend(interface.iter().filter(|id| !gone.contains(id)));
    kept[0] = (kept.len() as u32) << 16 | OP_ENTRY_POINT;
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn op(operation: u32, operands: &[u32]) -> Vec<u32> {
        let mut words = vec![(operands.len() as u32 + 1) << 16 | operation];
        words.extend(operands);
        words
    }

    /// Makes a module in which function 1 calls 2, and nothing calls 3. Each stores to a variable: 11, 12,
    /// 13.
    fn module() -> Vec<u32> {
        let mut words = vec![0x0723_0203, 0x0001_0500, 0, 50, 0];
        words.extend(op(OP_ENTRY_POINT, &[5, 1, u32::from_le_bytes(*b"main"), 0, 11, 12, 13, 14]));
        for variable in [11, 12, 13] {
            words.extend(op(OP_NAME, &[variable, 0x61]));
            words.extend(op(OP_DECORATE, &[variable, 33, variable]));
        }
        words.extend(op(OP_DECORATE, &[33, 42]));
        for variable in [11, 12, 13, 14] {
            words.extend(op(OP_VARIABLE, &[20, variable, 12]));
        }
        for (function, calls) in [(1, Some(2)), (2, None), (3, Some(2))] {
            words.extend(op(OP_FUNCTION, &[20, function, 0, 21]));
            words.extend(op(OP_LABEL, &[function + 40]));
            // The result of function 3 is 33; a literal number that equals a variable's id is not a use of
            // it.
            words.extend(op(81, &[20, function + 30, 22, 14]));
            words.extend(op(62, &[function + 10, function + 30]));
            if let Some(called) = calls {
                words.extend(op(OP_FUNCTION_CALL, &[20, function + 35, called]));
            }
            words.extend(op(253, &[]));
            words.extend(op(OP_FUNCTION_END, &[]));
        }
        words
    }

    #[test]
    fn what_runs_is_kept_and_the_rest_is_gone() {
        let kept = only_reached(&module());
        let all: Vec<&[u32]> = instructions(&kept).collect();
        let second = |wanted: u32| -> Vec<u32> {
            all.iter().filter(|each| operation(each) == wanted).filter_map(|each| result(each)).collect()
        };
        assert_eq!(second(OP_FUNCTION), [1, 2]);
        assert_eq!(second(OP_VARIABLE), [11, 12]);
        let targets = |wanted: u32| -> Vec<u32> {
            all.iter().filter(|each| operation(each) == wanted).map(|each| each[1]).collect()
        };
        assert_eq!((targets(OP_NAME), targets(OP_DECORATE)), (vec![11, 12], vec![11, 12]));
        assert_eq!(all[0][3..], [u32::from_le_bytes(*b"main"), 0, 11, 12]);
        assert_eq!(all[0][0] >> 16, all[0].len() as u32);
        assert_eq!(only_reached(&kept), kept);
    }

    #[test]
    fn text_for_people_goes_without_a_trace() {
        let kept = without_debug_text(&module());
        assert!(instructions(&kept).all(|each| operation(each) != OP_NAME));
        assert_eq!(kept.len() + 3 * 3, module().len());
    }

    #[test]
    fn words_that_are_no_module_are_no_panic() {
        for length in 0..module().len() {
            only_reached(&module()[..length]);
            without_debug_text(&module()[..length]);
        }
        only_reached(&[0; 12]);
    }
}
