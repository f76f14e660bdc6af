//! Hash that keys are made of.

use sha2::{Digest, Sha256};

/// SHA-256 over named values. Lengths are hashed as well, so that different lists of values have different
/// input.
#[derive(Clone, Debug, Default)]
pub struct KeyHash(Sha256);

impl KeyHash {
    /// Returns this hash with one more value.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl AsRef<[u8]>) -> Self {
        for bytes in [name.as_bytes(), value.as_ref()] {
            self.0.update((bytes.len() as u64).to_le_bytes());
            self.0.update(bytes);
        }
        self
    }

    /// Returns the hash as 64 hexadecimal digits.
    pub fn finish(self) -> String {
        self.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn lists_of_values_do_not_run_into_each_other() {
        let key = |values: &[(&str, &str)]| {
            let hash = values.iter().fold(KeyHash::default(), |hash, (name, value)| hash.with(name, value));
            hash.finish()
        };
        let keys =
            [&[("a", "bc")][..], &[("ab", "c")], &[("a", "b"), ("c", "")], &[("a", ""), ("b", "c")], &[]];
        assert_eq!(keys.iter().map(|values| key(values)).collect::<BTreeSet<_>>().len(), keys.len());
        assert_eq!(key(keys[0]), key(keys[0]));
    }
}
