//! Packed form of modules in programs and packages: a form of SPIR-V that byte-wise compression makes a
//! quarter smaller, then compressed.
//!
//! Opcodes and lengths of instructions come first, then their operands, all as numbers of one to five bytes.
//! Most operands are ids of recent results, and are kept as their distance to the highest id so far.

/// Number of words of a module before its instructions.
pub(crate) const HEADER: usize = 5;
/// Largest step by which an id may exceed the highest id before and become the highest.
const AHEAD: u32 = 16;

/// Unpacks the words; `None` if the bytes are not a packed module.
pub(crate) fn unpack(packed: &[u8]) -> Option<Vec<u32>> {
    let packed = miniz_oxide::inflate::decompress_to_vec(packed).ok()?;
    let mut packed = &packed[..];
    let mut words = Vec::new();
    for _ in 0..HEADER {
        words.push(u32::try_from(take(&mut packed)?).ok()?);
    }
    let length = usize::try_from(take(&mut packed)?).ok()?;
    let (mut heads, mut operands) = packed.split_at_checked(length)?;
    let mut ids = Ids::default();
    while !heads.is_empty() {
        let (operation, length) = (take(&mut heads)?, take(&mut heads)?);
        words.push(u32::try_from(length << 16 | operation).ok()?);
        for _ in 1..length {
            let kept = take(&mut operands)?;
            let number = u32::try_from(kept >> 1).ok()?;
            let is_near = kept & 1 != 0;
            let word = if is_near { ids.apart(number) } else { number };
            ids.see(word);
            words.push(word);
        }
    }
    operands.is_empty().then_some(words)
}

/// Highest id so far.
#[derive(Default)]
pub(crate) struct Ids {
    highest: u32,
}

impl Ids {
    /// Returns the distance of an id from a little above the highest, and likewise the id at such a distance.
    pub(crate) fn apart(&self, id: u32) -> u32 {
        self.highest.wrapping_add(AHEAD).wrapping_sub(id)
    }

    pub(crate) fn see(&mut self, word: u32) {
        if word > self.highest && word - self.highest <= AHEAD {
            self.highest = word;
        }
    }
}

/// Reads a number of seven bits per byte, the lowest first; the highest bit tells that more bytes follow.
fn take(bytes: &mut &[u8]) -> Option<u64> {
    let mut number = 0;
    for shift in (0..35).step_by(7) {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        number |= u64::from(byte & 0x7f) << shift;
        if byte < 0x80 {
            return Some(number);
        }
    }
    None
}
