//! Text for people: results on stdout, everything else on stderr.

use crate::error::{AppError, one_line};
use rasray_scene::Scene;
use std::io::{self, IsTerminal, Write};
use tracing_subscriber::EnvFilter;

/// Writes to stdout. A reader that has gone away, such as `head`, wants no more and is no error.
///
/// # Errors
/// [`AppError::Refused`] when stdout takes no more for another reason.
pub(crate) fn print(text: &str) -> Result<(), AppError> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(AppError::refused(format!("stdout: {error}"), "send the output somewhere with room for it"))
        }
        _ => Ok(()),
    }
}

/// Writes to stderr; there is nowhere left to complain when that fails.
pub(crate) fn complain(text: &str) {
    _ = io::stderr().lock().write_all(text.as_bytes());
}

/// One line of warning.
pub(crate) fn warn(text: &str) {
    complain(&format!("warning: {}\n", one_line(text)));
}

/// Says what was dropped or replaced in a scene, and that an empty one shows only its environment.
pub(crate) fn warn_of_scene(scene: &Scene, triangles: u64) {
    for warning in &scene.warnings {
        warn(&format!("{}: {} ({})", scene.name, warning.message, warning.kind));
    }
    // The reader may have said so, and why.
    if triangles == 0 && !scene.warnings.iter().any(|warning| warning.kind == "no-triangles") {
        warn(&format!(
            "{}: the scene has no triangles; only its environment will be seen (no-triangles)",
            scene.name
        ));
    }
}

/// Sends log messages to stderr. `RASRAY_LOG` sets the filter; unless it does, warnings are shown,
/// without those of scene files, which [`warn_of_scene`] shows.
pub(crate) fn start_logging() {
    let usual = || EnvFilter::new("warn,rasray_scene=error");
    let filter = match std::env::var("RASRAY_LOG") {
        Ok(text) => EnvFilter::try_new(&text).unwrap_or_else(|error| {
            warn(&format!("RASRAY_LOG={text} is no log filter: {error}"));
            usual()
        }),
        Err(_) => usual(),
    };
    // A second start in one process keeps the first one's settings.
    _ = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(io::stderr)
        .with_ansi(io::stderr().is_terminal())
        .without_time()
        .try_init();
}
