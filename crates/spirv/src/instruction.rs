//! Instructions of a module.

use std::borrow::Cow;
use std::ops::RangeInclusive;

pub(crate) const HEADER_WORDS: usize = 5;

/// Opcodes of the specification, section 3.49.
pub(crate) mod op {
    pub const UNDEF: u32 = 1;
    pub const NAME: u32 = 5;
    pub const STRING: u32 = 7;
    pub const EXT_INST: u32 = 12;
    pub const ENTRY_POINT: u32 = 15;
    pub const TYPE_INT: u32 = 21;
    pub const TYPE_FLOAT: u32 = 22;
    pub const CONSTANT_TRUE: u32 = 41;
    pub const CONSTANT_FALSE: u32 = 42;
    pub const CONSTANT: u32 = 43;
    pub const SPEC_CONSTANT_TRUE: u32 = 48;
    pub const SPEC_CONSTANT_FALSE: u32 = 49;
    pub const SPEC_CONSTANT: u32 = 50;
    pub const SPEC_CONSTANT_OP: u32 = 52;
    pub const FUNCTION: u32 = 54;
    pub const FUNCTION_END: u32 = 56;
    pub const FUNCTION_CALL: u32 = 57;
    pub const VARIABLE: u32 = 59;
    pub const DECORATE: u32 = 71;
    /// OpDecorationGroup, OpGroupDecorate, OpGroupMemberDecorate.
    pub const GROUPED_DECORATIONS: [u32; 3] = [73, 74, 75];
    pub const COPY_OBJECT: u32 = 83;
    pub const I_ADD: u32 = 128;
    pub const I_SUB: u32 = 130;
    pub const I_MUL: u32 = 132;
    pub const LOGICAL_EQUAL: u32 = 164;
    pub const LOGICAL_NOT_EQUAL: u32 = 165;
    pub const LOGICAL_OR: u32 = 166;
    pub const LOGICAL_AND: u32 = 167;
    pub const LOGICAL_NOT: u32 = 168;
    pub const SELECT: u32 = 169;
    pub const I_EQUAL: u32 = 170;
    pub const I_NOT_EQUAL: u32 = 171;
    pub const U_GREATER_THAN: u32 = 172;
    pub const S_GREATER_THAN: u32 = 173;
    pub const U_GREATER_THAN_EQUAL: u32 = 174;
    pub const S_GREATER_THAN_EQUAL: u32 = 175;
    pub const U_LESS_THAN: u32 = 176;
    pub const S_LESS_THAN: u32 = 177;
    pub const U_LESS_THAN_EQUAL: u32 = 178;
    pub const S_LESS_THAN_EQUAL: u32 = 179;
    pub const SHIFT_RIGHT_LOGICAL: u32 = 194;
    pub const SHIFT_LEFT_LOGICAL: u32 = 196;
    pub const BITWISE_OR: u32 = 197;
    pub const BITWISE_XOR: u32 = 198;
    pub const BITWISE_AND: u32 = 199;
    pub const NOT: u32 = 200;
    pub const PHI: u32 = 245;
    pub const LOOP_MERGE: u32 = 246;
    pub const SELECTION_MERGE: u32 = 247;
    pub const LABEL: u32 = 248;
    pub const BRANCH: u32 = 249;
    pub const BRANCH_CONDITIONAL: u32 = 250;
    pub const SWITCH: u32 = 251;
    pub const RETURN_VALUE: u32 = 254;
    pub const UNREACHABLE: u32 = 255;
    pub const DECORATE_ID: u32 = 332;
    pub const DECORATE_STRING: u32 = 5632;
}

/// Opcodes of instructions of functions that have no result: OpNop, OpLine, OpFunctionEnd, OpStore,
/// OpCopyMemory, OpImageWrite, OpControlBarrier, OpMemoryBarrier, OpAtomicStore, OpLoopMerge,
/// OpSelectionMerge, OpBranch, OpBranchConditional, OpSwitch, OpKill, OpReturn, OpReturnValue, OpUnreachable,
/// OpNoLine, OpTerminateInvocation, OpRayQueryInitializeKHR, OpRayQueryTerminateKHR,
/// OpRayQueryGenerateIntersectionKHR, OpRayQueryConfirmIntersectionKHR, OpDemoteToHelperInvocation.
const WITHOUT_RESULT: [u32; 25] = [
    0, 8, 56, 62, 63, 99, 224, 225, 228, 246, 247, 249, 250, 251, 252, 253, 254, 255, 317, 4416, 4473, 4474,
    4475, 4476, 5380,
];

