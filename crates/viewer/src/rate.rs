//! Rates of events.

use std::collections::VecDeque;

/// Span of time over which events are counted, seconds.
const SPAN: f64 = 2.0;

/// Rate of events per second, over the last two seconds.
#[derive(Clone, Debug, Default)]
pub struct Rate {
    /// Times of the events, seconds, the oldest first.
    events: VecDeque<f64>,
}

impl Rate {
    /// Counts an event at `now` (seconds), which never decreases.
    pub fn count(&mut self, now: f64) {
        self.events.push_back(now);
        while self.events.front().is_some_and(|event| now - event > SPAN) {
            self.events.pop_front();
        }
    }

    /// Returns the events per second up to `now` (seconds); `None` before the second event.
    pub fn per_second(&self, now: f64) -> Option<f64> {
        let recent = self.events.iter().filter(|event| now - **event <= SPAN);
        let (count, first) =
            recent.fold((0_u32, now), |(count, first), event| (count + 1, first.min(*event)));
        let span = now - first;
        (count > 1 && span > 0.0).then(|| f64::from(count - 1) / span)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_of_the_last_seconds() {
        let mut rate = Rate::default();
        assert_eq!(rate.per_second(0.0), None);
        rate.count(0.0);
        assert_eq!(rate.per_second(1.0), None, "one event has no rate");
        for event in 1..=40 {
            rate.count(f64::from(event) / 8.0);
        }
        assert_eq!(rate.per_second(5.0), Some(8.0));
        assert_eq!(rate.per_second(6.0), Some(8.0 / 2.0), "it falls while nothing happens");
        assert_eq!(rate.per_second(9.0), None);
    }
}
