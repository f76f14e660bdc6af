//! The pools of a structure: one row for each says all that does not depend on options.

use std::fmt;

use bytemuck::Pod;
use rasray_gpu::{Device, GpuError};

use crate::kit::Parts;

/// The header's name among the pools.
pub const HEADER_POOL: &str = "header";

/// The pools of one structure, in the order of their bindings; the header is the first.
/// [`pools!`](crate::pools) makes one.
pub trait PoolName: Copy + fmt::Debug + PartialEq + 'static {
    /// Header that shaders start from: the only element of the first pool.
    type Header: Pod;

    /// Every pool.
    const ALL: &'static [Self];

    /// Its name in sizes, statuses and reports.
    fn name(self) -> &'static str;

    /// Place of its device address in the header, low word first; absent for the header itself.
    fn address_in(self, header: &mut Self::Header) -> Option<&mut [u32; 2]>;
}

/// Pools with their bytes.
pub type PoolBytes<'a, P> = Vec<(P, &'a [u8])>;

/// The pools of a structure on the host, for checks. `C` is its configuration, `P` its pools.
pub trait PoolContents<C, P: PoolName>: Sized {
    /// Pools as downloaded.
    ///
    /// # Errors
    /// The device failed.
    fn download(parts: &Parts<C>, device: &Device, header: P::Header) -> Result<Self, GpuError>;

    /// Header and other pools to write back, with their bytes.
    fn pools(&self) -> (P::Header, PoolBytes<'_, P>);
}

/// Makes the enum of a structure's pools. After the header, which is there by itself, each has a row in the
/// order of bindings: the variant, its name in sizes, statuses and reports, and the header's field of its
/// device address.
///
/// A last line names the configuration and the struct with the words to be checked on the host, and its field
/// for the configuration where it has one; then a row ends with `=> field` where the struct has the words of
/// its pool:
///
/// ```ignore
/// rasray_ads::pools! {
///     /// Pools of lists, in the order of their bindings.
///     pub enum Pool: Header {
///         /// Where the list of each cell ends.
///         Lists "lists" lists_address => lists,
///         /// Sums of the scan.
///         Sums "sums" sums_address,
///     }
///     Config => Contents { header, config }
/// }
/// ```
///
/// It names the crate `rasray_gpu`.
#[macro_export]
macro_rules! pools {
    ($(#[$about:meta])* pub enum $pool:ident: $header:ty {
        $($(#[$what:meta])* $variant:ident $name:literal $address:ident,)+
    }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $pool {
            /// Header that shaders start from.
            Header,
            $($(#[$what])* $variant,)+
        }

        impl $crate::kit::PoolName for $pool {
            type Header = $header;

            const ALL: &'static [Self] = &[Self::Header, $(Self::$variant),+];

            fn name(self) -> &'static str {
                match self {
                    Self::Header => $crate::kit::HEADER_POOL,
                    $(Self::$variant => $name,)+
                }
            }

            fn address_in(self, header: &mut $header) -> Option<&mut [u32; 2]> {
                match self {
                    Self::Header => None,
                    $(Self::$variant => Some(&mut header.$address),)+
                }
            }
        }
    };
    ($(#[$about:meta])* pub enum $pool:ident: $header:ty {
        $($(#[$what:meta])* $variant:ident $name:literal $address:ident $(=> $field:ident)?,)+
    } $config:ty => $contents:ident { header $(, $of_config:ident)? }) => {
        $crate::pools! {
            $(#[$about])*
            pub enum $pool: $header {
                $($(#[$what])* $variant $name $address,)+
            }
        }

        impl $crate::kit::PoolContents<$config, $pool> for $contents {
            fn download(
                parts: &$crate::kit::Parts<$config>,
                device: &rasray_gpu::Device,
                header: $header,
            ) -> Result<Self, rasray_gpu::GpuError> {
                Ok(Self {
                    $($of_config: parts.config,)?
                    header,
                    $($($field: parts.pools.download_words(device, $pool::$variant)?,)?)+
                })
            }

            fn pools(&self) -> ($header, $crate::kit::PoolBytes<'_, $pool>) {
                let pools = vec![$($(($pool::$variant, $crate::kit::bytes_of_words(&self.$field)),)?)+];
                (self.header, pools)
            }
        }
    };
}

/// Words as the bytes that are uploaded, for [`pools!`].
#[doc(hidden)]
pub fn bytes_of_words(words: &[u32]) -> &[u8] {
    bytemuck::cast_slice(words)
}
