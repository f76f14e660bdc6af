//! The descriptor bindings that modules use.

use std::collections::HashMap;

use crate::instruction::{HEADER_WORDS, op};

const MAGIC: u32 = 0x0723_0203;
const DECORATION_BINDING: u32 = 33;
const DECORATION_DESCRIPTOR_SET: u32 = 34;
const STORAGE_CLASS_STORAGE_BUFFER: u32 = 12;

/// Words are not a module of SPIR-V.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotAModule {
    /// Fault of the words.
    pub reason: &'static str,
}

impl std::fmt::Display for NotAModule {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "no SPIR-V module: {}", self.reason)
    }
}

impl std::error::Error for NotAModule {}

/// Returns the bindings of each set, from set 0 up, that the functions of a module name: one bit per binding.
/// A set layout with only these bindings suffices for the module, which matters if a device lets a stage
/// access few buffers.
///
/// # Errors
/// Words that are not a module, and bindings beyond 63.
pub fn used_bindings(words: &[u32]) -> Result<Vec<u64>, NotAModule> {
    used_bindings_of(words, |_| true)
}

/// Returns [`used_bindings`] of the variables in the storage classes that `is_wanted` accepts.
fn used_bindings_of(words: &[u32], is_wanted: impl Fn(u32) -> bool) -> Result<Vec<u64>, NotAModule> {
    let invalid = |reason| NotAModule { reason };
    check_header(words)?;
    let mut places: HashMap<u32, [Option<u32>; 2]> = HashMap::new();
    let mut used = Vec::new();
    let mut in_function = false;
    let mut rest = &words[HEADER_WORDS..];
    while let [first, ..] = rest {
        let (operation, length) = (first & 0xffff, (first >> 16) as usize);
        if length == 0 || length > rest.len() {
            return Err(invalid("an instruction does not end within it"));
        }
        let (instruction, after) = rest.split_at(length);
        rest = after;
        match (operation, instruction) {
            (op::FUNCTION, _) => in_function = true,
            (op::FUNCTION_END, _) => in_function = false,
            (op::DECORATE, [_, variable, DECORATION_DESCRIPTOR_SET, set]) => {
                places.entry(*variable).or_default()[0] = Some(*set);
            }
            (op::DECORATE, [_, variable, DECORATION_BINDING, binding]) => {
                places.entry(*variable).or_default()[1] = Some(*binding);
            }
            (op::VARIABLE, [_, _, variable, class, ..]) if !in_function && !is_wanted(*class) => {
                places.remove(variable);
            }
            // Decorations precede variables, and those functions. A literal that happens to equal an id only
            // adds a binding to the result.
            _ if in_function => {
                for word in &instruction[1..] {
                    let Some([Some(set), Some(binding)]) = places.get(word) else { continue };
                    if *binding >= u64::BITS || *set >= u64::BITS {
                        return Err(invalid("it names a set or a binding beyond 63"));
                    }
                    let set = *set as usize;
                    if used.len() <= set {
                        used.resize(set + 1, 0);
                    }
                    used[set] |= 1 << binding;
                }
            }
            _ => {}
        }
    }
    Ok(used)
}

/// Returns the number of storage buffers that a module of SPIR-V 1.3 or later uses, over all sets: the number
/// that a device must let one stage access. Older modules may declare them as uniform blocks, which are not
/// counted.
///
/// # Errors
/// As [`used_bindings`].
pub fn storage_buffers_used(words: &[u32]) -> Result<u32, NotAModule> {
    let used = used_bindings_of(words, |class| class == STORAGE_CLASS_STORAGE_BUFFER)?;
    Ok(used.iter().map(|used| used.count_ones()).sum())
}

/// Checks that the words begin with the header of a module.
///
/// # Errors
/// They do not.
pub fn check_header(words: &[u32]) -> Result<(), NotAModule> {
    let reason = match words {
        [MAGIC, ..] if words.len() > HEADER_WORDS => return Ok(()),
        [MAGIC, ..] => "it ends within its header",
        [first, ..] if first.swap_bytes() == MAGIC => "its byte order is reversed",
        _ => "its first word is not the SPIR-V number",
    };
    Err(NotAModule { reason })
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn word(length: u32, operation: u32) -> u32 {
        length << 16 | operation
    }

    /// Makes a module with variables 10 to 12 at (0, 1), (2, 0) and (2, 3), and a function whose single
    /// instruction has `operands`.
    fn module(operands: &[u32]) -> Vec<u32> {
        let mut words = vec![MAGIC, 0x0001_0500, 0, 20, 0];
        for (id, set, binding) in [(10, 0, 1), (11, 2, 0), (12, 2, 3)] {
            words.extend([word(4, op::DECORATE), id, DECORATION_DESCRIPTOR_SET, set]);
            words.extend([word(4, op::DECORATE), id, DECORATION_BINDING, binding]);
        }
        // The last one is an image or an acceleration structure.
        for (id, class) in [(10, STORAGE_CLASS_STORAGE_BUFFER), (11, STORAGE_CLASS_STORAGE_BUFFER), (12, 0)] {
            words.extend([word(4, op::VARIABLE), 4, id, class]);
        }
        words.extend([word(5, op::FUNCTION), 1, 2, 0, 3, word(1 + operands.len() as u32, 65)]);
        words.extend(operands);
        words.push(word(1, op::FUNCTION_END));
        words
    }

    #[test]
    fn only_what_functions_name_is_used() {
        let of = |operands: &[u32]| used_bindings(&module(operands)).expect("a module");
        assert_eq!(of(&[7, 8]), []);
        assert_eq!(of(&[10]), [0b10]);
        assert_eq!(of(&[12, 10, 11]), [0b10, 0, 0b1001]);
    }

    #[test]
    fn storage_buffers_alone_are_counted() {
        let of = |operands: &[u32]| storage_buffers_used(&module(operands)).expect("a module");
        assert_eq!([of(&[7]), of(&[10]), of(&[12, 10, 11]), of(&[12])], [0, 1, 2, 0]);
    }

    #[test]
    fn what_is_no_module_is_an_error() {
        let mut cut = module(&[10, 11, 12]);
        cut.truncate(cut.len() - 2);
        let mut endless = module(&[]);
        endless[HEADER_WORDS] = word(0, op::DECORATE);
        let mut beyond = module(&[10]);
        beyond[HEADER_WORDS + 7] = 64;
        for words in [&[][..], &[MAGIC], &cut, &endless, &beyond] {
            assert!(used_bindings(words).is_err(), "{words:x?}");
        }
    }
}
