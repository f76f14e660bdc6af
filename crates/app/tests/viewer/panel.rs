//! The panel: systems, options and maps, chosen with the mouse. Places are those in a window for a small
//! picture.

use std::path::Path;

use crate::window::{Display, Window, made_by, pixels};

/// The left and right end of the way of the slider of the time, and how far down it is.
pub const TIME_SLIDER: [i32; 3] = [335, 453, 337];

/// The list of what is shown, of a scene with or without clips.
const SHOWN: [i32; 2] = [438, 119];

/// That of tones.
const TONE: [i32; 2] = [580, 119];

/// Switch of denoising.
const DENOISE: [i32; 2] = [442, 188];

/// The list of systems, what opens the options of `bvh`, and its list of builders, of a scene that does not
/// move.
const SYSTEM: [i32; 2] = [430, 314];
const OPTIONS: [i32; 2] = [390, 360];
const BUILDER: [i32; 2] = [470, 383];

/// The preset `published` of `mmrt`, of such a scene.
const PUBLISHED: [i32; 2] = [461, 337];

/// An entry of an open list, from 0.
fn entry([x, y]: [i32; 2], position: i32) -> [i32; 2] {
    [x, y + 25 + 23 * position]
}

fn choose(window: &Window<'_>, list: [i32; 2], position: i32) {
    window.click(list);
    // Frames of a software driver may be slow, and a list opens in several.
    std::thread::sleep(std::time::Duration::from_secs(2));
    window.click(entry(list, position));
}

#[test]
fn systems_options_and_maps_are_chosen_with_the_mouse() {
    let Some(display) = Display::start("systems_options_and_maps_are_chosen_with_the_mouse") else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let line = "view cornell --size 60x40 --spp 1 --bounces 1 --system bvh --validation";
    let mut window = Window::open(&display, folder.path(), line);
    let (first, _) = window.save();
    let first = pixels(&first);

    choose(&window, TONE, 1);
    let (toned, line) = window.save_when(|line| line.contains(" --tone agx "));
    let toned = pixels(&toned);
    assert!(made_by(folder.path(), &line) == toned && toned != first, "{line}");
    choose(&window, TONE, 0);

    window.click(OPTIONS);
    choose(&window, BUILDER, 1);
    let (built, line) = window.save_when(|line| line.contains(" --builder=") && !line.contains(" --tone "));
    let built = pixels(&built);
    assert!(made_by(folder.path(), &line) == built && built == first, "a tree is exact: {line}");

    choose(&window, SYSTEM, 1);
    window.save_when(|line| line.contains(" --system mmrt "));
    window.click(PUBLISHED);
    let (coarse, line) = window.save_when(|line| line.contains(" --preset published "));
    let coarse = pixels(&coarse);
    assert!(made_by(folder.path(), &line) == coarse && coarse != first, "fragments are not: {line}");

    choose(&window, SHOWN, 1);
    let (difference, scale) = window.save_map("difference from bricks");
    let difference = pixels(&difference);
    assert!(!scale.ends_with("greatest 0"), "{scale}");
    let (low, high) = (difference.iter().min(), difference.iter().max());
    assert!(low == Some(&0) && high >= Some(&0xfc), "from no difference to the greatest: {low:?} {high:?}");

    choose(&window, SHOWN, 2);
    let (cells, _) = window.save_map("cells per ray");
    let cells = pixels(&cells);
    assert!(cells != difference && cells.chunks_exact(3).any(|colour| colour != &cells[..3]));

    display.xdotool("key ctrl+q");
    assert_eq!(window.end().code(), Some(0), "a message of the validation layers is an error");
}

/// Saved pictures are those on the screen, and say what denoised them.
#[test]
fn noise_is_taken_out_with_the_mouse() {
    if let Err(error) = rasray_denoise::Denoiser::find() {
        return eprintln!("skipped: noise_is_taken_out_with_the_mouse: {error}");
    }
    let Some(display) = Display::start("noise_is_taken_out_with_the_mouse") else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let line = "view cornell --size 60x40 --spp 2 --bounces 1 --system bvh --validation";
    let mut window = Window::open(&display, folder.path(), line);
    let says_so = |path: &Path| {
        let bytes = std::fs::read(path).expect("a picture");
        bytes.windows(14).any(|text| text == b"rasrayDenoised")
    };
    let (first, _) = window.save();
    assert!(!says_so(&first));
    let first = pixels(&first);

    window.click(DENOISE);
    let (clean, line) = window.save_when(|line| line.contains(" --denoise "));
    assert!(says_so(&clean), "{line}");
    let clean = pixels(&clean);
    assert!(made_by(folder.path(), &line) == clean && clean != first, "{line}");

    window.click(DENOISE);
    let (back, line) = window.save_when(|line| !line.contains(" --denoise "));
    assert!(pixels(&back) == first && !says_so(&back), "{line}");
    display.xdotool("key ctrl+q");
    assert_eq!(window.end().code(), Some(0), "a message of the validation layers is an error");
}

/// Typed at the top of the panel. What cannot be read changes nothing, and the new scene is the one of its
/// command line.
#[test]
fn another_scene_is_opened_by_its_name() {
    let Some(display) = Display::start("another_scene_is_opened_by_its_name") else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let line = "view cornell --size 60x40 --spp 1 --integrator raycast --system bvh --validation";
    let mut window = Window::open(&display, folder.path(), line);
    let (first, _) = window.save();
    let first = pixels(&first);
    let open = |name: &str| {
        display.xdotool("key ctrl+o");
        std::thread::sleep(std::time::Duration::from_secs(1));
        display.xdotool(&format!("type {name}"));
        display.xdotool("key Return");
        std::thread::sleep(std::time::Duration::from_secs(3));
    };
    open("missing.glb");
    let (same, line) = window.save();
    assert!(pixels(&same) == first && line.contains(" render cornell "), "{line}");
    open("walker:8k");
    let (other, line) = window.save_when(|line| line.contains(" render walker:8k "));
    let other = pixels(&other);
    assert!(made_by(folder.path(), &line) == other && other != first, "{line}");

    // From above, and with everything in the picture.
    display.xdotool("key 7");
    display.xdotool("key f");
    let (above, line) = window.save_when(|line| line.contains(" --eye "));
    let above = pixels(&above);
    assert!(made_by(folder.path(), &line) == above && above != other, "{line}");
    display.xdotool("key ctrl+q");
    assert_eq!(window.end().code(), Some(0), "a message of the validation layers is an error");
}
