//! rasray: tracer.
