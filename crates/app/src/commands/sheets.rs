//! Sheets: pictures of runs side by side in one file.

use super::campaign::picture_place;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{Destination, encode_picture};
use crate::terminal;
use image::{RgbImage, imageops};
use rasray_campaign::{SHEET_COLUMNS, Sheet};
use std::path::Path;

/// Width of the white margin around each picture, pixels.
const GAP: u32 = 4;

/// Width up to which smaller pictures are magnified, each pixel to a square; pixels.
const WIDTH: u32 = 300;

/// Writes a sheet of the existing pictures into the folder of a campaign. Warns of missing pictures, since
/// lines of cells may come from elsewhere.
///
/// # Errors
/// A file is not a picture, or the folder accepts no file.
pub(super) fn write_sheet(sheet: &Sheet, folder: &Path, interrupt: &Interrupt) -> Result<(), AppError> {
    let mut pictures = Vec::new();
    let mut missing = 0;
    for key in &sheet.pictures {
        let place = picture_place(folder, key);
        if !place.is_file() {
            missing += 1;
            pictures.push(RgbImage::new(0, 0));
            continue;
        }
        let picture = image::open(&place).map_err(|error| {
            AppError::input(&place, error, "remove it, and its line of cells.jsonl, and resume")
        })?;
        pictures.push(picture.into_rgb8());
    }
    if missing > 0 {
        let (all, name) = (pictures.len(), picture_place(folder, "*"));
        terminal::warn(&format!(
            "{missing} of {all} pictures of {} are not there ({}); their places are left empty",
            sheet.file,
            name.display()
        ));
    }
    let joined = joined(&pictures);
    let place = folder.join(&sheet.file);
    let size = [joined.width(), joined.height()];
    let bytes = encode_picture(joined.as_raw(), size)?;
    Destination::check(&place)?.write(&bytes, interrupt)
}

/// Joins pictures in rows, on white.
fn joined(pictures: &[RgbImage]) -> RgbImage {
    let largest = |side: fn(&RgbImage) -> u32| pictures.iter().map(side).max().unwrap_or_default().max(1);
    let (width, height) = (largest(RgbImage::width), largest(RgbImage::height));
    let scale = (WIDTH / width).max(1);
    let (width, height) = (width * scale, height * scale);
    let columns = SHEET_COLUMNS.min(pictures.len());
    let side = |count: usize, size: u32| GAP + count as u32 * (size + GAP);
    let rows = pictures.len().div_ceil(SHEET_COLUMNS);
    let white = image::Rgb([255; 3]);
    let mut sheet = RgbImage::from_pixel(side(columns, width), side(rows, height), white);
    for (number, picture) in pictures.iter().enumerate() {
        if picture.width() == 0 || picture.height() == 0 {
            continue;
        }
        let scale = (width / picture.width()).min(height / picture.height());
        let (w, h) = (picture.width() * scale, picture.height() * scale);
        let larger = imageops::resize(picture, w, h, imageops::FilterType::Nearest);
        let at = |place: usize, size: u32| i64::from(side(place, size));
        let (x, y) = (at(number % SHEET_COLUMNS, width), at(number / SHEET_COLUMNS, height));
        imageops::replace(&mut sheet, &larger, x, y);
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_stand_in_rows_and_small_ones_are_magnified() {
        let plain = |width, height, grey| RgbImage::from_pixel(width, height, image::Rgb([grey; 3]));
        let pictures = [10, 20, 30, 40, 50].map(|grey| plain(150, 60, grey));
        let sheet = joined(&pictures);
        assert_eq!((sheet.width(), sheet.height()), (4 + 4 * 304, 4 + 2 * 124));
        let seen = [(4, 4), (303, 123), (304, 4), (308, 4), (4, 132), (308, 132)];
        let grey = seen.map(|(x, y)| sheet.get_pixel(x, y).0[0]);
        assert_eq!(grey, [10, 10, 255, 20, 50, 255]);
        // One picture is smaller than the others, and one is missing.
        let sheet = joined(&[plain(300, 100, 1), plain(100, 50, 2), RgbImage::new(0, 0)]);
        assert_eq!((sheet.width(), sheet.height()), (4 + 3 * 304, 108));
        let seen = [(303, 103), (308, 4), (507, 103), (508, 4), (612, 4)];
        let grey = seen.map(|(x, y)| sheet.get_pixel(x, y).0[0]);
        assert_eq!(grey, [1, 2, 2, 255, 255]);
    }
}
