//! Tests that pages agree with the registry: `docs/options.md` has the rows of options, the page of each
//! system names every option that the system has, the page of published frames has a line for each frame, and
//! the table of features in `docs/embedding.md` has the requirements of structures.
//!
//! `RASRAY_WRITE_PAGES=1` writes the page of options and the table instead of comparing them.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use rasray_gpu::{Feature, Requirements};
use rasray_systems::{Group, OPTIONS, SYSTEMS, Spec};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

fn page() -> String {
    let mut page = String::from(
        "# Options of structures\n\n\
         Every option of the command's `--system`, from the rows of `crates/systems/src/options.rs`; defaults are on the\n\
         pages of the [systems](systems/). A system takes the values that have a meaning for it, and names them where\n\
         another is given. Hits are bit-identical whatever an option's value ([how this is held](accuracy.md)), unless the\n\
         last column says where it may change one: *lossy*, where the rules of a paper lose hits; *fragments*, where\n\
         fragments are stored. This page is made by\n\
         `RASRAY_WRITE_PAGES=1 cargo test -p rasray-systems --test pages`.\n",
    );
    for group in Group::ALL {
        let title = group.title();
        let (first, rest) = title.split_at(1);
        let _ = write!(
            page,
            "\n## {}{rest}\n\n| option | says | values | systems | may change a hit |\n|---|---|---|---|---|\n",
            first.to_uppercase()
        );
        for option in OPTIONS.iter().filter(|option| option.group == group) {
            let row = &option.row;
            let systems: Vec<_> =
                SYSTEMS.iter().filter(|system| system.has(row.name)).map(|system| system.name).collect();
            let values =
                if row.values.is_switch() { "`on`, `off`".to_owned() } else { row.values.in_markdown() };
            let _ = writeln!(
                page,
                "| `{}` | {} | {} | {} | {} |",
                row.name,
                row.doc,
                values,
                systems.join(", "),
                option.hits.describe()
            );
        }
    }
    page
}

#[test]
fn the_page_of_options_is_that_of_the_rows() {
    let (path, page) = (docs().join("options.md"), page());
    if std::env::var_os("RASRAY_WRITE_PAGES").is_some() {
        std::fs::write(&path, page).expect("the page can be written");
        return;
    }
    let written = std::fs::read_to_string(&path).expect("there is a page of options");
    assert!(written == page, "docs/options.md is not what the rows say: write it with RASRAY_WRITE_PAGES=1");
}

#[test]
fn the_page_of_a_system_names_its_options() {
    for system in SYSTEMS.iter().filter(|system| !system.options().is_empty()) {
        // Systems with one structure have one set of options, which the page of one of them names.
        let same = SYSTEMS.iter().filter(|other| other.structure == system.structure);
        let page: String = same
            .map(|system| docs().join("systems").join(format!("{}.md", system.name)))
            .map(|path| std::fs::read_to_string(path).expect("every system has a page"))
            .collect();
        for row in system.options().iter().map(|option| &option.row) {
            let named =
                page.contains(&format!("`{}`", row.name)) || page.contains(&format!("`{}=", row.name));
            assert!(named, "the page of {} does not name the option {}", system.name, row.name);
        }
    }
}

#[test]
fn the_page_of_published_frames_has_a_line_for_each() {
    let page =
        std::fs::read_to_string(docs().join("published-frames.md")).expect("there is a page of frames");
    for system in SYSTEMS {
        let Some(frame) = system.frame else { continue };
        let options: String =
            frame.options.iter().map(|(name, value)| format!(" `{name}={value}`")).collect();
        let line = format!(
            "| `{}` | `{}` |{options} | `{}` | `{}` |\n",
            system.name, frame.integrator, frame.primary, frame.occluder
        );
        assert!(page.contains(&line), "docs/published-frames.md lacks {line}");
    }
}

/// Returns the requirements of a structure with these options, or `None` if the system does not have them.
fn requirements(system: &str, options: &[(&str, &str)]) -> Option<Requirements> {
    let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
    Spec::new(system, "robust", given).ok()?.requirements().ok()
}

/// Returns the table of features: a line for each structure with each of its builders, the preset's builder
/// first.
fn features() -> String {
    let mut table = String::from(
        "| structure | built by | features | queue | storage buffers of a stage |\n|---|---|---|---|---|\n",
    );
    let mut known = Vec::new();
    for system in SYSTEMS {
        if known.contains(&system.structure) {
            continue;
        }
        known.push(system.structure);
        let usual = requirements(system.name, &[]).expect("the preset is valid");
        let mut builders: Vec<_> = ["raster", "binning"]
            .into_iter()
            .filter_map(|builder| Some((builder, requirements(system.name, &[("builder", builder)])?)))
            .collect();
        builders.sort_by_key(|(_, requirements)| *requirements != usual);
        if builders.is_empty() {
            builders.push(("", usual));
        }
        for (builder, requirements) in builders {
            let draws = requirements.required.contains(&Feature::DynamicRendering);
            let names: Vec<_> =
                requirements.required.iter().map(|feature| format!("`{}`", feature.name())).collect();
            let _ = writeln!(
                table,
                "| `{}` | {} | {} | {} | {} |",
                system.structure,
                match builder {
                    "raster" => "drawing: `Builder::Raster`",
                    "binning" => "computing: `Builder::Binning`",
                    _ => "computing",
                },
                names.join(", "),
                if draws { "graphics and compute" } else { "compute" },
                requirements.storage_buffers,
            );
        }
    }
    table
}

#[test]
fn the_table_of_features_is_what_structures_require() {
    let (path, table) = (docs().join("embedding.md"), features());
    let page = std::fs::read_to_string(&path).expect("there is a page about embedding");
    let begin = page.find("| structure | built by |").expect("it has the table");
    let end = page[begin..].find("\n\n").map_or(page.len(), |length| begin + length + 1);
    if std::env::var_os("RASRAY_WRITE_PAGES").is_some() {
        let page = format!("{}{table}{}", &page[..begin], &page[end..]);
        std::fs::write(&path, page).expect("the page can be written");
        return;
    }
    let written = &page[begin..end];
    assert!(
        written == table,
        "the table of docs/embedding.md is not this: write it with RASRAY_WRITE_PAGES=1\n{table}"
    );
    // Only the `addressing` value `address` requires device addresses, as the page says.
    let addressed = SYSTEMS.iter().filter(|system| system.has("addressing"));
    for system in addressed {
        let with = |addressing| requirements(system.name, &[("addressing", addressing)]).expect("an option");
        let (sets, addresses) = (with("descriptor"), with("address"));
        assert!(!sets.required.contains(&Feature::BufferDeviceAddress), "{}", system.name);
        assert!(addresses.required.contains(&Feature::BufferDeviceAddress), "{}", system.name);
    }
}

/// Checks that no shader has a name that begins with `host`, which the page leaves to shaders of a host.
#[test]
fn no_glsl_has_a_name_of_a_host() {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    for file in rasray_shaders_glsl::files() {
        for line in file.text.lines() {
            let code = line.split("//").next().unwrap_or_default();
            let names = code.split(|c| !is_part(c));
            let taken: Vec<_> = names.filter(|name| name.to_ascii_lowercase().starts_with("host")).collect();
            assert!(taken.is_empty(), "{}: {taken:?}", file.name);
        }
    }
}
