//! Tests of the page of a comparison as text: its parts, its loads, and that no name becomes markup.

use crate::fixture::{everything, hard_runs};
use rasray_report::figures::Figures;
use rasray_report::{Pass, PoseRecord, Report, Run};
use rasray_report_html as html;

fn page(report: &Report, figures: &Figures) -> String {
    String::from_utf8(html::page(report, figures).expect("figures that fit")).expect("UTF-8")
}

/// Returns the page without the library that draws its plots, by far the longest script.
fn without_library(page: &str) -> String {
    let start = page.find("<script>\n/**\n* plotly.js").expect("the library");
    let end = start + page[start..].find("</script>").expect("its end");
    format!("{}{}", &page[..start], &page[end + "</script>".len()..])
}

/// Returns the anchors of the parts, in order.
fn parts(page: &str) -> Vec<String> {
    page.split("<section id=\"").skip(1).map(|rest| rest.split('"').next().unwrap_or("").to_owned()).collect()
}

/// Anchors of all parts in order: charts first, then tables, then pictures.
const ALL_PARTS: [&str; 9] =
    ["speed-error", "passes", "memory", "histograms", "percentiles", "summary", "work", "images", "runs"];

#[test]
fn a_full_report_has_every_part_once() {
    let (report, figures) = everything("spheres:10k");
    let page = page(&report, &figures);
    assert_eq!(parts(&page), ALL_PARTS);
    for part in ALL_PARTS {
        assert!(page.contains(&format!("<a href=\"#{part}\">")), "{part}");
    }
    assert_eq!(page.matches("plotly.js (basic").count(), 1);
    assert!(page.contains("A software driver.") && page.contains("0123456789ab"));
}

/// Function that removes a measurement from every run or figure.
type Removal = fn(&mut Report, &mut Figures);

#[test]
fn a_part_is_there_exactly_when_its_data_is() {
    let removals: [(&[&str], Removal); 7] = [
        (&["histograms"], |_, figures| figures.depth_errors.clear()),
        (&["percentiles"], |report, _| {
            for accuracy in report.runs.iter_mut().filter_map(|run| run.accuracy.as_mut()) {
                (accuracy.dt_rel_p50, accuracy.dt_rel_p90) = (None, None);
                (accuracy.dt_rel_p99, accuracy.dt_rel_p999, accuracy.dt_rel_max) = (None, None, None);
            }
        }),
        (&["passes"], |report, _| report.runs.iter_mut().for_each(|run| run.passes.clear())),
        (&["memory"], |report, _| report.runs.iter_mut().for_each(|run| run.memory = None)),
        (&["work"], |_, figures| figures.work.clear()),
        (&["images"], |_, figures| figures.images = None),
        (&["speed-error"], |report, _| {
            for run in &mut report.runs {
                run.times = Default::default();
            }
        }),
    ];
    for (gone, remove) in removals {
        let (mut report, mut figures) = everything("spheres:10k");
        remove(&mut report, &mut figures);
        let page = page(&report, &figures);
        let left: Vec<_> = ALL_PARTS.into_iter().filter(|part| !gone.contains(part)).collect();
        assert_eq!(parts(&page), left);
        assert!(!page.contains(&format!("href=\"#{}\"", gone[0])));
    }
    let (mut report, _) = everything("spheres:10k");
    report.runs.clear();
    let page = page(&report, &Figures::default());
    assert!(parts(&page).is_empty() && !page.contains("plotly.js (basic"), "nothing to plot, no library");
}

#[test]
fn hard_cases_have_verdicts_and_a_few_have_plots() {
    for (cases, plotted) in [(1, true), (4, true), (5, false)] {
        let (mut report, _) = everything("hard:all");
        report.runs = hard_runs(cases);
        let page = page(&report, &Figures::default());
        let order = if plotted { ["summary", "hard-cases"] } else { ["hard-cases", "summary"] };
        let tables: Vec<_> = parts(&page).into_iter().filter(|part| order.contains(&part.as_str())).collect();
        assert_eq!(tables, order);
        assert_eq!(parts(&page)[0] == "speed-error", plotted, "{cases} cases");
        let bad =
            report.runs.iter().filter(|run| run.hard.as_ref().is_some_and(|hard| hard.met == Some(false)));
        assert_eq!(page.matches("class=\"verdict broken\"").count(), bad.count());
        assert!(page.contains("rays that leak") && page.contains(">E0</th>"));
    }
}

