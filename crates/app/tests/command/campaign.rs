//! Plans of many comparisons: stopped, resumed, divided and merged, their pages are those of one process.

use rasray_report::Report;

use crate::scripted::{done, entries, read, scripted, stderr};

const PLAN: &str = r#"
title = "Two things"
[common]
rays = 100
repetitions = 1
ray-set = ["incoherent", "camera"]
[[experiment]]
name = "Storages"
scene = ["cornell", "spheres:10k"]
systems = ["mmrt", "bvh"]
"mmrt.storage" = ["ll", "sb"]
exclude = [{ scene = "cornell", system = "bvh" }]
[[experiment]]
name = "Seeds"
scene = "cornell"
systems = "mmrt"
"mmrt.storage" = ["ll", "sb"]
seed = [1, 2]
small = { seed = 1 }
"#;

/// A folder with a plan.
fn planned() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("plan.toml"), PLAN).expect("a plan");
    folder
}

const PAGES: [&str; 3] = ["table.csv", "report.md", "report.html"];

#[test]
fn a_plan_is_made_once_a_cell_and_shown_by_experiment() {
    let folder = planned();
    let folder = folder.path();
    let said = done(folder, "ablate plan.toml --output out");
    assert!(said.contains("holds 14 of 14 cells"), "{said}");
    let lines: Vec<Report> = read(folder, "out/cells.jsonl")
        .lines()
        .map(|line| serde_json::from_str(line).expect("a report"))
        .collect();
    // Cornell has no tree, and with the first seed serves both experiments.
    let shape: Vec<_> = lines
        .iter()
        .map(|line| {
            let cell = line.cell.as_ref().expect("a cell");
            let campaign = cell.campaign.as_ref().expect("of a campaign");
            (cell.depends_on.scene.as_str(), cell.depends_on.system.as_str(), campaign.experiments.len())
        })
        .collect();
    let spheres = |system| ("spheres:10k", system, 1);
    let set = [spheres("mmrt"), spheres("mmrt"), spheres("bvh")];
    let cornell = |shown| [("cornell", "mmrt", shown); 4];
    let all: Vec<_> = cornell(2).into_iter().chain(set).chain(set).chain(cornell(1)).collect();
    assert_eq!(shape, all);
    let page = read(folder, "out/report.md");
    assert!(
        page.starts_with("# Two things\n") && page.contains("## Storages\n") && page.contains("## Seeds\n"),
        "{page}"
    );
    let table = read(folder, "out/table.csv");
    assert_eq!(table.lines().count(), 1 + 10 + 8, "{table}");
    assert!(table.starts_with("experiment,key,scene,camera,size,"), "{table}");
    let page = read(folder, "out/report.html");
    assert!(page.contains("Two things") && page.contains("<h2>Seeds</h2>"));
    let said = done(folder, "ablate plan.toml --small --output small");
    assert!(said.contains("holds 10 of 10 cells"), "{said}");
}

#[test]
fn killed_twice_or_divided_by_three_the_pages_are_the_same_bytes() {
    let folder = planned();
    let folder = folder.path();
    done(folder, "ablate plan.toml --output whole");
    let text = read(folder, "whole/cells.jsonl");
    let ends: Vec<_> = text.match_indices('\n').map(|(end, _)| end + 1).collect();
    std::fs::create_dir(folder.join("killed")).expect("a folder");
    for (lines, torn) in [(3, 200), (9, 0)] {
        std::fs::write(folder.join("killed/cells.jsonl"), &text[..ends[lines - 1] + torn]).expect("a file");
        let said = done(folder, "ablate plan.toml --output killed --resume");
        assert!(said.contains(&format!("{lines} of 14 runs are there already")), "{said}");
    }
    for share in 1..=3 {
        done(folder, &format!("ablate plan.toml --output parts --shard {share}/3"));
    }
    let parts = [1, 2, 3].map(|share| format!("parts/cells.{share}-of-3.jsonl")).join(" ");
    for page in PAGES.into_iter().chain(["cells.jsonl"]) {
        done(folder, &format!("merge parts/{page} {parts}"));
    }
    for page in PAGES {
        let whole = read(folder, &format!("whole/{page}"));
        assert_eq!(read(folder, &format!("killed/{page}")), whole, "{page}");
        assert_eq!(read(folder, &format!("parts/{page}")), whole, "{page}");
    }
    // Where cells were merged, a command with the plan makes nothing but pages.
    std::fs::remove_file(folder.join("parts/report.md")).expect("it is there");
    let said = done(folder, "ablate plan.toml --output parts --resume");
    assert!(said.contains("14 of 14 runs are there already, 0 are made"), "{said}");
    assert_eq!(read(folder, "parts/report.md"), read(folder, "whole/report.md"));
}

#[test]
fn a_dry_run_says_what_would_be_made_and_makes_nothing() {
    let folder = planned();
    let folder = folder.path();
    let before = entries(folder);
    let output = scripted(folder, "ablate plan.toml --output out --dry-run");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("cornell mmrt storage=ll incoherent seed=1  [Storages; Seeds]"), "{text}");
    assert!(text.contains("14 runs of 14: 2800 rays") && text.contains("14 runs by"), "{text}");
    assert_eq!(entries(folder), before);
    done(folder, "ablate plan.toml --output out --shard 1/3");
    std::fs::rename(folder.join("out/cells.1-of-3.jsonl"), folder.join("out/cells.jsonl"))
        .expect("one share");
    let output = scripted(folder, "ablate plan.toml --output out --dry-run");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("9 runs of 14: 1800 rays") && !text.contains("    0  "), "{text}");
}

