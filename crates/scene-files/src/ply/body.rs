//! Numbers of the body, one after the other, in any encoding.

use std::path::Path;

use super::header::{Encoding, Header, Scalar};
use rasray_scene::SceneError;

/// Reads the body from front to back.
pub(super) struct Body<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
    /// Current line, from 1; only counted for ASCII.
    line: usize,
}

impl<'a> Body<'a> {
    pub fn new(path: &'a Path, bytes: &'a [u8], header: &Header) -> Self {
        Self { path, bytes, at: header.body, encoding: header.encoding, line: header.lines + 1 }
    }

    /// Returns the number of bytes that are not read yet.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Reads the next number. Every type fits into f64 exactly.
    pub fn number(&mut self, scalar: Scalar) -> Result<f64, SceneError> {
        match self.encoding {
            Encoding::Ascii => self.word(scalar),
            Encoding::LittleEndian => self.binary(scalar, false),
            Encoding::BigEndian => self.binary(scalar, true),
        }
    }

    /// Reads the length of a list. It is at most the number of bytes left, since every entry takes one.
    pub fn length(&mut self, scalar: Scalar) -> Result<usize, SceneError> {
        let length = self.number(scalar)?;
        if length < 0.0 || length.fract() != 0.0 {
            return Err(self.error(&format!("a list cannot have {length} entries")));
        }
        if length > self.left() as f64 {
            return Err(
                self.error(&format!("a list has {length} entries, more than the rest of the file can hold"))
            );
        }
        Ok(length as usize)
    }

    /// Skips numbers.
    pub fn skip(&mut self, scalar: Scalar, count: usize) -> Result<(), SceneError> {
        if self.encoding == Encoding::Ascii {
            return (0..count).try_for_each(|_| self.word(scalar).map(|_| ()));
        }
        let size = count.checked_mul(scalar.size()).filter(|size| *size <= self.left());
        self.at += size.ok_or_else(|| self.too_short())?;
        Ok(())
    }

    fn word(&mut self, scalar: Scalar) -> Result<f64, SceneError> {
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            self.line += usize::from(*byte == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if end == 0 {
            return Err(self.too_short());
        }
        self.at += end;
        let number = std::str::from_utf8(&rest[..end]).ok().and_then(|text| text.parse::<f64>().ok());
        match number {
            Some(number) if scalar.is_float() || number.fract() == 0.0 => Ok(number),
            _ => {
                let shown: String = String::from_utf8_lossy(&rest[..end]).chars().take(40).collect();
                let kind = if scalar.is_float() { "a number" } else { "a whole number" };
                Err(self.error(&format!("`{shown}` is not {kind}")))
            }
        }
    }

    fn binary(&mut self, scalar: Scalar, big: bool) -> Result<f64, SceneError> {
        let size = scalar.size();
        let Some(bytes) = self.bytes.get(self.at..self.at + size) else { return Err(self.too_short()) };
        self.at += size;
        // Bytes in little-endian order, whatever the file has.
        let mut little = [0; 8];
        for (place, byte) in bytes.iter().enumerate() {
            little[if big { size - 1 - place } else { place }] = *byte;
        }
        let bits = u64::from_le_bytes(little);
        Ok(match scalar {
            Scalar::I8 => f64::from(bits as u8 as i8),
            Scalar::U8 => f64::from(bits as u8),
            Scalar::I16 => f64::from(bits as u16 as i16),
            Scalar::U16 => f64::from(bits as u16),
            Scalar::I32 => f64::from(bits as u32 as i32),
            Scalar::U32 => f64::from(bits as u32),
            Scalar::F32 => f64::from(f32::from_bits(bits as u32)),
            Scalar::F64 => f64::from_bits(bits),
        })
    }

    fn too_short(&self) -> SceneError {
        self.error("the file ends before all elements that its header promises")
    }

    pub fn error(&self, reason: &str) -> SceneError {
        let place = match self.encoding {
            Encoding::Ascii => format!("line {}", self.line),
            _ => format!("byte {}", self.at),
        };
        SceneError::syntax(self.path, format!("{place}: {reason}"))
    }
}