#[test]
fn intervals_and_quartiles_stand_next_to_their_numbers() {
    let (mut report, figures) = everything("spheres:10k");
    let before = page(&report, &figures);
    assert!(
        before.contains("0<span class=\"interval\">&lt;\u{a0}1.5e\u{2011}5</span>"),
        "3/N of no missed hit"
    );
    assert!(before.contains("<span class=\"interval\">27.568 – 31.921</span>"), "quartiles of a build");
    for run in &mut report.runs {
        run.spread.clear();
        run.accuracy.iter_mut().for_each(|accuracy| accuracy.rates.clear());
    }
    let after = page(&report, &figures);
    assert!(!after.contains("class=\"interval\""));
}

#[test]
fn numbers_that_change_change_the_page() {
    let (report, figures) = everything("spheres:10k");
    let before = page(&report, &figures);
    let changes: [(&str, Removal); 11] = [
        ("a rate", |report, _| report.runs[1].times.mrays_per_s = Some(3.5)),
        ("a missed hit", |report, _| report.runs[3].accuracy.as_mut().expect("judged").missed += 1),
        ("a pass", |report, _| report.runs[7].passes[2].ms_share = Some(1.5)),
        ("a part of memory", |report, _| {
            let parts = &mut report.runs[0].memory.as_mut().expect("measured").by_part;
            *parts.values_mut().next().expect("a part") += 4096;
        }),
        ("a bin", |_, figures| figures.depth_errors[1].bins[20] += 10_000),
        ("a ray's work", |_, figures| figures.work[2].tests[40] += 7),
        ("a pixel", |_, figures| {
            figures.images.as_mut().expect("images").systems[1].pixels[77] = [0.0, 1.0, 0.0];
        }),
        ("a pixel's FLIP", |_, figures| figures.images.as_mut().expect("images").systems[1].flip[77] = 0.5),
        ("bytes that are not uploaded", |report, _| report.scene.not_uploaded_bytes = Some(9_216)),
        ("a time", |report, _| {
            let clips = vec!["walk".to_owned()];
            report.scene.pose = Some(PoseRecord { time_s: 0.75, clips, ..PoseRecord::default() });
        }),
        ("an option", |report, _| {
            report.runs[0].options.insert("resolution".to_owned(), 1024.into());
        }),
    ];
    for (what, change) in changes {
        let (mut report, mut figures) = everything("spheres:10k");
        change(&mut report, &mut figures);
        assert_ne!(page(&report, &figures), before, "{what}");
    }
    assert_eq!(page(&report, &figures), before, "the same report makes the same page");
}

/// Returns the contents of bar charts: the title of each, and each bar's name with the sum of its parts.
fn bars(page: &str, id: &str) -> Vec<(String, Vec<(String, f64)>)> {
    let start = "<script type=\"application/json\" id=\"plots\">";
    let plots = page.split(start).nth(1).and_then(|rest| rest.split("</script>").next()).expect("plots");
    let plots: Vec<serde_json::Value> = serde_json::from_str(plots).expect("JSON");
    let of = |plot: &serde_json::Value| -> Vec<(String, f64)> {
        let mut sums: Vec<(String, f64)> = Vec::new();
        let traces = plot["data"].as_array().expect("traces").iter().filter(|trace| trace["type"] == "bar");
        for trace in traces {
            let (names, sizes) =
                (trace["y"].as_array().expect("names"), trace["x"].as_array().expect("sizes"));
            for (name, size) in names.iter().zip(sizes) {
                let (name, size) = (name.as_str().expect("a name"), size.as_f64().expect("a size"));
                match sums.iter_mut().find(|(known, _)| known == name) {
                    Some((_, sum)) => *sum += size,
                    None => sums.push((name.to_owned(), size)),
                }
            }
        }
        sums
    };
    let named = |plot: &&serde_json::Value| plot["id"].as_str().is_some_and(|one| one.starts_with(id));
    let title = |plot: &serde_json::Value| {
        let area = format!("id=\"{}\"", plot["id"].as_str().expect("an id"));
        let before = page.split(&area).next().expect("a page");
        let title = before.rsplit("<strong>").next().and_then(|rest| rest.split("</strong>").next());
        title.expect("a title").to_owned()
    };
    plots.iter().filter(named).map(|plot| (title(plot), of(plot))).collect()
}

