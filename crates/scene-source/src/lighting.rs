//! Light of a loaded scene.

use crate::error::LoadError;
use crate::key_hash::KeyHash;
use crate::loaded::LoadedScene;
use rasray_scene::{Environment, Moment, Scene, default_view as view};

/// Source of a scene's light.
#[derive(Clone, Debug, Default)]
pub(crate) enum Lighting {
    /// The scene's own light, or no light yet.
    #[default]
    Own,
    /// An environment that the caller gave.
    Given,
    /// The default light, in place of the scene's own environment.
    Default(Environment),
}

impl Lighting {
    /// Name in reports.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Own => "scene",
            Self::Given => "given",
            Self::Default(_) => "default",
        }
    }
}

impl LoadedScene {
    /// Lights the scene. A given environment replaces the scene's own and stays as it is, even a black one;
    /// otherwise a scene that is not lit as it is shown gets [`view::default_light`], with a warning.
    pub fn light(&mut self, environment: Option<Environment>) {
        match environment {
            Some(environment) => self.light_with(environment),
            None => self.relight(),
        }
    }

    /// Lights the scene for frames, which share one light: the scene gets the default light if it is unlit at
    /// all of these times, seconds. Where surfaces alone may light it, one time after the other is examined
    /// until the scene is lit; with numbered files, every file is read for that.
    ///
    /// # Errors
    /// An error if the scene has no such clip, or its deformer fails.
    pub fn light_frames(
        &mut self,
        environment: Option<Environment>,
        clip: Option<&str>,
        times: impl IntoIterator<Item = f64>,
    ) -> Result<(), LoadError> {
        if environment.is_some() || !view::is_lit_at_times(&self.scene) {
            self.light(environment);
            return Ok(());
        }
        let clips = self.clips(clip)?;
        let mut is_lit = false;
        for seconds in times {
            is_lit = self.is_lit_at(&Moment { seconds, clips: clips.clone() })?;
            if is_lit {
                break;
            }
        }
        // The key holds the decision, since a picture of other frames may have another light.
        let values = if is_lit { "own" } else { "default" };
        self.content =
            KeyHash::default().with("scene", &self.content).with("light of frames", values).finish();
        if !is_lit {
            self.add_default_light();
        }
        Ok(())
    }

    fn light_with(&mut self, environment: Environment) {
        let values = match &environment {
            Environment::Constant(radiance) => format!("{radiance:?}").into_bytes(),
            Environment::LatLong { width, height, radiance } => {
                let texels = radiance.iter().flatten().flat_map(|value| value.to_le_bytes());
                [width, height].into_iter().flat_map(|side| side.to_le_bytes()).chain(texels).collect()
            }
        };
        self.content = KeyHash::default().with("scene", &self.content).with("environment", values).finish();
        self.scene.environment = environment;
        self.lighting = Lighting::Given;
    }

    /// Decides anew, for the scene as it is shown now, whether the default light is added, unless an
    /// environment was given. The method is called after [`Self::show`], or after a return to rest.
    pub fn relight(&mut self) {
        if let Lighting::Default(own) = &mut self.lighting {
            self.scene.environment = std::mem::take(own);
        } else if matches!(self.lighting, Lighting::Given) {
            return;
        }
        self.lighting = Lighting::Own;
        self.scene.warnings.retain(|warning| warning.kind != "default-light");
        let is_lit = match self.moment.clone() {
            // A moment that cannot be posed is not shown either, and the code that poses it reports why.
            Some(moment) if view::is_lit_at_times(&self.scene) => self.is_lit_at(&moment).unwrap_or(true),
            _ => view::is_lit(&self.scene),
        };
        if !is_lit {
            self.add_default_light();
        }
    }

    /// True if the default light was added.
    pub fn has_default_light(&self) -> bool {
        matches!(self.lighting, Lighting::Default(_))
    }

    fn add_default_light(&mut self) {
        self.lighting = Lighting::Default(self.scene.environment.clone());
        view::add_default_light(&mut self.scene);
    }

    /// True if the scene is lit at a moment.
    fn is_lit_at(&mut self, moment: &Moment) -> Result<bool, LoadError> {
        // Images do not change and may be most of the memory, but they shape the emission of surfaces.
        let images = std::mem::take(&mut self.scene.images);
        match self.scene.at(moment) {
            Ok(posed) => {
                let posed = Scene { images, ..posed };
                let is_lit = view::is_lit(&posed);
                self.scene.images = posed.images;
                Ok(is_lit)
            }
            Err(error) => {
                self.scene.images = images;
                Err(error.into())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loaded::load;

    #[test]
    fn an_environment_that_was_asked_for_stays() {
        let mut file = tempfile::Builder::new().suffix(".obj").tempfile().expect("a file");
        std::io::Write::write_all(&mut file, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("bytes");
        for asked in [None, Some([0.0; 3]), Some([2.0; 3])] {
            let mut loaded = load(file.path().as_os_str()).expect("a triangle");
            loaded.light(asked.map(Environment::Constant));
            let constant = match loaded.scene.environment {
                Environment::Constant(radiance) => Some(radiance),
                Environment::LatLong { .. } => None,
            };
            assert_eq!(constant, asked);
            let warned = loaded.scene.warnings.iter().any(|warning| warning.kind == "default-light");
            assert_eq!(warned, asked.is_none());
        }
    }
}
