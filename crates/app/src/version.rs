//! Identity of this build of the command.

use rasray_report::Origin;

/// Version of the command.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Commit that the command was built from, if git knew it.
pub const COMMIT: Option<&str> = option_env!("RASRAY_COMMIT");

/// Returns the version and, where known, the commit.
pub fn version_text() -> &'static str {
    static TEXT: std::sync::LazyLock<String> = std::sync::LazyLock::new(|| match COMMIT {
        Some(commit) => format!("{VERSION} ({commit})"),
        None => VERSION.to_owned(),
    });
    &TEXT
}

/// Returns the identity of this build of the command, and the line that was typed.
pub(crate) fn origin(line: &str) -> Origin {
    Origin { version: VERSION.to_owned(), commit: COMMIT.map(str::to_owned), command: Some(line.to_owned()) }
}
