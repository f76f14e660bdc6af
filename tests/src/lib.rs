//! rasray: tests.
