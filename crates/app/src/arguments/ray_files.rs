//! Options about files of rays and hits.

use super::values::ValueError;
use clap::Args;
use std::path::PathBuf;

/// Rays and hits in files; `docs/ray-files.md` has the formats.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Files of rays and hits")]
pub struct RayFileArguments {
    /// Rays to trace: a .rays file, or a .npy array of N x 6, 7 or 8 numbers (origin, direction, t_min,
    /// t_max)
    #[arg(long, value_name = "FILE")]
    pub rays_file: Option<PathBuf>,
    /// Hits that another tracer found for the only set of rays; compared like a system's
    #[arg(long, value_name = "NAME=FILE.npy", value_parser = named_file)]
    pub hits_file: Vec<NamedFile>,
    /// Existing folder for the rays of each set (.rays, .npy) and the triangles (.npy)
    #[arg(long, value_name = "FOLDER")]
    pub save_rays: Option<PathBuf>,
    /// Existing folder for the oracle's and each system's answers to each set (.npy)
    #[arg(long, value_name = "FOLDER")]
    pub save_hits: Option<PathBuf>,
}

/// File with a name for reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFile {
    /// Name of letters, digits, `.`, `_` and `-`.
    pub name: String,
    /// Path of the file.
    pub path: PathBuf,
}

/// Reads `NAME=FILE`.
fn named_file(text: &str) -> Result<NamedFile, ValueError> {
    let (name, path) = text.split_once('=').ok_or(ValueError::NamedFile)?;
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-');
    if name.is_empty() || !name.chars().all(plain) {
        return Err(ValueError::Name);
    }
    if path.is_empty() {
        return Err(ValueError::NamedFile);
    }
    Ok(NamedFile { name: name.to_owned(), path: path.into() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_files() {
        let file = named_file("embree-4.1=a=b.npy").expect("the first = counts");
        assert_eq!((file.name.as_str(), file.path.to_str()), ("embree-4.1", Some("a=b.npy")));
        for bad in ["", "a", "=a.npy", "a=", "a b=c.npy", "<i>=c.npy"] {
            assert!(named_file(bad).is_err(), "{bad}");
        }
    }
}
