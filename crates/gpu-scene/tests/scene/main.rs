//! Tests of scenes on the device.

mod tables;
mod texels;
mod upload;
