//! Scenes that move: played with a key, and put to a time with the slider.

use std::time::Duration;

use crate::panel::TIME_SLIDER;
use crate::window::{Display, Window, made_by, pixels};

/// The time that a command line names, seconds.
fn time(line: &str) -> Option<f64> {
    let (_, rest) = line.split_once(" --time ")?;
    rest.split(' ').next()?.parse().ok()
}

/// A walker, and a cloth that the host simulates. Pictures while it plays are not compared: they are of the
/// moment.
#[test]
fn what_plays_and_is_put_to_a_time_is_what_render_makes_of_that_time() {
    let Some(display) = Display::start("what_plays_and_is_put_to_a_time_is_what_render_makes_of_that_time")
    else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    for scene in ["walker:8k", "cloth-ball:1k"] {
        let line = format!("view {scene} --size 60x40 --spp 1 --integrator ao --system bvh --validation");
        let mut window = Window::open(&display, folder.path(), &line);
        let (first, first_line) = window.save();
        let first = pixels(&first);
        assert_eq!((time(&first_line), made_by(folder.path(), &first_line) == first), (None, true));

        let mut seen = vec![first];
        let mut times = vec![0.0];
        for _ in 0..2 {
            display.xdotool("key space");
            // Well below the shortest duration, after which it begins anew.
            std::thread::sleep(Duration::from_millis(500));
            display.xdotool("key space");
            let (played, line) =
                window.save_when(|line| time(line).is_some_and(|time| !times.contains(&time)));
            let played = pixels(&played);
            assert!(made_by(folder.path(), &line) == played, "{line}");
            times.push(time(&line).expect("a time"));
            assert!(seen.last() != Some(&played), "{line}: a picture of another time");
            seen.push(played);
        }
        assert!(times[1] > 0.0 && times[1] != times[2], "{times:?}");

        // From where the handle is to near the end, and back to the middle.
        let [left, right, y] = TIME_SLIDER;
        for x in [right - 20, (left + right) / 2] {
            window.drag([x - 10, y], [10, 0]);
            let is_new = |line: &str| time(line).is_some_and(|time| !times.contains(&time));
            let (scrubbed, line) = window.save_when(is_new);
            let scrubbed = pixels(&scrubbed);
            assert!(made_by(folder.path(), &line) == scrubbed, "{line}");
            times.push(time(&line).expect("a time"));
            assert!(seen.last() != Some(&scrubbed), "{line}: a picture of another time");
            seen.push(scrubbed);
        }
        // The slider is linear over the whole duration.
        let duration = if scene.starts_with("walker") { 6.0 } else { 3.0 };
        let at = |x: i32| duration * f64::from(x - left) / f64::from(right - left);
        for (found, x) in times[3..].iter().zip([right - 20, (left + right) / 2]) {
            assert!((found - at(x)).abs() < 0.08 * duration, "{times:?} at {x}: {}", at(x));
        }
        display.xdotool("key ctrl+q");
        assert_eq!(window.end().code(), Some(0), "a message of the validation layers is an error");
    }
}
