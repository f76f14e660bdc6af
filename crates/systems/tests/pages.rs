//! Pages follow the registry: `docs/options.md` is what the rows of options say, and the page of each system names every
//! option that it has.
//!
//! `RASRAY_WRITE_PAGES=1` writes the page of options instead of comparing it.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use rasray_systems::{Group, OPTIONS, OptionRow, SYSTEMS, Values};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

fn values(row: &OptionRow) -> String {
    match row.values {
        Values::Words(words) => {
            let words: Vec<_> = words.iter().map(|(word, doc)| format!("`{word}`: {doc}")).collect();
            words.join("<br>")
        }
        Values::Whole(lowest, u32::MAX) => format!("{lowest} or more"),
        Values::Whole(lowest, highest) => format!("{lowest} to {highest}"),
        Values::Metres => "metres, not negative".to_owned(),
        Values::Share => "a share, not negative".to_owned(),
        Values::Cells => "columns x rows, or one number for both".to_owned(),
    }
}

fn page() -> String {
    let mut page = String::from(
        "# Options of structures\n\n\
         Every option of the command's `--system`, from the rows of `crates/systems/src/options.rs`; defaults are on the\n\
         pages of the [systems](systems/). A system takes the values that have a meaning for it, and names them where\n\
         another is given. The last column says when an option may change a hit; where it does not, hits are\n\
         bit-identical whatever its value ([how this is held](accuracy.md)). This page is made by\n\
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
        for row in OPTIONS.iter().filter(|row| row.group == group) {
            let systems: Vec<_> =
                SYSTEMS.iter().filter(|system| system.has(row.name)).map(|system| system.name).collect();
            let _ = writeln!(
                page,
                "| `{}` | {} | {} | {} | {} |",
                row.name,
                row.doc,
                values(row),
                systems.join(", "),
                row.hits.describe()
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
        // Systems of one structure have its options, on the page of one of them.
        let same = SYSTEMS.iter().filter(|other| other.structure == system.structure);
        let page: String = same
            .map(|system| docs().join("systems").join(format!("{}.md", system.name)))
            .map(|path| std::fs::read_to_string(path).expect("every system has a page"))
            .collect();
        for row in system.options() {
            let named =
                page.contains(&format!("`{}`", row.name)) || page.contains(&format!("`{}=", row.name));
            assert!(named, "the page of {} does not name the option {}", system.name, row.name);
        }
    }
}
