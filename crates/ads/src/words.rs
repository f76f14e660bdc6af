//! Names of the values of options.

/// Gives each value of an option a word for options and reports. It declares `ALL` and `WORDS`, every value
/// in order, and `name`.
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
            /// All values, in order.
            pub const ALL: [Self; [$($word),+].len()] = [$(Self::$value),+];

            /// All values, each with its word in options and reports.
            pub const WORDS: &'static [(&'static str, Self)] = &[$(($word, Self::$value)),+];

            /// Returns the word of the value in options and reports.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$value => $word),+
                }
            }
        }
    };
}
