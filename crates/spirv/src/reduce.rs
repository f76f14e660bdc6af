//! Removal of unused parts of a module: functions that nothing calls, variables that nothing uses, debug
//! text.
//!
//! GLSL files that are included whole leave most of their functions unused, and a compiler that does not
//! optimise keeps all of them. Drivers would drop them, but an unused variable counts as used where a device
//! limits the buffers of a stage, and every byte is part of the program.

use std::collections::{HashMap, HashSet};

use crate::instruction::{annotated, filtered, instructions, is_understood, op, operation, result};

/// Opcodes of debug text: OpSourceContinued, OpSource, OpSourceExtension, OpName, OpMemberName, OpString,
/// OpLine, OpNoLine, OpModuleProcessed.
const DEBUG: [u32; 9] = [2, 3, 4, 5, 6, 7, 8, 317, 330];
/// Storage class Output.
const OUTPUT: u32 = 3;
/// Opcodes of instructions of functions whose operands are not variables, or are numbers that could be
/// mistaken for one: OpVectorShuffle, OpCompositeExtract, OpCompositeInsert, OpLoopMerge, OpSelectionMerge,
/// OpBranchConditional, OpSwitch, OpLine.
const NAMES_NO_VARIABLE: [u32; 8] = [8, 79, 81, 82, 246, 247, 250, 251];

/// Returns a module without names, source text and lines, none of which changes its effect. Strings that
/// instructions print stay.
pub fn without_debug_text(words: &[u32]) -> Vec<u32> {
    let printing = instructions(words).filter(|instruction| operation(instruction) == op::EXT_INST);
    let operands = printing.flat_map(|instruction| instruction.get(5..).unwrap_or_default());
    let printed: HashSet<u32> = operands.copied().collect();
    filtered(words, |instruction| {
        let is_printed =
            operation(instruction) == op::STRING && instruction.get(1).is_some_and(|id| printed.contains(id));
        (is_printed || !DEBUG.contains(&operation(instruction))).then(|| instruction.into())
    })
}

/// Returns a module without the functions that its entry points do not reach, and without the variables that
/// only those functions use. Outputs stay, which a later stage may read, and so does a module with
/// instructions that this crate does not know.
pub fn only_reached(words: &[u32]) -> Vec<u32> {
    if is_understood(words) { reduced(words) } else { words.to_vec() }
}

/// Returns an understood module as [`only_reached`] does.
pub(crate) fn reduced(words: &[u32]) -> Vec<u32> {
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
    // Variables of the module precede its functions. One may begin as the address of another.
    let head = || instructions(words).take_while(|instruction| operation(instruction) != op::FUNCTION);
    let variables = || head().filter(|instruction| operation(instruction) == op::VARIABLE);
    named.extend(variables().filter_map(|variable| variable.get(4).copied()));
    for variable in variables().filter(|variable| variable.get(3) != Some(&OUTPUT)) {
        gone.extend(result(variable).filter(|id| !named.contains(id)));
    }
    let mut function = None;
    filtered(words, |instruction| {
        let operation = operation(instruction);
        if operation == op::FUNCTION {
            function = result(instruction);
        }
        let unreached = function.is_some_and(|id| !reached.contains(&id));
        if operation == op::FUNCTION_END {
            function = None;
        }
        let of = match operation {
            op::VARIABLE => result(instruction),
            _ => annotated(instruction),
        };
        if unreached || of.is_some_and(|id| gone.contains(&id)) {
            None
        } else if operation == op::ENTRY_POINT {
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
                (op::ENTRY_POINT, [_, _, id, ..]) => functions.entries.push(*id),
                (op::FUNCTION, [_, _, id, ..]) => function = Some(*id),
                _ => {}
            }
            if let Some(id) = function {
                functions.bodies.entry(id).or_default().push(instruction);
            }
            if operation(instruction) == op::FUNCTION_END {
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
                if let (op::FUNCTION_CALL, [_, _, _, called, ..]) = (operation(instruction), *instruction) {
                    left.push(*called);
                }
            }
        }
        reached
    }
}

