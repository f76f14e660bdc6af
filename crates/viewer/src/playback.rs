//! Playback of an animation.

/// Number of steps per second, so that a time is a short number: the command line names exactly this moment.
const STEPS: f64 = 1000.0;

/// Time that is shown, and the state of playback.
#[derive(Clone, Debug, PartialEq)]
pub struct Playback {
    /// Time in seconds, in `0..=duration` during playback; absent at rest.
    seconds: Option<f64>,
    /// True if the animation plays.
    pub playing: bool,
    /// Speed, in seconds of the animation per second.
    pub speed: f64,
    /// Length of the longest clip, seconds.
    duration: f64,
}

impl Playback {
    /// Makes a playback that stands at `seconds`, or at rest.
    pub fn new(seconds: Option<f64>, duration: f64) -> Self {
        Self { seconds, playing: false, speed: 1.0, duration: duration.max(0.0) }
    }

    /// True if there is an animation to play.
    pub fn can_play(&self) -> bool {
        self.duration > 0.0
    }

    /// Returns the length of the longest clip, seconds.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Advances by `elapsed` seconds. The animation begins anew at its end.
    pub fn advance(&mut self, elapsed: f64) {
        if self.playing && self.can_play() {
            let now = self.seconds.unwrap_or(0.0) + elapsed * self.speed;
            self.seconds = Some(now.rem_euclid(self.duration));
        }
    }

    /// Sets the time.
    pub fn seek(&mut self, seconds: f64) {
        self.seconds = Some(seconds);
    }

    /// Stops at rest, with everything where the file places it.
    pub fn rest(&mut self) {
        (self.seconds, self.playing) = (None, false);
    }

    /// Returns the time that is shown, seconds; `None` at rest. Between the times that the command line gave,
    /// it is a whole number of milliseconds.
    pub fn shown(&self) -> Option<f64> {
        let rounded = |seconds: f64| if self.playing { (seconds * STEPS).round() / STEPS } else { seconds };
        self.seconds.map(rounded)
    }

    /// Plays or stops. The time at which playback stops is the one that is shown.
    pub fn toggle(&mut self) {
        self.seconds = self.shown();
        self.playing = !self.playing && self.can_play();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_plays_begins_anew_at_its_end() {
        let mut playback = Playback::new(None, 2.0);
        playback.advance(1.0);
        assert_eq!(playback.shown(), None, "nothing runs before it plays");
        playback.toggle();
        playback.advance(1.5);
        assert_eq!(playback.shown(), Some(1.5));
        playback.speed = 2.0;
        playback.advance(0.500_2);
        assert_eq!(playback.shown(), Some(0.5), "a whole number of milliseconds");
        playback.toggle();
        let stopped = playback.shown();
        playback.advance(1.0);
        assert_eq!((stopped, playback.shown()), (Some(0.5), Some(0.5)));
        playback.rest();
        assert_eq!(playback.shown(), None);
    }

    #[test]
    fn a_time_that_was_given_is_kept_and_what_has_no_clips_does_not_play() {
        let mut playback = Playback::new(Some(1.0 / 3.0), 0.0);
        assert_eq!(playback.shown(), Some(1.0 / 3.0));
        playback.toggle();
        assert!(!playback.playing && !playback.can_play());
    }
}
