//! Channels of an EXR that are read in place: encoding copies a block of rows at a time, not the image.

use exr::block::{BlockIndex, UncompressedBlock, lines::LineRefMut};
use exr::image::write::channels::{ChannelsWriter, WritableChannels};
use exr::math::{RoundingMode, Vec2};
use exr::meta::attribute::{ChannelDescription, ChannelList, LevelMode, SampleType};
use exr::meta::header::Header;

/// Values of a channel, one number per pixel, rows from the top.
#[derive(Clone, Copy, Debug)]
pub(super) enum Values<'a> {
    Floats(&'a [f32]),
    /// One component of vectors of three.
    Axis(&'a [[f32; 3]], usize),
    Whole(&'a [u32]),
}

impl Values<'_> {
    fn sample_type(self) -> SampleType {
        match self {
            Self::Floats(_) | Self::Axis(..) => SampleType::F32,
            Self::Whole(_) => SampleType::U32,
        }
    }

    /// Writes the values from pixel `first` on, as many as there are bytes for.
    fn write(self, first: usize, bytes: &mut [u8]) {
        let words = bytes.chunks_exact_mut(size_of::<u32>());
        match self {
            Self::Floats(values) => {
                let values = values.iter().skip(first);
                words.zip(values).for_each(|(word, value)| word.copy_from_slice(&value.to_ne_bytes()));
            }
            Self::Axis(values, axis) => {
                let values = values.iter().skip(first).map(|value| value[axis]);
                words.zip(values).for_each(|(word, value)| word.copy_from_slice(&value.to_ne_bytes()));
            }
            Self::Whole(values) => {
                let values = values.iter().skip(first);
                words.zip(values).for_each(|(word, value)| word.copy_from_slice(&value.to_ne_bytes()));
            }
        }
    }
}

/// Channels: names with their values, in the order of names.
#[derive(Clone, Debug)]
pub(super) struct Channels<'a>(pub Vec<(&'static str, Values<'a>)>);

impl<'a> Channels<'a> {
    pub fn add(&mut self, name: &'static str, values: Values<'a>) {
        self.0.push((name, values));
    }

    pub fn add_axes(&mut self, names: [&'static str; 3], values: &'a [[f32; 3]]) {
        self.0.extend((0..).zip(names).map(|(axis, name)| (name, Values::Axis(values, axis))));
    }
}

impl<'a, 'values: 'a> WritableChannels<'a> for Channels<'values> {
    type Writer = &'a Self;

    fn infer_channel_list(&self) -> ChannelList {
        let described = |(name, values): &(&'static str, Values<'_>)| {
            ChannelDescription::named(*name, values.sample_type())
        };
        ChannelList::new(self.0.iter().map(described).collect())
    }

    fn infer_level_modes(&self) -> (LevelMode, RoundingMode) {
        (LevelMode::Singular, RoundingMode::Down)
    }

    fn create_writer(&'a self, _: &Header) -> Self::Writer {
        self
    }
}

impl ChannelsWriter for &Channels<'_> {
    fn extract_uncompressed_block(&self, header: &Header, block: BlockIndex) -> Vec<u8> {
        UncompressedBlock::collect_block_data_from_lines(&header.channels, block, |line: LineRefMut<'_>| {
            let Vec2(column, row) = line.location.position;
            if let Some((_, values)) = self.0.get(line.location.channel) {
                values.write(row * header.layer_size.width() + column, line.value);
            }
        })
    }
}
