//! Engine that makes pictures of settings, step by step. A change repeats only the work that depends on it.

use std::time::Instant;

use rasray_experiment::{
    Built, DeviceScene, ExperimentError, Frame, ProgressiveImage, SystemConfig, TexelCapacity, texels,
    work_per_pixel,
};
use rasray_gpu::{Device, Timing};
use rasray_gpu_scene::View;
use rasray_report::Pass;
use rasray_scene::Camera;
use rasray_scene::needs::Needs;
use rasray_scene_source::LoadedScene;

use crate::denoising::Denoising;
use crate::error::ViewerError;
use crate::picked::{Answer, Pick};
use crate::picture::{Picture, Pixels};
use crate::preview::Preview;
use crate::preview_size::{PreviewSize, TARGET_MS};
use crate::scene_at_time::{ChooseCamera, SceneAtTime};
use crate::settings::{Redo, Settings, Shown, Standpoint};
use crate::traced::{Traced, exact_config, follow};

/// Scene to look at.
pub struct SceneSource {
    /// Scene as it was read: lit, and at rest.
    pub loaded: LoadedScene,
    /// Name of the clip that moves the scene; absent for all clips that can be played together.
    pub clip: Option<String>,
    /// True if all data is uploaded and compiled in, and not only the data that a picture can show.
    pub needs_all: bool,
    /// Choice of the camera while nobody moves it.
    pub camera: Box<ChooseCamera>,
}

/// Result of a step.
pub enum Step {
    /// Work in progress; there is no new picture.
    Working,
    /// New picture.
    Picture(Box<Picture>),
    /// End of the work for these settings.
    Done,
}

/// Engine that makes pictures on a device. After a failure, the next settings make everything anew that
/// failed.
pub struct Engine {
    device: Device,
    /// True if messages of the validation layer are errors.
    validation: bool,
    scene: SceneAtTime,
    needs_all: bool,
    choose: Box<ChooseCamera>,
    settings: Settings,
    stage: Option<(DeviceScene, Needs)>,
    /// Time of the scene on the device, seconds; absent at rest.
    posed: Option<f64>,
    /// True if the scene on the device has the default light.
    has_default_light: bool,
    traced: Option<Traced>,
    exact: Option<Traced>,
    /// Film of the whole picture.
    film: Option<ProgressiveImage>,
    exact_film: Option<ProgressiveImage>,
    /// Denoiser of the whole picture, once denoising was asked for.
    denoising: Option<Denoising>,
    /// Number [`Picture::cut_rays`] of the whole picture, once it is complete.
    cut_rays: u32,
    /// Preview while something moves.
    preview: Option<Preview>,
    preview_size: PreviewSize,
    /// Time spent on the samples of the preview picture that is being made, milliseconds.
    preview_ms: f64,
    /// True if films hold samples of other settings.
    stale: bool,
    /// True if the picture of these settings is complete.
    done: bool,
    sample_ms: f64,
}

impl Engine {
    /// Makes an engine; nothing else is made before the first step.
    pub fn new(device: Device, validation: bool, source: SceneSource, settings: Settings) -> Self {
        let SceneSource { loaded, clip, needs_all, camera } = source;
        Self {
            device,
            validation,
            scene: SceneAtTime::new(loaded, clip),
            needs_all,
            choose: camera,
            settings,
            stage: None,
            posed: None,
            has_default_light: false,
            traced: None,
            exact: None,
            film: None,
            exact_film: None,
            denoising: None,
            cut_rays: 0,
            preview: None,
            preview_size: PreviewSize::default(),
            preview_ms: 0.0,
            stale: true,
            done: false,
            sample_ms: 0.0,
        }
    }

    /// Changes to another scene. Settings of that scene must follow.
    pub fn show(&mut self, source: SceneSource) {
        let SceneSource { loaded, clip, needs_all, camera } = source;
        self.drop_for(Redo::ALL);
        self.scene = SceneAtTime::new(loaded, clip);
        (self.needs_all, self.choose, self.posed) = (needs_all, camera, None);
    }

