//! The panel next to the picture, and keys.

use std::path::PathBuf;

use egui::{Color32, Key, Modifiers, RichText};

use super::options_panel::{show_integrator_options, show_system};
use super::picked_panel::show_picked;
use super::picture_area::PictureArea;
use super::saving::{SavePicture, SavedPicture};
use super::tables::show_tables;
use super::view_panel::{show_time, show_view};
use crate::camera_control::Side;
use crate::picture::Pixels;
use crate::session::{Failure, Session};

/// Width of the panel, points.
const WIDTH: f32 = 330.0;

/// Time for which a notice about a key is shown, seconds.
const NOTICE: f64 = 5.0;

/// Keys and their actions.
const KEYS: &[(&str, &str)] = &[
    ("left drag", "turn around the scene"),
    ("right drag", "look around"),
    ("middle drag, Shift+left drag", "move sideways"),
    ("wheel", "nearer, farther"),
    ("W A S D, E Q", "fly, up and down; with Shift faster"),
    ("R", "camera as at first"),
    ("F, Home", "see everything"),
    ("1 3 7", "see the front, the right side, the top; with Ctrl the opposite"),
    ("Ctrl+wheel, + -", "picture larger, smaller"),
    ("Ctrl+drag", "move the picture"),
    ("Z", "picture fitted, one to one"),
    ("Ctrl+click, I", "pick what the pointer is on"),
    ("T", "turn around what was picked"),
    ("Space", "play, pause"),
    ("P", "save the picture"),
    ("C", "copy the command line"),
    ("Ctrl+O", "open a scene"),
    ("H", "hide or show this panel"),
    ("Ctrl+Q", "close"),
];

/// Keys of sides; with the command key the opposite side. Digits of both keyboards, by their places.
const SIDES: [(Key, [Side; 2]); 3] = [
    (Key::Num1, [Side::Front, Side::Back]),
    (Key::Num3, [Side::Right, Side::Left]),
    (Key::Num7, [Side::Top, Side::Bottom]),
];

/// Time of a frame of the window.
#[derive(Clone, Copy)]
pub(super) struct Moment {
    /// Seconds since the window was opened.
    pub(super) now: f64,
    /// Seconds since the last frame.
    pub(super) elapsed: f64,
    /// Frames of the window per second, once that is known.
    pub(super) frames: Option<f64>,
}

/// Message about the action of a key or a button.
struct Notice {
    text: String,
    is_error: bool,
    /// Time until which the message is shown, seconds.
    until: f64,
}

/// Returns the inner size of a window for a picture of this size, points.
pub(super) fn window_size([width, height]: [u32; 2]) -> [f32; 2] {
    [(width as f32).clamp(320.0, 1500.0) + WIDTH, (height as f32).clamp(560.0, 1000.0)]
}

/// Sets a style with text that is easy to read on a dark ground.
pub(super) fn set_style(context: &egui::Context) {
    context.set_theme(egui::Theme::Dark);
    context.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(6.0, 5.0);
        style.spacing.slider_width = 130.0;
        style.visuals.override_text_color = Some(Color32::from_gray(225));
        style.interaction.tooltip_delay = 0.3;
    });
}

/// Panel with its state.
pub(super) struct Panel {
    area: PictureArea,
    is_open: bool,
    notice: Option<Notice>,
    /// Name of a scene to be opened, as typed.
    typed: String,
    /// True if a key asked for the field of this name.
    wants_name: bool,
    /// True if a key asked for the end.
    pub(super) wants_to_close: bool,
}

impl Default for Panel {
    fn default() -> Self {
        Self {
            area: PictureArea::default(),
            is_open: true,
            notice: None,
            typed: String::new(),
            wants_name: false,
            wants_to_close: false,
        }
    }
}

