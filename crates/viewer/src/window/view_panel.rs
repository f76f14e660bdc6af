//! Controls of the picture: its view, its light, its camera and its time.

use egui::{Color32, DragValue, Slider};
use rasray_experiment::INTEGRATORS;
use rasray_metrics::ToneCurve;
use rasray_report::colour_scale::{Scale, colour};

use super::picture_area::PictureArea;
use crate::camera_control::Side;
use crate::picture::{Legend, Pixels};
use crate::picture_view::PictureView;
use crate::session::Session;
use crate::settings::Shown;

/// Shows the controls of the picture's subject and of its place in the window.
pub(super) fn show_view(ui: &mut egui::Ui, session: &mut Session, area: &mut PictureArea, now: f64) {
    egui::Grid::new("view").num_columns(2).show(ui, |ui| {
        ui.label("Show");
        ui.horizontal(|ui| {
            egui::ComboBox::from_id_salt("shown").selected_text(session.shown.name()).show_ui(ui, |ui| {
                for shown in Shown::ALL {
                    ui.selectable_value(&mut session.shown, shown, shown.name()).on_hover_text(shown.doc());
                }
            });
            ui.label("tone");
            let tone = &mut session.tone.curve;
            egui::ComboBox::from_id_salt("tone").width(70.0).selected_text(tone.name()).show_ui(ui, |ui| {
                for curve in ToneCurve::ALL {
                    ui.selectable_value(tone, curve, curve.name()).on_hover_text(curve.doc());
                }
            });
        });
        ui.end_row();
        show_legend(ui, session);
        ui.label("Exposure");
        ui.add(Slider::new(&mut session.tone.exposure, -8.0..=8.0).step_by(0.25).suffix(" stops"));
        ui.end_row();
        ui.label("Light");
        show_integrator(ui, session);
        ui.end_row();
        ui.label("Samples");
        ui.horizontal(|ui| {
            ui.add(DragValue::new(&mut session.frame.spp).range(1..=1_048_576).speed(1.0));
            let doc = "Takes what noise is left out of the picture, with the library Open Image Denoise where it is installed";
            ui.checkbox(&mut session.denoised, "denoise").on_hover_text(doc);
        });
        ui.end_row();
        ui.label("Size");
        ui.horizontal(|ui| {
            ui.add(DragValue::new(&mut session.frame.width).range(1..=8192).speed(2.0));
            ui.label("x");
            ui.add(DragValue::new(&mut session.frame.height).range(1..=8192).speed(2.0));
            if ui.small_button("window").on_hover_text("As many pixels as the window has for it").clicked() {
                let [width, height] = area.pixels.map(|side| side.min(8192));
                (session.frame.width, session.frame.height) = (width, height);
            }
        });
        ui.end_row();
        ui.label("Zoom").on_hover_text("Scale of the picture in the window; the size stays what is saved");
        ui.horizontal(|ui| show_zoom(ui, area));
        ui.end_row();
        ui.label("Camera");
        show_cameras(ui, session, now);
        ui.end_row();
        show_lens(ui, session, now);
    });
}

fn show_zoom(ui: &mut egui::Ui, area: &mut PictureArea) {
    let view = &mut area.view;
    if ui.selectable_label(view.is_fitted(), "fit").on_hover_text("Key Z").clicked() {
        view.fit();
    }
    let is_one = *view == PictureView::at_one_to_one();
    if ui.selectable_label(is_one, "1:1").on_hover_text("Key Z").clicked() {
        *view = PictureView::at_one_to_one();
    }
    if let Some(scale) = view.chosen_scale() {
        ui.weak(format!("{:.0} %", 100.0 * scale));
    }
}

