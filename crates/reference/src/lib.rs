//! rasray: reference.
