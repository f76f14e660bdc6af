/// A set of choices, one value index an option, in which every pair of values of two options occurs.
/// `values` says how many values each option has. Greedy, always the same for the same input.
pub fn pairwise(values: &[usize]) -> Vec<Vec<usize>> {
    let mut open: Vec<[(usize, usize); 2]> = Vec::new();
    for (a, &of_a) in values.iter().enumerate() {
        for (b, &of_b) in values.iter().enumerate().skip(a + 1) {
            open.extend((0..of_a).flat_map(|x| (0..of_b).map(move |y| [(a, x), (b, y)])));
        }
    }
    let mut rows = Vec::new();
    while let Some(first) = open.first().copied() {
        let mut row: Vec<Option<usize>> = vec![None; values.len()];
        for (option, value) in first {
            row[option] = Some(value);
        }
        for option in 0..values.len() {
            if row[option].is_some() {
                continue;
            }
            // The value that closes most open pairs with what is already chosen; the first of equals.
            let closes = |value: usize| {
                let chosen = |(other, other_value): (usize, usize)| row[other] == Some(other_value);
                open.iter()
                    .filter(|[left, right]| {
                        (*left == (option, value) && chosen(*right))
                            || (*right == (option, value) && chosen(*left))
                    })
                    .count()
            };
            row[option] = (0..values[option]).max_by_key(|&value| (closes(value), values[option] - value));
        }
        let row: Vec<usize> = row.into_iter().map(|value| value.unwrap_or(0)).collect();
        open.retain(|[(a, x), (b, y)]| row[*a] != *x || row[*b] != *y);
        rows.push(row);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uncovered(values: &[usize], rows: &[Vec<usize>]) -> usize {
        let mut missing = 0;
        for a in 0..values.len() {
            for b in a + 1..values.len() {
                for x in 0..values[a] {
                    for y in 0..values[b] {
                        missing += usize::from(!rows.iter().any(|row| row[a] == x && row[b] == y));
                    }
                }
            }
        }
        missing
    }

    #[test]
    fn every_pair_occurs_in_few_rows() {
        for values in [&[2, 2, 2, 2][..], &[4, 2, 3, 2, 5], &[3], &[], &[2, 7]] {
            let rows = pairwise(values);
            assert_eq!(uncovered(values, &rows), 0, "{values:?}");
            assert!(rows.len() <= 2 * 7 + 16, "{} rows for {values:?}", rows.len());
        }
        // A row less leaves pairs out.
        let rows = pairwise(&[2, 2, 2]);
        assert!(uncovered(&[2, 2, 2], &rows[1..]) > 0);
    }
}
