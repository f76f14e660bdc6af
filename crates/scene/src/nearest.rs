//! Suggestion of the name that was meant in place of an unknown one.

/// Returns the candidate that is reached from `word` with the fewest changes of single letters, swaps of
/// neighbours included and upper case ignored. At most one change is allowed for words of up to three
/// letters, two beyond, three from eight on. The first of equally near candidates is returned; `None` if all
/// are farther.
///
/// ```
/// use rasray_scene::nearest::nearest;
///
/// assert_eq!(nearest("cornel", ["furnace", "cornell"]), Some("cornell"));
/// assert_eq!(nearest("kitchen", ["furnace", "cornell"]), None);
/// ```
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = word.chars().count();
    // A longer word is no typing error, and the comparison takes the product of both lengths.
    if length > 64 {
        return None;
    }
    let most = match length {
        0..=3 => 1,
        4..=7 => 2,
        _ => 3,
    };
    let near = candidates.into_iter().map(|candidate| (changes(word, candidate), candidate));
    // The first of equally near candidates is kept.
    near.filter(|(changes, _)| *changes <= most.min(length.saturating_sub(1)))
        .min_by_key(|near| near.0)
        .map(|near| near.1)
}

/// Counts the letters that are inserted, removed, replaced or swapped with their neighbour between one word
/// and the other.
fn changes(from: &str, to: &str) -> usize {
    let letters = |word: &str| word.to_lowercase().chars().collect::<Vec<_>>();
    let (from, to) = (letters(from), letters(to));
    // Row i holds the changes from the first i letters to every beginning of `to`.
    let mut rows = vec![(0..=to.len()).collect::<Vec<usize>>()];
    for i in 1..=from.len() {
        let mut row = vec![i];
        for j in 1..=to.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(from[i - 1] != to[j - 1]);
            let mut fewest = replaced.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1] {
                fewest = fewest.min(rows[i - 2][j - 2] + 1);
            }
            row.push(fewest);
        }
        rows.push(row);
    }
    rows[from.len()][to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_counted() {
        for (from, to, count) in [
            ("", "abc", 3),
            ("abc", "abc", 0),
            ("ABC", "abc", 0),
            ("acb", "abc", 1),
            ("kitten", "sitting", 3),
            ("ä", "", 1),
        ] {
            assert_eq!((changes(from, to), changes(to, from)), (count, count), "{from} {to}");
        }
    }

    #[test]
    fn what_is_far_is_not_meant() {
        let names = ["cornell", "spheres", "size", "spp"];
        assert_eq!(nearest("sphere", names), Some("spheres"));
        assert_eq!(nearest("Cornell", names), Some("cornell"));
        assert_eq!(nearest("sp", names), Some("spp"));
        for far in ["", "width", "x", "atrium", &"cornell".repeat(50)] {
            assert_eq!(nearest(far, names), None, "{far}");
        }
    }
}
