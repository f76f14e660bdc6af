//! Opens a page in a browser without a window.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Longest time that a browser may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// Script that measures any page: the number of plots, the number drawn, and how far the page scrolls
/// sideways.
pub const LOOK: &str = r##"<script>
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

/// Returns the first browser of the usual names on the path.
pub fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];
    std::env::split_paths(&path)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|candidate| candidate.is_file())
}

/// Result of a visit: the elements after the scripts ran, and the complaints of the scripts.
pub struct Visit {
    elements: String,
    /// Complaints of the page's scripts.
    pub complaints: Vec<String>,
}

impl Visit {
    pub fn probe(&self, name: &str) -> String {
        let start = self.elements.split(&format!(" data-probe-{name}=\"")).nth(1);
        let value = start.and_then(|rest| rest.split('"').next());
        value.unwrap_or_else(|| panic!("no {name}; {:?}", self.complaints)).to_owned()
    }
}

/// Opens a page in a window without scroll bars. Output goes to files, because it is longer than a pipe
/// holds.
pub fn visit(browser: &Path, page: &str) -> Visit {
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

pub fn with_script(page: &str, script: &str) -> String {
    let end = page.rfind("</body>").expect("a body");
    format!("{}{script}{}", &page[..end], &page[end..])
}