#[test]
fn what_is_wrong_with_a_plan_is_named_with_its_experiment() {
    let folder = planned();
    let folder = folder.path();
    let before = entries(folder);
    let with = |from: &str, to: &str| {
        assert!(PLAN.contains(from));
        PLAN.replacen(from, to, 1)
    };
    for (plan, says) in [
        (with("\"mmrt\", \"bvh\"", "\"none\""), "experiment 'Storages': "),
        (with("seed = [1, 2]", "sed = [1, 2]"), "experiment 'Seeds': "),
        (with("rays = 100", "rays = 0"), "experiment 'Storages': "),
        (with("seed = [1, 2]", "seed = 1\nscene = 3"), "duplicate key"),
        (with("\"spheres:10k\"", "\"hard:E5\""), "a plan has no hard cases"),
        (with("\"spheres:10k\"", "\"nothing.glb\""), "nothing.glb"),
        (with("system = \"bvh\"", "sistem = \"bvh\""), "excludes by 'sistem'"),
        (with("scene = \"cornell\", system = \"bvh\"", "rays = 100"), "'Storages' excludes all of its runs"),
        (with("name = \"Seeds\"", "name = \"Storages\""), "two experiments"),
        (with("title =", "title"), "TOML parse error"),
    ] {
        std::fs::write(folder.join("plan.toml"), &plan).expect("a plan");
        let output = scripted(folder, "ablate plan.toml --output out");
        assert_eq!(output.status.code(), Some(2), "{says}: {}", stderr(&output));
        assert!(
            stderr(&output).contains("plan.toml: ") && stderr(&output).contains(says),
            "{}",
            stderr(&output)
        );
        assert!(stderr(&output).contains("help: "), "{}", stderr(&output));
        assert!(!folder.join("out/cells.jsonl").exists());
    }
    let output = scripted(folder, "ablate none.toml --output out");
    assert_eq!((output.status.code(), stderr(&output).contains("none.toml")), (Some(2), true));
    _ = std::fs::remove_dir(folder.join("out"));
    assert_eq!(entries(folder), before);
}

#[test]
fn an_exclusion_that_leaves_out_nothing_is_named() {
    let folder = planned();
    let folder = folder.path();
    let said = done(folder, "ablate plan.toml --output out --dry-run");
    assert!(!said.contains("excludes"), "{said}");
    let plan = PLAN.replace("scene = \"cornell\", system = \"bvh\"", "scene = \"cornel\", system = \"bvh\"");
    std::fs::write(folder.join("plan.toml"), plan).expect("a plan");
    let said = done(folder, "ablate plan.toml --output out --dry-run");
    assert!(said.contains("'Storages' excludes { scene = cornel, system = bvh }"), "{said}");
}

#[test]
fn plans_are_what_help_and_page_show() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let help = scripted(folder, "ablate --help").stdout;
    let help = String::from_utf8_lossy(&help).into_owned();
    let shown: Vec<_> = help
        .lines()
        .skip_while(|line| line.trim() != "[[experiment]]")
        .take_while(|line| !line.trim().is_empty())
        .collect();
    let page = include_str!("../../../../docs/campaigns.md");
    let (_, page) = page.split_once("```toml\n").expect("a plan");
    let (page, _) = page.split_once("```").expect("its end");
    for (plan, runs) in [(shown.join("\n"), "8 runs of 8"), (page.to_owned(), "77 runs of 77")] {
        std::fs::write(folder.join("plan.toml"), &plan).expect("a plan");
        let output = scripted(folder, "ablate plan.toml --output out --dry-run");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(0), "{plan}: {}", stderr(&output));
        assert!(text.contains(runs), "{plan}: {text}");
        // Settings that all images have in common tell none apart.
        assert!(!text.contains("sampler="), "{text}");
    }
}

#[test]
fn items_of_a_paper_are_listed_and_made_beside_its_numbers() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let output = scripted(folder, "replicate --list");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        text.matches("table1").count() == 5 && text.contains("selective") && text.contains("fig12"),
        "{text}"
    );
    done(folder, "replicate ldc table1 --small --output out");
    let page = read(folder, "out/ldc.md");
    for words in ["## table1: ", "| build, 1024 over 512, Bunny | 2.71 |", "rasray replicate ldc table1"] {
        assert!(page.contains(words), "{words}: {page}");
    }
    assert_eq!(entries(&folder.join("out")).iter().filter(|name| name.ends_with(".png")).count(), 0);
    let said = done(folder, "replicate ldc fig1 --small --output pictures");
    assert!(!said.contains("warning"), "{said}");
    let page = read(folder, "pictures/ldc.md");
    assert!(page.contains("](ldc-fig1.png)") && page.contains("| reference"), "{page}");
    assert!(page.contains("25.0 %"), "{page}");
    let sheet = image::open(folder.join("pictures/ldc-fig1.png")).expect("a picture").into_rgb8();
    assert_eq!(
        (sheet.width(), sheet.get_pixel(10, 10).0, sheet.get_pixel(1, 1).0),
        (1172, [188; 3], [255; 3])
    );
    let kept = entries(&folder.join("pictures/pictures"));
    assert!(kept.len() >= 4 && kept.iter().all(|name| name.len() == 64 + 4), "{kept:?}");
    std::fs::remove_file(folder.join("pictures/pictures").join(&kept[0])).expect("a picture");
    let said = done(folder, "replicate ldc fig1 --small --output pictures --resume");
    assert!(said.contains(&format!("1 of {} pictures of ldc-fig1.png", kept.len())), "{said}");
    let output = scripted(folder, "replicate ldc fig99 --output out");
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("no item 'fig99' in ldc") && stderr(&output).contains("table1"),
        "{}",
        stderr(&output)
    );
    let output = scripted(folder, "replicate ldc table1");
    assert_eq!((output.status.code(), stderr(&output).contains("--output")), (Some(2), true));
}
