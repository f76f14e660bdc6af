//! Images in addition to the colours (arbitrary output variables).

use std::fmt;

use rasray_scene::Scene;
use rasray_scene::needs::{Needs, Term, Workload};

/// Image in addition to the colours. All are of the rays through pixels' centres, except those of the samples
/// ([`Aov::is_of_samples`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Aov {
    /// Distance along the ray, metres; 0 where nothing was hit.
    Depth,
    /// Unit geometric normal in the world, facing the eye; zero where nothing was hit.
    Normal,
    /// Global triangle id in scene order; `u32::MAX` where nothing was hit.
    Primitive,
    /// Number of samples in the mean of each pixel: those that were made and are finite.
    Samples,
    /// Base colour, linear; for an unlit material the colour that it shows. 0 where nothing was hit.
    Albedo,
    /// Position in the world, metres; 0 where nothing was hit.
    Position,
    /// Texture coordinates of set 0; 0 where there are none.
    Uv,
    /// Index of the material in scene order; `u32::MAX` where nothing was hit.
    Material,
    /// Index of the instance in scene order; `u32::MAX` where nothing was hit.
    Instance,
    /// Motion from the place of a pixel's point to its place one frame before: pixels to the right and
    /// upwards.
    Motion,
    /// Emitted light, and light that was scattered at most once; W/(sr m^2).
    Direct,
    /// Light that was scattered more often: the picture less [`Aov::Direct`].
    Indirect,
    /// Variance of the mean of each pixel, computed as if samples were independent; 0 for one sample.
    Variance,
}

impl Aov {
    /// All additional images, in their order.
    pub const ALL: [Self; 13] = [
        Self::Depth,
        Self::Normal,
        Self::Primitive,
        Self::Samples,
        Self::Albedo,
        Self::Position,
        Self::Uv,
        Self::Material,
        Self::Instance,
        Self::Motion,
        Self::Direct,
        Self::Indirect,
        Self::Variance,
    ];

    /// Images that a denoiser takes beside the colours.
    pub const FOR_DENOISING: [Self; 2] = [Self::Albedo, Self::Normal];

    /// Returns the name of the image on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Primitive => "primitive",
            Self::Samples => "samples",
            Self::Albedo => "albedo",
            Self::Position => "position",
            Self::Uv => "uv",
            Self::Material => "material",
            Self::Instance => "instance",
            Self::Motion => "motion",
            Self::Direct => "direct",
            Self::Indirect => "indirect",
            Self::Variance => "variance",
        }
    }

    /// Returns the description of the image, one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Depth => "Z: metres from the eye along the ray",
            Self::Normal => "N.X N.Y N.Z: geometric normal",
            Self::Primitive => "id: global triangle id",
            Self::Samples => "samples: number in each pixel's mean",
            Self::Albedo => "albedo.R .G .B: base colour",
            Self::Position => "position.X .Y .Z: world, metres",
            Self::Uv => "uv.U .V: texture coordinates 0",
            Self::Material => "material: index of the material",
            Self::Instance => "instance: index of the instance",
            Self::Motion => "motion.X .Y: pixels to the right and upwards to the frame before, with `frames`",
            Self::Direct => "direct.R .G .B: light scattered at most once, with `integrator` path",
            Self::Indirect => "indirect.R .G .B: the picture less the direct light",
            Self::Variance => "variance.R .G .B: of each pixel's mean",
        }
    }

    /// Returns the channels of a file, in their order.
    pub fn channels(self) -> &'static [&'static str] {
        match self {
            Self::Depth => &["Z"],
            Self::Normal => &["N.X", "N.Y", "N.Z"],
            Self::Primitive => &["id"],
            Self::Samples => &["samples"],
            Self::Albedo => &["albedo.R", "albedo.G", "albedo.B"],
            Self::Position => &["position.X", "position.Y", "position.Z"],
            Self::Uv => &["uv.U", "uv.V"],
            Self::Material => &["material"],
            Self::Instance => &["instance"],
            Self::Motion => &["motion.X", "motion.Y"],
            Self::Direct => &["direct.R", "direct.G", "direct.B"],
            Self::Indirect => &["indirect.R", "indirect.G", "indirect.B"],
            Self::Variance => &["variance.R", "variance.G", "variance.B"],
        }
    }

    /// Returns the bytes per pixel.
    pub fn bytes(self) -> u64 {
        (self.channels().len() * size_of::<u32>()) as u64
    }

    /// True if the values are whole numbers of 32 bits; otherwise they are single-precision.
    pub fn is_whole(self) -> bool {
        matches!(self, Self::Primitive | Self::Samples | Self::Material | Self::Instance)
    }

    /// True if the image is of all samples of a picture together; otherwise it is of the rays through pixels'
    /// centres.
    pub fn is_of_samples(self) -> bool {
        matches!(self, Self::Samples | Self::Direct | Self::Indirect | Self::Variance)
    }
}

