/// Largest number of rays or hits that a file may hold.
pub const LIMIT: usize = 100_000_000;
