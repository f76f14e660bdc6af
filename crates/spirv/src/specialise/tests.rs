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

/// A loop of three blocks, whose last one branches by `back`.
fn a_loop(back: &[Line<'_>]) -> Vec<u32> {
    let begin: [Line<'_>; 7] = [
        (op::LABEL, &[30]),
        (op::BRANCH, &[31]),
        (op::LABEL, &[31]),
        (op::LOOP_MERGE, &[34, 32, 0]),
        (op::BRANCH, &[32]),
        (op::LABEL, &[32]),
        (op::I_ADD, &[UINT, 51, ONE, ONE]),
    ];
    let end: [Line<'_>; 2] = [(op::LABEL, &[34]), RETURN];
    module(&[(1, &[&begin[..], back, &end[..]].concat())])
}

#[test]
fn a_loop_that_runs_once_keeps_its_branch_back() {
    let words = a_loop(&[(op::BRANCH_CONDITIONAL, &[SWITCH, 31, 34])]);
    for constants in [&[][..], &[(7, 1)]] {
        assert_eq!(body(&specialised(&words, constants), 1), body(&words, 1));
    }
}

#[test]
fn a_module_whose_loop_would_lose_its_branch_back_stays_whole() {
    let back: [Line<'_>; 3] =
        [(op::BRANCH_CONDITIONAL, &[SWITCH, 34, 33]), (op::LABEL, &[33]), (op::BRANCH, &[31])];
    let words = a_loop(&back);
    assert_eq!(body(&specialised(&words, &[(7, 1)]), 1), body(&words, 1));
    let left = body(&specialised(&words, &[]), 1);
    assert!(left.contains(&(op::BRANCH, vec![33])), "{left:?}");
}

/// True if the entry of a module changes where the switch is on.
fn is_decided(words: &[u32]) -> bool {
    body(&specialised(words, &[(7, 1)]), 1) != body(words, 1)
}

#[test]
fn blocks_that_would_precede_what_leads_to_them_stay() {
    let at = |meeting_first: bool| {
        let begin: [Line<'_>; 3] = [
            (op::LABEL, &[30]),
            (op::SELECTION_MERGE, &[33, 0]),
            (op::BRANCH_CONDITIONAL, &[SWITCH, 31, 32]),
        ];
        let sides: [Line<'_>; 4] =
            [(op::LABEL, &[31]), (op::BRANCH, &[33]), (op::LABEL, &[32]), (op::BRANCH, &[33])];
        let meeting: [Line<'_>; 3] = [(op::LABEL, &[33]), (62, &[UNKNOWN, SWITCH]), RETURN];
        let order = if meeting_first { [&meeting[..], &sides] } else { [&sides[..], &meeting] };
        module(&[(1, &[&begin[..], order[0], order[1]].concat())])
    };
    assert_eq!([true, false].map(|meeting_first| is_decided(&at(meeting_first))), [false, true]);
}

#[test]
fn a_selection_that_is_left_from_within_keeps_its_merge() {
    // The side that is taken branches to the meeting place without a merge instruction of its own.
    let words = module(&[(
        1,
        &[
            (op::LABEL, &[30]),
            (op::SELECTION_MERGE, &[33, 0]),
            (op::BRANCH_CONDITIONAL, &[SWITCH, 31, 33]),
            (op::LABEL, &[31]),
            (op::BRANCH_CONDITIONAL, &[UNKNOWN, 32, 33]),
            (op::LABEL, &[32]),
            (op::BRANCH, &[33]),
            (op::LABEL, &[33]),
            RETURN,
        ],
    )]);
    assert!(!is_decided(&words));
}

#[test]
fn numbers_of_cases_are_no_labels() {
    // Case 32, a number, leads to block 31; block 32 is on the side that is not taken.
    let words = module(&[(
        1,
        &[
            (op::LABEL, &[30]),
            (op::SELECTION_MERGE, &[34, 0]),
            (op::BRANCH_CONDITIONAL, &[SWITCH, 35, 32]),
            (op::LABEL, &[35]),
            (op::SELECTION_MERGE, &[33, 0]),
            (op::SWITCH, &[UNKNOWN, 33, 32, 31]),
            (op::LABEL, &[31]),
            (op::BRANCH, &[33]),
            (op::LABEL, &[33]),
            (op::BRANCH, &[34]),
            (op::LABEL, &[32]),
            (op::BRANCH, &[34]),
            (op::LABEL, &[34]),
            RETURN,
        ],
    )]);
    let left = body(&specialised(&words, &[(7, 1)]), 1);
    assert!(left.contains(&(op::LABEL, vec![31])) && !left.contains(&(op::LABEL, vec![32])), "{left:?}");
}

#[test]
fn modules_with_unknown_instructions_stay_as_they_are() {
    let known = two_sides(SWITCH, &[], &[]);
    assert_ne!(specialised(&known, &[]), known);
    // OpExecuteCallableKHR; a group of decorations, which may be those of a constant.
    let in_function = two_sides(SWITCH, &[(4446, &[ONE, UNKNOWN])], &[]);
    let mut in_head = known;
    in_head.splice(5..5, instruction(op::GROUPED_DECORATIONS[0], &[60]));
    for words in [in_function, in_head] {
        assert_eq!(specialised(&words, &[]), words);
    }
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
