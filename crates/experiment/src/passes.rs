//! Times of passes, gathered over repetitions.

use rasray_gpu::{PassTiming, Stage, TimerKind};
use rasray_metrics::Summary;

use rasray_report::{Pass, PassOf, Spread, StageTime, Timer};

/// Times and dispatches of one pass in each repetition.
#[derive(Debug)]
struct Row {
    stage: Stage,
    label: String,
    /// Milliseconds of all dispatches of the pass, one sum per repetition.
    sums: Vec<f64>,
    /// Numbers of dispatches of the pass, one per repetition.
    dispatches: Vec<u64>,
}

/// All times of each pass, in the order the passes were first seen.
#[derive(Debug, Default)]
pub(super) struct Passes {
    rows: Vec<Row>,
    repetitions: usize,
    timer: Option<TimerKind>,
}

impl Passes {
    /// Begins another repetition, to which the following times belong.
    pub(super) fn repeat(&mut self) {
        self.repetitions += 1;
        for row in &mut self.rows {
            row.sums.push(0.0);
            row.dispatches.push(0);
        }
    }

    /// Adds the times of one submission to the repetition; the first repetition begins by itself.
    pub(super) fn add(&mut self, timings: &[PassTiming]) {
        for timing in timings {
            self.timer = Some(timing.timer);
            self.add_one(timing.stage, &timing.label, timing.milliseconds);
        }
    }

    /// Adds the time of a pass, or of the host's work, to the repetition.
    pub(super) fn add_one(&mut self, stage: Stage, label: &str, milliseconds: f64) {
        if self.repetitions == 0 {
            self.repeat();
        }
        let known = self.rows.iter().position(|row| row.stage == stage && row.label == label);
        let place = known.unwrap_or_else(|| {
            let (sums, dispatches) = (vec![0.0; self.repetitions], vec![0; self.repetitions]);
            self.rows.push(Row { stage, label: label.to_owned(), sums, dispatches });
            self.rows.len() - 1
        });
        let row = &mut self.rows[place];
        row.sums[self.repetitions - 1] += milliseconds;
        row.dispatches[self.repetitions - 1] += 1;
    }

    /// Returns the milliseconds of the passes of some stages in each repetition; `None` if no such pass was
    /// recorded.
    fn sums(&self, of: impl Fn(Stage) -> bool) -> Option<Vec<f64>> {
        let rows: Vec<_> = self.rows.iter().filter(|row| of(row.stage)).collect();
        let sum = |index| rows.iter().map(|row| row.sums[index]).sum();
        (!rows.is_empty()).then(|| (0..self.repetitions).map(sum).collect())
    }

    /// Returns the median over repetitions of the milliseconds that some stages took together; `None` if no
    /// such pass was recorded.
    pub(super) fn median_of(&self, of: impl Fn(Stage) -> bool) -> Option<f64> {
        self.sums(of).map(|sums| median(&sums))
    }

    /// Returns the times of each stage, in the order of a frame.
    pub(super) fn stages(&self) -> Vec<StageTime> {
        let time = |stage: Stage| {
            let sums = self.sums(|one| one == stage)?;
            Some(StageTime { stage: stage.to_string(), ms: median(&sums), spread: spread(&sums)? })
        };
        Stage::ALL.into_iter().filter_map(time).collect()
    }

    /// Returns share, median and spread of each pass as parts of a figure.
    pub(super) fn report(&self, of: Option<PassOf>) -> Vec<Pass> {
        let middle = middle(&self.sums(|_| true).unwrap_or_default());
        let share = |sums: &[f64]| middle.iter().map(|index| sums[*index]).sum::<f64>() / middle.len() as f64;
        let pass = |row: &Row| {
            let summary = Summary::of(&row.sums)?;
            Some(Pass {
                label: row.label.clone(),
                stage: Some(row.stage.to_string()),
                of,
                ms_share: Some(share(&row.sums)),
                dispatches: middle.first().map(|index| row.dispatches[*index]),
                ms_median: summary.median,
                ms_min: summary.min,
                ms_max: summary.max,
                ms_q1: Some(summary.first_quartile),
                ms_q3: Some(summary.third_quartile),
                count: Some(summary.count as u64),
            })
        };
        self.rows.iter().filter_map(pass).collect()
    }

    /// Returns the timer that measured the times.
    pub(super) fn timer(&self) -> Option<Timer> {
        self.timer.map(|timer| match timer {
            TimerKind::Device => Timer::Device,
            TimerKind::Host => Timer::Host,
        })
    }
}

/// Returns the positions of the median among times: one position, or two for an even number of times, whose
/// mean is the median.
fn middle(times: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|a, b| times[*a].total_cmp(&times[*b]));
    let count = order.len();
    order[count.saturating_sub(1) / 2..(count / 2 + 1).min(count)].to_vec()
}

