//! Names of pools, as an enum of each structure.

use std::fmt;

/// The pools of one structure, in the order of their bindings; the header is the first. [`pool_names!`](crate::pool_names)
/// makes one.
pub trait PoolName: Copy + fmt::Debug + PartialEq + 'static {
    /// Every pool.
    const ALL: &'static [Self];

    /// Its name in sizes, statuses and reports.
    fn name(self) -> &'static str;
}

/// Makes an enum of pools, each with its name in sizes, statuses and reports.
#[macro_export]
macro_rules! pool_names {
    ($(#[$about:meta])* pub enum $pool:ident { $($(#[$what:meta])* $variant:ident = $name:literal,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $pool {
            $($(#[$what])* $variant,)+
        }

        impl $crate::PoolName for $pool {
            const ALL: &'static [Self] = &[$(Self::$variant),+];

            fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }
        }
    };
}
