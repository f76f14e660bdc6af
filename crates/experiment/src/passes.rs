//! Times of passes, gathered over repetitions.

use rasray_gpu::{PassTiming, TimerKind};
use rasray_metrics::Summary;

use rasray_report::{Pass, Spread, Timer};

/// All times of each pass, in the order the passes were first seen.
#[derive(Debug, Default)]
pub(super) struct Passes {
    times: Vec<(String, Vec<f64>)>,
    timer: Option<TimerKind>,
}

impl Passes {
    /// Adds times of one submission.
    pub(super) fn add(&mut self, timings: &[PassTiming]) {
        for timing in timings {
            self.timer = Some(timing.timer);
            match self.times.iter_mut().find(|(label, _)| *label == timing.label) {
                Some((_, times)) => times.push(timing.milliseconds),
                None => self.times.push((timing.label.clone(), vec![timing.milliseconds])),
            }
        }
    }

    /// Median and spread of each pass.
    pub(super) fn report(&self) -> Vec<Pass> {
        let pass = |(label, times): &(String, Vec<f64>)| {
            let summary = Summary::of(times)?;
            Some(Pass {
                label: label.clone(),
                ms_median: summary.median,
                ms_min: summary.min,
                ms_max: summary.max,
                ms_q1: Some(summary.first_quartile),
                ms_q3: Some(summary.third_quartile),
                count: Some(summary.count as u64),
            })
        };
        self.times.iter().filter_map(pass).collect()
    }

    /// Milliseconds of all passes whose label passes the filter.
    pub(super) fn total(&self, keep: impl Fn(&str) -> bool) -> f64 {
        self.times.iter().filter(|(label, _)| keep(label)).flat_map(|(_, times)| times).sum()
    }

    /// What measured them.
    pub(super) fn timer(&self) -> Option<Timer> {
        self.timer.map(|timer| match timer {
            TimerKind::Device => Timer::Device,
            TimerKind::Host => Timer::Host,
        })
    }
}

/// How far times lie apart; absent for nothing.
pub(super) fn spread(times: &[f64]) -> Option<Spread> {
    Summary::of(times).map(|summary| Spread {
        count: summary.count as u64,
        min: summary.min,
        q1: summary.first_quartile,
        q3: summary.third_quartile,
        max: summary.max,
    })
}

/// The median; 0 of nothing.
pub(super) fn median(times: &[f64]) -> f64 {
    rasray_metrics::median(times).unwrap_or(0.0)
}
