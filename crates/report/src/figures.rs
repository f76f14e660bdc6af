//! Figures that a page shows and the JSON leaves out: images, and the work of single rays.

/// Pictures and maps of a comparison; `run` is always a position in [`crate::Report::runs`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figures {
    /// The reference and the systems' images; absent unless images were compared.
    pub images: Option<Images>,
    /// Work per pixel of the camera's rays, one map a run.
    pub work: Vec<WorkMap>,
    /// Errors in t of a run's hits, one histogram a run.
    pub depth_errors: Vec<DepthErrors>,
}

impl Figures {
    /// Moves runs to other positions, which `place` gives.
    #[must_use]
    pub fn moved(mut self, place: impl Fn(usize) -> usize) -> Self {
        let images =
            self.images.iter_mut().flat_map(|images| &mut images.systems).map(|image| &mut image.run);
        let work = self.work.iter_mut().map(|map| &mut map.run);
        let errors = self.depth_errors.iter_mut().map(|errors| &mut errors.run);
        images.chain(work).chain(errors).for_each(|run| *run = place(*run));
        self
    }
}

/// Images of one size; linear Rec. 709, W/(sr m^2), rows from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Images {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The reference, `width * height` pixels.
    pub reference: Vec<[f32; 3]>,
    /// One per run with an image.
    pub systems: Vec<SystemImage>,
}

/// The image of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SystemImage {
    /// The run.
    pub run: usize,
    /// `width * height` pixels.
    pub pixels: Vec<[f32; 3]>,
    /// FLIP of each pixel against the reference, in [0, 1].
    pub flip: Vec<f32>,
}

/// Work of the ray through each pixel's centre, rows from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorkMap {
    /// The run.
    pub run: usize,
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Cells stepped.
    pub cells: Vec<u32>,
    /// List entries or tree nodes read.
    pub entries: Vec<u32>,
    /// Primitive tests.
    pub tests: Vec<u32>,
}

/// Distribution of |dt|/t over hits that the system and the oracle share.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DepthErrors {
    /// The run.
    pub run: usize,
    /// Hits with exactly the oracle's t, rounded to f32.
    pub zero: u64,
    /// Hits per bin; bin i holds [10^(low + i w), 10^(low + (i + 1) w)), `low` and w of
    /// [`DepthErrors::LOW`] and [`DepthErrors::WIDTH`]; the first and last bins are open.
    pub bins: Vec<u64>,
}

impl DepthErrors {
    /// Decimal exponent at the start of the first bin.
    pub const LOW: f64 = -9.0;
    /// Decades a bin.
    pub const WIDTH: f64 = 0.25;
    /// Bins: up to 10^1.
    pub const BINS: usize = 40;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_go_with_their_runs() {
        let image = SystemImage { run: 2, ..SystemImage::default() };
        let figures = Figures {
            images: Some(Images { systems: vec![image], ..Images::default() }),
            work: vec![WorkMap { run: 0, ..WorkMap::default() }],
            depth_errors: vec![DepthErrors { run: 1, ..DepthErrors::default() }],
        };
        let Figures { images, work, depth_errors } = figures.moved(|run| 10 + run);
        let image = images.map(|images| images.systems[0].run);
        assert_eq!((image, work[0].run, depth_errors[0].run), (Some(12), 10, 11));
    }
}