/// Returns the spread of times; `None` without times.
pub(super) fn spread(times: &[f64]) -> Option<Spread> {
    Summary::of(times).map(|summary| Spread {
        count: summary.count as u64,
        min: summary.min,
        q1: summary.first_quartile,
        q3: summary.third_quartile,
        max: summary.max,
    })
}

/// Returns the median; 0 without times.
pub(super) fn median(times: &[f64]) -> f64 {
    rasray_metrics::median(times).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use rasray_gpu::TraceMode;

    use super::*;

    fn timing(label: &str, milliseconds: f64) -> PassTiming {
        PassTiming { stage: Stage::Build, label: label.to_owned(), milliseconds, timer: TimerKind::Device }
    }

    fn shares(passes: &Passes) -> Vec<f64> {
        passes.report(None).iter().filter_map(|pass| pass.ms_share).collect()
    }

    #[test]
    fn a_pass_is_all_its_dispatches_of_a_repetition() {
        let mut passes = Passes::default();
        for scale in [1.0, 3.0, 2.0] {
            passes.repeat();
            passes.add(&[timing("sort", scale), timing("scan", 10.0 * scale), timing("sort", 4.0 * scale)]);
        }
        let report = passes.report(Some(PassOf::Build));
        let sort = &report[0];
        assert_eq!(
            (sort.label.as_str(), sort.of, sort.count, sort.dispatches),
            ("sort", Some(PassOf::Build), Some(3), Some(2))
        );
        assert_eq!((sort.ms_min, sort.ms_median, sort.ms_max), (5.0, 10.0, 15.0));
    }

    /// Checks that shares add up to the median of the whole, although medians of the parts do not.
    #[test]
    fn shares_add_up_to_the_median_of_the_whole() {
        let times = [[1.0, 9.0, 4.0], [8.0, 1.0, 2.0], [3.0, 3.0, 3.5], [7.0, 7.0, 7.0]];
        for count in 1..=times.len() {
            let mut passes = Passes::default();
            for [a, b, c] in &times[..count] {
                passes.repeat();
                passes.add(&[timing("a", *a), timing("b", *b), timing("a", *c)]);
            }
            let wholes: Vec<f64> = times[..count].iter().map(|one| one.iter().sum()).collect();
            assert_eq!(passes.sums(|_| true).as_ref(), Some(&wholes));
            assert!((shares(&passes).iter().sum::<f64>() - median(&wholes)).abs() < 1.0e-12, "{count}");
        }
        // The median of the three repetitions is the one that took 11; medians of the parts are 6.5 and 3,
        // which add up to 9.5.
        assert_eq!(middle(&[14.0, 11.0, 9.5]), [1]);
        assert_eq!((middle(&[]), middle(&[2.0, 1.0])), (vec![], vec![1, 0]));
    }

    /// Checks the sums of stages, also for passes that take turns, whatever their labels are.
    #[test]
    fn a_stage_is_all_its_passes_of_a_repetition() {
        let [closest, occluded] = [TraceMode::Closest, TraceMode::Occluded].map(Stage::Trace);
        let mut passes = Passes::default();
        for scale in [3.0, 1.0, 2.0] {
            passes.repeat();
            passes.add_one(Stage::Shade, "a", 10.0 * scale);
            passes.add_one(closest, "b", scale);
            passes.add_one(occluded, "b", 0.5 * scale);
            passes.add_one(closest, "c", 6.0 - scale);
        }
        let stages = passes.stages();
        let medians: Vec<_> = stages.iter().map(|time| (time.stage.as_str(), time.ms)).collect();
        assert_eq!(medians, [("trace-closest", 6.0), ("trace-occluded", 1.0), ("shade", 20.0)]);
        let spread = &stages[1].spread;
        assert_eq!((spread.count, spread.min, spread.max), (3, 0.5, 1.5));
        assert_eq!(passes.median_of(|stage| matches!(stage, Stage::Trace(_))), Some(7.0));
        assert_eq!(passes.median_of(|stage| stage == Stage::Visible), None);
    }

    #[test]
    fn a_pass_that_a_repetition_lacks_took_no_time_in_it() {
        let mut passes = Passes::default();
        passes.add(&[timing("a", 1.0)]);
        passes.repeat();
        passes.add(&[timing("b", 5.0)]);
        let report = passes.report(None);
        assert_eq!((report[0].ms_min, report[0].ms_max), (0.0, 1.0));
        assert_eq!((report[1].ms_min, report[1].ms_max), (0.0, 5.0));
        assert!(Passes::default().report(None).is_empty());
    }
}
