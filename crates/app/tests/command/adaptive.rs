//! More samples where there is more noise, as the command renders it.

use std::path::Path;

use exr::prelude::{FlatSamples, read_all_flat_layers_from_file};
use rasray_report::{AdaptiveRecord, Report, Run};

use crate::scripted::{rasray, stderr};

fn run(folder: &Path, line: &str) {
    let output = rasray(folder, line);
    assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
}

fn channel(folder: &Path, file: &str, name: &str) -> FlatSamples {
    let image = read_all_flat_layers_from_file(folder.join(file)).expect("an image");
    let channels = &image.layer_data[0].channel_data.list;
    channels.iter().find(|channel| channel.name.to_string() == name).expect("the channel").sample_data.clone()
}

fn floats(folder: &Path, file: &str, name: &str) -> Vec<f32> {
    match channel(folder, file, name) {
        FlatSamples::F32(values) => values,
        other => panic!("{name}: {other:?}"),
    }
}

fn counts(folder: &Path, file: &str) -> Vec<u32> {
    match channel(folder, file, "samples") {
        FlatSamples::U32(values) => values,
        other => panic!("samples: {other:?}"),
    }
}

fn only_run(folder: &Path, file: &str) -> Run {
    let text = std::fs::read_to_string(folder.join(file)).expect("a report");
    let mut report: Report = serde_json::from_str(&text).expect("a report");
    report.runs.pop().expect("a run")
}

#[test]
fn numbers_of_samples_are_kept_and_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let image = "render cornell --size 16x12 --bounces 1 --aov samples --validation";
    let adaptive = "--spp 8 --adaptive 0.2 --least-samples 4";
    run(folder, &format!("{image} {adaptive} --report r.json --output a.exr"));
    let samples = counts(folder, "a.exr");
    let [least, most] = [samples.iter().min(), samples.iter().max()].map(|count| *count.expect("pixels"));
    assert!(least == 4 && most > 4, "{least} to {most}");
    let run_of = only_run(folder, "r.json");
    let mean = f64::from(samples.iter().sum::<u32>()) / samples.len() as f64;
    let expected =
        AdaptiveRecord { threshold: 0.2, least_samples: 4, samples_mean: mean, samples_most: most };
    assert_eq!((run_of.adaptive, run_of.spp), (Some(expected), Some(8)));

    // Pixels with all samples are those of the plain image, whose numbers of samples are all the same.
    run(folder, &format!("{image} --spp 8 --report plain.json --output plain.exr"));
    assert_eq!(counts(folder, "plain.exr"), vec![8; samples.len()]);
    assert_eq!(only_run(folder, "plain.json").adaptive, None);
    let (found, plain) = (floats(folder, "a.exr", "G"), floats(folder, "plain.exr", "G"));
    let with_all = (0..samples.len()).filter(|pixel| samples[*pixel] == 8);
    let same = with_all.clone().filter(|pixel| found[*pixel] == plain[*pixel]).count();
    assert_eq!(same, with_all.count());
    assert_ne!(found, plain, "pixels with fewer");
}

/// Kernels and film stay from frame to frame; each has numbers of its own.
#[test]
fn frames_are_the_pictures_of_their_times() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let image = "render walker:8k --size 24x16 --spp 6 --adaptive 0.2 --least-samples 3 --integrator ao --aov samples";
    run(folder, &format!("{image} --frames 0-1 --fps 2 --output f#.exr"));
    run(folder, &format!("{image} --time 0.5 --output one.exr"));
    for name in ["R", "G", "B"] {
        assert_eq!(floats(folder, "f1.exr", name), floats(folder, "one.exr", name));
    }
    assert_eq!(counts(folder, "f1.exr"), counts(folder, "one.exr"));
    assert_ne!(counts(folder, "f0.exr"), counts(folder, "one.exr"));
}
