//! Packer of modules, in the format that `src/packed.rs` describes and unpacks.

use crate::packed::{HEADER, Ids};

/// Largest distance at which an id is kept as a distance.
const NEAR: u32 = 64;
/// Effort of compression, 1 to 10: a greater one takes longer and gains less than one percent.
const EFFORT: u8 = 6;

/// Packs a module; `None` if it is not SPIR-V.
pub(crate) fn pack(words: &[u32]) -> Option<Vec<u8>> {
    let (header, mut rest) = words.split_at_checked(HEADER)?;
    let (mut heads, mut operands, mut ids) = (Vec::new(), Vec::new(), Ids::default());
    while let Some(first) = rest.first() {
        let (instruction, after) = rest.split_at_checked((first >> 16) as usize)?;
        put(&mut heads, u64::from(first & 0xffff));
        put(&mut heads, u64::from(first >> 16));
        for &word in instruction.get(1..)? {
            let distance = Some(ids.apart(word)).filter(|&distance| distance < NEAR);
            put(&mut operands, u64::from(distance.unwrap_or(word)) << 1 | u64::from(distance.is_some()));
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
    Some(miniz_oxide::deflate::compress_to_vec(&packed, EFFORT))
}

/// Writes a number with seven bits per byte, the lowest first; the highest bit tells that more bytes follow.
fn put(bytes: &mut Vec<u8>, mut number: u64) {
    while number > 0x7f {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
}
