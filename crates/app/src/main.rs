//! The `rasray` command.
fn main() {}
