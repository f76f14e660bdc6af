//! A device as reports name it.

use rasray_gpu::Device;

/// Describes a device to a report, software with the processor that it runs on.
pub fn device_record(device: &Device) -> rasray_report::Device {
    let software = device.is_software();
    rasray_report::Device {
        name: device.name().to_owned(),
        driver: device.driver().to_owned(),
        software,
        processor: if software { processor() } else { None },
    }
}

/// Returns the name of the processor, where Linux tells it.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let mut pairs = text.lines().filter_map(|line| line.split_once(':'));
    let (_, name) = pairs.find(|(key, _)| key.trim() == "model name")?;
    // Some names are padded.
    Some(name.split_whitespace().collect::<Vec<_>>().join(" "))
}
