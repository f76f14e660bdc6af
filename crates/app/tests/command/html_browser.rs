//! Pages of comparisons as the built command writes them, in a browser without a window. Skipped by name
//! where no browser is installed.

#[path = "../../../report-html/tests/page/visit.rs"]
mod visit;

use std::process::Command;

use visit::{LOOK, browser, visit, with_script};

/// Pages as the built command writes them: of a scene with images, and of hard cases.
#[test]
fn pages_of_the_command_work_in_a_browser() {
    let Some(browser) = browser() else {
        eprintln!("skipped: pages_of_the_command_work_in_a_browser needs chromium or chrome on the path");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    for (line, least_plots) in [
        ("compare cornell --systems mmrt,dirt,bvh --rays 300 --image --size 24x16 --spp 1", 6),
        ("compare hard:E1 --systems mmrt,brute-force --presets robust", 1),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_rasray"))
            .args(line.split(' '))
            .args(["--repetitions", "1", "--html", "page.html"])
            .current_dir(folder.path())
            .output()
            .expect("the command starts");
        assert_eq!(output.status.code(), Some(0), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        let page = std::fs::read_to_string(folder.path().join("page.html")).expect("a page");
        let visit = visit(&browser, &with_script(&page, LOOK));
        assert_eq!(visit.complaints, Vec::<String>::new(), "{line}");
        let number = |name: &str| visit.probe(name).parse::<usize>().expect("a number");
        let (areas, drawn) = (number("areas"), number("drawn"));
        assert!(areas >= least_plots && drawn == areas, "{line}: {drawn} of {areas} plots are drawn");
        assert!(number("tables") >= 2, "{line}: {} rows", number("tables"));
        assert_eq!(visit.probe("wide"), "0", "{line}: the page scrolls sideways");
    }
}
