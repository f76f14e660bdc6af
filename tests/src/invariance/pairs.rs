/// Values of two options, each the number of an option and of its value.
pub type Pair = [(usize, usize); 2];

/// Choices of values that try options in pairs.
#[derive(Clone, Debug)]
pub struct Pairs {
    /// One value index an option.
    pub rows: Vec<Vec<usize>>,
    /// Pairs that no row was found for.
    pub refused: Vec<Pair>,
}

/// Choices in which every pair of values of two options occurs that goes with the first values of the others,
/// or with all but two of them. `values` says how many values each option has, `allowed` whether all values
/// of a choice go together. Greedy, always the same for the same input.
pub fn pairwise(values: &[usize], allowed: impl Fn(&[usize]) -> bool) -> Pairs {
    let mut open: Vec<Pair> = Vec::new();
    for (a, &of_a) in values.iter().enumerate() {
        for (b, &of_b) in values.iter().enumerate().skip(a + 1) {
            open.extend((0..of_a).flat_map(|x| (0..of_b).map(move |y| [(a, x), (b, y)])));
        }
    }
    let (mut rows, mut refused) = (Vec::new(), Vec::new());
    while let Some(first) = open.first().copied() {
        match filled(values, &open, first, &allowed) {
            Some(row) => {
                open.retain(|[(a, x), (b, y)]| row[*a] != *x || row[*b] != *y);
                rows.push(row);
            }
            None => refused.push(open.remove(0)),
        }
    }
    Pairs { rows, refused }
}

/// A choice with a pair in it that closes as many other open ones as it can; absent if none is allowed.
fn filled(
    values: &[usize],
    open: &[Pair],
    pair: Pair,
    allowed: &impl Fn(&[usize]) -> bool,
) -> Option<Vec<usize>> {
    // An option not chosen yet has its first value, which leaves options that exclude others as they are.
    let mut row = vec![0; values.len()];
    let mut chosen: Vec<(usize, usize)> = pair.to_vec();
    for (option, value) in pair {
        row[option] = value;
    }
    // Up to two other options may have to take another value for the pair.
    let others: Vec<(usize, usize)> = (0..values.len())
        .filter(|option| !pair.iter().any(|(taken, _)| taken == option))
        .flat_map(|option| (1..values[option]).map(move |value| (option, value)))
        .collect();
    let one = others.iter().map(|&first| vec![first]);
    let two = others.iter().enumerate().flat_map(|(place, &first)| {
        others[place + 1..]
            .iter()
            .filter(move |second| second.0 != first.0)
            .map(move |&second| vec![first, second])
    });
    let helpers = std::iter::once(Vec::new()).chain(one).chain(two).find(|helpers| {
        let mut other = row.clone();
        helpers.iter().for_each(|&(option, value)| other[option] = value);
        allowed(&other)
    })?;
    helpers.iter().for_each(|&(option, value)| row[option] = value);
    chosen.extend(helpers);
    for option in 0..values.len() {
        if chosen.iter().any(|&(taken, _)| taken == option) {
            continue;
        }
        let closes = |value: usize| {
            let is_chosen = |other: &(usize, usize)| chosen.contains(other);
            open.iter()
                .filter(|[left, right]| {
                    (*left == (option, value) && is_chosen(right))
                        || (*right == (option, value) && is_chosen(left))
                })
                .count()
        };
        let default = row[option];
        let mut candidates: Vec<usize> = (0..values[option]).collect();
        candidates.sort_by_key(|&value| std::cmp::Reverse(closes(value)));
        row[option] = candidates
            .into_iter()
            .find(|&value| {
                let mut other = row.clone();
                other[option] = value;
                allowed(&other)
            })
            .unwrap_or(default);
        chosen.push((option, row[option]));
    }
    Some(row)
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
            let Pairs { rows, refused } = pairwise(values, |_| true);
            assert_eq!((uncovered(values, &rows), refused.len()), (0, 0), "{values:?}");
            assert!(rows.len() <= 2 * 7 + 16, "{} rows for {values:?}", rows.len());
        }
        // A row less leaves pairs out.
        let rows = pairwise(&[2, 2, 2], |_| true).rows;
        assert!(uncovered(&[2, 2, 2], &rows[1..]) > 0);
    }

    #[test]
    fn only_pairs_that_go_with_nothing_are_left_out() {
        // The second value of the first option requires that of the second and excludes that of the third.
        let allowed = |row: &[usize]| row[0] == 0 || (row[1] == 1 && row[2] == 0);
        let Pairs { rows, refused } = pairwise(&[2, 2, 2, 3], allowed);
        assert!(rows.iter().all(|row| allowed(row)), "{rows:?}");
        assert_eq!(refused, [[(0, 1), (1, 0)], [(0, 1), (2, 1)]]);
        assert_eq!(uncovered(&[2, 2, 2, 3], &rows), 2);
    }
}
