//! What stands next to the picture, and keys.

use std::path::PathBuf;

use egui::{Color32, DragValue, Key, Modifiers, RichText, Slider};
use rasray_experiment::INTEGRATORS;
use rasray_report::colour_scale::{Scale, colour};

use super::options_panel::{show_integrator_options, show_system};
use super::picture_area::PictureArea;
use super::saving::{SavePicture, SavedPicture};
use super::tables::show_tables;
use crate::picture::{Legend, Pixels};
use crate::session::Session;
use crate::settings::Shown;

/// Width of the panel, points.
const WIDTH: f32 = 330.0;

/// Keys and what they do.
const KEYS: &[(&str, &str)] = &[
    ("left drag", "turn around the scene"),
    ("right drag", "look around"),
    ("middle drag, Shift+left drag", "move sideways"),
    ("wheel", "nearer, farther"),
    ("W A S D, E Q", "fly, up and down; with Shift faster"),
    ("R", "camera as at first"),
    ("Space", "play, pause"),
    ("P", "save the picture"),
    ("C", "copy the command line"),
    ("H", "hide or show this panel"),
    ("Ctrl+Q", "close"),
];

/// The inner size of a window for a picture of this size, points.
pub(super) fn window_size([width, height]: [u32; 2]) -> [f32; 2] {
    [(width as f32).clamp(320.0, 1500.0) + WIDTH, (height as f32).clamp(560.0, 1000.0)]
}

/// Text that is easy to read, on dark.
pub(super) fn set_style(context: &egui::Context) {
    context.set_theme(egui::Theme::Dark);
    context.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(6.0, 5.0);
        style.spacing.slider_width = 130.0;
        style.visuals.override_text_color = Some(Color32::from_gray(225));
        style.interaction.tooltip_delay = 0.3;
    });
}

/// The panel and what it remembers of a window.
pub(super) struct Panel {
    area: PictureArea,
    is_open: bool,
    /// What was said of the last picture that was saved, and whether it is an error.
    said: Option<(String, bool)>,
    /// Whether a key asked for the end.
    pub(super) wants_to_close: bool,
}

impl Default for Panel {
    fn default() -> Self {
        Self { area: PictureArea::default(), is_open: true, said: None, wants_to_close: false }
    }
}

impl Panel {
    /// Shows panel and picture of a frame. `now` and `elapsed` in seconds.
    pub(super) fn show(
        &mut self,
        ui: &mut egui::Ui,
        session: &mut Session,
        now: f64,
        elapsed: f64,
        save: &mut SavePicture<'_>,
    ) {
        self.take_keys(ui.ctx(), session, save);
        if self.is_open {
            egui::Panel::right("panel").resizable(true).default_size(WIDTH).show(ui, |ui| {
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    self.contents(ui, session, now, save);
                });
            });
        }
        self.area.show(ui, session, now, elapsed);
    }

    fn take_keys(&mut self, context: &egui::Context, session: &mut Session, save: &mut SavePicture<'_>) {
        let pressed = |key| context.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if context.input_mut(|input| input.consume_key(Modifiers::COMMAND, Key::Q)) {
            self.wants_to_close = true;
        }
        if context.egui_wants_keyboard_input() {
            return;
        }
        if pressed(Key::H) {
            self.is_open = !self.is_open;
        }
        if pressed(Key::Space) {
            session.playback.toggle();
        }
        if pressed(Key::R) {
            session.reset_camera();
        }
        if pressed(Key::P) {
            self.save(session, save);
        }
        if pressed(Key::C)
            && let Some(line) = command_line(session)
        {
            context.copy_text(line);
            self.said = Some(("the command line is on the clipboard".to_owned(), false));
        }
    }

    fn contents(&mut self, ui: &mut egui::Ui, session: &mut Session, now: f64, save: &mut SavePicture<'_>) {
        ui.add_space(4.0);
        ui.label(RichText::new(session.scene_name()).heading().strong());
        show_state(ui, session);
        ui.separator();
        show_view(ui, session, now);
        if session.playback.can_play() {
            ui.separator();
            show_time(ui, session, now);
        }
        ui.separator();
        show_system(ui, session);
        show_integrator_options(ui, session);
        ui.separator();
        self.show_saving(ui, session, save);
        ui.separator();
        if let Some(picture) = &session.picture {
            show_tables(ui, picture);
        }
        ui.collapsing("Keys", |ui| {
            egui::Grid::new("keys").num_columns(2).show(ui, |ui| {
                for (key, does) in KEYS {
                    ui.strong(*key);
                    ui.label(*does);
                    ui.end_row();
                }
            });
        });
    }

    fn show_saving(&mut self, ui: &mut egui::Ui, session: &mut Session, save: &mut SavePicture<'_>) {
        ui.horizontal(|ui| {
            if ui.button("Save picture").on_hover_text("Key P").clicked() {
                self.save(session, save);
            }
            if ui.button("Copy command line").on_hover_text("Key C").clicked()
                && let Some(line) = command_line(session)
            {
                ui.ctx().copy_text(line);
                self.said = Some(("the command line is on the clipboard".to_owned(), false));
            }
        });
        if let Some((text, is_error)) = &self.said {
            let colour = if *is_error { ui.visuals().error_fg_color } else { Color32::LIGHT_GREEN };
            ui.colored_label(colour, text);
        }
        if let Some(line) = command_line(session) {
            ui.collapsing("Command line of this picture", |ui| {
                ui.add(egui::Label::new(RichText::new(line).monospace().small()).wrap().selectable(true));
            });
        }
    }

    fn save(&mut self, session: &Session, save: &mut SavePicture<'_>) {
        let Some(picture) = session.picture.as_ref().filter(|picture| !picture.settings.moving) else {
            self.said = Some(("there is no whole picture yet".to_owned(), true));
            return;
        };
        let place = next_place(session);
        let line = command_line(session);
        let saved = SavedPicture {
            place: &place,
            size: [picture.width, picture.height],
            pixels: &picture.pixels.bytes(session.exposure),
            command_line: line.as_deref(),
            scale: match &picture.pixels {
                Pixels::Map(_, legend) => Some(legend.described()),
                Pixels::Radiance(_) => None,
            },
            is_finished: picture.is_finished(),
        };
        self.said = Some(match save(&saved) {
            Ok(()) if picture.is_finished() => (format!("saved {}", place.display()), false),
            Ok(()) => {
                let wanted = picture.settings.frame.spp;
                // Of maps there is no command line.
                let finished = if line.is_some() { ": the command line makes the finished one" } else { "" };
                let (place, samples) = (place.display(), picture.samples);
                (format!("saved {place} with {samples} of {wanted} samples{finished}"), false)
            }
            Err(error) => (error, true),
        });
    }
}

