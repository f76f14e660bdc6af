//! Words of a table: stored, or only counted if only the size of the table is needed.

use rasray_shaders_glsl::constants::scene::ATTRIBUTE_NONE;

use crate::GpuSceneError;

/// Words that are appended part by part.
#[derive(Clone, Debug)]
pub struct Words {
    count: u64,
    stored: Option<Vec<f32>>,
}

impl Words {
    /// Makes an empty list whose words are stored.
    pub fn stored() -> Self {
        Self { count: 0, stored: Some(Vec::new()) }
    }

    /// Makes an empty list whose words are counted and not made.
    pub fn counted() -> Self {
        Self { count: 0, stored: None }
    }

    /// Appends `count` words, which `make` makes if words are stored, and returns the offset of the first.
    ///
    /// # Errors
    /// `TooManyVertices` where 32-bit word offsets do not reach.
    pub fn append<I: IntoIterator<Item = f32>>(
        &mut self,
        count: usize,
        make: impl FnOnce() -> I,
    ) -> Result<u32, GpuSceneError> {
        let (first, limit) = (self.count, u64::from(ATTRIBUTE_NONE));
        let end = first + count as u64;
        if end >= limit {
            return Err(GpuSceneError::TooManyVertices { count: end, limit });
        }
        if let Some(stored) = &mut self.stored {
            stored.extend(make());
            assert_eq!(stored.len() as u64, end, "as many words as were announced");
        }
        self.count = end;
        Ok(first as u32)
    }

    /// Returns the number of words, stored or not.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Returns the stored words.
    pub fn into_vec(self) -> Vec<f32> {
        self.stored.unwrap_or_default()
    }
}
