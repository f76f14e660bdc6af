//! Modules as packages hold them: a form of SPIR-V that compression, which knows bytes alone, makes a quarter smaller.
//!
//! Opcodes and lengths of instructions come first, then their operands, all as numbers of one to five bytes. Most
//! operands are ids of what came just before, and are kept as their distance to the highest id so far.

/// Words of a module before its instructions.
const HEADER: usize = 5;
/// An id that is at most so much higher than the highest one before is the highest from then on.
const AHEAD: u32 = 16;
/// Distances that are kept: to this much below.
const NEAR: u32 = 64;

/// A module in few bytes; none where it is no SPIR-V.
pub(crate) fn pack(words: &[u32]) -> Option<Vec<u8>> {
    let (header, mut rest) = words.split_at_checked(HEADER)?;
    let (mut heads, mut operands, mut ids) = (Vec::new(), Vec::new(), Ids::default());
    while let Some(first) = rest.first() {
        let (instruction, after) = rest.split_at_checked((first >> 16) as usize)?;
        put(&mut heads, u64::from(first & 0xffff));
        put(&mut heads, u64::from(first >> 16));
        for &word in instruction.get(1..)? {
            let distance = ids.highest.wrapping_add(AHEAD).wrapping_sub(word);
            let is_near = distance < NEAR;
            let kept = if is_near { distance } else { word };
            put(&mut operands, u64::from(kept) << 1 | u64::from(is_near));
            ids.see(word);
        }
        rest = after;
    }
    let mut packed = Vec::new();
    for &word in header {
        put(&mut packed, word.into());
    }
    put(&mut packed, heads.len() as u64);
    packed.extend(heads);
    packed.extend(operands);
    Some(packed)
}

/// The words that were packed; none where the bytes are no such thing.
pub(crate) fn unpack(mut packed: &[u8]) -> Option<Vec<u32>> {
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
            let word = if is_near { ids.highest.wrapping_add(AHEAD).wrapping_sub(number) } else { number };
            ids.see(word);
            words.push(word);
        }
    }
    operands.is_empty().then_some(words)
}

/// The highest id so far.
#[derive(Default)]
struct Ids {
    highest: u32,
}

impl Ids {
    fn see(&mut self, word: u32) {
        if word > self.highest && word - self.highest <= AHEAD {
            self.highest = word;
        }
    }
}

/// Seven bits a byte, the lowest first; the highest bit says that more follow.
fn put(bytes: &mut Vec<u8>, mut number: u64) {
    while number > 0x7f {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
}

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
