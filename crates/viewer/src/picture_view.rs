//! Place and size of a picture in a window: fitted, or at a scale and moved by hand.

/// Window pixels that a zoomed picture keeps in sight, along each side.
const IN_SIGHT: f32 = 32.0;

/// Least and greatest window pixels per pixel of a picture, where it was zoomed.
const SCALES: [f32; 2] = [1.0 / 64.0, 64.0];

/// Window pixels per pixel of a picture from which on its pixels are squares.
const SQUARES: f32 = 2.0;

/// A rectangle of a window, pixels: the left top corner, then width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Left and top.
    pub corner: [f32; 2],
    /// Width and height.
    pub size: [f32; 2],
}

impl Area {
    fn centre(&self) -> [f32; 2] {
        [0, 1].map(|axis| self.corner[axis] + 0.5 * self.size[axis])
    }

    /// A point as shares of width and height; nothing outside.
    pub fn share(&self, point: [f32; 2]) -> Option<[f32; 2]> {
        let share = [0, 1].map(|axis| (point[axis] - self.corner[axis]) / self.size[axis]);
        share.iter().all(|share| (0.0..1.0).contains(share)).then_some(share)
    }

    /// The point at shares of width and height.
    pub fn at(&self, share: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| self.corner[axis] + share[axis] * self.size[axis])
    }

    /// The whole pixels of the window that it touches.
    pub fn whole(&self) -> Self {
        let corner = self.corner.map(f32::floor);
        Self { corner, size: [0, 1].map(|axis| (self.corner[axis] + self.size[axis]).ceil() - corner[axis]) }
    }

    /// Pixels that a window shows of a picture that lies here, whose pixels are squares: per pixel of
    /// `window`, which are whole ones, the pixel of the picture that its centre is in, and `around` beside
    /// the picture. `pixels` has the picture's rows from the top.
    pub fn squares<Pixel: Copy>(
        &self,
        (picture, pixels): ([u32; 2], &[Pixel]),
        window: Self,
        around: Pixel,
    ) -> Vec<Pixel> {
        let along = |axis: usize| {
            let first = window.corner[axis] - self.corner[axis] + 0.5;
            (0..window.size[axis] as usize).map(move |pixel| {
                let share = (first + pixel as f32) / self.size[axis];
                let place = (share * picture[axis] as f32) as usize;
                (0.0..1.0).contains(&share).then(|| place.min(picture[axis].saturating_sub(1) as usize))
            })
        };
        let columns: Vec<_> = along(0).collect();
        let rows = along(1).flat_map(|row| columns.iter().map(move |column| row.zip(*column)));
        let at = |place: Option<(usize, usize)>| {
            place.and_then(|(row, column)| pixels.get(row * picture[0] as usize + column)).copied()
        };
        rows.map(|place| at(place).unwrap_or(around)).collect()
    }
}

/// Layout of a picture in an area. All lengths are pixels of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PictureView {
    /// Window pixels per pixel of the picture; absent where the picture is as large as it fits.
    scale: Option<f32>,
    /// From the centre of the area to that of the picture.
    shift: [f32; 2],
}

impl PictureView {
    /// As large as it fits, and with the window.
    pub fn fit(&mut self) {
        *self = Self::default();
    }

    /// A pixel of the window per pixel of the picture, in the middle.
    pub fn at_one_to_one() -> Self {
        Self { scale: Some(1.0), shift: [0.0; 2] }
    }

    /// One to one where it is fitted, else fitted.
    pub fn toggle(&mut self) {
        *self = if self.is_fitted() { Self::at_one_to_one() } else { Self::default() };
    }

    /// True if the picture is as large as it fits.
    pub fn is_fitted(&self) -> bool {
        self.scale.is_none()
    }

    /// Window pixels per pixel of the picture; absent where it is as large as it fits.
    pub fn chosen_scale(&self) -> Option<f32> {
        self.scale
    }

    /// Window pixels per pixel of a picture of this size.
    pub fn scale(&self, area: Area, picture: [u32; 2]) -> f32 {
        let fit = |axis: usize| area.size[axis] / picture[axis].max(1) as f32;
        self.scale.unwrap_or_else(|| fit(0).min(fit(1))).max(f32::MIN_POSITIVE)
    }

    /// True if pixels of a picture of this size are squares; smaller ones are interpolated.
    pub fn shows_squares(&self, area: Area, picture: [u32; 2]) -> bool {
        self.scale(area, picture) >= SQUARES
    }

    /// Rectangle of a picture of this size; its corner is on a whole pixel of the window.
    pub fn place(&self, area: Area, picture: [u32; 2]) -> Area {
        let scale = self.scale(area, picture);
        let size = picture.map(|side| side as f32 * scale);
        let (centre, shift) = (area.centre(), self.in_sight(area, size));
        let corner = [0, 1].map(|axis| (centre[axis] + shift[axis] - 0.5 * size[axis]).round());
        Area { corner, size }
    }

