//! rasray: reference.

pub mod oracle;
