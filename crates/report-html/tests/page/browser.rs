//! Page of a comparison in a browser without a window: no errors, every plot drawn, sorting and the slider at
//! work. The test is skipped by name if no browser is installed.

use rasray_report_html as html;

use crate::fixture::everything;
use crate::visit::{LOOK, browser, visit, with_script};

/// Script that uses the page like a person, after the page was measured, and writes the results into
/// attributes of the body.
const PROBE: &str = r##"<script>
addEventListener("load", () => {
  const report = (name, value) => parent.document.body.setAttribute(`data-probe-${name}`, value);
  report("width", innerWidth);
  const wider = (box) => box.scrollWidth > box.clientWidth && box.getBoundingClientRect().width > 0;
  const cut = [...document.querySelectorAll(".scrolled")].filter(wider);
  report("cut", cut.map((box) => `${box.ariaLabel} ${box.scrollWidth} of ${box.clientWidth}`).join("|"));
  const labels = (area, axis) => area.querySelectorAll(`.${axis}tick text`).length;
  const few = [...document.querySelectorAll(".area")].flatMap((area) =>
    ["x", "y"].filter((axis) => labels(area, axis) < 2 && !(axis === "y" && area.layout.yaxis.type === "category"))
      .map((axis) => `${area.id} ${axis}`));
  report("unlabelled", few.join("|"));

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
    // Windows have a least width that is greater than a phone's, so a phone is simulated by a frame in a
    // window.
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
        // There are 14 plots. Speed and error: two for each of two ray sets, one for images. Two histograms,
        // two plots of percentiles. Passes: one plot of builds, two of traces, one of images. One plot of
        // memory.
        assert_eq!((areas.as_str(), drawn.as_str()), ("14", "14"));
        assert_eq!(visit.probe("wide"), "0", "the page scrolls sideways at {width} pixels");
        if width == "1280" {
            assert_eq!(visit.probe("cut"), "", "tables that are wider than the page");
        }
        // Each axis of numbers has enough labels to be readable.
        let unlabelled = visit.probe("unlabelled");
        assert_eq!(unlabelled, "", "axes with fewer than two labels");
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
    // The first fault is a plot that cannot be drawn because its place is missing, the second a picture that
    // the page may not load.
    let broken = page.replacen("id=\"histogram-0\"", "id=\"elsewhere\"", 1);
    assert_ne!(broken, page);
    let broken = with_script(&broken, "<img src=\"https://a.invalid/b.png\" alt=\"\">");
    let visit = visit(&browser, &probed(&broken));
    assert!(visit.complaints.len() >= 2, "{:?}", visit.complaints);
    assert!(visit.complaints.iter().any(|line| line.contains("Content Security Policy")));
    assert_ne!(visit.probe("drawn"), visit.probe("areas"));
}
