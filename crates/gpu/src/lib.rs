//! rasray: gpu.
