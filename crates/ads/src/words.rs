//! Words of options.

/// Gives each value of an option its word, in options and reports: `ALL` and `WORDS`, every value in order,
/// and `name`.
///
/// ```
/// #[derive(Clone, Copy)]
/// pub enum March {
///     Exact,
///     Jump,
/// }
///
/// rasray_ads::words! { March { Exact "exact", Jump "jump" } }
///
/// assert_eq!(March::Jump.name(), "jump");
/// assert_eq!(March::WORDS.len(), 2);
/// ```
#[macro_export]
macro_rules! words {
    ($choice:ident { $($value:ident $word:literal),+ $(,)? }) => {
        impl $choice {
            /// Every value.
            pub const ALL: [Self; [$($word),+].len()] = [$(Self::$value),+];

            /// Every value, by its word in options and reports.
            pub const WORDS: &'static [(&'static str, Self)] = &[$(($word, Self::$value)),+];

            /// The word of options and reports.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$value => $word),+
                }
            }
        }
    };
}
