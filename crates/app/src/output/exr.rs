//! OpenEXR: linear 32-bit floats in one part, losslessly compressed. Channels: R, G, B, and those that
//! [`Aov::channels`] names, of which a layer is what precedes the last dot; whole numbers have 32 bits
//! without a sign. A share of the samples has sums in R, G, B, and in samples how many each sum holds.
//!
//! [`Aov::channels`]: rasray_experiment::Aov::channels

use super::exr_channels::{Channels, Values};
use super::exr_header::{CHECKSUM, NO_CHECKSUM, finish};
use super::stamp::{DENOISED, KEY};
use exr::prelude::*;
use rasray_experiment::{Aov, AovImage, RenderOutput, Shard};
use std::io::Cursor;

/// Metadata in the header of an image.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata {
    /// Name of the scene.
    pub scene: String,
    /// Name of the system, such as `mmrt`.
    pub system: String,
    /// Name of the preset, such as `robust`.
    pub preset: String,
    /// Name of the integrator, such as `path`.
    pub integrator: String,
    /// Samples per pixel that were asked for.
    pub spp: u32,
    /// Samples per pixel in the image; fewer after an early end.
    pub samples: u32,
    /// Seed of all random numbers.
    pub seed: u32,
    /// Version of the program that made the picture.
    pub version: String,
    /// Key of the file; absent if it holds less than was asked for.
    pub key: Option<String>,
    /// Name and version of the denoiser; absent for a picture with noise.
    pub denoised: Option<String>,
    /// Picture of which the file holds a share of the samples; absent if it holds all.
    pub part: Option<PartOf>,
}

/// Share of a picture's samples.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartOf {
    /// Key of the picture, which all its parts have.
    pub picture: String,
    /// Share of the samples.
    pub shard: Shard,
}

/// Name of the attribute with the picture's key, in parts.
pub(super) const PICTURE: &str = "rasrayPicture";
pub(super) const SHARD: &str = "rasrayShard";
/// Name of the channel with the number of samples in each pixel's mean or, in parts, in its sum.
pub(super) const SAMPLES: &str = "samples";
pub(super) const VERSION: &str = "rasrayVersion";

/// Converts text to the format's encoding: one byte per character.
fn text(value: &str) -> Text {
    let plain: String = value.chars().map(|c| if c.is_ascii() { c } else { '?' }).collect();
    Text::new_or_none(&plain).unwrap_or_else(|| Text::from("?"))
}

/// Returns the bytes of an EXR file of all images of `output`; a part holds sums in place of means.
///
/// # Errors
/// The message of the encoder.
pub fn encode(output: &RenderOutput, metadata: &Metadata) -> std::result::Result<Vec<u8>, String> {
    let mut channels = Channels(Vec::new());
    let sums = output.sums.as_ref().filter(|_| metadata.part.is_some());
    let colours = sums.map_or(&output.beauty, |film| &film.sums);
    channels.add_axes(["R", "G", "B"], colours);
    if let Some(film) = sums {
        channels.add(SAMPLES, Values::Whole(&film.counts));
    }
    // A part holds the counts of its sums, so the image of sample counts is left out.
    for (aov, image) in output.aovs.iter().filter(|(aov, _)| sums.is_none() || **aov != Aov::Samples) {
        let values: Vec<_> = match image {
            AovImage::Floats(channels) => channels.iter().map(|channel| Values::Floats(channel)).collect(),
            AovImage::Whole(values) => vec![Values::Whole(values)],
        };
        channels.0.extend(aov.channels().iter().copied().zip(values));
    }
    channels.0.sort_unstable_by_key(|(name, _)| *name);

    let mut attributes = LayerAttributes { software_name: Some(text(&software())), ..Default::default() };
    let part = metadata.part.as_ref();
    let words = [
        ("scene", Some(metadata.scene.clone())),
        ("system", Some(metadata.system.clone())),
        ("preset", Some(metadata.preset.clone())),
        ("integrator", Some(metadata.integrator.clone())),
        (VERSION, Some(metadata.version.clone())),
        (KEY, metadata.key.clone()),
        (DENOISED, metadata.denoised.clone()),
        (PICTURE, part.map(|part| part.picture.clone())),
        (SHARD, part.map(|part| part.shard.to_string())),
        (CHECKSUM, Some(NO_CHECKSUM.to_owned())),
    ];
    for (name, value) in words.iter().filter_map(|(name, value)| Some((*name, value.as_ref()?))) {
        attributes.other.insert(Text::from(name), AttributeValue::Text(text(value)));
    }
    // The seed is text, because the number may exceed the range of a signed attribute.
    attributes.other.insert(Text::from("seed"), AttributeValue::Text(text(&metadata.seed.to_string())));
    for (name, value) in [("spp", metadata.spp), ("samples", metadata.samples)] {
        let value = i32::try_from(value).unwrap_or(i32::MAX);
        attributes.other.insert(Text::from(name), AttributeValue::I32(value));
    }

    let size = (output.width as usize, output.height as usize);
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let image = Image::from_layer(Layer::new(size, attributes, encoding, channels));
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_unbuffered(&mut bytes).map_err(|error| error.to_string())?;
    let mut bytes = bytes.into_inner();
    finish(&mut bytes).ok_or("the encoder wrote a header that is none")?;
    Ok(bytes)
}

