//! Modules and their constants. Every module without what three sets of constants switch off is held against
//! SPIR-V's own validator; other tests make pipelines with the constants of structures and integrators.

use std::collections::BTreeSet;
use std::io::Write;
use std::process::{Command, Stdio};

use rasray_shaders_glsl as shaders;
use rasray_spirv::{specialised, without_debug_text};

/// Returns the fault that the validator finds in a module.
fn fault(words: &[u32]) -> Option<String> {
    let mut validator = Command::new("spirv-val")
        .args(["--target-env", "vulkan1.2", "--scalar-block-layout", "-"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("spirv-val runs (tools/setup test)");
    validator.stdin.take().expect("a pipe").write_all(bytemuck::cast_slice(words)).expect("it reads");
    let done = validator.wait_with_output().expect("it ends");
    (!done.status.success()).then(|| String::from_utf8_lossy(&done.stderr).into_owned())
}

/// Constants have many ids and few values; each module has some of them.
#[test]
fn modules_are_valid_without_what_constants_switch_off() {
    let all_are = |bits: u32| -> Vec<(u32, u32)> { (0..256).map(|id| (id, bits)).collect() };
    let every = [Vec::new(), all_are(0), all_are(1)];
    for shader in shaders::ALL {
        let module = shader.words();
        let mut checked = Vec::new();
        for constants in &every {
            let left = specialised(&module, constants);
            // Text for people takes the validator longer than the module.
            let bare = without_debug_text(&left);
            if !checked.contains(&bare) {
                assert_eq!(fault(&bare), None, "{} with {:?}", shader.name, constants.first());
                assert_eq!(specialised(&left, constants), left, "{}", shader.name);
                checked.push(bare);
            }
        }
    }
}

#[test]
fn a_module_that_is_cut_is_not_valid() {
    let mut words = shaders::ADS_QUEUE_TAKE.words().to_vec();
    words.pop();
    assert!(fault(&words).is_some());
}

/// A path's step has a switch for every feature that a scene may have.
#[test]
fn switches_that_are_off_leave_half_of_a_path_s_step() {
    let module = without_debug_text(&shaders::INTEGRATORS_PATH_SHADE_HITS.words());
    let all_off: Vec<(u32, u32)> = (0..256).map(|id| (id, 0)).collect();
    let left = specialised(&module, &all_off).len();
    assert!(left * 10 < module.len() * 6, "{left} of {} words", module.len());
}

/// The page on the contract names every id of a specialisation constant, for hosts that choose their own.
#[test]
fn the_contract_names_the_ids_of_all_constants() {
    let declared: BTreeSet<u32> = shaders::files()
        .iter()
        .flat_map(|file| file.text.split("constant_id = ").skip(1))
        .filter_map(|rest| rest.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok())
        .collect();
    let page = include_str!("../../docs/contract.md");
    let (_, rest) = page.split_once("Ids of specialisation constants in use: ").expect("the page has them");
    let (text, _) = rest.split_once(". Ids from").expect("and ends them");
    let numbers = text.split(|c: char| !c.is_ascii_digit() && c != '–').filter(|word| !word.is_empty());
    let named: BTreeSet<u32> = numbers
        .flat_map(|word| {
            let (first, last) = word.split_once('–').unwrap_or((word, word));
            let id = |text: &str| text.parse().expect("an id");
            id(first)..=id(last)
        })
        .collect();
    assert_eq!(named, declared);
}
