//! The reference on its own and compared with the device.

mod device_scattering;
mod glass_tables;
mod oracle_replay;
