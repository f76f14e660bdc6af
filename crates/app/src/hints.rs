//! Hints for errors of libraries: advice by options of the command, and exit codes.

use crate::error::EXIT_DEFECT;
use rasray_denoise::DenoiseError;
use rasray_experiment::{
    AdsError, ExperimentError, FrameError, GpuError, GpuSceneError, IntegratorError, OccluderError,
    OracleError, ReferenceError, SelectionError, SystemsError, TracerError,
};
use rasray_metrics::MetricsError;
use rasray_ray_files::{FileError, FormatError};
use rasray_report::grouped;
use rasray_scene::{SceneError, builtin};
use rasray_scene_source::LoadError;
use rasray_systems::{SYSTEMS, System};
use std::borrow::Cow;

mod exit_codes;
#[cfg(test)]
mod tests;

#[cfg(feature = "viewer")]
pub(crate) use exit_codes::code_of_viewer;
pub(crate) use exit_codes::exit_code;

/// Advice if something does not fit a device, or fails there.
const SMALLER: &str = "try a smaller --resolution or --size, or another --device";

/// Advice for an image, a film or its rays, which no option of structures makes smaller.
const SMALLER_IMAGE: &str = "try a smaller --size, or another --device";

/// Advice for the scene's own tables, which no option of structures or images makes smaller.
const SMALLER_SCENE: &str =
    "try a scene with fewer triangles and images, a smaller map for --environment, or another --device";

/// Advice for an error that neither input nor device causes; its exit code is
/// [`EXIT_DEFECT`].
pub(crate) const DEFECT: &str = "this is a defect; please report it with the command line";

const LOST: &str = "its results are not kept; please report it with the command line";

const LONG: &str = "its results are not kept; where very many triangles lie in one place --system bvh has shorter work, else \
                    please report it with the command line";

const LEAVE: &str = "change the option, or leave it to the preset";

const DAMAGED: &str = "the file is damaged or breaks its format: correct it, or export it again";

const PLACE_CAMERA: &str = "place the camera by --eye and --target";

/// Writes options in the form of the command line; libraries write them `` `views` cube ``.
pub(crate) fn with_flags(text: &str) -> String {
    let parts = text.split('`').enumerate();
    parts.map(|(place, part)| if place % 2 == 1 { format!("--{part}") } else { part.to_owned() }).collect()
}

/// Returns the message of an error, with options in the form of the command line.
pub(crate) fn message(error: &ExperimentError) -> String {
    match error {
        // Each of these messages begins with the name of an option.
        ExperimentError::OptionNeedsFeature { .. }
        | ExperimentError::Pinhole { .. }
        | ExperimentError::NoFirstHits { .. }
        | ExperimentError::Occluder(_)
        | ExperimentError::ShadowMaps { .. }
        | ExperimentError::Integrator(IntegratorError::Value(_)) => format!("--{error}"),
        ExperimentError::Systems(SystemsError::Value { system, source }) => format!("{system}: --{source}"),
        ExperimentError::Selection(SelectionError::NoOption { system, option }) => {
            format!("system {} has no option --{option}", system.name)
        }
        ExperimentError::Selection(SelectionError::NoneHasOption { systems, option }) => {
            format!("none of the systems {} has an option --{option}", names(systems.iter().copied()))
        }
        ExperimentError::Load(LoadError::NoDirection) => {
            "--eye and --target give no direction to look in".to_owned()
        }
        ExperimentError::Load(LoadError::NoFocus) => {
            "--aperture blurs what is not in focus, and nothing says what is".to_owned()
        }
        ExperimentError::NoReference { known } => {
            format!("--image compares with the reference, which has the integrators {known}")
        }
        ExperimentError::MissingPixels { .. } => format!("{error}; nothing was written"),
        other => other.to_string(),
    }
}

/// Returns the advice for an error; empty if the message already gives it.
pub(crate) fn help(error: &ExperimentError) -> Cow<'static, str> {
    if exit_code(error) == EXIT_DEFECT {
        return DEFECT.into();
    }
    match error {
        ExperimentError::Selection(error) => help_of_selection(error),
        ExperimentError::Load(error) => help_of_scene_source(error),
        ExperimentError::PoolExceedsBinding { system, .. } => help_of_pool(system),
        ExperimentError::OptionNeedsFeature { option, value, .. } => {
            format!("leave out --{option} {value}, or choose another --device").into()
        }
        ExperimentError::ImageTooLarge { available, bytes_per_pixel, .. } => {
            let most = grouped(available / (*bytes_per_pixel).max(1));
            format!("choose a --size of at most {most} pixels in all, or leave out --aov and --adaptive")
                .into()
        }
        other => Cow::Borrowed(fixed_help(other)),
    }
}

