//! Records that Rust and shaders share, as data.

/// A record that a structure shares with its shaders: name, and the layout of its members in Rust. A test compares it
/// with every compiled module that has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordLayout {
    /// Name in GLSL.
    pub name: &'static str,
    /// Bytes.
    pub size: usize,
    /// Members in order: name, offset in bytes, bytes.
    pub members: &'static [(&'static str, usize, usize)],
}

/// Size in bytes of the member that a function returns.
#[doc(hidden)]
pub const fn size_of_member<T, M>(_: fn(&T) -> &M) -> usize {
    size_of::<M>()
}

/// The [`RecordLayout`] of a struct under its name in GLSL, with all its members in order:
/// `record_layout!(Header as "GridHeader" { status, demand })`.
#[macro_export]
macro_rules! record_layout {
    ($record:ty as $name:literal { $($member:ident),* $(,)? }) => {
        $crate::RecordLayout {
            name: $name,
            size: size_of::<$record>(),
            members: &[$((
                stringify!($member),
                std::mem::offset_of!($record, $member),
                $crate::size_of_member(|record: &$record| &record.$member),
            )),*],
        }
    };
}
