//! rasray: abuffer.