#[test]
fn bars_of_passes_are_as_long_as_the_figures_of_the_table() {
    let (report, figures) = everything("spheres:10k");
    let bars = bars(&page(&report, &figures), "passes");
    let titles: Vec<_> = bars.iter().map(|(title, _)| title.as_str()).collect();
    assert_eq!(
        titles,
        [
            "camera, incoherent, image, path: build",
            "camera: trace",
            "incoherent: trace",
            "image, path: all passes of the image"
        ]
    );
    for (title, sums) in &bars {
        let (rays, figure) = title.rsplit_once(": ").expect("rays and a figure");
        let of_rays = |run: &&Run| rays.starts_with(run.ray_set.as_deref().unwrap_or("image"));
        let mut seen = 0;
        for run in report.runs.iter().filter(of_rays) {
            let name = format!("{}<br>{}", run.system, run.preset);
            let sum = sums.iter().find(|(bar, _)| *bar == name).expect("a bar").1;
            let wanted = match figure {
                "build" => run.times.build_ms,
                "trace" => run.times.trace_ms,
                _ => run.times.image_ms,
            };
            let wanted = wanted.expect("measured");
            assert!((sum / wanted - 1.0).abs() < 1.0e-9, "{title}, {name}: {sum} of {wanted}");
            seen += 1;
        }
        assert_eq!(seen, 5, "{title}");
    }
}

/// Checks that the host's part of a build is shown as no pass of a device, however many passes there are.
#[test]
fn what_the_host_does_has_a_bar_of_its_own() {
    let (report, figures) = everything("spheres:10k");
    let page = page(&report, &figures);
    for name in [Pass::HOST, Pass::WAITING] {
        assert!(page.contains(&format!("\"name\":\"{name}\"")), "{name}");
    }
    let (_, sums) = &bars(&page, "passes")[0];
    let brute = sums.iter().find(|(bar, _)| bar.starts_with("brute-force")).expect("a bar");
    assert!(brute.1 > 0.0, "all that it does is the host's");
}

#[test]
fn no_text_of_the_report_becomes_markup() {
    let evil = "<script>alert(1)</script>\"'&<!--";
    let (mut report, figures) = everything(evil);
    report.device.name = evil.to_owned();
    report.device.driver = evil.to_owned();
    report.commit = Some(evil.to_owned());
    for run in &mut report.runs {
        run.system = evil.to_owned();
        run.preset = evil.to_owned();
        run.ray_set = run.ray_set.take().map(|_| evil.to_owned());
        run.passes.iter_mut().for_each(|pass| pass.label = evil.to_owned());
        run.options.insert(evil.to_owned(), evil.into());
        run.paths.insert(evil.to_owned(), evil.to_owned());
        if let Some(memory) = &mut run.memory {
            memory.by_part.insert(evil.to_owned(), 77);
        }
    }
    let page = without_library(&page(&report, &figures));
    assert!(!page.contains("alert(1)<") && !page.contains("<!--"), "raw text of the report");
    assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;"));
    // Two scripts belong to the page and one holds data; the library is taken out.
    assert_eq!(page.matches("<script").count(), 3);
    assert_eq!(well_formed(&page), Ok(()));
}

#[test]
fn the_page_loads_nothing() {
    let (report, figures) = everything("spheres:10k");
    let page = without_library(&page(&report, &figures));
    assert_eq!(loads(&page), Vec::<String>::new());
    assert!(page.contains("content=\"default-src &#39;none&#39;; img-src data: blob:;"));
    // This part checks that the check finds what it looks for.
    for bad in
        ["<img src=\"https://a.example/b.png\">", "<a href=\"//a.example\">x</a>", "<link rel=\"icon\">"]
    {
        assert_eq!(loads(&format!("{page}{bad}")).len(), 1, "{bad}");
    }
}

