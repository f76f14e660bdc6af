//! What the tests of rasray share: a device, triangles, random numbers, hard cases.

pub mod conformance;
pub mod hard_cases;
pub mod harness;
pub mod random;
pub mod shapes;
pub mod visits;
