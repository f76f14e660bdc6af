//! Pareto front: runs that no other run beats in both speed and error.

/// Speed and error of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    /// Measure of speed; more is better.
    pub speed: f64,
    /// Measure of error; less is better.
    pub error: f64,
}

/// Returns the positions of the points on the Pareto front, slowest first.
///
/// A point is on the front unless another is at least as fast and at least as exact, and better in one of the
/// two; hence equal points are on the front together. A point with a number that is not finite is never on
/// the front.
pub(super) fn front(points: &[Point]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len())
        .filter(|index| points[*index].speed.is_finite() && points[*index].error.is_finite())
        .collect();
    // The order is fastest first and, among equally fast points, most exact first: a point can then be beaten
    // only by a point before it.
    order.sort_by(|a, b| {
        let (a, b) = (points[*a], points[*b]);
        b.speed.total_cmp(&a.speed).then(a.error.total_cmp(&b.error))
    });
    let mut kept: Vec<usize> = Vec::new();
    for index in order {
        let on_front = kept
            .last()
            .is_none_or(|last| points[index].error < points[*last].error || points[index] == points[*last]);
        if on_front {
            kept.push(index);
        }
    }
    kept.reverse();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(pairs: &[(f64, f64)]) -> Vec<Point> {
        pairs.iter().map(|(speed, error)| Point { speed: *speed, error: *error }).collect()
    }

    #[test]
    fn only_what_nothing_beats_is_on_the_front() {
        let all = points(&[(1.0, 0.0), (2.0, 0.5), (1.5, 0.7), (4.0, 0.9), (4.0, 1.0), (0.5, 0.0)]);
        assert_eq!(front(&all), [0, 1, 3]);
    }

    #[test]
    fn equal_points_share_the_front_and_unknown_ones_never_reach_it() {
        let all = points(&[(1.0, 0.1), (f64::NAN, 0.0), (1.0, 0.1), (9.0, f64::INFINITY)]);
        let mut found = front(&all);
        found.sort_unstable();
        assert_eq!(found, [0, 2]);
        assert!(front(&[]).is_empty());
    }

    /// Computes the front by its definition, for every pair of points.
    fn front_by_definition(all: &[Point]) -> Vec<usize> {
        let beats = |a: Point, b: Point| {
            a.speed >= b.speed && a.error <= b.error && (a.speed > b.speed || a.error < b.error)
        };
        (0..all.len()).filter(|index| !all.iter().any(|other| beats(*other, all[*index]))).collect()
    }

    #[test]
    fn it_agrees_with_the_definition() {
        // The values are few, so that ties are common.
        let mut state = 1_u32;
        let mut next = |range: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from((state >> 16) % range)
        };
        for round in 0..500 {
            let mut all: Vec<Point> =
                (0..round % 12).map(|_| Point { speed: next(5), error: next(5) }).collect();
            let mut found = front(&all);
            found.sort_unstable();
            assert_eq!(found, front_by_definition(&all), "{all:?}");
            // The last point beats every other and is alone on the front, which shows that the answer depends
            // on the input.
            all.push(Point { speed: 10.0, error: -1.0 });
            assert_eq!(front(&all), [all.len() - 1]);
        }
    }
}
