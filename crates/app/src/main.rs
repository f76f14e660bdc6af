//! The `rasray` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(rasray_app::run(std::env::args_os(), &mut rasray_experiment::open))
}
