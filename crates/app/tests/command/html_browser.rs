//! The page of a comparison in a browser without a window: no error, every plot drawn, sorting and the
//! slider at work. Skipped by name where no browser is installed.

use crate::html_fixture::everything;
use rasray_app::report::html;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// How long a browser may take on a busy machine before it is given up.
const PATIENCE: Duration = Duration::from_secs(120);

/// What any page shows: how many plots there are, how many were drawn, and how far it scrolls sideways.
const LOOK: &str = r##"<script>
addEventListener("load", () => {
  // In a frame the answers go to the page around it, whose elements are the ones that are read.
  const report = (name, value) => parent.document.body.setAttribute(`data-probe-${name}`, value);
  const areas = [...document.querySelectorAll(".area")];
  report("areas", areas.length);
  report("drawn", areas.filter((area) => area.querySelector(".main-svg .xy")).length);
  report("wide", document.documentElement.scrollWidth - document.documentElement.clientWidth);
  report("tables", document.querySelectorAll("table tbody tr").length);
});
</script>"##;

/// Uses the page like a person, once it was looked at, and writes what happened into attributes of the body.
const PROBE: &str = r##"<script>
addEventListener("load", () => {
  const report = (name, value) => parent.document.body.setAttribute(`data-probe-${name}`, value);
  report("width", innerWidth);

  const table = document.querySelector("table.sortable");
  const column = (index) => [...table.tBodies[0].rows].map((row) => row.cells[index].textContent).join("|");
  const buttons = [...table.querySelectorAll("th button")];
  const heading = buttons.findIndex((button) => button.textContent === "Mrays/s");
  const press = () => buttons[heading].click();
  press();
  report("ascending", column(heading));
  press();
  report("descending", column(heading));

  const over = document.getElementById("viewer-over");
  const slide = (value) => {
    const slider = document.getElementById("viewer-split");
    slider.value = value;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    return getComputedStyle(over).clipPath;
  };
  report("clip-30", slide(30));
  report("clip-80", slide(80));
  const before = over.alt;
  const choice = document.getElementById("viewer-left");
  choice.value = "image-1";
  choice.dispatchEvent(new Event("input", { bubbles: true }));
  report("left", `${before}|${over.alt}|${over.naturalWidth > 0}`);
});
</script>"##;

/// The first browser of the usual names on the path.
fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];
    std::env::split_paths(&path)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|candidate| candidate.is_file())
}

/// What a page came to: its elements after the scripts ran, and what they complained about.
struct Visit {
    elements: String,
    complaints: Vec<String>,
}

impl Visit {
    fn probe(&self, name: &str) -> String {
        let start = self.elements.split(&format!(" data-probe-{name}=\"")).nth(1);
        let value = start.and_then(|rest| rest.split('"').next());
        value.unwrap_or_else(|| panic!("no {name}; {:?}", self.complaints)).to_owned()
    }
}

/// Opens a page in a window without scroll bars. Output goes to files: it is longer than a pipe holds.
fn visit(browser: &Path, page: &str) -> Visit {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("page.html");
    std::fs::write(&file, page).expect("the page");
    let output = |name: &str| std::fs::File::create(folder.path().join(name)).expect("a file");
    let mut child = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run"])
        .args(["--enable-logging=stderr", "--virtual-time-budget=20000", "--dump-dom"])
        .args(["--window-size=1280,2000", "--hide-scrollbars"])
        .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
        .arg(format!("file://{}", file.display()))
        .stdin(Stdio::null())
        .stdout(output("elements"))
        .stderr(output("log"))
        .spawn()
        .expect("the browser starts");
    let begun = Instant::now();
    while child.try_wait().expect("a state").is_none() {
        if begun.elapsed() > PATIENCE {
            _ = child.kill();
            _ = child.wait();
            panic!("the browser did not end within {PATIENCE:?}");
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    let read = |name: &str| {
        let mut bytes = Vec::new();
        let mut file = std::fs::File::open(folder.path().join(name)).expect("a file");
        file.read_to_end(&mut bytes).expect("its bytes");
        String::from_utf8_lossy(&bytes).into_owned()
    };
    let complaints = read("log").lines().filter(|line| line.contains("CONSOLE")).map(str::to_owned).collect();
    Visit { elements: read("elements"), complaints }
}

fn with_script(page: &str, script: &str) -> String {
    let end = page.rfind("</body>").expect("a body");
    format!("{}{script}{}", &page[..end], &page[end..])
}

fn probed(page: &str) -> String {
    with_script(&with_script(page, LOOK), PROBE)
}

fn fixture() -> String {
    let (report, figures) = everything("<script>spheres</script>");
    String::from_utf8(html::page(&report, &figures).expect("a page")).expect("UTF-8")
}

#[test]
fn the_page_works_in_a_browser() {
    let Some(browser) = browser() else {
        eprintln!("skipped: the_page_works_in_a_browser needs chromium or chrome on the path");
        return;
    };
    let page = probed(&fixture());
    // Windows have a least width that phones are below, so a phone is a frame in a window.
    let phone = format!(
        "<!doctype html><title>phone</title><iframe width=\"360\" height=\"740\" style=\"border:0\" srcdoc=\"{}\">\
         </iframe>",
        page.replace('&', "&amp;").replace('"', "&quot;")
    );
    for (width, page) in [("1280", &page), ("360", &phone)] {
        let visit = visit(&browser, page);
        assert_eq!(visit.probe("width"), width);
        assert_eq!(visit.complaints, Vec::<String>::new());
        let (areas, drawn) = (visit.probe("areas"), visit.probe("drawn"));
        // Speed and error: two for each of two ray sets, one for images. Two histograms, two times
        // percentiles, three of passes, one of memory.
        assert_eq!((areas.as_str(), drawn.as_str()), ("13", "13"));
        assert_eq!(visit.probe("wide"), "0", "the page scrolls sideways at {width} pixels");
        let rates = |name: &str| -> Vec<f64> {
            visit.probe(name).split('|').map(|text| text.parse().expect("a rate")).collect()
        };
        let (ascending, descending) = (rates("ascending"), rates("descending"));
        assert!(ascending.is_sorted() && ascending.len() == 10, "{ascending:?}");
        assert!(descending.is_sorted_by(|a, b| a >= b) && descending[0] > descending[9]);
        assert_eq!(visit.probe("clip-30"), "inset(0px 70% 0px 0px)");
        assert_eq!(visit.probe("clip-80"), "inset(0px 20% 0px 0px)");
        assert_eq!(
            visit.probe("left"),
            "The scene as the reference renders it|The scene as mmrt published renders it|true"
        );
    }
}

#[test]
fn the_browser_test_sees_a_broken_page() {
    let Some(browser) = browser() else {
        eprintln!("skipped: the_browser_test_sees_a_broken_page needs chromium or chrome on the path");
        return;
    };
    let page = fixture();
    // A plot that cannot be drawn, for its place is gone, and a picture that the page may not load.
    let broken = page.replacen("id=\"histogram-0\"", "id=\"elsewhere\"", 1);
    assert_ne!(broken, page);
    let broken = with_script(&broken, "<img src=\"https://a.invalid/b.png\" alt=\"\">");
    let visit = visit(&browser, &probed(&broken));
    assert!(visit.complaints.len() >= 2, "{:?}", visit.complaints);
    assert!(visit.complaints.iter().any(|line| line.contains("Content Security Policy")));
    assert_ne!(visit.probe("drawn"), visit.probe("areas"));
}

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