/// Returns the advice for an error that is no defect, in words that are always the same.
fn fixed_help(error: &ExperimentError) -> &'static str {
    match error {
        ExperimentError::Systems(SystemsError::Value { .. }) => LEAVE,
        ExperimentError::Systems(_) => "see `rasray render --help`",
        ExperimentError::Opening(_) => "`rasray info` lists the devices and what they lack",
        ExperimentError::Gpu(_) => SMALLER,
        ExperimentError::Ads(error) => help_of_ads(error),
        ExperimentError::GpuScene(error) => help_of_tables(error),
        ExperimentError::Integrator(error) => help_of_integrator(error),
        ExperimentError::Frame(error) => help_of_frame(error),
        ExperimentError::Tracer(error) => help_of_tracer(error),
        ExperimentError::Unanswered { .. } => LONG,
        ExperimentError::Oracle(error) => help_of_oracle(error),
        ExperimentError::Reference(ReferenceError::Oracle(error)) => help_of_oracle(error),
        ExperimentError::Reference(ReferenceError::EmptyImage { .. }) => "choose a larger --size, and --spp",
        ExperimentError::Reference(ReferenceError::Malformed { .. }) => DAMAGED,
        ExperimentError::Metrics(MetricsError::TooLarge { .. }) => {
            "choose a smaller --size, or leave out --image"
        }
        ExperimentError::SceneExceedsBinding { .. } => SMALLER_SCENE,
        ExperimentError::SystemNeedsFeature { .. } => "choose another --device or --system",
        ExperimentError::Pinhole { .. } => "write --primary trace, or leave out --aperture",
        ExperimentError::NoFirstHits { .. } => "write --system mmrt --views cube+camera, or leave it out",
        ExperimentError::Occluder(error) => help_of_occluder(error),
        ExperimentError::ShadowMaps { points: 0, .. } => {
            "choose a smaller --shadow-resolution, or another --device"
        }
        ExperimentError::ShadowMaps { .. } => {
            "choose a smaller --shadow-resolution or --shadow-points, or another --device"
        }
        ExperimentError::NoReference { .. } => "choose one of these with --integrator, or leave --image out",
        ExperimentError::NoStillPart => "leave out --refresh",
        ExperimentError::NoSuchRay { .. } => "rays are counted from 0; --rays says how many a set has",
        ExperimentError::HitCount { .. } => "give one hit for each ray, in the order of the rays",
        ExperimentError::TemporaryFile { .. } => "set TMPDIR to a folder for temporary files",
        ExperimentError::MissingEntries { .. } => {
            "its results are not kept; lower --resolution, or use a device with more memory"
        }
        _ => "",
    }
}

fn help_of_frame(error: &FrameError) -> &'static str {
    match error {
        FrameError::Gpu(_) => SMALLER,
        FrameError::Ads(error) => help_of_ads(error),
        FrameError::Tracer(error) => help_of_tracer(error),
        FrameError::Integrator(error) => help_of_integrator(error),
        FrameError::Scene(error) => help_of_tables(error),
        FrameError::Unfinished { .. } => LONG,
        FrameError::Unstable { .. } => LOST,
        FrameError::DrawnAdaptively => "write --primary trace, or leave out --adaptive",
        _ => "",
    }
}

fn help_of_tracer(error: &TracerError) -> &'static str {
    match error {
        TracerError::Gpu(_) => SMALLER,
        TracerError::Ads(error) => help_of_ads(error),
        _ => LOST,
    }
}

fn help_of_ads(error: &AdsError) -> &'static str {
    match error {
        AdsError::Gpu(_) | AdsError::PoolTooLarge { .. } => SMALLER,
        AdsError::Option { .. } => LEAVE,
        AdsError::NoFirstHits { .. } => "write --primary trace",
        AdsError::InParts { .. } => "leave out --refresh, or choose another --system",
        AdsError::Damaged { .. } => LOST,
        _ => "",
    }
}

fn help_of_tables(error: &GpuSceneError) -> &'static str {
    match error {
        GpuSceneError::TooManyVertices { .. }
        | GpuSceneError::TooManyTexels { .. }
        | GpuSceneError::Gpu(GpuError::OutOfDeviceMemory { .. })
        | GpuSceneError::Ads(AdsError::Gpu(GpuError::OutOfDeviceMemory { .. })) => SMALLER_SCENE,
        GpuSceneError::OtherTriangles { .. } => "show the scene at one --time",
        GpuSceneError::DeformedTwice { .. } | GpuSceneError::Malformed { .. } => DAMAGED,
        GpuSceneError::Ads(error) => help_of_ads(error),
        _ => SMALLER,
    }
}