/// Selection of images in addition to the colours.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct AovSelection(u16);

impl AovSelection {
    /// True if the selection contains the image.
    pub fn contains(self, aov: Aov) -> bool {
        self.0 & 1 << aov as u16 != 0
    }

    /// True if the selection is empty.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Returns the selected images, in their order.
    pub fn iter(self) -> impl Iterator<Item = Aov> {
        Aov::ALL.into_iter().filter(move |aov| self.contains(*aov))
    }

    /// Adds the images of another selection.
    #[must_use]
    pub fn with(self, other: impl IntoIterator<Item = Aov>) -> Self {
        Self(other.into_iter().fold(self.0, |bits, aov| bits | 1 << aov as u16))
    }

    /// True if any image needs materials and meshes of the surfaces that pixels show.
    pub(crate) fn has_surfaces(self) -> bool {
        self.iter().any(|aov| {
            matches!(aov, Aov::Albedo | Aov::Position | Aov::Uv | Aov::Material | Aov::Instance | Aov::Motion)
        })
    }

    /// True if any image is of the rays through pixels' centres.
    pub(crate) fn has_centres(self) -> bool {
        self.iter().any(|aov| !aov.is_of_samples())
    }

    /// True if any image needs the picture of light that is scattered at most once.
    pub(crate) fn has_direct_light(self) -> bool {
        self.contains(Aov::Direct) || self.contains(Aov::Indirect)
    }

    /// Adds the needs of these images to a workload.
    pub fn workload(self, workload: Workload) -> Workload {
        match self.contains(Aov::Albedo) {
            true => Workload { emission: true, shades: true, ..workload },
            false => workload,
        }
    }

    /// Returns the data of a scene that a picture with these images needs.
    pub fn needs(self, scene: &Scene, workload: Workload) -> Needs {
        let needs = Needs::of(scene, self.workload(workload));
        match self.contains(Aov::Uv) {
            true => needs.with(Term::Uv0, "texture coordinates were asked for"),
            false => needs,
        }
    }
}

impl FromIterator<Aov> for AovSelection {
    fn from_iter<I: IntoIterator<Item = Aov>>(aovs: I) -> Self {
        Self::default().with(aovs)
    }
}

impl From<Aov> for AovSelection {
    fn from(aov: Aov) -> Self {
        Self::from_iter([aov])
    }
}

impl fmt::Debug for AovSelection {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_set().entries(self.iter()).finish()
    }
}

/// Pixels of an image in addition to the colours, rows from the top: the pixels of each channel, in the order
/// of [`Aov::channels`].
#[derive(Clone, Debug, PartialEq)]
pub enum AovImage {
    /// Pixels of an image that is not [`Aov::is_whole`].
    Floats(Vec<Vec<f32>>),
    /// Pixels of an image that is [`Aov::is_whole`], with one channel.
    Whole(Vec<u32>),
}

