//! Comparisons of pictures that keep them as files where they fail, in the folder `rasray-failed-pictures` of
//! cargo's folder for tests (`target/tmp`). The tests of `rasray-integrators` use this file too.

use std::error::Error;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Files of a comparison that failed.
const KINDS: [&str; 3] = ["picture", "reference", "difference"];

/// A picture and the one that it is held to: linear, row by row from the top left.
#[derive(Clone, Copy)]
pub struct Compared<'a> {
    pub picture: &'a [[f32; 3]],
    pub reference: &'a [[f32; 3]],
    /// Pixels a row of both.
    pub width: u32,
}

impl Compared<'_> {
    /// Fails the running test unless `holds`. The message is `why` and the paths of three EXR files, which
    /// are named after the test: the picture, the reference, and their absolute difference. Those of an
    /// earlier failure are replaced.
    #[track_caller]
    pub fn assert(self, holds: bool, why: impl Display) {
        assert!(holds, "{why}\n{}", self.kept());
    }

    /// Fails as [`Compared::assert`] does, unless all numbers are the same bit for bit.
    #[track_caller]
    pub fn assert_bits(self, why: impl Display) {
        let apart = differing(self.picture, self.reference);
        let holds = apart == 0 && self.picture.len() == self.reference.len();
        self.assert(holds, format_args!("{why}: {apart} numbers differ"));
    }

    /// Lines that name the files, or say why there are none.
    fn kept(self) -> String {
        match self.write() {
            Ok(()) => KINDS.map(|kind| format!("{kind}: {}", file(kind).display())).join("\n"),
            Err(error) => format!("the pictures could not be kept: {error}"),
        }
    }

    fn write(self) -> Result<(), Box<dyn Error>> {
        let (count, width) = (self.picture.len(), self.width as usize);
        if width == 0 || count != self.reference.len() || !count.is_multiple_of(width) {
            return Err(format!("{count} and {} pixels in rows of {width}", self.reference.len()).into());
        }
        let pairs = self.picture.iter().zip(self.reference);
        let apart =
            |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|channel| (a[channel] - b[channel]).abs());
        let difference: Vec<[f32; 3]> = pairs.map(apart).collect();
        std::fs::create_dir_all(folder())?;
        for (kind, pixels) in KINDS.into_iter().zip([self.picture, self.reference, &difference]) {
            let pixel = |x: usize, y: usize| <(f32, f32, f32)>::from(pixels[y * width + x]);
            exr::prelude::write_rgb_file(file(kind), width, count / width, pixel)?;
        }
        Ok(())
    }
}

/// Numbers of two pictures that are not the same bit for bit.
fn differing(picture: &[[f32; 3]], other: &[[f32; 3]]) -> usize {
    let pairs = picture.as_flattened().iter().zip(other.as_flattened());
    pairs.filter(|(a, b)| a.to_bits() != b.to_bits()).count()
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("rasray-failed-pictures").join(env!("CARGO_PKG_NAME"))
}

/// A file of the running test, whose thread has its name.
fn file(kind: &str) -> PathBuf {
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("unnamed").replace("::", ".");
    folder().join(format!("{test}.{kind}.exr"))
}

#[test]
fn failed_comparisons_keep_their_pictures_and_others_write_nothing() {
    let message = |fails: &(dyn Fn() + std::panic::RefUnwindSafe)| {
        let failed = std::panic::catch_unwind(fails).expect_err("it does not hold");
        failed.downcast_ref::<String>().expect("a message").clone()
    };
    let picture =
        [[0.0, 0.5, 1.0], [2.0, f32::MAX, 1.0e-40], [0.25, 0.0, 3.0e5], [1.0; 3], [0.1; 3], [7.0; 3]];
    let mut reference = picture;
    reference[3] = [0.75, 1.5, 1.0];
    let mut difference = [[0.0; 3]; 6];
    difference[3] = [0.25, 0.5, 0.0];
    KINDS.iter().for_each(|kind| _ = std::fs::remove_file(file(kind)));
    let compared = Compared { picture: &picture, reference: &reference, width: 3 };

    compared.assert(true, "nothing to say");
    Compared { reference: &picture, ..compared }.assert_bits("nothing to say");
    assert!(KINDS.iter().all(|kind| !file(kind).exists()), "files of comparisons that hold");

    let uneven = Compared { width: 4, ..compared };
    let expected = "uneven\nthe pictures could not be kept: 6 and 6 pixels in rows of 4";
    assert_eq!(message(&|| uneven.assert(false, "uneven")), expected);

    let [kept, _, _] = KINDS.map(|kind| file(kind).display().to_string());
    assert!(kept.contains("failed_comparisons_keep_their_pictures"), "{kept}");
    let named = KINDS.map(|kind| format!("{kind}: {}", file(kind).display())).join("\n");
    assert_eq!(message(&|| compared.assert_bits("a pixel")), format!("a pixel: 2 numbers differ\n{named}"));
    for (kind, expected) in KINDS.into_iter().zip([picture, reference, difference]) {
        let (size, pixels) = read(&file(kind));
        assert_eq!((size, differing(&pixels, &expected)), ([3, 2], 0), "{kind}: {pixels:?}");
        std::fs::remove_file(file(kind)).expect("it can be deleted");
    }
}

/// Width, height and pixels of a file.
fn read(file: &Path) -> ([usize; 2], Vec<[f32; 3]>) {
    let image = exr::prelude::read_first_rgba_layer_from_file(
        file,
        |size, _| (size.width(), vec![[0.0; 3]; size.area()]),
        |(width, pixels), at, (red, green, blue, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [red, green, blue];
        },
    );
    let layer = image.expect("an image").layer_data;
    ([layer.size.width(), layer.size.height()], layer.channel_data.pixels.1)
}