    /// Changes the settings, and drops everything that must be made anew for them.
    pub fn apply(&mut self, settings: Settings) {
        let redo = Redo::between(&self.settings, &settings);
        self.settings = settings;
        self.drop_for(redo);
    }

    fn drop_for(&mut self, redo: Redo) {
        if redo.scene {
            self.stage = None;
            self.exact = None;
        }
        if redo.structure {
            self.traced = None;
        }
        if redo.film || redo.scene {
            (self.film, self.exact_film, self.preview) = (None, None, None);
        }
        if redo.samples {
            self.stale = true;
        }
        if redo.pixels {
            self.done = false;
        }
    }

    /// Does the next piece of work: at most one wave of rays after everything that must be made, or a sample
    /// of a picture while something moves. `say` receives a few words about work that takes long.
    ///
    /// # Errors
    /// The settings are impossible, the device fails, or a structure or rays do not become complete. The next
    /// step tries again.
    pub fn step(&mut self, say: &mut dyn FnMut(&str)) -> Result<Step, ViewerError> {
        if self.done {
            return Ok(Step::Done);
        }
        let made = self.make(say);
        // After a failure films may lack samples, except after one of the denoiser, when they are whole.
        self.stale |= made.as_ref().is_err_and(|error| !matches!(error, ViewerError::Denoise(_)));
        let step = made?;
        match self.device.validation_messages().first() {
            Some(message) if self.validation => {
                Err(ExperimentError::Validation { message: message.clone() }.into())
            }
            _ => Ok(step),
        }
    }

    fn make(&mut self, say: &mut dyn FnMut(&str)) -> Result<Step, ViewerError> {
        self.settings.system.spec()?;
        if self.settings.denoised && self.denoising.is_none() {
            // A missing denoiser is noticed before anything is rendered in vain.
            self.denoising = Some(Denoising::find()?);
        }
        let camera = self.prepare_scene(say)?;
        let size = self.picture_size();
        self.look(&camera, size)?;
        let config = self.config(&camera);
        follow(&self.device, self.stage.as_ref(), self.posed, &mut self.traced, &config, say)?;
        if self.stale {
            for film in self.films() {
                film.clear()?;
            }
            if let Some(denoising) = &mut self.denoising {
                denoising.begin();
            }
            self.preview_ms = 0.0;
            self.stale = false;
        }
        match self.settings.shown {
            _ if self.settings.moving => self.preview(camera, size, say),
            Shown::Picture => self.refine(camera, say),
            Shown::Difference => self.difference(camera, say),
            Shown::Cells | Shown::Entries | Shown::Tests => self.work(camera, say),
        }
    }

    /// Returns all existing films.
    fn films(&mut self) -> impl Iterator<Item = &mut ProgressiveImage> {
        let preview = self.preview.iter_mut().flat_map(Preview::films);
        self.film.iter_mut().chain(&mut self.exact_film).chain(preview)
    }

