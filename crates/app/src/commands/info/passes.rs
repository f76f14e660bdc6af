//! Text of the commands that a structure records for a scene, pass by pass.

use rasray_experiment::PassCommands;
use rasray_report::{columns, grouped};
use serde_json::{Value, json};

pub(super) fn passes_json(passes: &[PassCommands]) -> Value {
    let rows = passes.iter().map(|pass| {
        json!({
            "label": pass.label,
            "stage": pass.stage.name(),
            "dispatches": pass.dispatches,
            "workgroups": pass.workgroups,
            "indirect": pass.indirect,
            "draws": pass.draws,
            "vertices": pass.vertices,
            "transfers": pass.transfers,
            "trees": pass.trees,
        })
    });
    json!({ "passes": rows.collect::<Vec<_>>() })
}

pub(super) fn passes_text(passes: &[PassCommands]) -> String {
    let head =
        ["pass", "stage", "dispatches", "workgroups", "indirect", "draws", "vertices", "transfers", "trees"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    rows.extend(passes.iter().map(|pass| {
        let counts = [
            pass.dispatches.into(),
            pass.workgroups,
            pass.indirect.into(),
            pass.draws.into(),
            pass.vertices,
            pass.transfers.into(),
            pass.trees.into(),
        ];
        let shown = counts.iter().map(|count| if *count == 0 { String::new() } else { grouped(*count) });
        [pass.label.clone(), pass.stage.to_string()].into_iter().chain(shown).collect()
    }));
    columns(&rows, 1)
}