fn next_place(session: &Session) -> PathBuf {
    session.place_for_picture(|place| place.exists())
}

/// The command line of the picture that is shown; of maps there is none.
fn command_line(session: &Session) -> Option<String> {
    let picture = session.picture.as_ref().filter(|picture| matches!(picture.pixels, Pixels::Radiance(_)))?;
    Some(session.command_line(&picture.settings, &next_place(session)))
}

fn show_state(ui: &mut egui::Ui, session: &Session) {
    if let Some(failure) = session.failure() {
        ui.colored_label(ui.visuals().error_fg_color, &failure.message);
        if !failure.help.is_empty() {
            ui.colored_label(ui.visuals().warn_fg_color, &failure.help);
        }
        if session.picture.is_some() {
            ui.weak("The last complete picture is shown.");
        }
        return;
    }
    ui.horizontal(|ui| {
        if let Some(status) = &session.status {
            ui.spinner();
            ui.label(status);
        } else if let Some(picture) = &session.picture {
            let (done, wanted) = (picture.samples, picture.settings.frame.spp);
            let ms = picture.sample_ms;
            let size = format!("{}x{}", picture.width, picture.height);
            match picture.settings.shown {
                _ if picture.settings.moving => ui.label(format!("moving: {size}, {ms:.0} ms per sample")),
                shown if shown.is_work() => ui.label(format!("{size}, one ray per pixel")),
                _ => ui.label(format!("{size}, {done} of {wanted} samples, {ms:.0} ms each")),
            };
        }
    });
    if let Some(picture) = session.picture.as_ref().filter(|picture| picture.cut_rays > 0) {
        let text =
            format!("{} rays passed too many transparent surfaces: light is missing", picture.cut_rays);
        ui.colored_label(ui.visuals().warn_fg_color, text);
    }
}

fn show_view(ui: &mut egui::Ui, session: &mut Session, now: f64) {
    egui::Grid::new("view").num_columns(2).show(ui, |ui| {
        ui.label("Show");
        egui::ComboBox::from_id_salt("shown").selected_text(session.shown.name()).show_ui(ui, |ui| {
            for shown in Shown::ALL {
                ui.selectable_value(&mut session.shown, shown, shown.name()).on_hover_text(shown.doc());
            }
        });
        ui.end_row();
        show_legend(ui, session);
        ui.label("Exposure");
        ui.add(Slider::new(&mut session.exposure, -8.0..=8.0).step_by(0.25).suffix(" stops"));
        ui.end_row();
        ui.label("Light");
        show_integrator(ui, session);
        ui.end_row();
        ui.label("Samples");
        ui.add(DragValue::new(&mut session.frame.spp).range(1..=1_048_576).speed(1.0));
        ui.end_row();
        ui.label("Size");
        ui.horizontal(|ui| {
            ui.add(DragValue::new(&mut session.frame.width).range(1..=8192).speed(2.0));
            ui.label("x");
            ui.add(DragValue::new(&mut session.frame.height).range(1..=8192).speed(2.0));
        });
        ui.end_row();
        ui.label("Camera");
        if session.is_camera_moved() {
            if ui.button("As at first").on_hover_text("Key R").clicked() {
                session.reset_camera();
            }
        } else {
            ui.weak("as the command line says");
        }
        ui.end_row();
        show_lens(ui, session, now);
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

/// A bar of the colours of a scale, the darkest left.
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

fn show_time(ui: &mut egui::Ui, session: &mut Session, now: f64) {
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