    /// Prepares the scene on the device at its time, and returns the camera there.
    fn prepare_scene(&mut self, say: &mut dyn FnMut(&str)) -> Result<Camera, ViewerError> {
        let seconds = self.settings.seconds;
        self.scene.show(seconds)?;
        let camera = match &self.settings.standpoint {
            Standpoint::AsGiven => self.scene.camera(&*self.choose)?,
            Standpoint::Camera(index) => {
                self.scene.loaded().camera(*index).ok_or(ViewerError::NoCamera { index: *index })?
            }
            Standpoint::Placed(rounded) => rounded.camera()?,
        };
        let is_posed = self.scene.loaded().moment.is_some();
        let has_default_light = self.scene.loaded().has_default_light();
        let is_kept = |(stage, _): &(DeviceScene, Needs)| {
            stage.suits(&self.scene.loaded().scene, &camera)
                && self.has_default_light == has_default_light
                && (self.posed == seconds || (stage.is_moving() && is_posed))
        };
        if self.stage.as_ref().is_some_and(|stage| !is_kept(stage)) {
            self.drop_for(Redo::ALL);
        }
        if self.stage.is_none() {
            say("scene to the device");
            let Frame { width, height, seed, .. } = self.settings.frame;
            let needs = if self.needs_all {
                Needs::all()
            } else {
                Needs::of(&self.scene.loaded().scene, self.settings.workload())
            };
            let capacity = TexelCapacity::of(&self.device);
            if let Some(text) = texels::fit(self.scene.loaded_mut(), &needs, &capacity)? {
                tracing::warn!("{text} (smaller-images)");
            }
            let scene = &self.scene.loaded().scene;
            let make = if is_posed { DeviceScene::moving } else { DeviceScene::new };
            let stage = make(&self.device, scene, &camera, [width, height], seed, &needs)?;
            self.stage = Some((stage, needs));
            self.posed = if is_posed { None } else { seconds };
            self.has_default_light = has_default_light;
        }
        if self.posed != seconds
            && let (Some((stage, _)), Some(moment)) = (&mut self.stage, &self.scene.loaded().moment)
        {
            stage.pose(&self.device, &self.scene.loaded().scene, moment, Timing::None)?;
            for film in self.films() {
                film.scene_moved();
            }
            self.posed = seconds;
        }
        Ok(camera)
    }

    /// Returns width and height of the picture in progress, pixels.
    fn picture_size(&self) -> [u32; 2] {
        let Frame { width, height, .. } = self.settings.frame;
        if self.settings.moving { self.preview_size.size([width, height]) } else { [width, height] }
    }

    fn look(&mut self, camera: &Camera, [width, height]: [u32; 2]) -> Result<(), ExperimentError> {
        let Some((stage, _)) = &mut self.stage else { return Ok(()) };
        stage.look(&View { camera: camera.clone(), width, height, seed: self.settings.frame.seed })?;
        stage.sample_as(&self.settings.frame)
    }

    /// Returns the configuration as a render has it.
    fn config(&self, camera: &Camera) -> SystemConfig {
        let Settings { system, frame, .. } = &self.settings;
        system.clone().serving(frame.workload()).seen_by(camera, frame)
    }

    /// Renders one wave of the whole picture. A complete picture is shown in another way.
    fn refine(&mut self, camera: Camera, say: &mut dyn FnMut(&str)) -> Result<Step, ViewerError> {
        let Self { device, stage, traced, film, settings, denoising, .. } = self;
        let (Some((stage, needs)), Some(traced)) = (stage, traced) else { return Ok(Step::Working) };
        let film = opened(device, stage, film, &settings.frame, needs, &traced.built, say)?;
        let is_complete = |film: &ProgressiveImage| film.image().samples_done() >= settings.frame.spp;
        if !is_complete(film) {
            if !advance(device, film, traced, &mut self.sample_ms)? {
                return Ok(Step::Working);
            }
            // Faults are read once, as by a render.
            self.cut_rays = if is_complete(film) { film.warn_of_faults(device)?.cut } else { 0 };
        }
        self.done = is_complete(film);
        let denoising = denoising.as_mut().filter(|_| settings.denoised);
        if !self.done && denoising.as_ref().is_some_and(|denoising| !denoising.is_due()) {
            return Ok(Step::Working);
        }
        let mut radiance = film.read(device)?;
        let mut denoised = None;
        if let Some(denoising) = denoising {
            if !denoising.is_fed() {
                say("albedo and normal, for taking out noise");
                denoising.feed(film, stage, &traced.built)?;
            }
            radiance = denoising.denoised([settings.frame.width, settings.frame.height], &radiance)?;
            denoised = Some(denoising.version().to_owned());
        }
        let (samples, passes) = (film.image().samples_done(), film.pass_times());
        let mut step = self.picture(camera, Pixels::Radiance(radiance), samples, passes)?;
        if let Step::Picture(picture) = &mut step {
            (picture.cut_rays, picture.denoised) = (self.cut_rays, denoised);
        }
        Ok(step)
    }

