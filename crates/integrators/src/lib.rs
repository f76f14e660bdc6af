//! rasray: integrators.
