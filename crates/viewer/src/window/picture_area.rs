//! Area of the picture in the window: its size and place, the motion of the camera, and picks.

use egui::{
    Color32, ColorImage, Key, PointerButton, Pos2, Rect, Sense, Stroke, TextureHandle, TextureOptions, Vec2,
};

use rasray_metrics::Tone;

use super::panel::Moment;
use crate::picture::Picture;
use crate::picture_view::{Area, PictureView};
use crate::session::Session;

/// Angle of turn per point of a drag, radians.
const TURN: f64 = 0.006;

/// Speed of flight, half diagonals of the scene per second.
const SPEED: f64 = 0.5;

/// Factor by which a key scales the picture.
const STEP: f32 = 1.25;

/// Grey around the picture.
const AROUND: Color32 = Color32::from_gray(24);

/// Number of a picture, and the tone in which it is shown.
type Of = (u64, Tone);

/// Picture as a texture, and its place.
#[derive(Default)]
pub(super) struct PictureArea {
    /// Colours of the picture's pixels.
    colours: Vec<Color32>,
    colours_of: Option<Of>,
    texture: Option<TextureHandle>,
    /// Contents of the texture: the picture's pixels or, if pixels are squares, the window's pixels over the
    /// picture.
    texture_of: Option<(Of, Option<Squares>)>,
    /// Number of the scene for which the picture was placed.
    scene: u32,
    pub(super) view: PictureView,
    /// Size of the area in the last frame, pixels.
    pub(super) pixels: [u32; 2],
    /// Position of the pointer on the picture, shares of width and height.
    pointed: Option<[f32; 2]>,
}

impl PictureArea {
    /// Shows the session's picture in the rest of `ui`.
    pub(super) fn show(&mut self, ui: &mut egui::Ui, session: &mut Session, moment: Moment) {
        let area = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(area, Sense::click_and_drag());
        ui.painter().rect_filled(area, 0.0, AROUND);
        let points = ui.ctx().pixels_per_point();
        let within = pixels_of(area, points);
        self.pixels = within.size.map(|side| side.max(1.0) as u32);
        let frame = &session.frame;
        let picture = session.picture.as_ref();
        let full = picture.map_or([frame.width, frame.height], |picture| {
            [picture.settings.frame.width, picture.settings.frame.height]
        });
        if let Some(picture) = picture {
            if self.scene != picture.settings.scene {
                self.scene = picture.settings.scene;
                self.view.fit();
            }
            let place = self.view.place(within, full);
            // A picture that is shown while something moves has fewer pixels, and stays smooth.
            let has_squares = !picture.settings.moving && self.view.shows_squares(within, full);
            let window = within.whole();
            // A window may be too small for a picture.
            let has_room = window.size.iter().all(|side| *side >= 1.0);
            let squares = (has_squares && has_room).then_some(Squares { place, window });
            self.update(ui.ctx(), picture, (session.pictures, session.tone), squares);
            if let Some(texture) = &self.texture {
                let drawn = points_of(squares.map_or(place, |squares| squares.window), points);
                let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
                let painter = ui.painter().with_clip_rect(area);
                painter.image(texture.id(), drawn, whole, Color32::WHITE);
                show_picked(&painter, session, picture, points_of(place, points));
            }
        }
        let pointer = response.hover_pos().map(|at| [at.x * points, at.y * points]);
        let place = self.view.place(within, full);
        self.pointed = pointer.and_then(|pointer| place.share(pointer)).filter(|_| session.picture.is_some());
        let command = ui.input(|input| input.modifiers.command);
        let is_asked = ui.input(|input| !command && input.key_pressed(Key::I));
        if (command && response.clicked()) || (is_asked && !ui.ctx().egui_wants_keyboard_input()) {
            self.pick(session);
        }
        self.lay(ui, &response, pointer, within, full);
        if !command {
            move_camera(ui, &response, area, session, moment);
        }
    }

    /// Picks the point under the pointer.
    fn pick(&self, session: &mut Session) {
        if let Some(place) = self.pointed {
            session.pick(place);
        }
    }

    /// Uploads the picture if it has changed. The window's renderer interpolates between pixels, which
    /// changes nothing where a pixel of the texture is a pixel of the window.
    fn update(&mut self, context: &egui::Context, picture: &Picture, of: Of, squares: Option<Squares>) {
        if self.texture_of == Some((of, squares)) {
            return;
        }
        self.texture_of = Some((of, squares));
        if self.colours_of != Some(of) {
            let bytes = picture.pixels.bytes(of.1);
            self.colours =
                bytes.chunks_exact(3).map(|rgb| Color32::from_rgb(rgb[0], rgb[1], rgb[2])).collect();
            self.colours_of = Some(of);
        }
        let own = [picture.width, picture.height];
        let (size, colours) = match squares {
            Some(Squares { place, window }) => {
                (window.size.map(|side| side as usize), place.squares((own, &self.colours), window, AROUND))
            }
            None => (own.map(|side| side as usize), self.colours.clone()),
        };
        let image = ColorImage::new(size, colours);
        match &mut self.texture {
            Some(texture) if texture.size() == size => {
                texture.set_partial([0, 0], image, TextureOptions::LINEAR)
            }
            texture => *texture = Some(context.load_texture("picture", image, TextureOptions::LINEAR)),
        }
    }