    /// Renders samples of the preview while something moves, as many as there is time for.
    fn preview(
        &mut self,
        camera: Camera,
        size: [u32; 2],
        say: &mut dyn FnMut(&str),
    ) -> Result<Step, ViewerError> {
        let Self { device, stage, traced, preview, settings, .. } = self;
        let (Some((stage, needs)), Some(traced)) = (stage, traced) else { return Ok(Step::Working) };
        let kept = preview.take().filter(|kept| kept.size == size && kept.serves(&traced.built));
        let films = preview.insert(match kept {
            Some(films) => films,
            None => {
                say("first use of the shaders");
                self.preview_ms = 0.0;
                Preview::new(device, stage, &settings.frame, size, needs, &traced.built)?
            }
        });
        let full = [settings.frame.width, settings.frame.height];
        // Settings change faster than waves end, which would start them over for ever; therefore a step ends
        // with a picture. If all samples so far were quick, there is time for one more.
        let (samples, of_a_sample) = loop {
            let started = Instant::now();
            while !(advance(device, films.next(), traced, &mut self.sample_ms)? && films.is_whole()) {}
            self.preview_ms += started.elapsed().as_secs_f64() * 1.0e3;
            let samples = films.light().image().samples_done();
            self.done = samples >= settings.frame.spp;
            let of_a_sample = self.preview_ms / f64::from(samples);
            if self.done || size != full || self.preview_ms + of_a_sample >= TARGET_MS {
                break (samples, of_a_sample);
            }
        };
        let pixels = Pixels::Radiance(films.read(device)?);
        let passes = films.light().pass_times();
        self.sample_ms = of_a_sample;
        self.preview_size.took(of_a_sample, full, size[0] * size[1]);
        self.picture(camera, pixels, samples, passes)
    }

    /// Renders one wave of the picture or of its counterpart through an exact structure, whichever has fewer
    /// samples.
    fn difference(&mut self, camera: Camera, say: &mut dyn FnMut(&str)) -> Result<Step, ViewerError> {
        let config = exact_config(&self.settings.system);
        follow(&self.device, self.stage.as_ref(), self.posed, &mut self.exact, &config, say)?;
        let Self { device, stage, traced, exact, film, exact_film, settings, .. } = self;
        let (Some((stage, needs)), Some(traced), Some(exact)) = (stage, traced, exact) else {
            return Ok(Step::Working);
        };
        let film = opened(device, stage, film, &settings.frame, needs, &traced.built, say)?;
        let exact_film = opened(device, stage, exact_film, &settings.frame, needs, &exact.built, say)?;
        if film.image().samples_done() <= exact_film.image().samples_done() {
            advance(device, film, traced, &mut self.sample_ms)?;
            return Ok(Step::Working);
        }
        if !advance(device, exact_film, exact, &mut 0.0)?
            || film.image().samples_done() != exact_film.image().samples_done()
        {
            return Ok(Step::Working);
        }
        self.done = film.image().samples_done() >= settings.frame.spp;
        let name = exact.config.system.name;
        let pixels = Pixels::of_difference(&film.read(device)?, &exact_film.read(device)?, name);
        let (samples, passes) = (film.image().samples_done(), film.pass_times());
        self.picture(camera, pixels, samples, passes)
    }