/// Opcodes of instructions of functions with a result, whose second operand is its id: of objects and memory,
/// of images, of numbers, of derivatives, of atomics, OpPhi, of subgroups, OpCopyLogical to OpPtrDiff, of ray
/// queries.
const WITH_RESULT: [RangeInclusive<u32>; 23] = [
    1..=1,
    12..=12,
    54..=55,
    57..=57,
    59..=61,
    65..=70,
    77..=84,
    86..=98,
    100..=107,
    109..=124,
    126..=152,
    154..=191,
    194..=205,
    207..=215,
    227..=227,
    229..=242,
    245..=245,
    333..=366,
    400..=403,
    4447..=4447,
    4477..=4477,
    4479..=4479,
    6016..=6035,
];

/// Returns true if this crate knows the operands of all instructions that matter to it. Other modules, such
/// as those with grouped decorations or debug information that names variables, are left as they are.
pub(crate) fn is_understood(words: &[u32]) -> bool {
    let mut within = false;
    let mut wide_integers = false;
    let mut switches = false;
    for each in instructions(words) {
        let code = operation(each);
        if each.len() != (each[0] >> 16) as usize {
            return false;
        }
        within |= code == op::FUNCTION;
        wide_integers |= code == op::TYPE_INT && each.get(2) == Some(&64);
        switches |= code == op::SWITCH;
        let is_known = if within {
            code == op::LABEL
                || WITHOUT_RESULT.contains(&code)
                || WITH_RESULT.iter().any(|codes| codes.contains(&code))
        } else {
            ![op::EXT_INST, op::DECORATE_ID].contains(&code) && !op::GROUPED_DECORATIONS.contains(&code)
        };
        if !is_known {
            return false;
        }
    }
    // The numbers of the cases are a word each.
    !(wide_integers && switches)
}

/// Iterates over the instructions of a module; the last one is cut where the module is cut.
pub(crate) fn instructions(words: &[u32]) -> impl Iterator<Item = &[u32]> {
    let mut rest = words.get(HEADER_WORDS..).unwrap_or_default();
    std::iter::from_fn(move || {
        let first = *rest.first()?;
        let (instruction, after) = rest.split_at(((first >> 16) as usize).clamp(1, rest.len()));
        rest = after;
        Some(instruction)
    })
}

pub(crate) fn operation(instruction: &[u32]) -> u32 {
    instruction[0] & 0xffff
}

/// Makes an instruction; it has fewer than 65,535 operands.
pub(crate) fn instruction(operation: u32, operands: &[u32]) -> Vec<u32> {
    let mut words = vec![(operands.len() as u32 + 1) << 16 | operation];
    words.extend(operands);
    words
}

/// Returns the id that an instruction of a function, or a global variable, defines.
pub(crate) fn result(instruction: &[u32]) -> Option<u32> {
    match operation(instruction) {
        operation if WITHOUT_RESULT.contains(&operation) => None,
        op::LABEL => instruction.get(1).copied(),
        _ => instruction.get(2).copied(),
    }
}

/// Returns the id that a name or a decoration is for.
pub(crate) fn annotated(instruction: &[u32]) -> Option<u32> {
    match operation(instruction) {
        op::NAME | op::DECORATE | op::DECORATE_STRING => instruction.get(1).copied(),
        _ => None,
    }
}

/// Returns the module with only the instructions for which `keep` returns one, in the form that it returns.
pub(crate) fn filtered<'a>(
    words: &'a [u32],
    keep: impl FnMut(&'a [u32]) -> Option<Cow<'a, [u32]>>,
) -> Vec<u32> {
    let mut kept = words[..HEADER_WORDS.min(words.len())].to_vec();
    for instruction in instructions(words).filter_map(keep) {
        kept.extend_from_slice(&instruction);
    }
    kept
}
