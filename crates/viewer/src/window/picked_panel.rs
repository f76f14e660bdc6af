//! Panel of a pick and the answer of each system.

use egui::RichText;

use crate::picked::{Answer, PickedHit};
use crate::session::Session;

/// Shows the pick, if there is one.
pub(super) fn show_picked(ui: &mut egui::Ui, session: &mut Session, now: f64) {
    let Some(picked) = session.picked() else { return };
    ui.separator();
    let hit = picked.hit().cloned();
    let (answers, awaited, [x, y]) = (picked.answers.clone(), picked.awaited, picked.pick.place);
    ui.strong(format!("Picked at pixel {x:.1}, {y:.1}"));
    if let Some(hit) = &hit {
        show_hit(ui, hit);
        ui.horizontal(|ui| {
            let turn = ui.button("Turn around it").on_hover_text("Key T");
            if turn.clicked() {
                session.turn_to_picked(now);
            }
            let is_open = session.lens().is_some_and(|lens| lens.aperture > 0.0);
            let focus = ui.add_enabled(is_open, egui::Button::new("Focus on it"));
            if focus.on_disabled_hover_text("A pinhole has everything in focus").clicked() {
                session.focus_on_picked(now);
            }
        });
    }
    egui::Grid::new("answers").num_columns(3).striped(true).show(ui, |ui| {
        for Answer { system, hit: answered } in &answers {
            ui.label(system);
            show_answer(ui, answered, hit.as_ref());
            ui.end_row();
        }
    });
    ui.horizontal(|ui| {
        if awaited > 0 {
            ui.spinner();
            ui.label(format!("{awaited} to come"));
        } else if answers.len() == 1 && ui.button("Trace through all systems").clicked() {
            session.pick_through_all();
        }
        if ui.small_button("Forget").clicked() {
            session.unpick();
        }
    });
}

fn show_hit(ui: &mut egui::Ui, hit: &PickedHit) {
    egui::Grid::new("hit").num_columns(2).show(ui, |ui| {
        let mut row = |name: &str, text: String| {
            ui.label(name);
            ui.label(RichText::new(text).monospace());
            ui.end_row();
        };
        match &hit.triangle {
            Some(triangle) => {
                row(
                    "triangle",
                    format!("{} ({} of {})", triangle.id, triangle.instance.1, triangle.instance.0),
                );
                row("material", triangle.material.clone());
            }
            None => row("triangle", "not kept by fragments".to_owned()),
        }
        row("depth", format!("{:.6} m", hit.depth));
        row("distance", format!("{:.6} m", hit.distance));
        let [x, y, z] = hit.point.to_array();
        row("point", format!("{x:.5}, {y:.5}, {z:.5}"));
    });
}

/// Shows depth and triangle of an answer, and the difference in depth to the system that is shown.
fn show_answer(ui: &mut egui::Ui, answer: &Result<Option<PickedHit>, String>, shown: Option<&PickedHit>) {
    match answer {
        Err(error) => {
            ui.colored_label(ui.visuals().error_fg_color, "no answer").on_hover_text(error);
        }
        Ok(None) => {
            ui.label("nothing");
        }
        Ok(Some(hit)) => {
            let off = shown.map_or(0.0, |shown| hit.depth - shown.depth);
            let by = if off == 0.0 { String::new() } else { format!(" ({off:+.1e})") };
            ui.monospace(format!("{:.5} m{by}", hit.depth));
            let id = hit.triangle.as_ref().map(|triangle| triangle.id.to_string());
            ui.monospace(id.unwrap_or_default());
        }
    }
}
