//! rasray: metrics.
