/// The random numbers of the samples of an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampler {
    /// Sobol points in groups of four dimensions, shuffled and scrambled for every pixel: least noise, above
    /// all where the samples per pixel are a power of two.
    #[default]
    Sobol,
    /// Independent numbers.
    Pcg,
}

impl Sampler {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Sobol, Self::Pcg];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sobol => "sobol",
            Self::Pcg => "pcg",
        }
    }

    /// Meaning, in one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Sobol => {
                "Points spread evenly over the samples of a pixel: least noise where `spp` is a power of two"
            }
            Self::Pcg => "Independent numbers",
        }
    }
}
