//! Picks of points of the scene in a session.

use rasray_experiment::{OptionValues, SystemConfig};
use rasray_scene::Lens;
use rasray_systems::{Preset, SYSTEMS};

use super::Session;
use crate::picked::{Answer, Pick, Picked};

impl Session {
    /// Picks a place of the picture that is shown, as shares of its width and height from the left top
    /// corner. Does nothing before the first picture.
    pub fn pick(&mut self, place: [f32; 2]) {
        let Some(picture) = &self.picture else { return };
        let settings = &picture.settings;
        let size = [settings.frame.width, settings.frame.height];
        self.picks += 1;
        let pick = Pick {
            number: self.picks,
            camera: picture.camera.clone(),
            size,
            place: [0, 1].map(|axis| place[axis] * size[axis] as f32),
            scene: self.scene,
            seconds: settings.seconds,
            systems: vec![settings.system.clone()],
        };
        self.ask(pick, Vec::new());
    }

    /// Asks all other systems of the registry, in the preset `robust`, about the pick.
    pub fn pick_through_all(&mut self) {
        let Some(picked) = self.picked.as_ref().filter(|picked| picked.answers.len() == 1) else { return };
        let shown = &picked.pick.systems;
        let others = SYSTEMS.iter().filter(|system| shown.iter().all(|shown| shown.system != *system));
        let robust = |system| SystemConfig::new(system, Preset::Robust, OptionValues::default());
        self.picks += 1;
        let pick = Pick { number: self.picks, systems: others.map(robust).collect(), ..picked.pick.clone() };
        let answers = picked.answers.clone();
        self.ask(pick, answers);
    }

    fn ask(&mut self, pick: Pick, answers: Vec<Answer>) {
        let awaited = pick.systems.len();
        self.to_pick = Some(pick.clone());
        self.picked = Some(Picked { pick, answers, awaited });
    }

    /// Returns the last pick.
    pub fn picked(&self) -> Option<&Picked> {
        self.picked.as_ref()
    }

    /// Forgets the last pick.
    pub fn unpick(&mut self) {
        (self.picked, self.to_pick) = (None, None);
    }

    /// Returns the pick to ask about; only once.
    pub fn asked_pick(&mut self) -> Option<Pick> {
        self.to_pick.take()
    }

    /// Turns to the picked point, which is the centre of turns from then on, at `now` (seconds).
    pub fn turn_to_picked(&mut self, now: f64) {
        let point = self.picked.as_ref().and_then(Picked::hit).map(|hit| hit.point);
        if let Some(point) = point
            && let Some(camera) = self.move_camera(now)
        {
            camera.look_at(point);
        }
    }

    /// Brings the picked point into the focus of the lens, at `now` (seconds).
    pub fn focus_on_picked(&mut self, now: f64) {
        let depth = self.picked.as_ref().and_then(Picked::hit).map(|hit| hit.depth);
        if let Some((depth, lens)) = depth.zip(self.lens()) {
            self.set_lens(Lens { focus: depth as f32, ..lens }, now);
        }
    }
}
