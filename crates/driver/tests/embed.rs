//! Test that the example runs, that its hits are those of brute force, and that the validation layer is
//! silent.

use rasray_driver::{Config, Driver};
use rasray_gpu::Device;

#[path = "../examples/embed.rs"]
mod embed;

#[test]
fn a_renderer_of_its_own_traces_through_the_drivers_tree() {
    let wanted = Driver::requirements_of(&Config::new());
    let devices = Device::list(&wanted).expect("there is a device");
    // The example takes the first device.
    if devices.first().is_none_or(|device| !device.is_suitable()) {
        eprintln!("skipped: the device has no rayQuery");
        return;
    }
    embed::main().expect("the example succeeds");
}
