/// Generator of the random numbers of an image's samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampler {
    /// Sobol points in groups of four dimensions, shuffled and scrambled for every pixel: the least noise, in
    /// particular where the samples per pixel are a power of two.
    #[default]
    Sobol,
    /// Independent random numbers.
    Pcg,
}

impl Sampler {
    /// All samplers.
    pub const ALL: [Self; 2] = [Self::Sobol, Self::Pcg];

    /// Name of the sampler on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sobol => "sobol",
            Self::Pcg => "pcg",
        }
    }

    /// Meaning of the sampler, in one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Sobol => {
                "Points spread evenly over the samples of a pixel: least noise where `spp` is a power of two"
            }
            Self::Pcg => "Independent numbers",
        }
    }
}
