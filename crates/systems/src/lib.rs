//! rasray: systems.
