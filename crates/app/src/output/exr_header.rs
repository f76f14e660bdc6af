//! Header of an EXR file of one part, byte by byte: values that the encoder leaves open are fixed, and a
//! checksum detects damage, since the format itself has none.

use sha2::{Digest, Sha256};
use std::ops::Range;

/// Name of the attribute that holds the SHA-256 of all other bytes of the file, in hexadecimal.
pub(super) const CHECKSUM: &str = "rasrayChecksum";

/// Placeholder of the checksum, of the same length.
pub(super) const NO_CHECKSUM: &str = "0000000000000000000000000000000000000000000000000000000000000000";

/// Start of a header in bytes, after magic number and version.
const FIRST: usize = 8;

const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

struct Attribute<'a> {
    name: &'a [u8],
    value: Range<usize>,
}

/// Returns all attributes, in their order, and the end of the header. `None` if the header is cut short.
fn attributes(bytes: &[u8]) -> Option<(Vec<Attribute<'_>>, usize)> {
    // An attribute is a name and a type, both ended by 0, a size and a value; an empty name ends the header.
    let mut found = Vec::new();
    let mut at = FIRST;
    while *bytes.get(at)? != 0 {
        let end_of_text =
            |from: usize| Some(from + bytes.get(from..)?.iter().position(|byte| *byte == 0)? + 1);
        let end_of_name = end_of_text(at)?;
        let size_at = end_of_text(end_of_name)?;
        let size = i32::from_le_bytes(bytes.get(size_at..size_at + 4)?.try_into().ok()?);
        let value = size_at + 4..(size_at + 4).checked_add(usize::try_from(size).ok()?)?;
        bytes.get(value.clone())?;
        let name = &bytes[at..end_of_name - 1];
        at = value.end;
        found.push(Attribute { name, value });
    }
    Some((found, at))
}

fn value_of(bytes: &[u8], name: &str) -> Option<Range<usize>> {
    let (found, _) = attributes(bytes)?;
    found.into_iter().find(|attribute| attribute.name == name.as_bytes()).map(|attribute| attribute.value)
}

/// Returns the text of an attribute; `None` if the file has no such attribute, or no whole header.
pub(super) fn text<'a>(bytes: &'a [u8], name: &str) -> Option<&'a str> {
    std::str::from_utf8(&bytes[value_of(bytes, name)?]).ok()
}

/// True if a file begins like an EXR, with a whole header.
pub(super) fn is_readable(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC) && attributes(bytes).is_some()
}

/// True if the checksum is that of the other bytes.
pub(super) fn is_whole(bytes: &[u8]) -> bool {
    value_of(bytes, CHECKSUM).is_some_and(|place| bytes[place.clone()] == *checksum(bytes, &place).as_bytes())
}

fn checksum(bytes: &[u8], place: &Range<usize>) -> String {
    let mut hash = Sha256::new();
    hash.update(&bytes[..place.start]);
    hash.update(&bytes[place.end..]);
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Orders the attributes by their names, since the encoder keeps them in a map that has no order, and equal
/// images must be equal files; then fills in the checksum. `None` if the header is cut short or has no space
/// for a checksum.
pub(super) fn finish(bytes: &mut [u8]) -> Option<()> {
    let (found, end) = attributes(bytes)?;
    let mut begin = FIRST;
    let mut whole = Vec::new();
    for attribute in found {
        whole.push(bytes[begin..attribute.value.end].to_vec());
        begin = attribute.value.end;
    }
    // Names are unique, and an attribute begins with its name.
    whole.sort();
    bytes[FIRST..end].copy_from_slice(&whole.concat());
    let place = value_of(bytes, CHECKSUM).filter(|place| place.len() == NO_CHECKSUM.len())?;
    let sum = checksum(bytes, &place);
    bytes[place].copy_from_slice(sum.as_bytes());
    Some(())
}

/// Returns the number of an attribute of four bytes; `None` if the file has no such attribute.
pub(super) fn number(bytes: &[u8], name: &str) -> Option<i32> {
    Some(i32::from_le_bytes(bytes[value_of(bytes, name)?].try_into().ok()?))
}