impl AovImage {
    /// Makes an image without pixels, with room for that many.
    pub(crate) fn with_room(aov: Aov, pixels: usize) -> Self {
        match aov.is_whole() {
            true => Self::Whole(Vec::with_capacity(pixels)),
            false => Self::Floats(aov.channels().iter().map(|_| Vec::with_capacity(pixels)).collect()),
        }
    }

    /// Makes an image of pixels with N channels.
    pub fn of<const N: usize>(pixels: impl IntoIterator<Item = [f32; N]>) -> Self {
        let mut image = Self::Floats(vec![Vec::new(); N]);
        image.extend(pixels);
        image
    }

    /// Appends pixels with as many channels; an image of whole numbers stays unchanged.
    pub(crate) fn extend<const N: usize>(&mut self, pixels: impl IntoIterator<Item = [f32; N]>) {
        let Self::Floats(channels) = self else { return };
        for pixel in pixels {
            channels.iter_mut().zip(pixel).for_each(|(channel, value)| channel.push(value));
        }
    }

    /// Appends pixels of whole numbers; an image of floats stays unchanged.
    pub(crate) fn extend_whole(&mut self, pixels: impl IntoIterator<Item = u32>) {
        let Self::Whole(values) = self else { return };
        values.extend(pixels);
    }

    /// Returns the number of pixels in the shortest channel.
    pub fn pixels(&self) -> usize {
        match self {
            Self::Floats(channels) => channels.iter().map(Vec::len).min().unwrap_or(0),
            Self::Whole(values) => values.len(),
        }
    }

    /// Returns the pixels of an image with three channels; `None` for any other number of channels.
    pub fn triples(&self) -> Option<Vec<[f32; 3]>> {
        let Self::Floats(channels) = self else { return None };
        let [x, y, z] = &channels[..] else { return None };
        Some(x.iter().zip(y).zip(z).map(|((x, y), z)| [*x, *y, *z]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_aov_has_a_name_and_channels_of_its_own() {
        let names: BTreeSet<_> = Aov::ALL.iter().map(|aov| aov.name()).collect();
        let channels: Vec<_> = Aov::ALL.iter().flat_map(|aov| aov.channels()).collect();
        let different: BTreeSet<_> = channels.iter().collect();
        assert_eq!((names.len(), different.len()), (Aov::ALL.len(), channels.len()));
        for aov in Aov::ALL {
            assert!(!aov.is_whole() || aov.channels().len() == 1, "{aov:?}");
            let (first, _) = aov.doc().split_once(':').expect("its channels first");
            assert!(first.starts_with(aov.channels()[0]), "{aov:?}");
        }
    }

    #[test]
    fn selections_are_sets() {
        let two = AovSelection::from_iter([Aov::Variance, Aov::Depth, Aov::Depth]);
        assert_eq!(two.iter().collect::<Vec<_>>(), [Aov::Depth, Aov::Variance]);
        assert!(two.contains(Aov::Depth) && !two.contains(Aov::Normal) && !two.is_empty());
        assert_eq!(format!("{two:?}"), "{Depth, Variance}");
        assert!(AovSelection::default().is_empty() && two.has_centres() && !two.has_surfaces());
    }

    #[test]
    fn what_shows_materials_needs_them() {
        let loaded = rasray_scene_source::load("atrium".as_ref()).expect("built in");
        let needs = |aov| AovSelection::from_iter(aov).needs(&loaded.scene, Workload::VISIBILITY);
        assert_eq!(needs(None), Needs::of(&loaded.scene, Workload::VISIBILITY));
        assert!(!needs(None).requires(Term::BaseColorTextures));
        assert!(needs(Some(Aov::Albedo)).requires(Term::BaseColorTextures));
        let cornell = rasray_scene_source::load("cornell".as_ref()).expect("built in");
        let uv = AovSelection::from(Aov::Uv).needs(&cornell.scene, Workload::ALL);
        assert!(uv.requires(Term::Uv0) && !Needs::of(&cornell.scene, Workload::ALL).requires(Term::Uv0));
    }
}
