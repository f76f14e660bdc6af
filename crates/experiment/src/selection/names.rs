//! Names of systems in messages.

use rasray_systems::{SYSTEMS, System};

/// With commas between them.
pub(super) fn names<'a>(systems: impl IntoIterator<Item = &'a &'static System>) -> String {
    systems.into_iter().map(|system| system.name).collect::<Vec<_>>().join(", ")
}

/// Which systems have an option, in words.
pub(super) fn who_has(option: &str) -> String {
    let having: Vec<_> =
        SYSTEMS.iter().filter(|system| system.has(option)).map(|system| system.name).collect();
    if having.is_empty() {
        "no system has it".to_owned()
    } else {
        format!("it belongs to {}", having.join(", "))
    }
}
