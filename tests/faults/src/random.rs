//! Numbers that look random and are the same in every run.

/// A generator of numbers whose sequence is fixed (Marsaglia's xorshift).
pub fn scrambled(mut state: u32) -> impl FnMut() -> u32 {
    move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state
    }
}