fn software() -> String {
    format!("rasray {}", crate::version::version_text())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metadata() -> Metadata {
        Metadata {
            scene: "Café".to_owned(),
            system: "mmrt".to_owned(),
            preset: "robust".to_owned(),
            integrator: "path".to_owned(),
            spp: 8,
            samples: 5,
            seed: u32::MAX,
            ..Metadata::default()
        }
    }

    fn output() -> RenderOutput {
        RenderOutput {
            width: 3,
            height: 2,
            beauty: (0..6).map(|i| [i as f32, -0.5, 1.0e30]).collect(),
            aovs: [
                (Aov::Depth, AovImage::of((0..6).map(|i| [0.25 * i as f32]))),
                (Aov::Normal, AovImage::of([[0.0, 1.0, -1.0]; 6])),
                (Aov::Primitive, AovImage::Whole(vec![0, 1, 2, 0x7fff_ffff, 0xffff_fffe, u32::MAX])),
            ]
            .into(),
            ..Default::default()
        }
    }

    fn read(bytes: &[u8]) -> FlatImage {
        exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .expect("a valid file")
    }

    #[test]
    fn equal_images_are_equal_files() {
        let encoded = || encode(&output(), &metadata()).expect("a small image");
        let expected = encoded();
        // Each map of the encoder has an order of its own: unless they are sorted, nearly all of these files
        // differ.
        assert!((0..8).all(|_| encoded() == expected));
        let mut cut = expected[..40].to_vec();
        assert_eq!(finish(&mut cut), None);
    }

    #[test]
    fn every_channel_reads_back_bit_for_bit() {
        let image = read(&encode(&output(), &metadata()).expect("a small image"));
        let layer = &image.layer_data[0];
        assert_eq!((layer.size.x(), layer.size.y()), (3, 2));
        let names: Vec<_> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "N.X", "N.Y", "N.Z", "R", "Z", "id"]);
        let samples = |name: &str| {
            let found = layer.channel_data.list.iter().find(|c| c.name.to_string() == name);
            found.expect("the channel").sample_data.clone()
        };
        assert_eq!(samples("R"), FlatSamples::F32((0..6).map(|i| i as f32).collect()));
        assert_eq!(samples("B"), FlatSamples::F32(vec![1.0e30; 6]));
        assert_eq!(samples("Z"), FlatSamples::F32((0..6).map(|i| 0.25 * i as f32).collect()));
        assert_eq!(samples("N.Z"), FlatSamples::F32(vec![-1.0; 6]));
        assert_eq!(samples("id"), FlatSamples::U32(vec![0, 1, 2, 0x7fff_ffff, 0xffff_fffe, u32::MAX]));
    }

    #[test]
    fn the_header_says_how_the_image_was_made() {
        let image = read(&encode(&output(), &metadata()).expect("a small image"));
        let other = &image.layer_data[0].attributes.other;
        let word = |name: &str| match other.get(&Text::from(name)) {
            Some(AttributeValue::Text(text)) => text.to_string(),
            Some(AttributeValue::I32(number)) => number.to_string(),
            unexpected => panic!("{name}: {unexpected:?}"),
        };
        assert_eq!(word("scene"), "Caf?");
        assert_eq!(
            (word("spp"), word("samples"), word("seed")),
            ("8".into(), "5".into(), "4294967295".into())
        );
        assert_eq!(
            (word("system"), word("preset"), word("integrator")),
            ("mmrt".into(), "robust".into(), "path".into())
        );
    }

    #[test]
    fn without_further_images_there_are_three_channels() {
        let plain = RenderOutput { aovs: Default::default(), ..output() };
        let image = read(&encode(&plain, &metadata()).expect("a small image"));
        assert_eq!(image.layer_data[0].channel_data.list.len(), 3);
    }
}