fn show_cameras(ui: &mut egui::Ui, session: &mut Session, now: f64) {
    let names: Vec<String> = session.cameras().map(str::to_owned).collect();
    let chosen = session.chosen_camera();
    let text = match chosen.and_then(|place| names.get(place)) {
        Some(name) => name.as_str(),
        None if session.is_camera_moved() => "moved",
        None => "as at first",
    };
    ui.horizontal(|ui| {
        egui::ComboBox::from_id_salt("camera").selected_text(text).show_ui(ui, |ui| {
            let is_first = chosen.is_none() && !session.is_camera_moved();
            if ui.selectable_label(is_first, "as at first").on_hover_text("Key R").clicked() {
                session.reset_camera();
            }
            for (place, name) in names.iter().enumerate() {
                if ui.selectable_label(chosen == Some(place), name).clicked() {
                    session.choose_camera(place);
                }
            }
            let doc = "From where a scene without cameras is seen";
            if ui.selectable_label(false, "default").on_hover_text(doc).clicked() {
                session.choose_default_camera();
            }
            ui.separator();
            for side in Side::ALL {
                if ui.selectable_label(false, side.name()).clicked() {
                    session.view_along(side, now);
                }
            }
        });
        if ui.small_button("see all").on_hover_text("Key F").clicked() {
            session.frame_all(now);
        }
    });
}

fn show_lens(ui: &mut egui::Ui, session: &mut Session, now: f64) {
    let Some(mut lens) = session.lens() else { return };
    let before = lens;
    ui.label("Aperture").on_hover_text("Diameter of the lens's opening; 0 is a pinhole");
    let speed = 0.0005 * session.radius();
    ui.add(
        DragValue::new(&mut lens.aperture).range(0.0..=f32::MAX).speed(speed).max_decimals(5).suffix(" m"),
    );
    ui.end_row();
    if lens.aperture > 0.0 {
        ui.label("Focus").on_hover_text("Distance of the plane in focus, along the view");
        let speed = 0.01 * f64::from(lens.focus);
        ui.add(
            DragValue::new(&mut lens.focus)
                .range(f32::MIN_POSITIVE..=f32::MAX)
                .speed(speed)
                .max_decimals(4)
                .suffix(" m"),
        );
        ui.end_row();
    }
    if lens != before {
        session.set_lens(lens, now);
    }
}

fn show_legend(ui: &mut egui::Ui, session: &Session) {
    let Some(picture) = &session.picture else { return };
    if let Pixels::Map(_, legend) = &picture.pixels {
        ui.weak("Scale");
        ui.vertical(|ui| {
            ui.horizontal(|ui| {
                ui.label("0");
                show_colours(ui, legend.colours);
                ui.label(Legend::shown(legend.bright));
            });
            ui.weak(format!("{}\n{}", legend.extent(), legend.unit));
        });
        ui.end_row();
    }
}

/// Shows a bar of the colours of a scale, the darkest on the left.
fn show_colours(ui: &mut egui::Ui, scale: &Scale) {
    let (bar, _) = ui.allocate_exact_size(egui::vec2(120.0, 12.0), egui::Sense::hover());
    let count = (bar.width() as usize).max(1);
    for column in 0..count {
        let [red, green, blue] = colour(scale, column as f64 / (count - 1).max(1) as f64);
        let left = bar.left_top() + egui::vec2(column as f32, 0.0);
        let column = egui::Rect::from_min_size(left, egui::vec2(1.0, bar.height()));
        ui.painter().rect_filled(column, 0.0, Color32::from_rgb(red, green, blue));
    }
}

fn show_integrator(ui: &mut egui::Ui, session: &mut Session) {
    let integrator = &mut session.frame.integrator;
    egui::ComboBox::from_id_salt("integrator").width(70.0).selected_text(integrator.name()).show_ui(
        ui,
        |ui| {
            for row in INTEGRATORS {
                let is_chosen = row == integrator.row();
                if ui.selectable_label(is_chosen, row.name).on_hover_text(row.doc).clicked() && !is_chosen {
                    *integrator = row.into();
                }
            }
        },
    );
}

/// Shows the time of a scene that moves.
pub(super) fn show_time(ui: &mut egui::Ui, session: &mut Session, now: f64) {
    ui.horizontal(|ui| {
        let word = if session.playback.playing { "Pause" } else { "Play" };
        if ui.button(word).on_hover_text("Space").clicked() {
            session.playback.toggle();
        }
        ui.add(DragValue::new(&mut session.playback.speed).range(-8.0..=8.0).speed(0.02).prefix("speed "));
        if ui.button("At rest").on_hover_text("As the file places everything").clicked() {
            session.playback.rest();
        }
    });
    let mut seconds = session.playback.shown().unwrap_or(0.0);
    let slider = Slider::new(&mut seconds, 0.0..=session.playback.duration()).step_by(0.001).suffix(" s");
    if ui.add(slider).changed() {
        session.seek(seconds, now);
    }
}
