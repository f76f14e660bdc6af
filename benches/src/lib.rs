//! rasray: benches.
