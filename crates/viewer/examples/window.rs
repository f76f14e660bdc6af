//! Window without the command: `cargo run -p rasray-viewer --features window --example window -- cornell`.
//! Pictures are saved as .ppm, and the `rasray render` command that makes each is printed.

use rasray_experiment::{
    DeviceChoice, Frame, INTEGRATORS, IntegratorSpec, OccluderKind, OptionValues, Primary, Sampler,
    SystemConfig, open_device,
};
use rasray_scene::default_view as view;
use rasray_scene_source::{LoadError, LoadedScene, load};
use rasray_systems::{Preset, SYSTEMS};
use rasray_viewer::{
    Engine, Failure, Opened, Opening, SavedPicture, SceneSource, Session, Settings, Shown, Standpoint,
    Viewing, camera_names, run,
};
use std::ffi::OsStr;
use std::sync::Arc;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args_os().nth(1).unwrap_or("cornell".into());
    let validation = std::env::args_os().any(|word| word == "--validation");
    let Opened { opening, source } = opened(&name)?;
    let device = open_device(&DeviceChoice { device: None, validation })?;
    let settings = opening.settings.clone();
    let end = run(Viewing {
        device: device.name().to_owned(),
        engine: Box::new(move || Engine::new(device, validation, source, settings)),
        session: Session::new(opening, Failure::without_help),
        open: Arc::new(|name: &OsStr| opened(name).map_err(|error| Failure::without_help(&error))),
        validation,
        stop: &|| false,
        save: &mut |saved: &SavedPicture<'_>| {
            let [width, height] = saved.size;
            let bytes = [format!("P6\n{width} {height}\n255\n").as_bytes(), saved.pixels].concat();
            std::fs::write(saved.place, bytes).map_err(|error| error.to_string())?;
            println!("{}: {}", saved.place.display(), saved.command_line.unwrap_or("a map"));
            Ok(())
        },
    })?;
    println!("{end:?}");
    Ok(())
}

/// Opens the scene of a name, and returns the state that its session begins with.
fn opened(name: &OsStr) -> Result<Opened, LoadError> {
    let mut loaded = load(name)?;
    loaded.light(None);
    let frame = Frame {
        integrator: IntegratorSpec::from(&INTEGRATORS[0]),
        width: 320,
        height: 180,
        spp: 16,
        adaptive: None,
        seed: 1,
        sampler: Sampler::Sobol,
        primary: Primary::Trace,
        occluder: OccluderKind::Structure,
        back_faces: rasray_scene::BackFaces::Camera,
    };
    let system = SystemConfig::new(&SYSTEMS[0], Preset::Robust, OptionValues::default());
    let standpoint = Standpoint::AsGiven;
    let (shown, denoised, moving) = (Shown::Picture, false, false);
    let settings = Settings { scene: 0, standpoint, seconds: None, system, frame, shown, denoised, moving };
    let opening = Opening {
        scene: name.to_owned(),
        camera_words: Vec::new(),
        camera_is_default: loaded.scene.cameras.is_empty(),
        cameras: camera_names(&loaded),
        default_camera: view::default_camera(&loaded.scene),
        time_words: Vec::new(),
        other_words: Vec::new(),
        settings,
        tone: Default::default(),
        duration: loaded.scene.animation.duration.into(),
        bounds: view::bounds(&loaded.scene).unwrap_or_default(),
        output: "window.###.ppm".into(),
    };
    let source =
        SceneSource { loaded, clip: None, needs_all: false, camera: Box::new(LoadedScene::default_view) };
    Ok(Opened { opening, source })
}