    /// The shift, so that a part of the picture stays in the area.
    fn in_sight(&self, area: Area, size: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| {
            let most = (0.5 * (area.size[axis] + size[axis]) - IN_SIGHT).max(0.0);
            self.shift[axis].clamp(-most, most)
        })
    }

    /// Makes the picture larger by a factor; what is under `point` stays there.
    pub fn zoom(&mut self, factor: f32, point: [f32; 2], area: Area, picture: [u32; 2]) {
        let before = self.scale(area, picture);
        let after = (before * factor).clamp(SCALES[0].min(before), SCALES[1].max(before));
        if !after.is_finite() || after == before {
            return;
        }
        let (centre, size) = (area.centre(), picture.map(|side| side as f32 * before));
        let shift = self.in_sight(area, size);
        let from_point = |axis: usize| centre[axis] + shift[axis] - point[axis];
        self.shift = [0, 1].map(|axis| point[axis] - centre[axis] + from_point(axis) * after / before);
        self.scale = Some(after);
    }

    /// Moves the picture in the area.
    pub fn shift(&mut self, by: [f32; 2], area: Area, picture: [u32; 2]) {
        let scale = self.scale(area, picture);
        // From where it is seen to be, so that it moves at once where it was beyond sight.
        let shift = self.in_sight(area, picture.map(|side| side as f32 * scale));
        *self = Self { scale: Some(scale), shift: [0, 1].map(|axis| shift[axis] + by[axis]) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Area = Area { corner: [10.0, 0.0], size: [900.0, 700.0] };

    #[test]
    fn a_fitted_picture_fills_the_window_along_one_side_and_never_leaves_it() {
        let view = PictureView::default();
        for picture in [[640, 360], [40, 30], [360, 640], [4000, 100], [1, 1]] {
            for area in [AREA, Area { corner: [0.0; 2], size: [301.0, 95.0] }] {
                let place = view.place(area, picture);
                let full = [0, 1].map(|axis| (place.size[axis] - area.size[axis]).abs() < 0.01);
                assert!(full[0] || full[1], "{picture:?} in {area:?}: {place:?}");
                for axis in 0..2 {
                    assert!(place.size[axis] <= area.size[axis] + 0.01, "{place:?}");
                    assert!(
                        place.corner[axis] >= area.corner[axis] - 0.51 && place.corner[axis].fract() == 0.0
                    );
                }
            }
        }
        assert_eq!(view.scale(AREA, [450, 100]), 2.0, "it follows the window");
    }

    #[test]
    fn what_is_under_the_pointer_stays_there_while_the_picture_grows() {
        let mut view = PictureView::default();
        let (picture, point) = ([640, 360], [333.0, 222.0]);
        for factor in [1.5, 1.5, 0.7, 2.0] {
            let before = view.place(AREA, picture).share(point).expect("on the picture");
            view.zoom(factor, point, AREA, picture);
            let after = view.place(AREA, picture).at(before);
            // The corner is rounded before and after.
            let rounded = 0.51 * (1.0 + factor);
            assert!((0..2).all(|axis| (after[axis] - point[axis]).abs() <= rounded), "{after:?}");
        }
        for (factor, most) in [(1.0e9, SCALES[1]), (1.0e-9, SCALES[0])] {
            view.zoom(factor, point, AREA, picture);
            assert_eq!(view.scale(AREA, picture), most);
        }
        view.toggle();
        assert!(view.is_fitted());
        view.toggle();
        assert_eq!(view.place(AREA, picture).size, [640.0, 360.0]);
    }

    #[test]
    fn a_picture_is_not_lost_however_far_it_is_moved() {
        let mut view = PictureView::at_one_to_one();
        view.shift([1.0e6, -1.0e6], AREA, [64, 48]);
        let place = view.place(AREA, [64, 48]);
        assert!(place.corner[0] < 910.0 - 16.0 && place.corner[1] + 48.0 > 16.0, "{place:?}");
        view.shift([-8.0, 0.0], AREA, [64, 48]);
        assert_eq!(view.place(AREA, [64, 48]).corner[0], place.corner[0] - 8.0, "and comes back at once");
    }

    #[test]
    fn pixels_are_squares_where_they_are_two_of_the_window_or_more() {
        let mut view = PictureView::default();
        assert!(view.shows_squares(AREA, [450, 100]) && !view.shows_squares(AREA, [451, 100]), "fitted");
        assert!(!PictureView::at_one_to_one().shows_squares(AREA, [40, 30]));
        view.toggle();
        view.zoom(1.99, [0.0; 2], AREA, [40, 30]);
        assert!(!view.shows_squares(AREA, [40, 30]));
        view.zoom(1.01, [0.0; 2], AREA, [40, 30]);
        assert!(view.shows_squares(AREA, [40, 30]));
    }

    #[test]
    fn squares_are_of_one_colour_and_lie_where_the_picture_does() {
        let place = Area { corner: [2.0, -1.0], size: [6.0, 4.0] };
        let window = Area { corner: [1.25, 0.0], size: [5.5, 3.5] }.whole();
        assert_eq!(window, Area { corner: [1.0, 0.0], size: [6.0, 4.0] });
        let shown = place.squares(([3, 2], b"abcdef"), window, b'.');
        let rows: Vec<_> = shown.chunks(6).map(|row| std::str::from_utf8(row).expect("letters")).collect();
        assert_eq!(rows, [".aabbc", ".ddeef", ".ddeef", "......"]);
        // A picture that is larger than the window, and one of no pixels.
        let large = Area { corner: [-1.0e4, -1.0e4], size: [3.0e4, 2.0e4] };
        assert_eq!(large.squares(([3, 2], b"abcdef"), window, b'.'), [b'e'; 24]);
        assert_eq!(place.squares(([0, 0], b""), window, b'.'), [b'.'; 24]);
    }

    #[test]
    fn a_point_outside_of_the_picture_has_no_share() {
        let place = PictureView::default().place(AREA, [640, 360]);
        assert_eq!(place.share([0.0, 0.0]), None);
        let middle = place.share([460.0, 350.0]).expect("on the picture");
        assert!(middle.iter().all(|share| (share - 0.5).abs() < 0.01), "{middle:?}");
    }
}