fn help_of_integrator(error: &IntegratorError) -> &'static str {
    match error {
        IntegratorError::PhotonBytes { .. } => "choose fewer --photon-paths, or fewer --bounces",
        IntegratorError::Crowded { .. } => "choose a smaller --radius, or fewer --photon-paths",
        IntegratorError::UnknownOption { .. } => "leave it out, or choose another --integrator",
        IntegratorError::CannotFetch { .. } => "leave out --fetch raster, or choose another --device",
        IntegratorError::CannotDraw { .. } => "choose --primary trace, or another --device",
        IntegratorError::Ads(AdsError::Option { option: "fetch", .. }) => {
            "leave out --fetch raster, or choose another --system"
        }
        IntegratorError::Gpu(_)
        | IntegratorError::Ads(_)
        | IntegratorError::WaveSize { .. }
        | IntegratorError::ImageSize { .. }
        | IntegratorError::WaveCapacity { .. } => SMALLER_IMAGE,
        // The message about a value lists the possible ones.
        _ => "",
    }
}

fn help_of_oracle(error: &OracleError) -> &'static str {
    match error {
        OracleError::TooManyTriangles { .. } => "use a scene with fewer triangles",
        _ => DAMAGED,
    }
}

fn help_of_occluder(error: &OccluderError) -> &'static str {
    match error {
        OccluderError::Blended => {
            "write --occluder structure, or --alpha off, which makes every surface opaque"
        }
        OccluderError::Panes { can_be_opaque: true } => {
            "write --occluder structure, or --glass-shadows opaque"
        }
        OccluderError::NoShadowRays { .. } => {
            "write --occluder structure, or choose --integrator path with bounces"
        }
        OccluderError::BackFaces => "write --occluder structure, or leave out --back-faces all",
        _ => "write --occluder structure",
    }
}

fn help_of_pool(system: &System) -> Cow<'static, str> {
    let smaller = system.size_option().map(|option| format!("a smaller --{option}"));
    let address = system.has("addressing").then(|| "--addressing address".to_owned());
    let fixes: Vec<_> =
        [address, smaller, Some("another --device".to_owned())].into_iter().flatten().collect();
    format!("try {}", fixes.join(" or ")).into()
}

fn help_of_selection(error: &SelectionError) -> Cow<'static, str> {
    match error {
        SelectionError::NoPreset { system, preset } => {
            let own: Vec<_> = system.presets.iter().map(|preset| preset.name()).collect();
            let having = SYSTEMS.iter().filter(|system| system.presets.contains(preset));
            format!("its presets: {}; choose another --system for it: {}", own.join(", "), names(having))
                .into()
        }
        SelectionError::NoOption { option, .. } => {
            format!("{}; leave it out or choose another --system", who_has(option)).into()
        }
        SelectionError::NoneHasOption { option, .. } => {
            format!("{}; leave it out or add such a system to --systems", who_has(option)).into()
        }
        SelectionError::NoneHasPreset { .. } => {
            "leave it out of --presets or add a system that has it to --systems".into()
        }
        SelectionError::SystemNotCompared { system } => {
            format!("add {} to --systems or leave the option out", system.name).into()
        }
        SelectionError::PresetNotCompared { preset } => {
            format!("add {} to --presets or leave the option out", preset.name()).into()
        }
        SelectionError::Form { .. } => "write for example mmrt.samples=50".into(),
        SelectionError::UnknownSystem { .. } => format!("the systems: {}", names(SYSTEMS)).into(),
        SelectionError::UnknownOption { option, .. } => who_has(option).into(),
        SelectionError::Value { row, .. } => format!("--{}: {}", row.name, with_flags(&row.help())).into(),
        _ => "".into(),
    }
}

/// Joins names with commas.
fn names(systems: impl IntoIterator<Item = &'static System>) -> String {
    systems.into_iter().map(|system| system.name).collect::<Vec<_>>().join(", ")
}

/// Describes the systems that have an option.
fn who_has(option: &str) -> String {
    match names(SYSTEMS.iter().filter(|system| system.has(option))).as_str() {
        "" => "no system has it".to_owned(),
        having => format!("it belongs to {having}"),
    }
}

fn help_of_scene_source(error: &LoadError) -> Cow<'static, str> {
    match error {
        LoadError::NoSceneFile { .. } | LoadError::NoSuchScene { meant: None, .. } => {
            kinds_of_scenes().into()
        }
        LoadError::NoSuchScene { meant: Some(meant), .. } => {
            format!("did you mean {meant}? {}", kinds_of_scenes()).into()
        }
        LoadError::Gone { .. } => "leave the file in place while it is read".into(),
        LoadError::Scene(error) => help_of_scene(error).into(),
        LoadError::NoSuchCamera { cameras, .. } if cameras.is_empty() => {
            format!("the scene has no cameras; {PLACE_CAMERA}").into()
        }
        LoadError::NoSuchCamera { cameras, .. } => {
            let known: Vec<_> =
                cameras.iter().enumerate().map(|(index, name)| format!("{index} '{name}'")).collect();
            format!("its cameras: {}", known.join(", ")).into()
        }
        LoadError::ParallelLens { .. } => format!("leave out --aperture, or {PLACE_CAMERA}").into(),
        LoadError::NoFocus => {
            format!("say --focus METRES, or {PLACE_CAMERA}, whose target is in focus").into()
        }
        LoadError::NoDirection => "choose a --target at another place than --eye".into(),
        LoadError::NothingMoves { .. } => "leave --time out; `rasray info SCENE` says what moves".into(),
        LoadError::NoClips { .. } => "leave --clip out".into(),
        LoadError::NoSuchClip { clips, .. } => {
            let known: Vec<_> =
                clips.iter().enumerate().map(|(index, name)| format!("{index} ({name})")).collect();
            format!("it has {}", known.join(", ")).into()
        }
        _ => "".into(),
    }
}

