//! A machine without a loader, a driver or a device: the command says so, with a remedy, and ends with 3.
#![cfg(target_os = "linux")]

use std::path::Path;
use std::process::{Command, Output};

/// The command itself, on a machine whose loader and drivers the environment decides.
fn rasray(folder: &Path, line: &str, environment: &[(&str, &str)]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rasray"))
        .args(line.split_whitespace())
        .env_remove("VK_DRIVER_FILES")
        .env_remove("VK_ICD_FILENAMES")
        .envs(environment.iter().copied())
        .current_dir(folder)
        .output()
        .expect("the command starts")
}

fn check_refusal(output: &Output, words: &[&str]) {
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert_eq!(text.matches("error: ").count(), 1, "{text}");
    assert_eq!(text.matches("help: ").count(), 1, "{text}");
    for word in words {
        assert!(text.contains(word), "`{word}` is missing: {text}");
    }
}

const COMMANDS: [&str; 3] = [
    "render cornell --size 8x8 -o a.png --report r.json",
    "compare cornell --systems brute-force --rays 10 --report r.json",
    "info",
];

#[test]
fn a_machine_without_drivers_is_told_what_to_install() {
    let folder = tempfile::tempdir().expect("a folder");
    for variable in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
        for line in COMMANDS {
            let output = rasray(folder.path(), line, &[(variable, "/nonexistent/driver.json")]);
            check_refusal(&output, &["no Vulkan device", "mesa-vulkan-drivers"]);
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 0, "something was written");
}

/// A file of the loader's name that is no library stands before the real one.
#[test]
fn a_machine_without_a_loader_is_told_what_to_install() {
    let folder = tempfile::tempdir().expect("a folder");
    let libraries = tempfile::tempdir().expect("a folder");
    std::fs::write(libraries.path().join("libvulkan.so.1"), b"no library").expect("a file");
    let path = libraries.path().to_str().expect("a plain name");
    for line in COMMANDS {
        let output = rasray(folder.path(), line, &[("LD_LIBRARY_PATH", path)]);
        check_refusal(&output, &["Vulkan loader", "libvulkan1"]);
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 0, "something was written");
}

/// Contents and needs of a scene are known without a device.
#[test]
fn a_scene_is_described_without_a_device() {
    let folder = tempfile::tempdir().expect("a folder");
    let nowhere = [("VK_ICD_FILENAMES", "/nonexistent/a.json"), ("VK_DRIVER_FILES", "/nonexistent/a.json")];
    let output = rasray(folder.path(), "info cornell", &nowhere);
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(text.contains("scene cornell") && text.contains("triangles"), "{text}");
}

/// The shipped command cannot be made to fail on demand: no feature of `rasray-gpu` is on in it. That this
/// would be seen is shown by the package of the tests of faults, which has it on.
#[test]
fn what_ships_has_no_faults_on_demand() {
    let features = |package: &str, edges: &str| {
        let output = Command::new(env!("CARGO"))
            .args(["tree", "--offline", "--locked", "--prefix", "none", "--format", "{p} [{f}]"])
            .args(["--package", package, "--edges", edges])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .expect("cargo starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let line = text.lines().find(|line| line.starts_with("rasray-gpu ")).map(str::to_owned);
        line.unwrap_or_else(|| panic!("{package} does not use rasray-gpu: {text}"))
    };
    let shipped = features("rasray-app", "normal,build");
    assert!(shipped.contains("[]"), "{shipped}");
    let tested = features("rasray-faults", "normal,build,dev");
    assert!(tested.contains("[fault-injection]"), "{tested}");
}
