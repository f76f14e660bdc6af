//! Text about the devices, the features of the one in use, and the choices of each structure on it.

use super::rows::pair;
use crate::hints::with_flags;
use rasray_experiment::DeviceDescription;
use rasray_report::{Device, columns};
use serde_json::{Map, Value, json};
use std::fmt::Write;

pub(super) fn device_json(device: &Device, description: &DeviceDescription) -> Value {
    let features = description.features.iter().map(|feature| {
        json!({
            "name": feature.name,
            "present": feature.present,
            "required": feature.required,
            "purpose": with_flags(&feature.purpose),
        })
    });
    let limits = description.limits.iter().map(|(name, value)| (name.clone(), Value::from(value.as_str())));
    let paths = description.paths.iter().map(|path| {
        json!({
            "system": path.system,
            "choice": path.choice,
            "chosen": path.chosen,
            "reason": path.reason,
        })
    });
    json!({
        "devices": description.devices,
        "device": device,
        "vulkan": description.api_version,
        "features": features.collect::<Vec<_>>(),
        "limits": limits.collect::<Map<_, _>>(),
        "paths": paths.collect::<Vec<_>>(),
    })
}

pub(super) fn device_text(device: &Device, description: &DeviceDescription) -> String {
    let kind = if device.software { "a program on the processor" } else { "hardware" };
    let mut text = String::from("devices\n");
    let rows: Vec<_> =
        description.devices.iter().enumerate().map(|(i, name)| vec![i.to_string(), name.clone()]).collect();
    text += &columns(&rows, 2);
    _ = writeln!(text, "in use");
    let rows = [
        pair("name", &device.name),
        pair("driver", &device.driver),
        pair("kind", kind),
        pair("Vulkan", &description.api_version),
    ];
    text += &columns(&rows, 2);
    if !description.features.is_empty() {
        text += "features\n";
        let rows: Vec<_> = description
            .features
            .iter()
            .map(|feature| {
                let state = match (feature.present, feature.required) {
                    (true, _) => "yes",
                    (false, true) => "MISSING",
                    (false, false) => "no",
                };
                let need = if feature.required { "required" } else { "optional" };
                vec![feature.name.clone(), state.to_owned(), need.to_owned(), with_flags(&feature.purpose)]
            })
            .collect();
        text += &columns(&rows, 4);
    }
    if !description.limits.is_empty() {
        text += "limits\n";
        let rows: Vec<_> = description.limits.iter().map(|(name, value)| pair(name, value)).collect();
        text += &columns(&rows, 2);
    }
    if !description.paths.is_empty() {
        text += "paths\n";
        let rows: Vec<_> = description
            .paths
            .iter()
            .map(|path| {
                vec![path.system.clone(), path.choice.clone(), path.chosen.clone(), path.reason.clone()]
            })
            .collect();
        text += &columns(&rows, 4);
    }
    text
}
