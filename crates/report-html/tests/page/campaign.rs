//! Tests of the page of a campaign: bars, curves, speed against error, and tables; no name becomes markup.

use rasray_report::{
    Accuracy, Campaign, CampaignRecord, Cell, CellImage, CellRays, CellRecord, Device, ExperimentRecord,
    ImageError, Origin, Report, Run, SceneRecord, Times,
};
use rasray_report_html::campaign_page;

use crate::visit::{LOOK, browser, visit, with_script};

/// Makes the line of a run that an experiment asked for.
fn line(place: u32, name: &str, system: &str, samples: Option<u32>, is_image: bool) -> Report {
    let experiment =
        ExperimentRecord { place: u32::from(name != "Samples"), name: name.to_owned(), ..Default::default() };
    let campaign = CampaignRecord { title: "<b>All</b>".to_owned(), experiments: vec![experiment] };
    let rays = CellRays { set: "camera".to_owned(), count: 100, content: None };
    let image = CellImage { integrator: "path".to_owned(), spp: 4, ..Default::default() };
    let options = samples.map(|samples| ("samples".to_owned(), samples.to_string()));
    let depends_on = Cell {
        scene: "<script>box</script>".to_owned(),
        system: system.to_owned(),
        preset: "robust".to_owned(),
        options: options.into_iter().collect(),
        rays: (!is_image).then_some(rays),
        image: is_image.then_some(image),
        ..Default::default()
    };
    let time = 3.0 + f64::from(place);
    let run = Run {
        system: system.to_owned(),
        preset: "robust".to_owned(),
        ray_set: (!is_image).then(|| "camera".to_owned()),
        times: Times {
            build_ms: Some(time),
            trace_ms: (!is_image).then_some(time),
            mrays_per_s: (!is_image).then_some(1.0 / time),
            image_ms: is_image.then_some(time),
            ..Default::default()
        },
        accuracy: (!is_image).then(|| Accuracy { rays: 100, missed: u64::from(place), ..Default::default() }),
        image: is_image.then(|| ImageError { flip_mean: Some(0.1 * time), ..Default::default() }),
        ..Default::default()
    };
    let report = Report::new(Origin::default(), Device::default(), SceneRecord::default(), vec![run]);
    let cell = CellRecord { place, campaign: Some(campaign), depends_on, ..Default::default() };
    Report { cell: Some(cell), ..report }
}

/// Makes lines of a parameter with three values, and of two systems on rays and images.
fn lines() -> Vec<Report> {
    let samples = [25, 50, 100].into_iter().enumerate();
    let samples = samples.map(|(place, samples)| line(place as u32, "Samples", "mmrt", Some(samples), false));
    let systems = ["mmrt", "bvh"].into_iter().enumerate();
    let systems = systems.flat_map(|(place, system)| {
        [false, true].map(|is_image| {
            line(3 + 2 * place as u32 + u32::from(is_image), "<i>Systems", system, None, is_image)
        })
    });
    samples.chain(systems).collect()
}

fn page(lines: &[Report]) -> String {
    let campaign = Campaign::of(lines).expect("of a campaign");
    String::from_utf8(campaign_page(&campaign)).expect("UTF-8")
}

#[test]
fn experiments_have_the_plots_of_what_they_vary() {
    let page = page(&lines());
    let plot = |id: &str| page.contains(&format!("id=\"experiment-{id}\""));
    // The parameter has curves, the systems have bars, and both have plots of speed against error.
    for id in [
        "0-0-samples-mrays_per_s",
        "0-0-samples-build_ms",
        "0-0-samples-error_share",
        "0-0-mrays_per_s-error_share",
    ] {
        assert!(plot(id), "{id}");
    }
    for id in
        ["1-0-bars-mrays_per_s", "1-0-bars-build_ms", "1-1-bars-image_ms", "1-1-image_ms-image.flip_mean"]
    {
        assert!(plot(id), "{id}");
    }
    assert!(!plot("0-0-bars-mrays_per_s") && !plot("1-0-bars-image_ms"));
    assert!(!page.contains("<b>All") && !page.contains("<i>Systems") && !page.contains("<script>box"));
    assert!(page.contains("&lt;i&gt;Systems"));
    assert_eq!(page.matches("<tr><td").count(), 7);
}

#[test]
fn points_of_one_system_are_named_by_what_it_was_asked_for() {
    let lines = [4, 8].map(|spp| {
        let mut line = line(spp, "Samples of pixels", "mmrt", None, true);
        let image = line.cell.as_mut().and_then(|cell| cell.depends_on.image.as_mut());
        image.expect("an image").spp = spp;
        line
    });
    let page = page(&lines);
    let (_, plot) = page.split_once("image_ms-image.flip_mean").expect("speed against error");
    for name in ["\"name\":\"spp 4\"", "\"name\":\"spp 8\""] {
        assert!(plot.contains(name), "{name}");
    }
}

#[test]
fn a_single_run_has_a_table_and_no_plot() {
    let page = page(&lines()[..1]);
    assert!(page.contains("<tr><td") && !page.contains("plotly.js (basic"));
}

#[test]
fn the_plots_of_a_campaign_are_drawn() {
    let Some(browser) = browser() else {
        eprintln!("skipped: the_plots_of_a_campaign_are_drawn needs chromium or chrome on the path");
        return;
    };
    let visit = visit(&browser, &with_script(&page(&lines()), LOOK));
    assert_eq!(visit.complaints, Vec::<String>::new());
    let (areas, drawn) = (visit.probe("areas"), visit.probe("drawn"));
    assert_eq!((areas.as_str(), drawn.as_str()), ("10", "10"));
    assert_eq!((visit.probe("wide").as_str(), visit.probe("tables").as_str()), ("0", "7"));
}
