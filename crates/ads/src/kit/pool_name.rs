//! Pools of a structure, with their properties that do not depend on options.

use std::fmt;

use bytemuck::Pod;
use rasray_gpu::{Device, GpuError};

use crate::kit::Parts;

/// Name of the header among the pools.
pub const HEADER_POOL: &str = "header";

/// Enumeration of the pools of one structure, in the order of their bindings; the header is the first. The
/// macro [`pools!`](crate::pools) makes one.
pub trait PoolName: Copy + fmt::Debug + PartialEq + 'static {
    /// Header that shaders start from: the single element of the first pool.
    type Header: Pod;

    /// All pools.
    const ALL: &'static [Self];

    /// Returns the name of the pool in sizes, statuses and reports.
    fn name(self) -> &'static str;

    /// Returns the field of the header for the device address of the pool, low word first; absent for the
    /// header itself.
    fn address_in(self, header: &mut Self::Header) -> Option<&mut [u32; 2]>;
}

/// Pools, each with its bytes.
pub type PoolBytes<'a, P> = Vec<(P, &'a [u8])>;

/// Copy of the pools of a structure on the host, for checks. `C` is the structure's configuration, `P` its
/// pools.
pub trait PoolContents<C, P: PoolName>: Sized {
    /// Downloads the pools.
    ///
    /// # Errors
    /// The device failed.
    fn download(parts: &Parts<C>, device: &Device, header: P::Header) -> Result<Self, GpuError>;

    /// Returns the header and the other pools to write back, with their bytes.
    fn pools(&self) -> (P::Header, PoolBytes<'_, P>);
}

/// Makes the enum of a structure's pools. The header is included automatically. Each other pool has a row, in
/// the order of bindings: the variant, its name in sizes, statuses and reports, and the field of the header
/// for its device address.
///
/// A last line names the configuration and the struct with the words to be checked on the host, and that
/// struct's field for the configuration, if it has one; then a row ends with `=> field` if the struct has the
/// words of its pool:
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
/// The expansion names the crate `rasray_gpu`.
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

/// Returns words as the bytes that are uploaded, for [`pools!`].
#[doc(hidden)]
pub fn bytes_of_words(words: &[u32]) -> &[u8] {
    bytemuck::cast_slice(words)
}