/// Iterates over the ids in an instruction of a function, which include all variables that it uses.
fn variables_named(instruction: &[u32]) -> impl Iterator<Item = u32> {
    let operation = operation(instruction);
    let operands = if NAMES_NO_VARIABLE.contains(&operation) { &[] } else { &instruction[1..] };
    // The number of an extended instruction is not an id.
    let number = if operation == op::EXT_INST { Some(3) } else { None };
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
    kept[0] = (kept.len() as u32) << 16 | op::ENTRY_POINT;
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::instruction::instruction;

    /// Makes a module in which function 1 calls 2, and nothing calls 3. Each stores to a variable: 11, 12,
    /// 13.
    fn module() -> Vec<u32> {
        let mut words = vec![0x0723_0203, 0x0001_0500, 0, 50, 0];
        words.extend(instruction(op::ENTRY_POINT, &[5, 1, u32::from_le_bytes(*b"main"), 0, 11, 12, 13, 14]));
        for variable in [11, 12, 13] {
            words.extend(instruction(op::NAME, &[variable, 0x61]));
            words.extend(instruction(op::DECORATE, &[variable, 33, variable]));
        }
        words.extend(instruction(op::DECORATE, &[33, 42]));
        for variable in [11, 12, 13, 14] {
            words.extend(instruction(op::VARIABLE, &[20, variable, 12]));
        }
        for (function, calls) in [(1, Some(2)), (2, None), (3, Some(2))] {
            words.extend(instruction(op::FUNCTION, &[20, function, 0, 21]));
            words.extend(instruction(op::LABEL, &[function + 40]));
            // The result of function 3 is 33; a literal number that equals a variable's id is not a use of
            // it.
            words.extend(instruction(81, &[20, function + 30, 22, 14]));
            words.extend(instruction(62, &[function + 10, function + 30]));
            if let Some(called) = calls {
                words.extend(instruction(op::FUNCTION_CALL, &[20, function + 35, called]));
            }
            words.extend(instruction(253, &[]));
            words.extend(instruction(op::FUNCTION_END, &[]));
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
        assert_eq!(second(op::FUNCTION), [1, 2]);
        assert_eq!(second(op::VARIABLE), [11, 12]);
        let targets = |wanted: u32| -> Vec<u32> {
            all.iter().filter(|each| operation(each) == wanted).map(|each| each[1]).collect()
        };
        assert_eq!((targets(op::NAME), targets(op::DECORATE)), (vec![11, 12], vec![11, 12]));
        assert_eq!(all[0][3..], [u32::from_le_bytes(*b"main"), 0, 11, 12]);
        assert_eq!(all[0][0] >> 16, all[0].len() as u32);
        assert_eq!(only_reached(&kept), kept);
    }

    #[test]
    fn text_for_people_goes_without_a_trace() {
        let kept = without_debug_text(&module());
        assert!(instructions(&kept).all(|each| operation(each) != op::NAME));
        assert_eq!(kept.len() + 3 * 3, module().len());
    }

    #[test]
    fn outputs_and_strings_that_are_printed_stay() {
        let mut words = module();
        let mut add = |place, operation, operands: &[u32]| {
            words.splice(place..place, instruction(operation, operands));
        };
        add(5, op::STRING, &[30, 0x61]);
        add(5, op::STRING, &[31, 0x61]);
        let functions =
            words.windows(2).position(|pair| pair == [5 << 16 | op::FUNCTION, 20]).expect("there");
        // An output that nothing uses, and an extended instruction, number 30, that prints string 31.
        words.splice(functions..functions, instruction(op::VARIABLE, &[20, 15, OUTPUT]));
        let body = functions + 4 + 5 + 2;
        words.splice(body..body, instruction(op::EXT_INST, &[20, 36, 35, 30, 31]));
        let kept = without_debug_text(&only_reached(&words));
        let of = |wanted| -> Vec<&[u32]> {
            instructions(&kept).filter(|each| operation(each) == wanted).map(|each| &each[1..]).collect()
        };
        assert_eq!(of(op::STRING), [[31, 0x61]]);
        assert_eq!(of(op::VARIABLE).iter().map(|each| each[1]).collect::<Vec<_>>(), [11, 12, 15]);
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
