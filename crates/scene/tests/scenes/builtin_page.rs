//! Page of built-in scenes, compared with the scenes.

use rasray_scene::builtin::{NAMES, builtin};

#[test]
fn the_page_lists_every_scene_with_its_count_of_triangles() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/built-in-scenes.md");
    let page = std::fs::read_to_string(page).expect("the page of built-in scenes");
    // The first table of the page.
    let listed = page.split("\n## ").next().unwrap_or_default();
    let rows: Vec<Vec<&str>> = listed
        .lines()
        .filter_map(|line| line.strip_prefix("| `"))
        .map(|row| row.trim_end_matches(" |").split(" | ").collect())
        .collect();
    assert_eq!(rows.iter().map(|row| row[0].trim_end_matches('`')).collect::<Vec<_>>(), NAMES);
    for row in rows {
        let name = row[0].trim_end_matches('`');
        let scene = builtin(name).expect("built in").expect("it takes its defaults");
        let counts = scene.instances.iter().map(|instance| scene.meshes[instance.mesh].triangle_count());
        let listed = row[row.len() - 1].replace(',', "").parse::<usize>().ok();
        assert_eq!(listed, Some(counts.sum()), "{name}");
    }
}