impl Panel {
    /// Shows the panel and the picture in a frame.
    pub(super) fn show(
        &mut self,
        ui: &mut egui::Ui,
        session: &mut Session,
        moment: Moment,
        save: &mut SavePicture<'_>,
    ) {
        self.take_keys(ui.ctx(), session, moment.now, save);
        if self.is_open {
            egui::Panel::right("panel").resizable(true).default_size(WIDTH).show(ui, |ui| {
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    self.contents(ui, session, moment, save);
                });
            });
        }
        let place = ui.available_rect_before_wrap();
        self.area.show(ui, session, moment);
        self.show_notice(ui.ctx(), place, moment.now);
        show_not_opened(ui.ctx(), session, place);
    }

    /// Shows a notice on the picture, with or without the panel.
    fn show_notice(&mut self, context: &egui::Context, place: egui::Rect, now: f64) {
        let Some(Notice { text, is_error, until }) = &self.notice else { return };
        if now >= *until {
            self.notice = None;
            return;
        }
        context.request_repaint_after(std::time::Duration::from_secs_f64(until - now));
        let colour = if *is_error { Color32::from_rgb(255, 120, 110) } else { Color32::LIGHT_GREEN };
        over_picture(context, place, egui::Align2::LEFT_BOTTOM, |ui| {
            ui.colored_label(colour, text);
        });
    }

    fn say(&mut self, text: impl Into<String>, is_error: bool, now: f64) {
        self.notice = Some(Notice { text: text.into(), is_error, until: now + NOTICE });
    }

    fn copy(&mut self, context: &egui::Context, session: &Session, now: f64) {
        match command_line(session) {
            Some(line) => {
                context.copy_text(line);
                self.say("The command line is on the clipboard.", false, now);
            }
            None => self.say("There is no picture yet, and of maps there is no command line.", true, now),
        }
    }

    fn take_keys(
        &mut self,
        context: &egui::Context,
        session: &mut Session,
        now: f64,
        save: &mut SavePicture<'_>,
    ) {
        let pressed = |key| context.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let commanded = |key| context.input_mut(|input| input.consume_key(Modifiers::COMMAND, key));
        if commanded(Key::Q) {
            self.wants_to_close = true;
        }
        if commanded(Key::O) {
            (self.is_open, self.wants_name) = (true, true);
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
        if pressed(Key::F) || pressed(Key::Home) {
            session.frame_all(now);
        }
        for (key, [side, opposite]) in SIDES {
            match take_digit(context, key) {
                Some(false) => session.view_along(side, now),
                Some(true) => session.view_along(opposite, now),
                None => (),
            }
        }
        if pressed(Key::T) {
            session.turn_to_picked(now);
        }
        if pressed(Key::P) {
            self.save(session, now, save);
        }
        if pressed(Key::C) {
            self.copy(context, session, now);
        }
    }

    fn contents(
        &mut self,
        ui: &mut egui::Ui,
        session: &mut Session,
        moment: Moment,
        save: &mut SavePicture<'_>,
    ) {
        ui.add_space(4.0);
        ui.label(RichText::new(session.scene_name()).heading().strong());
        self.show_opening(ui, session);
        show_state(ui, session);
        show_rates(ui, session, moment);
        ui.separator();
        show_view(ui, session, &mut self.area, moment.now);
        show_picked(ui, session, moment.now);
        if session.playback.can_play() {
            ui.separator();
            show_time(ui, session, moment.now);
        }
        ui.separator();
        show_system(ui, session);
        show_integrator_options(ui, session);
        ui.separator();
        self.show_saving(ui, session, moment.now, save);
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

    /// Shows the field for another scene, and the state of its opening.
    fn show_opening(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        ui.horizontal(|ui| {
            let typed = egui::TextEdit::singleline(&mut self.typed)
                .desired_width(WIDTH - 90.0)
                .hint_text("file, or built-in scene");
            let response = ui.add(typed).on_hover_text("Ctrl+O; a file can also be dropped on the window");
            if std::mem::take(&mut self.wants_name) {
                response.request_focus();
                response.scroll_to_me(Some(egui::Align::TOP));
            }
            let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            if (ui.button("Open").clicked() || entered) && !self.typed.is_empty() {
                session.open(std::mem::take(&mut self.typed).into());
            }
        });
        if let Some(name) = session.reading() {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.label(format!("reading {name}"));
            });
        }
    }

    fn show_saving(
        &mut self,
        ui: &mut egui::Ui,
        session: &mut Session,
        now: f64,
        save: &mut SavePicture<'_>,
    ) {
        ui.horizontal(|ui| {
            if ui.button("Save picture").on_hover_text("Key P").clicked() {
                self.save(session, now, save);
            }
            if ui.button("Copy command line").on_hover_text("Key C").clicked() {
                self.copy(ui.ctx(), session, now);
            }
        });
        if let Some(line) = command_line(session) {
            ui.collapsing("Command line of this picture", |ui| {
                ui.add(egui::Label::new(RichText::new(line).monospace().small()).wrap().selectable(true));
            });
        }
    }

    fn save(&mut self, session: &Session, now: f64, save: &mut SavePicture<'_>) {
        let Some(picture) = session.picture.as_ref().filter(|picture| !picture.settings.moving) else {
            return self.say("There is no whole picture yet.", true, now);
        };
        let place = next_place(session);
        let line = command_line(session);
        let saved = SavedPicture {
            place: &place,
            size: [picture.width, picture.height],
            pixels: &picture.pixels.bytes(session.tone),
            tone: matches!(picture.pixels, Pixels::Radiance(_)).then_some(session.tone),
            denoised: picture.denoised.as_deref(),
            command_line: line.as_deref(),
            scale: match &picture.pixels {
                Pixels::Map(_, legend) => Some(legend.described()),
                Pixels::Radiance(_) => None,
            },
            is_finished: picture.is_finished(),
        };
        let (text, is_error) = match save(&saved) {
            Ok(()) if picture.is_finished() => (format!("saved {}", place.display()), false),
            Ok(()) => {
                let wanted = picture.settings.frame.spp;
                // Maps have no command line.
                let finished = if line.is_some() { ": the command line makes the finished one" } else { "" };
                let (place, samples) = (place.display(), picture.samples);
                (format!("saved {place} with {samples} of {wanted} samples{finished}"), false)
            }
            Err(error) => (error, true),
        };
        self.say(text, is_error, now);
    }
}

