//! The `.rays` format: a header of 48 bytes, then records of 48 bytes, all little-endian.

use super::LIMIT;
use super::error::FormatError;
use super::rays::{Place, RaysFile, check};
use rasray_ads::{RAY_CULL_BACK_FACES, Ray};

const MAGIC: &[u8; 8] = b"RASRAYS\0";
const VERSION: u32 = 1;
const HEADER: usize = 48;
const RECORD: usize = size_of::<Ray>();

/// Reads a `.rays` file.
///
/// # Errors
/// An error for another format or version, a length other than the header's, or a ray that cannot be traced.
pub fn read_rays(bytes: &[u8]) -> Result<RaysFile, FormatError> {
    if !bytes.starts_with(MAGIC) {
        return Err(FormatError::Magic { format: ".rays" });
    }
    let Some((header, records)) = bytes.split_at_checked(HEADER) else {
        return Err(FormatError::Length { bytes: bytes.len() as u64, promised: HEADER as u64 });
    };
    let version = u32::from_le_bytes(part(header, 8));
    if version != VERSION {
        return Err(FormatError::Version { version: version.to_string(), known: "1" });
    }
    let record = u32::from_le_bytes(part(header, 12));
    if record as usize != RECORD {
        return Err(FormatError::Header {
            what: format!("records of {record} bytes; version 1 has {RECORD}"),
        });
    }
    let count = u64::from_le_bytes(part(header, 16));
    if count > LIMIT as u64 {
        return Err(FormatError::TooMany { entries: count });
    }
    let promised = HEADER as u64 + count * RECORD as u64;
    if promised != bytes.len() as u64 {
        return Err(FormatError::Length { bytes: bytes.len() as u64, promised });
    }
    let point: [f64; 3] = std::array::from_fn(|axis| f64::from_le_bytes(part(header, 24 + 8 * axis)));
    if !point.iter().all(|x| x.is_finite()) {
        return Err(FormatError::Header { what: "the frame origin is not finite".to_owned() });
    }
    let mut rays = Vec::with_capacity(count as usize);
    for (index, record) in records.chunks_exact(RECORD).enumerate() {
        let word = |place: usize| u32::from_le_bytes(part(record, 4 * place));
        let number = |place: usize| f32::from_bits(word(place));
        let ray = Ray {
            origin: [number(0), number(1), number(2)],
            t_min: number(3),
            direction: [number(4), number(5), number(6)],
            t_max: number(7),
            exclude_primitive: word(8),
            flags: word(9),
            cone_width: number(10),
            cone_spread: number(11),
        };
        check(index, &ray)?;
        if ray.flags & !RAY_CULL_BACK_FACES != 0 {
            return Err(FormatError::Entry {
                index,
                what: "its flags have bits that version 1 does not know",
            });
        }
        if ray.cone_width.is_nan() || ray.cone_spread.is_nan() {
            return Err(FormatError::Entry { index, what: "its cone is NaN" });
        }
        rays.push(ray);
    }
    Ok(RaysFile { rays, place: Place::Point(point) })
}

/// Returns the bytes of a `.rays` file; origins are relative to `frame_origin` (world, metres).
pub fn write_rays(rays: &[Ray], frame_origin: [f64; 3]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + rays.len() * RECORD);
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend((RECORD as u32).to_le_bytes());
    bytes.extend((rays.len() as u64).to_le_bytes());
    bytes.extend(frame_origin.into_iter().flat_map(f64::to_le_bytes));
    for ray in rays {
        let floats = |values: &[f32]| values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
        bytes.extend(floats(&ray.origin));
        bytes.extend(ray.t_min.to_le_bytes());
        bytes.extend(floats(&ray.direction));
        bytes.extend(ray.t_max.to_le_bytes());
        bytes.extend(ray.exclude_primitive.to_le_bytes());
        bytes.extend(ray.flags.to_le_bytes());
        bytes.extend(floats(&[ray.cone_width, ray.cone_spread]));
    }
    bytes
}

/// Returns bytes of a slice, which was checked to be long enough.
fn part<const N: usize>(bytes: &[u8], start: usize) -> [u8; N] {
    let mut part = [0; N];
    part.copy_from_slice(&bytes[start..start + N]);
    part
}
