//! Place and size of a picture in a window: fitted, or at a scale and moved by hand.

/// Number of window pixels, along each side, that a zoomed picture keeps in sight.
const IN_SIGHT: f32 = 32.0;

/// Least and greatest scale of a zoomed picture, in window pixels per pixel of the picture.
const SCALES: [f32; 2] = [1.0 / 64.0, 64.0];

/// Least scale at which pixels are drawn as squares, in window pixels per pixel of the picture.
const SQUARES: f32 = 2.0;

/// Rectangle of a window, pixels: the left top corner, then width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Left and top coordinate.
    pub corner: [f32; 2],
    /// Width and height.
    pub size: [f32; 2],
}

impl Area {
    fn centre(&self) -> [f32; 2] {
        [0, 1].map(|axis| self.corner[axis] + 0.5 * self.size[axis])
    }

    /// Returns a point as shares of width and height; `None` outside the area.
    pub fn share(&self, point: [f32; 2]) -> Option<[f32; 2]> {
        let share = [0, 1].map(|axis| (point[axis] - self.corner[axis]) / self.size[axis]);
        share.iter().all(|share| (0.0..1.0).contains(share)).then_some(share)
    }

    /// Returns the point at shares of width and height.
    pub fn at(&self, share: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| self.corner[axis] + share[axis] * self.size[axis])
    }

    /// Returns the area rounded outwards to whole pixels of the window.
    pub fn whole(&self) -> Self {
        let corner = self.corner.map(f32::floor);
        Self { corner, size: [0, 1].map(|axis| (self.corner[axis] + self.size[axis]).ceil() - corner[axis]) }
    }

    /// Computes the pixels of a window over a picture that lies in this area and whose pixels are squares:
    /// for each pixel of `window`, whose bounds are whole pixels, the pixel of the picture at its centre, and
    /// `around` outside the picture. `pixels` has the picture's rows from the top.
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
    /// Scale in window pixels per pixel of the picture; absent if the picture is fitted to the area.
    scale: Option<f32>,
    /// Shift from the centre of the area to the centre of the picture.
    shift: [f32; 2],
}

impl PictureView {
    /// Fits the picture to the area, whatever the size of the window.
    pub fn fit(&mut self) {
        *self = Self::default();
    }

    /// Makes a layout with one pixel of the window per pixel of the picture, in the middle.
    pub fn at_one_to_one() -> Self {
        Self { scale: Some(1.0), shift: [0.0; 2] }
    }

    /// Changes a fitted picture to one to one, any other to fitted.
    pub fn toggle(&mut self) {
        *self = if self.is_fitted() { Self::at_one_to_one() } else { Self::default() };
    }

    /// True if the picture is fitted to the area.
    pub fn is_fitted(&self) -> bool {
        self.scale.is_none()
    }

    /// Returns the scale in window pixels per pixel of the picture; `None` if it is fitted.
    pub fn chosen_scale(&self) -> Option<f32> {
        self.scale
    }

    /// Returns the scale of a picture of this size, in window pixels per pixel of the picture.
    pub fn scale(&self, area: Area, picture: [u32; 2]) -> f32 {
        let fit = |axis: usize| area.size[axis] / picture[axis].max(1) as f32;
        self.scale.unwrap_or_else(|| fit(0).min(fit(1))).max(f32::MIN_POSITIVE)
    }

    /// True if pixels of a picture of this size are drawn as squares; smaller pixels are interpolated.
    pub fn shows_squares(&self, area: Area, picture: [u32; 2]) -> bool {
        self.scale(area, picture) >= SQUARES
    }

    /// Returns the rectangle of a picture of this size, whose corner is on a whole pixel of the window.
    pub fn place(&self, area: Area, picture: [u32; 2]) -> Area {
        let scale = self.scale(area, picture);
        let size = picture.map(|side| side as f32 * scale);
        let (centre, shift) = (area.centre(), self.in_sight(area, size));
        let corner = [0, 1].map(|axis| (centre[axis] + shift[axis] - 0.5 * size[axis]).round());
        Area { corner, size }
    }

    /// Returns the shift, limited so that a part of the picture stays in the area.
    fn in_sight(&self, area: Area, size: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| {
            let most = (0.5 * (area.size[axis] + size[axis]) - IN_SIGHT).max(0.0);
            self.shift[axis].clamp(-most, most)
        })
    }

    /// Scales the picture by a factor; the part under `point` stays there.
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
        // The shift starts from the visible place, so that the picture moves at once even if its shift was
        // beyond the limit.
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
            // The corner is rounded before and after the zoom.
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
        // The first picture is larger than the window, the second has no pixels.
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