fn next_place(session: &Session) -> PathBuf {
    session.place_for_picture(|place| place.exists())
}

/// Returns the command line of the picture that is shown; `None` for maps.
fn command_line(session: &Session) -> Option<String> {
    let picture = session.picture.as_ref().filter(|picture| matches!(picture.pixels, Pixels::Radiance(_)))?;
    Some(session.command_line(&picture.settings, &next_place(session)))
}

/// Shows a widget over a corner of the picture.
fn over_picture(
    context: &egui::Context,
    place: egui::Rect,
    corner: egui::Align2,
    contents: impl FnOnce(&mut egui::Ui),
) {
    let inside = place.shrink(12.0);
    egui::Area::new(egui::Id::new(("over", corner)))
        .fixed_pos(corner.pos_in_rect(&inside))
        .pivot(corner)
        .show(context, |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_max_width((inside.width() - 16.0).max(120.0));
                contents(ui);
            });
        });
}

/// Shows why a scene could not be opened, until the user has read it.
fn show_not_opened(context: &egui::Context, session: &mut Session, place: egui::Rect) {
    let Some(failure) = session.not_opened().cloned() else { return };
    over_picture(context, place, egui::Align2::LEFT_TOP, |ui| {
        show_failure(ui, &failure);
        ui.horizontal(|ui| {
            ui.weak("The scene before is shown.");
            if ui.small_button("OK").clicked() {
                session.dismiss();
            }
        });
    });
}

/// Returns `Some` if the digit of a key, by its place on either keyboard, was pressed; true if with the
/// command key.
fn take_digit(context: &egui::Context, digit: Key) -> Option<bool> {
    context.input(|input| {
        input.events.iter().find_map(|event| match event {
            egui::Event::Key { key, physical_key, pressed: true, repeat: false, modifiers } => {
                (physical_key.unwrap_or(*key) == digit).then_some(modifiers.command)
            }
            _ => None,
        })
    })
}

fn show_failure(ui: &mut egui::Ui, failure: &Failure) {
    ui.colored_label(ui.visuals().error_fg_color, &failure.message);
    if !failure.help.is_empty() {
        ui.colored_label(ui.visuals().warn_fg_color, &failure.help);
    }
}

/// Shows the rates of window frames and of pictures.
fn show_rates(ui: &mut egui::Ui, session: &Session, moment: Moment) {
    let (window, pictures) = (moment.frames, session.picture_rate.per_second(moment.now));
    let [window, pictures] = [window, pictures].map(|rate| rate.unwrap_or(0.0));
    ui.weak(format!("window {window:.1}/s, pictures {pictures:.1}/s"))
        .on_hover_text("Draws of each in the last two seconds; what does not change is not drawn");
}

fn show_state(ui: &mut egui::Ui, session: &Session) {
    if let Some(failure) = session.failure() {
        show_failure(ui, failure);
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
                _ if picture.settings.moving => ui.label(format!("moving: {size}, direct light, {ms:.0} ms")),
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
