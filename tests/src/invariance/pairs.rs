/// Pair of values of two options, each the number of an option and of its value.
pub type Pair = [(usize, usize); 2];

/// Choices of values that cover options in pairs.
#[derive(Clone, Debug)]
pub struct Pairs {
    /// Choices, each with one value index per option.
    pub rows: Vec<Vec<usize>>,
    /// Pairs for which no choice was found.
    pub refused: Vec<Pair>,
}

/// Makes choices that contain every pair of values of two options which goes with the first values of the
/// other options, or of all but two of them. `values` gives the number of values of each option; `allowed`
/// tells whether all values of a choice go together. The algorithm is greedy and deterministic.
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

/// Returns a choice that contains a pair and closes as many other open pairs as possible; `None` if none is
/// allowed.
fn filled(
    values: &[usize],
    open: &[Pair],
    pair: Pair,
    allowed: &impl Fn(&[usize]) -> bool,
) -> Option<Vec<usize>> {
    // An option not chosen yet has its first value, which keeps options that exclude others unset.
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
        // One row less leaves pairs out.
        let rows = pairwise(&[2, 2, 2], |_| true).rows;
        assert!(uncovered(&[2, 2, 2], &rows[1..]) > 0);
    }

    #[test]
    fn only_pairs_that_go_with_nothing_are_left_out() {
        // The second value of the first option requires the second value of the second and excludes that of
        // the third.
        let allowed = |row: &[usize]| row[0] == 0 || (row[1] == 1 && row[2] == 0);
        let Pairs { rows, refused } = pairwise(&[2, 2, 2, 3], allowed);
        assert!(rows.iter().all(|row| allowed(row)), "{rows:?}");
        assert_eq!(refused, [[(0, 1), (1, 0)], [(0, 1), (2, 1)]]);
        assert_eq!(uncovered(&[2, 2, 2, 3], &rows), 2);
    }
}