fn kinds_of_scenes() -> String {
    format!(
        "scenes are .gltf, .glb, .obj and .ply files, numbered files such as 'cloth.####.ply', or built-in: {} (parameters \
         follow a colon: spheres:10k)",
        builtin::NAMES.join(", ")
    )
}

/// Returns the advice for a scene that cannot be read; empty for messages that already end in advice.
fn help_of_scene(error: &SceneError) -> &'static str {
    match error {
        SceneError::Read { .. } => "check the name and that you may read the file",
        SceneError::Missing { .. } => {
            "put that file where the scene looks for it, and check that you may read it"
        }
        SceneError::TooLarge { .. } => "split or simplify the scene",
        SceneError::Syntax { .. }
        | SceneError::Invalid { .. }
        | SceneError::IndexOutOfRange { .. }
        | SceneError::NoTriangles { .. } => DAMAGED,
        SceneError::Sequence { .. } => {
            "numbered files go on without a gap, with the meshes and materials of the first"
        }
        SceneError::Image { .. } => "convert the image to .png or .jpg and refer to that",
        SceneError::Builtin { .. } => {
            "write NAME:PARAMETER=VALUE,PARAMETER=VALUE, or the name alone for its defaults"
        }
        _ => "",
    }
}

/// Returns the advice for a file of rays or hits that cannot be read.
pub(crate) fn help_of_rays(error: &FileError) -> &'static str {
    match error {
        FileError::Unreadable { .. } => "check the name and that you may read the file",
        FileError::NotRays { .. } => "name a .rays file or a .npy array of N x 6, 7 or 8 numbers",
        FileError::NotHits { .. } => "name a .npy array with fields t and primitive",
        FileError::Format { source, .. } => match source {
            FormatError::Magic { .. } | FormatError::Version { .. } | FormatError::Header { .. } => {
                "write the file again: .rays by --save-rays, .npy by numpy.save"
            }
            FormatError::Length { .. } => "the file is cut short or has something after it; write it again",
            FormatError::Content { .. } => "docs/ray-files.md shows the arrays that can be read",
            FormatError::Entry { .. } => {
                "directions must be finite and not zero, origins finite, and no number NaN; correct the entry"
            }
            FormatError::TooMany { .. } => "split the file",
            _ => "",
        },
        _ => "",
    }
}

/// Returns the message of a failure of `--denoise`.
pub(crate) fn message_of_denoiser(error: &DenoiseError) -> String {
    format!("--denoise: {error}")
}

/// Returns the advice for a failure of `--denoise`.
pub(crate) fn help_of_denoiser(error: &DenoiseError) -> &'static str {
    match error {
        DenoiseError::Missing { .. } | DenoiseError::Unsuitable { .. } => {
            "get version 2 from openimagedenoise.org or with `pip install pyoidn`, and where it is not found name \
             libOpenImageDenoise.so.2 in RASRAY_OIDN; or leave --denoise out"
        }
        _ => "leave --denoise out",
    }
}

/// Returns the advice for a window that cannot be opened, or shows no picture.
#[cfg(feature = "viewer")]
pub(crate) fn help_of_viewer(error: &rasray_viewer::ViewerError) -> Cow<'static, str> {
    use rasray_viewer::ViewerError;
    match error {
        ViewerError::Experiment(error) => help(error),
        ViewerError::Denoise(error) => help_of_denoiser(error).into(),
        ViewerError::NoCamera { .. } => "choose another camera".into(),
        ViewerError::Nowhere => "reset it".into(),
        ViewerError::NotCounted { .. } => "choose another system".into(),
        ViewerError::Moved => "pick again".into(),
        ViewerError::NoDisplay | ViewerError::NoWindow { .. } => {
            "set DISPLAY or WAYLAND_DISPLAY, or run `rasray render`, which needs none; a virtual display will do: xvfb-run \
             rasray view SCENE"
                .into()
        }
        ViewerError::Window { .. } => "`rasray render` needs no window".into(),
        _ => "".into(),
    }
}
