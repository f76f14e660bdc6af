//! Times of passes, gathered over repetitions.

use rasray_gpu::{PassTiming, TimerKind};

use crate::report::{Pass, Timer};

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

    /// Median, shortest and longest time of each pass.
    pub(super) fn report(&self) -> Vec<Pass> {
        self.times
            .iter()
            .map(|(label, times)| {
                let least = times.iter().copied().fold(f64::INFINITY, f64::min);
                let most = times.iter().copied().fold(0.0, f64::max);
                Pass { label: label.clone(), ms_median: median(times), ms_min: least, ms_max: most }
            })
            .collect()
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

/// The median; 0 of nothing.
pub(super) fn median(times: &[f64]) -> f64 {
    rasray_metrics::median(times).unwrap_or(0.0)
}
