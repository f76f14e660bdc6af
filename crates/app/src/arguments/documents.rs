//! Options of `rasray completions` and `rasray man`.

use clap::Args;
use clap_complete::Shell;

const AFTER_COMPLETIONS: &str = "\
Examples:
  rasray completions bash > ~/.local/share/bash-completion/completions/rasray
  rasray completions fish > ~/.config/fish/completions/rasray.fish
  rasray completions zsh > ~/.zfunc/_rasray";

const AFTER_MAN: &str = "\
Examples:
  rasray man > rasray.1
  rasray man render > rasray-render.1
  rasray man render | man -l -";

/// Options of `rasray completions`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_COMPLETIONS)]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_enum, value_name = "SHELL")]
    pub shell: Shell,
}

/// Options of `rasray man`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_MAN)]
pub struct ManArguments {
    /// The command whose page is wanted [default: that of rasray itself]
    #[arg(value_name = "COMMAND")]
    pub command: Option<String>,
}