    /// Zooms and moves the picture.
    fn lay(
        &mut self,
        ui: &egui::Ui,
        response: &egui::Response,
        pointer: Option<[f32; 2]>,
        area: Area,
        full: [u32; 2],
    ) {
        let points = ui.ctx().pixels_per_point();
        let centre = area.at([0.5; 2]);
        // Zoom comes from the wheel with the command key, or from a pinch.
        let pinched = ui.input(|input| input.zoom_delta());
        if response.hovered() && pinched != 1.0 {
            self.view.zoom(pinched, pointer.unwrap_or(centre), area, full);
        }
        let drag = response.drag_delta();
        if ui.input(|input| input.modifiers.command) && drag != Vec2::ZERO {
            self.view.shift([drag.x * points, drag.y * points], area, full);
        }
        if ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        let pressed = |keys: &[Key]| {
            ui.input(|input| !input.modifiers.command && keys.iter().any(|key| input.key_pressed(*key)))
        };
        let around = pointer.unwrap_or(centre);
        if pressed(&[Key::Plus, Key::Equals]) {
            self.view.zoom(STEP, around, area, full);
        }
        if pressed(&[Key::Minus]) {
            self.view.zoom(1.0 / STEP, around, area, full);
        }
        if pressed(&[Key::Z]) {
            self.view.toggle();
        }
    }
}

/// Place of a picture whose pixels are squares.
#[derive(Clone, Copy, PartialEq)]
struct Squares {
    /// Area of the picture.
    place: Area,
    /// Area in whole pixels of the window.
    window: Area,
}

fn pixels_of(area: Rect, points: f32) -> Area {
    Area {
        corner: [area.min.x * points, area.min.y * points],
        size: [area.width() * points, area.height() * points],
    }
}

fn points_of(Area { corner, size }: Area, points: f32) -> Rect {
    Rect::from_min_size(Pos2::new(corner[0], corner[1]) / points, Vec2::new(size[0], size[1]) / points)
}

/// Draws a mark on the picked point, if the picture is seen from where it was picked.
fn show_picked(painter: &egui::Painter, session: &Session, picture: &Picture, place: Rect) {
    let Some(pick) = session.picked().map(|picked| &picked.pick) else { return };
    let is_from_there = pick.camera.world_from_camera == picture.camera.world_from_camera;
    if !is_from_there || pick.seconds != picture.settings.seconds {
        return;
    }
    let share = [0, 1].map(|axis| pick.place[axis] / pick.size[axis] as f32);
    let at = place.min + Vec2::new(share[0] * place.width(), share[1] * place.height());
    for (radius, colour) in [(6.0, Color32::BLACK), (5.0, Color32::from_rgb(255, 200, 60))] {
        painter.circle_stroke(at, radius, Stroke::new(1.5, colour));
    }
}

/// Turns, moves and flies the camera.
fn move_camera(ui: &egui::Ui, response: &egui::Response, area: Rect, session: &mut Session, moment: Moment) {
    let Moment { now, elapsed, .. } = moment;
    let drag = response.drag_delta();
    let (x, y) = (f64::from(drag.x), f64::from(drag.y));
    if drag != Vec2::ZERO
        && let Some(camera) = session.move_camera(now)
    {
        let shift = ui.input(|input| input.modifiers.shift);
        if response.dragged_by(PointerButton::Middle)
            || (shift && response.dragged_by(PointerButton::Primary))
        {
            let height = f64::from(area.height().max(1.0));
            camera.pan(-x / height, y / height);
        } else if response.dragged_by(PointerButton::Primary) {
            camera.orbit(-TURN * x, TURN * y);
        } else if response.dragged_by(PointerButton::Secondary) {
            camera.look(TURN * x, -TURN * y);
        }
    }
    let wheel = ui.input(|input| input.smooth_scroll_delta.y);
    if response.hovered()
        && wheel != 0.0
        && let Some(camera) = session.move_camera(now)
    {
        camera.zoom(f64::from(wheel) / 40.0);
    }
    if ui.ctx().egui_wants_keyboard_input() {
        return;
    }
    let flown = |plus, minus| {
        let held = |key| f64::from(u8::from(ui.input(|input| input.key_down(key))));
        held(plus) - held(minus)
    };
    let [forward, right, up] = [flown(Key::W, Key::S), flown(Key::D, Key::A), flown(Key::E, Key::Q)];
    if [forward, right, up] != [0.0; 3] {
        let fast = if ui.input(|input| input.modifiers.shift) { 4.0 } else { 1.0 };
        // After a pause the first step is limited to that of a slow picture.
        let step = fast * SPEED * session.radius() * elapsed.min(0.1);
        if let Some(camera) = session.move_camera(now) {
            camera.fly(forward * step, right * step, up * step);
        }
        ui.ctx().request_repaint();
    }
}
