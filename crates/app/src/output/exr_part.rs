//! Reader of a share of a picture's samples from its EXR.

use super::exr::{Metadata, PICTURE, PartOf, SAMPLES, SHARD, VERSION};
use super::exr_header::{is_readable, is_whole, number, text};
use super::stamp::KEY;
use exr::prelude::*;
use rasray_experiment::{Aov, AovImage, FilmSums, RenderOutput, Shard};
use std::collections::BTreeMap;
use std::io::Cursor;

/// File with a share of a picture's samples, whose header is read and whose bytes match their checksum.
pub(crate) struct PartFile {
    bytes: Vec<u8>,
    /// Metadata as in the file.
    pub(crate) metadata: Metadata,
    /// Share that the file holds.
    pub(crate) part: PartOf,
}

/// Reads the header of a part.
///
/// # Errors
/// The bytes are not a part, or damaged; the text describes it.
pub(crate) fn decode(bytes: Vec<u8>) -> std::result::Result<PartFile, &'static str> {
    if !is_readable(&bytes) {
        return Err("is not an EXR file, or is cut short");
    }
    if text(&bytes, PICTURE).is_none() {
        return Err("holds no share of a picture's samples");
    }
    if !is_whole(&bytes) {
        return Err("is damaged: it was cut short or changed after it was written");
    }
    let header = || {
        let word = |name: &str| text(&bytes, name).map(str::to_owned);
        let count = |name: &str| u32::try_from(number(&bytes, name)?).ok();
        let part = PartOf { picture: word(PICTURE)?, shard: Shard::parse(text(&bytes, SHARD)?)? };
        let metadata = Metadata {
            scene: word("scene")?,
            system: word("system")?,
            preset: word("preset")?,
            integrator: word("integrator")?,
            spp: count("spp")?,
            samples: count("samples")?,
            seed: text(&bytes, "seed")?.parse().ok()?,
            version: word(VERSION)?,
            key: word(KEY),
            denoised: None,
            part: Some(part.clone()),
        };
        Some((metadata, part))
    };
    let (metadata, part) = header().ok_or("was written by another version, or not by rasray")?;
    Ok(PartFile { bytes, metadata, part })
}

impl PartFile {
    /// Reads sums, counts and additional images; the result has no means.
    ///
    /// # Errors
    /// The message of the decoder.
    pub(crate) fn pixels(self) -> std::result::Result<RenderOutput, String> {
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(self.bytes))
            .map_err(|error| error.to_string())?;
        let layer = image.layer_data;
        // Each channel is moved out once, so that there is no second copy.
        let mut channels: BTreeMap<_, _> =
            layer.channel_data.list.into_iter().map(|one| (one.name.to_string(), one.sample_data)).collect();
        let floats = |samples| match samples {
            Some(FlatSamples::F32(values)) => Some(values),
            _ => None,
        };
        let whole = |samples| match samples {
            Some(FlatSamples::U32(values)) => Some(values),
            _ => None,
        };
        let triples = |all: [Option<FlatSamples>; 3]| {
            let [x, y, z] = all.map(floats);
            let pixels = x?.into_iter().zip(y?).zip(z?);
            Some(pixels.map(|((x, y), z)| [x, y, z]).collect::<Vec<_>>())
        };
        let mut taken = |name: &str| channels.remove(name);
        let missing = || "it lacks the sums or the counts of its samples".to_owned();
        let sums = FilmSums {
            sums: triples(["R", "G", "B"].map(&mut taken)).ok_or_else(missing)?,
            counts: whole(taken(SAMPLES)).ok_or_else(missing)?,
        };
        let mut further = |aov: Aov| {
            let mut values = aov.channels().iter().map(|name| taken(name));
            match aov.is_whole() {
                true => whole(values.next()?).map(AovImage::Whole),
                false => values.map(floats).collect::<Option<_>>().map(AovImage::Floats),
            }
        };
        Ok(RenderOutput {
            width: layer.size.x() as u32,
            height: layer.size.y() as u32,
            sums: Some(sums),
            aovs: Aov::ALL.into_iter().filter_map(|aov| Some((aov, further(aov)?))).collect(),
            samples_done: self.metadata.samples,
            ..RenderOutput::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::encode_exr;

    #[test]
    fn a_part_reads_back_bit_for_bit() {
        let part = PartOf { picture: "f".repeat(64), shard: Shard::new(1, 3).expect("a share") };
        let metadata = Metadata {
            scene: "cornell".to_owned(),
            spp: 7,
            samples: 3,
            seed: u32::MAX,
            version: "1".to_owned(),
            key: Some("a".repeat(64)),
            part: Some(part.clone()),
            ..Metadata::default()
        };
        let sums = vec![[1.0e-40, 3.0, 5.5e30], [0.1, 0.2, 0.3]];
        let output = RenderOutput {
            width: 1,
            height: 2,
            sums: Some(FilmSums { sums, counts: vec![3, 2] }),
            aovs: [
                (Aov::Depth, AovImage::of([[1.5], [0.0]])),
                (Aov::Normal, AovImage::of([[0.0, 1.0, 0.0], [0.0; 3]])),
                (Aov::Primitive, AovImage::Whole(vec![7, u32::MAX])),
                (Aov::Uv, AovImage::of([[0.25, 0.75], [0.0; 2]])),
            ]
            .into(),
            ..RenderOutput::default()
        };
        let bytes = encode_exr(&output, &metadata).expect("a small image");
        let file = decode(bytes.clone()).expect("a part");
        assert_eq!((&file.metadata, &file.part), (&metadata, &part));
        let read = file.pixels().expect("whole");
        assert_eq!((read.width, read.height, read.samples_done), (1, 2, 3));
        assert_eq!((&read.sums, &read.aovs), (&output.sums, &output.aovs));

        let mut changed = bytes;
        *changed.last_mut().expect("bytes") ^= 1;
        assert!(decode(changed).err().is_some_and(|error| error.contains("damaged")));
        let whole = RenderOutput { beauty: vec![[0.0; 3]; 2], sums: None, ..output };
        let bytes = encode_exr(&whole, &Metadata { part: None, ..metadata }).expect("a small image");
        assert!(decode(bytes).err().is_some_and(|error| error.contains("no share")));
        assert!(decode(b"P6".to_vec()).err().is_some_and(|error| error.contains("not an EXR")));
    }
}
