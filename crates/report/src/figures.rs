//! Figures that a page shows and the JSON leaves out: images, and the work of single rays.

/// Pictures and maps of a comparison; `run` is always a position in [`crate::Report::runs`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figures {
    /// Images of the reference and of the systems; absent unless images were compared.
    pub images: Option<Images>,
    /// Work per pixel of the camera's rays, one map per run.
    pub work: Vec<WorkMap>,
    /// Errors in t of a run's hits, one histogram per run.
    pub depth_errors: Vec<DepthErrors>,
}

impl Figures {
    /// Moves runs to the positions that `place` returns.
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

/// Images of one size in linear Rec. 709, W/(sr m^2), rows from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Images {
    /// Width of the images, pixels.
    pub width: u32,
    /// Height of the images, pixels.
    pub height: u32,
    /// Pixels of the reference, `width * height` of them.
    pub reference: Vec<[f32; 3]>,
    /// Images of the systems, one per run with an image.
    pub systems: Vec<SystemImage>,
}

/// Image of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SystemImage {
    /// Position of the run.
    pub run: usize,
    /// Pixels of the image, `width * height` of them.
    pub pixels: Vec<[f32; 3]>,
    /// FLIP of each pixel against the reference, in [0, 1].
    pub flip: Vec<f32>,
}

/// Map of the work of the ray through each pixel's centre, rows from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorkMap {
    /// Position of the run.
    pub run: usize,
    /// Width of the map, pixels.
    pub width: u32,
    /// Height of the map, pixels.
    pub height: u32,
    /// Number of cells stepped, per pixel.
    pub cells: Vec<u32>,
    /// Number of list entries or tree nodes read, per pixel.
    pub entries: Vec<u32>,
    /// Number of primitive tests, per pixel.
    pub tests: Vec<u32>,
}

/// Distribution of |dt|/t over hits that the system and the oracle share.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DepthErrors {
    /// Position of the run.
    pub run: usize,
    /// Number of hits with exactly the oracle's t, rounded to f32.
    pub zero: u64,
    /// Number of hits in each bin. Bin i holds [10^(low + i w), 10^(low + (i + 1) w)), where `low` is
    /// [`DepthErrors::LOW`] and w is [`DepthErrors::WIDTH`]; the first and last bins are open.
    pub bins: Vec<u64>,
}

impl DepthErrors {
    /// Decimal exponent at the start of the first bin.
    pub const LOW: f64 = -9.0;
    /// Width of a bin, decades.
    pub const WIDTH: f64 = 0.25;
    /// Number of bins, which end at 10^1.
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
