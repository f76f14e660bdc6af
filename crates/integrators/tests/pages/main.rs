//! The page of integrators, `docs/integrators.md`, must match the registry. `RASRAY_WRITE_PAGES=1` writes it.

use std::fmt::Write as _;
use std::path::Path;

use rasray_integrators::{INTEGRATORS, RayKind, integrator_options};

fn page() -> String {
    let mut page = String::from(
        "# Integrators\n\n\
         Every integrator of the command's `--integrator` and every option that one has, from the rows of\n\
         `crates/integrators/src/registry.rs`. What they compute is in [shading](shading.md), and of\n\
         [`whitted`](whitted.md), [`photons`](photons.md) and [`cube-map`](cube-map.md) on pages of their own. Each has a\n\
         naive one of its name in `rasray_reference::integrators`, to which its images are held. This page is made by\n\
         `RASRAY_WRITE_PAGES=1 cargo test -p rasray-integrators --test all -- pages::`.\n\n\
         | integrator | says | rays |\n|---|---|---|\n",
    );
    for row in INTEGRATORS {
        let rays: Vec<_> = row.rays.iter().copied().map(RayKind::name).collect();
        let _ = writeln!(page, "| `{}` | {} | {} |", row.name, row.doc, rays.join(", "));
    }
    page += "\n| option | says | values | default | integrators |\n|---|---|---|---|---|\n";
    for row in integrator_options() {
        let having = INTEGRATORS.iter().filter(|integrator| integrator.option(row.name).is_some());
        let having: Vec<_> = having.map(|integrator| integrator.name).collect();
        let default = row.default.map_or_else(String::new, |value| format!("`{value}`"));
        let (values, having) = (row.values.in_markdown(), having.join(", "));
        let _ = writeln!(page, "| `{}` | {} | {values} | {default} | {having} |", row.name, row.doc);
    }
    page
}

#[test]
fn the_page_of_integrators_is_that_of_the_rows() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/integrators.md");
    if std::env::var_os("RASRAY_WRITE_PAGES").is_some() {
        std::fs::write(&path, page()).expect("the page can be written");
        return;
    }
    let written = std::fs::read_to_string(&path).expect("there is a page of integrators");
    assert!(
        written == page(),
        "docs/integrators.md is not what the rows say: write it with RASRAY_WRITE_PAGES=1"
    );
}
