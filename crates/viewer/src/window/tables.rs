//! Tables of the times of passes and of the bytes of parts.

use rasray_report::{bytes, duration, grouped};

use crate::picture::Picture;

/// Shows the costs of a picture.
pub(super) fn show_tables(ui: &mut egui::Ui, picture: &Picture) {
    let total: f64 = picture.passes.iter().map(|pass| pass.ms_median).sum();
    let title = format!("Times of passes ({})", duration(total));
    egui::CollapsingHeader::new(title).id_salt("times").show(ui, |ui| {
        ui.weak(
            "All dispatches of a pass together, of the build and of all samples so far; those of the first build with what \
             the driver compiled.",
        );
        egui::Grid::new("times").num_columns(4).striped(true).show(ui, |ui| {
            ui.strong("pass");
            ui.strong("stage");
            ui.strong("ms");
            ui.strong("times");
            ui.end_row();
            for pass in &picture.passes {
                ui.label(&pass.label);
                ui.label(pass.stage.as_deref().unwrap_or_default());
                ui.monospace(format!("{:9.3}", pass.ms_median));
                ui.monospace(grouped(pass.dispatches.unwrap_or(1)));
                ui.end_row();
            }
        });
    });
    let parts = &picture.memory.by_part;
    let title = format!("Memory ({})", bytes(parts.values().sum()));
    egui::CollapsingHeader::new(title).id_salt("memory").show(ui, |ui| {
        egui::Grid::new("memory").num_columns(2).striped(true).show(ui, |ui| {
            for (part, count) in parts {
                ui.label(part);
                ui.monospace(bytes(*count));
                ui.end_row();
            }
            if let Some(peak) = picture.memory.device_peak_bytes {
                ui.strong("most at a time");
                ui.monospace(bytes(peak));
                ui.end_row();
            }
        });
    });
    let (options, paths) = &picture.resolved;
    ui.collapsing("In force", |ui| {
        egui::Grid::new("resolved").num_columns(2).striped(true).show(ui, |ui| {
            for (name, value) in options {
                ui.label(name);
                ui.monospace(value.as_str().map_or_else(|| value.to_string(), str::to_owned));
                ui.end_row();
            }
            for (name, value) in paths {
                ui.label(name);
                ui.monospace(value);
                ui.end_row();
            }
        });
    });
}