/// Returns everything in a page that makes a browser ask for something, or that leads elsewhere.
fn loads(page: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (attribute, allowed) in
        [(" src=\"", "data:image/png;base64,"), (" href=\"", "#"), (" srcset=\"", "-")]
    {
        for value in page.split(attribute).skip(1).map(|rest| rest.split('"').next().unwrap_or("")) {
            if !value.starts_with(allowed) {
                found.push(format!("{attribute}{value}"));
            }
        }
    }
    for word in ["<link", "<iframe", "<object", "<embed", "@import", "url(", "fetch(", "import("] {
        found.extend(page.matches(word).map(str::to_owned));
    }
    found
}

#[test]
fn the_page_is_well_formed() {
    let (report, figures) = everything("spheres:10k");
    let page = without_library(&page(&report, &figures));
    assert_eq!(well_formed(&page), Ok(()));
    assert!(well_formed(&page.replacen("</figure>", "", 1)).is_err());
    assert!(well_formed(&page.replacen("</dl>", "</div>", 1)).is_err());
    let ids: Vec<&str> =
        page.split(" id=\"").skip(1).map(|rest| rest.split('"').next().unwrap_or("")).collect();
    let mut distinct = ids.clone();
    distinct.sort_unstable();
    distinct.dedup();
    assert_eq!(distinct.len(), ids.len(), "an id twice");
    // Every picture has a description for readers who cannot see it; the viewer's pictures get theirs with
    // their source.
    let pictures = page.matches("<img").count();
    assert_eq!(page.matches(" alt=\"").count(), pictures);
    assert_eq!(page.matches(" alt=\"\"").count(), 2);
}

/// Checks that every element that begins ends, in order; scripts and styles are skipped.
fn well_formed(page: &str) -> Result<(), String> {
    const EMPTY: [&str; 4] = ["meta", "img", "input", "!doctype"];
    let mut open: Vec<&str> = Vec::new();
    let mut rest = page;
    while let Some(start) = rest.find('<') {
        let end = rest[start..].find('>').ok_or("a tag without an end")? + start;
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            let last = open.pop();
            if last != Some(name) {
                return Err(format!("</{name}> ends {last:?}"));
            }
            continue;
        }
        let name = tag.split_whitespace().next().unwrap_or("");
        if name == "script" || name == "style" {
            let close = format!("</{name}>");
            let end = rest.find(&close).ok_or("a script without an end")?;
            rest = &rest[end + close.len()..];
        } else if !EMPTY.contains(&name) {
            open.push(name);
        }
    }
    if open.is_empty() { Ok(()) } else { Err(format!("never ended: {open:?}")) }
}

#[test]
fn the_page_stays_small() {
    let (report, figures) = everything("spheres:10k");
    let text = page(&report, &figures);
    let pictures: usize = without_library(&text)
        .split("data:image/png;base64,")
        .skip(1)
        .map(|rest| rest.find('"').unwrap_or(0))
        .sum();
    let rest = text.len() - pictures;
    assert!(rest < 6_000_000, "{rest} bytes beside pictures");
    assert!(pictures > 1000, "{pictures} bytes of pictures");
}

#[test]
fn pictures_are_in_the_page_once() {
    let (report, figures) = everything("spheres:10k");
    let text = without_library(&page(&report, &figures));
    let images = figures.images.as_ref().expect("images");
    // The pictures are work maps in three quantities, images, maps of FLIP, three ramps of legends for work
    // and one for FLIP.
    let expected = 3 * figures.work.len() + 1 + 2 * images.systems.len() + 4;
    assert_eq!(text.matches("data:image/png;base64,").count(), expected);
}

#[test]
fn figures_that_do_not_fit_the_report_are_refused() {
    let changes: [Removal; 4] = [
        |_, figures| figures.work[0].run = 99,
        |_, figures| _ = figures.work[0].cells.pop(),
        |_, figures| _ = figures.images.as_mut().expect("images").reference.pop(),
        |_, figures| _ = figures.images.as_mut().expect("images").systems[0].flip.pop(),
    ];
    for change in changes {
        let (mut report, mut figures) = everything("spheres:10k");
        change(&mut report, &mut figures);
        assert!(html::page(&report, &figures).is_err());
    }
}
