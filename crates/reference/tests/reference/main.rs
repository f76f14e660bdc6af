//! The reference on its own and compared with the device.

mod device_scattering;
mod glass_tables;
mod mirror_hall;
mod oracle_replay;
