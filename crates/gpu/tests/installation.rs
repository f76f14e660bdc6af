//! Errors of an incomplete installation. Each test runs in a process of its own, because the errors depend on
//! its environment.

use std::process::Command;

use rasray_gpu::*;

/// Environment variable that is set in the child process.
const CHILD: &str = "RASRAY_GPU_INSTALLATION_CHILD";

/// Runs the test of this name again in a child process with an environment; returns true in the child.
fn in_child(test: &str, environment: &[(&str, &str)]) -> bool {
    if std::env::var_os(CHILD).is_some() {
        return true;
    }
    let program = std::env::current_exe().expect("the path of this test");
    let output = Command::new(program)
        .args(["--exact", test, "--nocapture"])
        .env(CHILD, "1")
        .envs(environment.iter().copied())
        .output()
        .expect("this test can be run again");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("1 passed"), "{text}");
    false
}

#[test]
fn a_missing_validation_layer_is_an_error_with_the_package() {
    let environment = [("VK_LAYER_PATH", "/nonexistent")];
    if in_child("installation::a_missing_validation_layer_is_an_error_with_the_package", &environment) {
        let desc = DeviceDesc { validation: true, ..DeviceDesc::default() };
        let error = Device::create(&desc).expect_err("there is no layer");
        assert!(matches!(error, GpuError::ValidationLayerMissing), "{error}");
        assert!(error.to_string().contains("vulkan-validationlayers"), "{error}");
    }
}

#[test]
fn a_machine_without_drivers_is_an_error_with_the_package() {
    let nowhere = "/nonexistent/driver.json";
    let environment = [("VK_ICD_FILENAMES", nowhere), ("VK_DRIVER_FILES", nowhere)];
    if in_child("installation::a_machine_without_drivers_is_an_error_with_the_package", &environment) {
        let error = Device::create(&DeviceDesc::default()).expect_err("there is no driver");
        assert!(matches!(error, GpuError::NoDevice), "{error}");
        assert!(error.to_string().contains("mesa-vulkan-drivers"), "{error}");
    }
}
