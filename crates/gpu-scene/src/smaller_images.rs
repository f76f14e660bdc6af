//! Textures that exceed a device: the largest images lose their finest levels.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use rasray_scene::Scene;

use crate::{
    GpuSceneError, Parts,
    materials::collect_materials,
    mips::{self, Encoding},
    texel_runs::TEXEL_BYTES,
};

/// Number of texels that the textures of a scene need, computed without making them.
#[derive(Clone, Debug)]
pub struct TexelDemand {
    images: Vec<StoredImage>,
}

/// Image as it is stored: once for each encoding.
#[derive(Clone, Debug)]
struct StoredImage {
    image: usize,
    name: String,
    size: [u32; 2],
    /// Encodings in which the image is stored, each with true if all levels are stored and false for the
    /// first alone.
    stored: Vec<(Encoding, bool)>,
}

impl StoredImage {
    fn texels(&self, [width, height]: [u32; 2]) -> u64 {
        self.stored.iter().map(|&(_, mipmapped)| mips::texel_count(width, height, mipmapped)).sum()
    }

    /// Returns the encoding in which means of texels are computed.
    fn encoding(&self) -> Encoding {
        let color = self.stored.iter().any(|&(encoding, _)| encoding == Encoding::Srgb);
        if color { Encoding::Srgb } else { Encoding::Linear }
    }
}

/// Image that is made smaller.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SmallerImage {
    /// Index into the scene's images.
    pub image: usize,
    /// Name or file of the image.
    pub name: String,
    /// Width and height in the scene.
    pub from: [u32; 2],
    /// Width and height afterwards, which are those of one of its smaller levels.
    pub to: [u32; 2],
    /// Number of that level.
    level: u32,
    encoding: Encoding,
}

impl TexelDemand {
    /// Computes the demand of the given parts of `scene`.
    ///
    /// # Errors
    /// `Malformed` where a texture or an image does not exist, or an image has too few bytes.
    pub fn of(scene: &Scene, parts: &Parts) -> Result<Self, GpuSceneError> {
        let (_, packer) = collect_materials(scene, parts)?;
        let mut images: BTreeMap<usize, StoredImage> = BTreeMap::new();
        for ((image, encoding), mipmapped) in packer.stored() {
            let found = &scene.images[image];
            let (name, size) = (&found.name, [found.width, found.height]);
            let stored = || StoredImage { image, name: name.clone(), size, stored: Vec::new() };
            images.entry(image).or_insert_with(stored).stored.push((encoding, mipmapped));
        }
        Ok(Self { images: images.into_values().collect() })
    }

    /// Returns the number of texels of all levels.
    pub fn texels(&self) -> u64 {
        self.images.iter().map(|image| image.texels(image.size)).sum()
    }

    /// Returns the bytes of all levels.
    pub fn bytes(&self) -> u64 {
        self.texels() * TEXEL_BYTES
    }

    /// Chooses the images that are made smaller so that `most` texels are enough: the largest, or the first
    /// of equal ones, is halved repeatedly. The list is empty if `most` is enough already.
    ///
    /// # Errors
    /// `TooManyTexels` where images of one texel each are still too many.
    pub fn smaller_images(&self, most: u64) -> Result<Vec<SmallerImage>, GpuSceneError> {
        let area = |[width, height]: [u32; 2]| u64::from(width) * u64::from(height);
        let mut left = self.texels();
        let mut levels = vec![0; self.images.len()];
        let heap_entry = |index: usize, size| (area(size), Reverse(index));
        let mut largest: BinaryHeap<_> =
            self.images.iter().enumerate().map(|(index, image)| heap_entry(index, image.size)).collect();
        while left > most {
            let Some((_, Reverse(index))) = largest.pop().filter(|(area, _)| *area > 1) else {
                return Err(GpuSceneError::TooManyTexels { count: self.texels(), limit: most });
            };
            let image = &self.images[index];
            let size = size_of_level(image.size, levels[index]);
            levels[index] += 1;
            let smaller = size_of_level(image.size, levels[index]);
            left -= image.texels(size) - image.texels(smaller);
            largest.push(heap_entry(index, smaller));
        }
        let reduced = self.images.iter().zip(levels).filter(|(_, level)| *level > 0);
        Ok(reduced
            .map(|(image, level)| SmallerImage {
                image: image.image,
                name: image.name.clone(),
                from: image.size,
                to: size_of_level(image.size, level),
                level,
                encoding: image.encoding(),
            })
            .collect())
    }
}

impl SmallerImage {
    /// Replaces the image by its smaller level: an image that has one use is then stored as before, without
    /// its finest levels. Code that reads the scene from then on gets the texels that the device has.
    ///
    /// # Panics
    /// If `scene` is not the one that the demand was computed for.
    pub fn apply(&self, scene: &mut Scene) {
        let image = &mut scene.images[self.image];
        assert_eq!([image.width, image.height], self.from, "image {}", self.name);
        let smaller = mips::level(image.width, image.height, &image.rgba8, self.encoding, self.level);
        (image.width, image.height) = (smaller.width, smaller.height);
        image.rgba8 = smaller.texels.into_iter().flat_map(u32::to_le_bytes).collect();
    }
}

fn size_of_level(size: [u32; 2], level: u32) -> [u32; 2] {
    size.map(|length| (length >> level).max(1))
}
