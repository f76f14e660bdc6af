//! Share of work that several processes divide among themselves.

use std::fmt;

use rasray_frame::Samples;
use rasray_options::text::numbers;

/// Share i of n of work that is dealt out in turns: items are counted from 0, and share i gets the items
/// whose number has the remainder i - 1 modulo n.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: u32,
    of: u32,
}

impl Default for Shard {
    /// Returns the share that holds everything.
    fn default() -> Self {
        Self { number: 1, of: 1 }
    }
}

impl Shard {
    /// Makes share `number` (from 1 on) of `of`; `None` unless there is such a share.
    pub fn new(number: u32, of: u32) -> Option<Self> {
        (1..=of).contains(&number).then_some(Self { number, of })
    }

    /// Reads the form that [`fmt::Display`] writes: `2/8`.
    pub fn parse(text: &str) -> Option<Self> {
        let [number, of] = numbers(text, &['/'])?;
        Self::new(number, of)
    }

    /// Returns the number of shares.
    pub fn count(self) -> u32 {
        self.of
    }

    /// True if the item at this place, from 0, is part of the share.
    pub fn holds(self, place: u32) -> bool {
        place % self.of == self.number - 1
    }

    /// Returns the samples from 0 to `count` - 1 that are part of the share, in their order.
    pub fn samples(self, count: u32) -> Samples {
        Samples::from(self.number - 1..count).step_by(self.of)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_deal_out_everything_once() {
        for (count, of) in [(7, 3), (3, 7), (8, 1), (0, 2)] {
            let shares: Vec<_> = (1..=of).map(|number| Shard::new(number, of).expect("a share")).collect();
            let mut samples: Vec<u32> = shares.iter().flat_map(|share| share.samples(count)).collect();
            assert!(
                shares.iter().all(|share| share.samples(count).into_iter().all(|sample| share.holds(sample)))
            );
            samples.sort_unstable();
            assert_eq!(samples, (0..count).collect::<Vec<_>>());
        }
        let share = Shard::new(2, 3).expect("a share");
        let samples = share.samples(8);
        assert_eq!(samples.into_iter().collect::<Vec<_>>(), [1, 4, 7]);
        assert_eq!([0, 1, 2, u32::MAX].map(|place| samples.index(place)), [1, 4, 7, u32::MAX]);
        assert_eq!((samples.count(), share.samples(1).count()), (3, 0));
    }

    #[test]
    fn shares_read_back_and_others_are_refused() {
        let share = Shard::new(2, 8).expect("a share");
        assert_eq!((share.to_string().as_str(), Shard::parse("2/8")), ("2/8", Some(share)));
        for bad in ["0/2", "3/2", "1", "1/0", "-1/2", "1/2/3", "a/b", ""] {
            assert_eq!(Shard::parse(bad), None, "{bad}");
        }
    }
}
