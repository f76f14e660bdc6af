//! Values of instructions whose operands are known. Values are 32 bits; a truth is 0 or 1.

use crate::instruction::{op, operation};

/// Returns the value of an instruction with a result, if `value` knows enough of its operands.
///
/// `value` knows no vectors and no numbers of other widths, so instructions on them have no value either.
pub(crate) fn folded(instruction: &[u32], value: impl Fn(u32) -> Option<u32>) -> Option<u32> {
    match (operation(instruction), instruction) {
        (op::SPEC_CONSTANT_OP, [_, _, _, operation, operands @ ..]) => applied(*operation, operands, value),
        (operation, [_, _, _, operands @ ..]) => applied(operation, operands, value),
        _ => None,
    }
}

/// Returns the value of an operation on operands that are ids.
fn applied(operation: u32, operands: &[u32], value: impl Fn(u32) -> Option<u32>) -> Option<u32> {
    let [first, second] = [0, 1].map(|place| operands.get(place).and_then(|id| value(*id)));
    match (operation, first, second) {
        // One operand decides.
        (op::LOGICAL_AND, Some(0), _) | (op::LOGICAL_AND, _, Some(0)) => return Some(0),
        (op::LOGICAL_OR, Some(1), _) | (op::LOGICAL_OR, _, Some(1)) => return Some(1),
        _ => {}
    }
    let a = first?;
    match operation {
        op::COPY_OBJECT => return Some(a),
        op::LOGICAL_NOT => return Some(1 - a.min(1)),
        op::NOT => return Some(!a),
        op::SELECT => return value(*operands.get(if a != 0 { 1 } else { 2 })?),
        _ => {}
    }
    let b = second?;
    let [signed_a, signed_b] = [a, b].map(u32::cast_signed);
    Some(match operation {
        op::I_ADD => a.wrapping_add(b),
        op::I_SUB => a.wrapping_sub(b),
        op::I_MUL => a.wrapping_mul(b),
        op::LOGICAL_OR | op::BITWISE_OR => a | b,
        op::LOGICAL_AND | op::BITWISE_AND => a & b,
        op::BITWISE_XOR => a ^ b,
        // The specification leaves longer shifts undefined.
        op::SHIFT_RIGHT_LOGICAL => a.checked_shr(b)?,
        op::SHIFT_LEFT_LOGICAL => a.checked_shl(b)?,
        op::LOGICAL_EQUAL | op::I_EQUAL => u32::from(a == b),
        op::LOGICAL_NOT_EQUAL | op::I_NOT_EQUAL => u32::from(a != b),
        op::U_GREATER_THAN => u32::from(a > b),
        op::U_GREATER_THAN_EQUAL => u32::from(a >= b),
        op::U_LESS_THAN => u32::from(a < b),
        op::U_LESS_THAN_EQUAL => u32::from(a <= b),
        op::S_GREATER_THAN => u32::from(signed_a > signed_b),
        op::S_GREATER_THAN_EQUAL => u32::from(signed_a >= signed_b),
        op::S_LESS_THAN => u32::from(signed_a < signed_b),
        op::S_LESS_THAN_EQUAL => u32::from(signed_a <= signed_b),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::instruction::instruction;

    /// Operands are ids 0 to 99, of which the even ones are known: their value is the id.
    fn of(operation: u32, operands: &[u32]) -> Option<u32> {
        let value = |id: u32| id.is_multiple_of(2).then_some(id);
        let plain = folded(&instruction(operation, &[&[100, 101], operands].concat()), value);
        let constant =
            folded(&instruction(op::SPEC_CONSTANT_OP, &[&[100, 101, operation], operands].concat()), value);
        assert_eq!(plain, constant);
        plain
    }

    #[test]
    fn operations_on_numbers_have_the_values_of_the_specification() {
        let expected = [
            (op::I_ADD, 10),
            (op::I_SUB, 6),
            (op::I_MUL, 16),
            (op::SHIFT_RIGHT_LOGICAL, 2),
            (op::SHIFT_LEFT_LOGICAL, 32),
            (op::BITWISE_OR, 10),
            (op::BITWISE_XOR, 10),
            (op::BITWISE_AND, 0),
            (op::I_EQUAL, 0),
            (op::I_NOT_EQUAL, 1),
            (op::U_GREATER_THAN, 1),
            (op::U_GREATER_THAN_EQUAL, 1),
            (op::U_LESS_THAN, 0),
            (op::U_LESS_THAN_EQUAL, 0),
            (op::S_GREATER_THAN, 1),
            (op::S_GREATER_THAN_EQUAL, 1),
            (op::S_LESS_THAN, 0),
            (op::S_LESS_THAN_EQUAL, 0),
        ];
        for (operation, value) in expected {
            assert_eq!(of(operation, &[8, 2]), Some(value), "{operation}");
            assert_eq!([of(operation, &[8, 1]), of(operation, &[1, 8])], [None; 2], "{operation}");
        }
        assert_eq!(of(op::NOT, &[8]), Some(!8));
        assert_eq!(of(op::COPY_OBJECT, &[8]), Some(8));
        assert_eq!(of(op::SHIFT_LEFT_LOGICAL, &[8, 32]), None);
        assert_eq!(of(op::SELECT, &[8, 2, 1]), Some(2));
        assert_eq!(of(op::SELECT, &[0, 1, 4]), Some(4));
        assert_eq!(of(op::SELECT, &[8, 1, 2]), None);
    }

    #[test]
    fn signed_comparisons_take_the_highest_bit_for_a_sign() {
        let value = |id: u32| Some(if id == 0 { u32::MAX } else { 1 });
        let of = |operation| folded(&instruction(operation, &[100, 101, 0, 1]), value);
        assert_eq!([op::S_LESS_THAN, op::S_LESS_THAN_EQUAL].map(of), [Some(1); 2]);
        assert_eq!([op::S_GREATER_THAN, op::S_GREATER_THAN_EQUAL].map(of), [Some(0); 2]);
        assert_eq!([op::U_LESS_THAN, op::U_LESS_THAN_EQUAL].map(of), [Some(0); 2]);
    }

    #[test]
    fn one_operand_decides_and_and_or() {
        let truth = |id: u32| (id < 2).then_some(id);
        let of = |operation, a, b| folded(&instruction(operation, &[100, 101, a, b]), truth);
        assert_eq!([of(op::LOGICAL_AND, 0, 9), of(op::LOGICAL_AND, 9, 0)], [Some(0); 2]);
        assert_eq!([of(op::LOGICAL_OR, 1, 9), of(op::LOGICAL_OR, 9, 1)], [Some(1); 2]);
        assert_eq!([of(op::LOGICAL_AND, 1, 9), of(op::LOGICAL_OR, 0, 9)], [None; 2]);
        assert_eq!([of(op::LOGICAL_AND, 1, 1), of(op::LOGICAL_OR, 0, 0)], [Some(1), Some(0)]);
        assert_eq!([of(op::LOGICAL_EQUAL, 1, 1), of(op::LOGICAL_NOT_EQUAL, 1, 1)], [Some(1), Some(0)]);
        assert_eq!(
            [0, 1].map(|a| folded(&instruction(op::LOGICAL_NOT, &[100, 101, a]), truth)),
            [Some(1), Some(0)]
        );
    }

    #[test]
    fn other_instructions_have_no_value() {
        for operation in 0..400 {
            let unknown = |_: u32| None;
            assert_eq!(folded(&instruction(operation, &[100, 101, 2, 4]), unknown), None, "{operation}");
        }
        for words in [&[][..], &[1], &[1, 2], &[1, 2, 3]] {
            assert_eq!(folded(&instruction(op::I_ADD, words), Some), None);
        }
    }
}