    /// Makes the map of the costs of the rays through the pixels' centres.
    fn work(&mut self, camera: Camera, say: &mut dyn FnMut(&str)) -> Result<Step, ViewerError> {
        let Self { device, stage, traced, settings, .. } = self;
        let (Some((stage, _)), Some(traced)) = (stage, traced) else { return Ok(Step::Working) };
        say("counting the work of rays");
        let size = [settings.frame.width, settings.frame.height];
        let spec = traced.config.spec()?;
        let map = work_per_pixel(device, stage, &spec, stage.scene.eye(), &camera, size)?;
        let map = map.ok_or(ViewerError::NotCounted { system: traced.config.system.name })?;
        let counts = match settings.shown {
            Shown::Cells => map.cells,
            Shown::Entries => map.entries,
            _ => map.tests,
        };
        self.done = true;
        let pixels = Pixels::of_counts(&counts, &format!("{} per ray", settings.shown.name()));
        let samples = settings.frame.spp;
        self.picture(camera, pixels, samples, Vec::new())
    }

    /// Traces the ray of a pick through one of its systems. The existing structure is used if it is of that
    /// system; one that is built for the pick is dropped.
    pub fn answer(&self, pick: &Pick, config: &SystemConfig) -> Answer {
        let system = format!("{} {}", config.system.name, config.preset.name());
        let is_there = pick.scene == self.settings.scene && pick.seconds == self.posed;
        let hit = match self.stage.as_ref().filter(|_| is_there) {
            Some((stage, _)) => {
                let scene = (&self.scene.loaded().scene, stage);
                pick.hit(&self.device, scene, self.traced.as_ref(), config, &self.settings.frame)
                    .map_err(ViewerError::from)
            }
            None => Err(ViewerError::Moved),
        };
        Answer { system, hit: hit.map_err(|error| error.to_string()) }
    }

    fn picture(
        &self,
        camera: Camera,
        pixels: Pixels,
        samples: u32,
        samples_passes: Vec<Pass>,
    ) -> Result<Step, ViewerError> {
        let (Some((stage, _)), Some(traced)) = (&self.stage, &self.traced) else { return Ok(Step::Working) };
        let mut memory = traced.built.memory(&self.device)?;
        for (name, bytes) in stage.scene.bytes_by_part() {
            memory.by_part.insert(format!("scene {name}"), *bytes);
        }
        let mut passes = traced.built.pass_times();
        passes.extend(samples_passes);
        let [width, height] = stage.scene.image_size();
        Ok(Step::Picture(Box::new(Picture {
            width,
            height,
            pixels,
            settings: self.settings.clone(),
            samples,
            denoised: None,
            cut_rays: 0,
            camera,
            sample_ms: self.sample_ms,
            passes,
            memory,
            resolved: traced.built.resolved()?,
        })))
    }
}

/// Returns the existing film, or a new one, whose kernels are compiled before it is timed.
fn opened<'a>(
    device: &Device,
    stage: &DeviceScene,
    film: &'a mut Option<ProgressiveImage>,
    frame: &Frame,
    needs: &Needs,
    built: &Built,
    say: &mut dyn FnMut(&str),
) -> Result<&'a mut ProgressiveImage, ExperimentError> {
    if film.as_ref().is_none_or(|film| !film.serves(built)) {
        say("first use of the shaders");
        let mut made = ProgressiveImage::new(device, (stage, built), frame, None, needs)?;
        made.warm_up(built)?;
        *film = Some(made);
    }
    Ok(film.as_mut().expect("it was made just now"))
}

/// Renders one wave, and returns whether it completes a sample. Rays without an answer are an error.
fn advance(
    device: &Device,
    film: &mut ProgressiveImage,
    traced: &Traced,
    sample_ms: &mut f64,
) -> Result<bool, ExperimentError> {
    let started = Instant::now();
    if film.image().is_between_samples() {
        *sample_ms = 0.0;
    }
    let advanced = film.advance(device, &traced.built)?;
    *sample_ms += started.elapsed().as_secs_f64() * 1.0e3;
    if film.image().unfinished() > 0 {
        return Err(ExperimentError::Unanswered {
            system: traced.config.system.name.to_owned(),
            rays: film.image().unfinished(),
        });
    }
    Ok(advanced && film.image().is_between_samples())
}
