//! The picture in the window, and the camera moved on it.

use egui::{Color32, ColorImage, Key, PointerButton, Pos2, Rect, Sense, TextureHandle, TextureOptions, Vec2};

use crate::picture::Picture;
use crate::session::Session;

/// Radians of a drag over a point.
const TURN: f64 = 0.006;

/// Half diagonals of the scene that are flown in a second.
const SPEED: f64 = 0.5;

/// The picture as a texture.
#[derive(Default)]
pub(super) struct PictureArea {
    texture: Option<TextureHandle>,
    /// Of which picture, by its number, and with which exposure the texture is.
    of: Option<(u64, u32)>,
}

impl PictureArea {
    /// Shows the session's picture in what is left of `ui`, as large as it fits: several pixels of the window per pixel of
    /// the picture where that is a whole number.
    pub(super) fn show(&mut self, ui: &mut egui::Ui, session: &mut Session, now: f64, elapsed: f64) {
        let area = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(area, Sense::click_and_drag());
        ui.painter().rect_filled(area, 0.0, Color32::from_gray(24));
        if let Some(picture) = &session.picture {
            self.update(ui.ctx(), picture, session.pictures, session.exposure);
            let full = [picture.settings.frame.width, picture.settings.frame.height];
            if let Some(texture) = &self.texture {
                let place = place(area, full, ui.ctx().pixels_per_point());
                let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
                ui.painter().image(texture.id(), place, whole, Color32::WHITE);
            }
        }
        self.control(ui, &response, area, session, now, elapsed);
    }

    fn update(&mut self, context: &egui::Context, picture: &Picture, number: u64, exposure: f32) {
        let of = Some((number, exposure.to_bits()));
        if self.of == of {
            return;
        }
        self.of = of;
        let size = [picture.width as usize, picture.height as usize];
        let image = ColorImage::from_rgb(size, &picture.pixels.bytes(exposure));
        match &mut self.texture {
            Some(texture) if texture.size() == size => {
                texture.set_partial([0, 0], image, TextureOptions::NEAREST)
            }
            texture => *texture = Some(context.load_texture("picture", image, TextureOptions::NEAREST)),
        }
    }

    fn control(
        &self,
        ui: &egui::Ui,
        response: &egui::Response,
        area: Rect,
        session: &mut Session,
        now: f64,
        elapsed: f64,
    ) {
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
            let held =
                |key| f64::from(u8::from(ui.input(|input| input.key_down(key) && !input.modifiers.command)));
            held(plus) - held(minus)
        };
        let [forward, right, up] = [flown(Key::W, Key::S), flown(Key::D, Key::A), flown(Key::E, Key::Q)];
        if [forward, right, up] != [0.0; 3] {
            let fast = if ui.input(|input| input.modifiers.shift) { 4.0 } else { 1.0 };
            // After a pause the first step is as one of a slow picture.
            let step = fast * SPEED * session.radius() * elapsed.min(0.1);
            if let Some(camera) = session.move_camera(now) {
                camera.fly(forward * step, right * step, up * step);
            }
            ui.ctx().request_repaint();
        }
    }
}

/// Where a picture of this size is shown in an area, on whole pixels of the window.
fn place(area: Rect, [width, height]: [u32; 2], scale: f32) -> Rect {
    let (width, height) = (width as f32, height as f32);
    let fit = (area.width() * scale / width).min(area.height() * scale / height);
    let fit = if fit >= 1.0 { fit.floor() } else { fit };
    let size = Vec2::new(width * fit, height * fit) / scale;
    let corner = area.center() - 0.5 * size;
    let whole = |value: f32| (value * scale).round() / scale;
    Rect::from_min_size(Pos2::new(whole(corner.x), whole(corner.y)), size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_shown_on_whole_pixels_and_never_beyond_the_window() {
        let area = Rect::from_min_size(Pos2::new(10.0, 0.0), Vec2::new(101.0, 95.0));
        for scale in [1.0, 1.5, 2.0] {
            for size in [[40, 30], [100, 95], [640, 360]] {
                let place = place(area, size, scale);
                assert!(area.expand(0.51).contains_rect(place), "{size:?} at {scale}: {place:?}");
                let corner = place.min * scale;
                assert!((corner.x - corner.x.round()).abs() < 1.0e-3, "{corner:?}");
            }
        }
        assert_eq!(place(area, [40, 30], 1.0).size(), Vec2::new(80.0, 60.0));
    }
}
