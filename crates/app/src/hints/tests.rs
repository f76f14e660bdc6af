use super::*;
use crate::error::AppError;
use rasray_ads::PoolStatus;
use rasray_experiment::{Holder, OptionValues, one_system};
use rasray_options::Value;
use rasray_systems::{Preset, Spec};
use std::error::Error;
use std::io;
use std::path::PathBuf;

fn gpu() -> GpuError {
    GpuError::DeviceLost { call: "vkQueueSubmit", during: "trace".to_owned() }
}

fn too_large() -> GpuError {
    GpuError::TooLarge { name: "bricks entries".to_owned(), size: 9, limit: 8 }
}

fn denied() -> io::Error {
    io::ErrorKind::PermissionDenied.into()
}

fn file() -> PathBuf {
    "a.glb".into()
}

fn system(name: &str) -> &'static System {
    System::named(name).expect("registered")
}

fn scene() -> String {
    "hall".to_owned()
}

/// Checks the exit code and the two lines of an error.
fn check(code: u8, message: &str, help: &str, error: impl Into<AppError>) {
    let error = error.into();
    let lines = error.lines();
    assert_eq!(error.exit_code(), code, "{lines}{error:?}");
    assert!(error.to_string().contains(message), "`{message}` is missing: {lines}{error:?}");
    assert!(error.help().contains(help), "`{help}` is missing: {lines}{error:?}");
    assert_eq!(error.help().is_empty(), help.is_empty(), "{lines}{error:?}");
    let about = error.about("frame 3");
    assert_eq!(about.exit_code(), code);
    assert_eq!(about.lines(), lines.replacen(": ", ": frame 3: ", 1));
}

#[test]
fn only_what_a_device_lacks_or_fails_at_ends_with_3() {
    use ExperimentError as E;
    check(3, "no Vulkan device", "rasray info", E::Opening(GpuError::NoDevice));
    check(3, "the device was lost", "another --device", E::Gpu(gpu()));
    let refused = || GpuError::Memory { name: "queue".to_owned(), reason: "no type fits".to_owned() };
    check(3, "memory for `queue` could not be had: no type fits", "--resolution", E::Gpu(refused()));
    check(3, "no type fits", "--size", E::Integrator(refused().into()));
    check(3, "the device was lost", "--resolution", E::Ads(gpu().into()));
    check(3, "the device was lost", "--size", E::Integrator(gpu().into()));
    check(3, "the device was lost", "--resolution", E::from(FrameError::Gpu(gpu())));
    check(3, "the device was lost", "--resolution", E::from(TracerError::Ads(gpu().into())));
    check(3, "the device was lost", "--resolution", E::GpuScene(gpu().into()));
    check(3, "the scene's bricks entries", "fewer triangles", E::from(GpuSceneError::Gpu(too_large())));
    let texels = GpuSceneError::TooManyTexels { count: 9, limit: 8 };
    check(3, "textures need 9 texels", "images", E::from(texels));
    for (name, pool) in [("mmrt", "a smaller --resolution"), ("bricks", "a smaller --grid")] {
        let error = || E::PoolExceedsBinding { system: system(name), source: too_large() };
        check(3, "bricks entries", pool, error());
        check(3, "bricks entries", "--addressing address", error());
    }
    let extension = ["coverage", "conservative-extension"].map(str::to_owned).into();
    let spec = Spec::new("dirt", "robust", [extension]).expect("valid");
    let feature = *spec.requirements().expect("valid").required.last().expect("some feature");
    let device = || "some device".to_owned();
    let lacks = E::SystemNeedsFeature { system: "dirt", feature, device: device() };
    check(3, "which some device lacks", "--system", lacks);
    let word = Value::Word("conservative-extension");
    let lacks =
        E::OptionNeedsFeature { system: "dirt", option: "coverage", value: word, feature, device: device() };
    check(
        2,
        "--coverage conservative-extension of dirt needs",
        "leave out --coverage conservative-extension",
        lacks,
    );
    let image =
        |memory| E::ImageTooLarge { size: [8192, 8192], bytes_per_pixel: 16, available: 1 << 29, memory };
    check(3, "16 bytes a pixel), and the device has 512.00 MiB", "at most 33,554,432", image(Holder::Device));
    check(2, "this machine has 512.00 MiB", "choose a --size", image(Holder::Host));
    let reason = || "no atomics".to_owned();
    let drawn = IntegratorError::CannotDraw { reason: reason() };
    check(3, "no atomics", "--primary trace", E::from(drawn));
    let fetched = IntegratorError::CannotFetch { reason: reason() };
    check(3, "no atomics", "--fetch raster", E::from(fetched));
    let maps = |points| E::ShadowMaps { points, source: FrameError::Gpu(gpu()) };
    check(3, "--occluder shadow-maps: the device was lost", "--shadow-resolution, or", maps(0));
    check(3, "--occluder shadow-maps: the device was lost", "--shadow-points", maps(2));
}

#[test]
fn what_is_not_whole_is_refused() {
    use ExperimentError as E;
    let bvh = "bvh";
    let pool = Some(PoolStatus { name: "nodes", demand: 9, capacity: 8 });
    let unstable = TracerError::Unstable { structure: bvh, rebuilds: 4, pool };
    check(4, "not stable: nodes holds 8 and takes 9", "not kept", E::from(unstable));
    check(4, "did not finish", "not kept", E::from(TracerError::Unfinished { unfinished: 2, rounds: 3 }));
    check(4, "invalid index", "not kept", E::from(TracerError::Corrupted { structure: bvh, entries: 1 }));
    check(4, "not built", "not kept", E::from(FrameError::Tracer(TracerError::NotReady { rays: 1 })));
    check(4, "2 rays did not finish", "--system bvh", E::from(FrameError::Unfinished { rays: 2 }));
    let unstable = FrameError::Unstable { structure: bvh, repeats: 9, pool };
    check(4, "not stable: nodes holds 8 and takes 9", "not kept", E::from(unstable));
    let unstable = FrameError::Unstable { structure: bvh, repeats: 9, pool: None };
    check(4, "after 9 repeats; its demand is not stable", "not kept", E::from(unstable));
    let system = || "bvh robust".to_owned();
    check(4, "3 entries", "--resolution", E::MissingEntries { system: system(), entries: 3 });
    check(4, "2 rays had no answer", "--system bvh", E::Unanswered { system: system(), rays: 2 });
    let damaged = AdsError::Damaged { structure: bvh, fault: "a loop".to_owned() };
    check(4, "a loop", "not kept", E::from(damaged));
}

#[test]
fn what_is_to_be_reported_as_a_defect_ends_with_5() {
    use ExperimentError as E;
    let of = |message: &str, error: E| check(5, message, DEFECT, error);
    let misused = || GpuError::InvalidUse { name: "queue".to_owned(), reason: "it has no slots".to_owned() };
    of("it has no slots", E::Gpu(misused()));
    of("it has no slots", E::Ads(misused().into()));
    of("it has no slots", E::GpuScene(misused().into()));
    of("it has no slots", E::Integrator(misused().into()));
    of("it has no slots", E::Integrator(IntegratorError::Ads(misused().into())));
    let surfaces = IntegratorError::SurfacesOfHits { structure: "hu" };
    of("leave out `surfaces_of_hits`", E::Integrator(surfaces));
    of("call prepare_build", E::from(AdsError::NotPrepared { structure: "bvh" }));
    of("slot 2 of 2", E::from(AdsError::Slot { structure: "bvh", slot: 2, slots: 2 }));
    of("log steps", E::from(TracerError::NoSteps { structure: "bvh" }));
    of("all 2 slots", E::from(TracerError::Busy { slots: 2 }));
    of("not made to move", E::NotPosed);
    let image = E::MissingPixels { image: "depth", pixels: 1, expected: 2 };
    of("1 of 2 pixels; nothing was written", image);
    of("validation layer says: bad", E::Validation { message: "bad".to_owned() });
    of("triangles of E5", E::OtherTriangles { case: "E5".to_owned() });
    of("not finite", E::from(MetricsError::NonFiniteReference { pixel: 0 }));
}

#[test]
fn what_was_asked_for_or_is_in_a_file_ends_with_2() {
    use ExperimentError as E;
    check(2, "too large for FLIP", "--size", E::from(MetricsError::TooLarge { size: [9, 9] }));
    check(2, "32-bit ids", "fewer", E::from(OracleError::TooManyTriangles { triangles: 9 }));
    check(2, "no multiple of three", "export", E::from(OracleError::IncompleteTriangle { indices: 2 }));
    let empty = ReferenceError::EmptyImage { width: 0, height: 1, samples: 1 };
    check(2, "is empty", "--size", E::from(empty));
    let many = ReferenceError::Oracle(OracleError::TooManyTriangles { triangles: 9 });
    check(2, "32-bit ids", "fewer", E::from(many));
    let named = ReferenceError::Malformed { what: "a material".to_owned(), count: 0 };
    check(2, "a material", "export", E::from(named));
    check(
        2,
        "9 posed vertices",
        "fewer triangles",
        E::from(GpuSceneError::TooManyVertices { count: 9, limit: 8 }),
    );
    let named = GpuSceneError::Malformed { what: "a mesh".to_owned(), limit: 1 };
    check(2, "a mesh", "export", E::from(named));
    let twice = GpuSceneError::DeformedTwice { scene: scene(), mesh: "cloth".to_owned() };
    check(2, "deformed by a rig and", "export", E::from(twice));
    let other = GpuSceneError::OtherTriangles { scene: scene(), mesh: 0, seconds: 1.0 };
    check(2, "other triangles", "--time", E::from(other));
    let option = |option| AdsError::Option { option, value: "7".to_owned(), expected: "at most 6" };
    check(2, "at most 6", "change the option", E::from(option("layers")));
    let fetch = IntegratorError::Ads(option("fetch"));
    check(2, "at most 6", "leave out --fetch raster", E::from(FrameError::Integrator(fetch)));
    check(2, "no view of the camera", "--primary trace", E::from(AdsError::NoFirstHits { structure: "bvh" }));
    let parts = AdsError::InParts { structure: "hu", reason: "it is one" };
    check(2, "in parts", "--refresh", E::from(parts));
    check(2, "camera rays are drawn", "--adaptive", E::from(FrameError::DrawnAdaptively));
    let integrator = IntegratorError::UnknownOption { integrator: "ao", option: "bounces" };
    check(2, "no option `bounces`", "--integrator", E::from(integrator));
    let crowded = IntegratorError::Crowded { surfaces: 3, limit: 9 };
    check(2, "3 surfaces have more than 9 photons", "--radius", E::from(FrameError::Integrator(crowded)));
    let photons = IntegratorError::PhotonBytes { bytes: 7, limit: 5 };
    check(2, "7 bytes", "--photon-paths", E::from(photons));
    let size = IntegratorError::ImageSize { width: 0, height: 1, limit: 9 };
    check(2, "0 x 1", "--size", E::from(size));
    check(2, "--primary raster draws through", "--primary trace", E::Pinhole { primary: "raster" });
    check(2, "--primary fragments: bvh has no view", "--views", E::NoFirstHits { structure: "bvh" });
    check(2, "no part that stands still", "--refresh", E::NoStillPart);
    let ray = E::NoSuchRay { index: 9, set: "eye".to_owned(), rays: 3 };
    check(2, "there is no ray 9 in eye, which has 3", "--rays", ray);
    let count = E::HitCount { name: "other".to_owned(), hits: 2, rays: 3, set: "eye".to_owned() };
    check(2, "2 hits for the 3 rays", "one hit", count);
    let reference = E::NoReference { known: "path, ao".to_owned() };
    check(2, "--image compares with the reference", "--integrator", reference);
    let temporary = E::TemporaryFile { path: file(), source: denied() };
    check(2, "a.glb: cannot be written: permission denied", "TMPDIR", temporary);
    check(2, "signals cannot be handled", "SIGINT", AppError::Signals(denied()));
}

#[test]
fn shadow_maps_that_cannot_answer_name_what_can() {
    let of = |code, message: &str, help: &str, error: OccluderError| {
        check(code, &format!("--occluder shadow-maps: {message}"), help, ExperimentError::from(error));
    };
    of(2, "surfaces of this scene", "--alpha off", OccluderError::Blended);
    of(2, "panes of this scene", "--glass-shadows", OccluderError::Panes { can_be_opaque: true });
    of(2, "panes of this scene", "--occluder structure", OccluderError::Panes { can_be_opaque: false });
    of(2, "the integrator ao", "--integrator path", OccluderError::NoShadowRays { integrator: "ao" });
    of(2, "maps have both sides", "--back-faces all", OccluderError::BackFaces);
}

#[test]
fn systems_and_options_that_do_not_go_together_name_those_that_do() {
    use SelectionError as S;
    let of = |message: &str, help: &str, error: S| check(2, message, help, ExperimentError::from(error));
    let (bvh, mmrt) = (system("bvh"), system("mmrt"));
    let text = || "mmrt.sort=x".to_owned();
    of("bvh has no preset published", "mmrt", S::NoPreset { system: bvh, preset: Preset::Published });
    of("bvh has no option --storage", "mmrt", S::NoOption { system: bvh, option: "storage" });
    let none = S::NoneHasOption { systems: vec![bvh], option: "storage" };
    of("none of the systems bvh has an option --storage", "--systems", none);
    let none = S::NoneHasPreset { systems: vec![bvh, mmrt], preset: Preset::Published };
    of("none of the systems bvh, mmrt has", "--presets", none);
    of("mmrt, which is not compared", "add mmrt to --systems", S::SystemNotCompared { system: mmrt });
    let preset = S::PresetNotCompared { preset: Preset::Published };
    of("published, which is not compared", "add published to --presets", preset);
    of("SYSTEM.OPTION=VALUE", "mmrt.samples=50", S::Form { assignment: text() });
    let unknown = S::UnknownSystem { assignment: text(), system: "mnrt".to_owned() };
    of("there is no system mnrt", "mmrt", unknown);
    let unknown = S::UnknownOption { assignment: text(), system: bvh, option: "storage".to_owned() };
    of("bvh has no option storage", "mmrt", unknown);
    let row = mmrt.option("sort").expect("an option");
    let value = row.parse("x").expect_err("no switch");
    of("sort x is not possible", "--sort:", S::Value { assignment: text(), row, source: value.clone() });
    let value = SystemsError::Value { system: "mmrt", source: value };
    check(2, "mmrt: --sort x is not possible", "change the option", ExperimentError::from(value));
    let unknown = SystemsError::UnknownPreset { system: "bvh", preset: "best".to_owned() };
    check(2, "no preset `best`", "--help", ExperimentError::from(unknown));
    let refused = one_system(mmrt, Preset::Published, &OptionValues::default().with("accept", "plane"));
    check(2, "payload", "change the option", refused.expect_err("published keeps no plane"));
}

#[test]
fn scenes_and_views_that_are_not_there_name_those_that_are() {
    use LoadError as L;
    let of = |message: &str, help: &str, error: L| check(2, message, help, error);
    of("a.glb: is not a scene file", "scenes are .gltf", L::NoSceneFile { path: file() });
    of("a.glb: there is neither", "built-in: cornell", L::NoSuchScene { path: file(), meant: None });
    let meant = L::NoSuchScene { path: "cornel".into(), meant: Some("cornell".to_owned()) };
    of("cornel: there is neither", "did you mean cornell? scenes are", meant);
    of("a.glb: cannot be read again", "in place", L::Gone { path: file(), source: denied() });
    let camera = |cameras: &[&str]| L::NoSuchCamera {
        scene: scene(),
        wanted: "door".to_owned(),
        cameras: cameras.iter().map(ToString::to_string).collect(),
    };
    of("the scene hall has no camera 'door'", "--eye and --target", camera(&[]));
    of("the scene hall has no camera 'door'", "0 'front', 1 'top'", camera(&["front", "top"]));
    of("parallel projection", "--aperture", L::ParallelLens { camera: "top".to_owned() });
    of("nothing says what is", "--focus METRES", L::NoFocus);
    of("--eye and --target give no direction", "--target", L::NoDirection);
    of("no clips that could move it", "--time", L::NothingMoves { scene: scene() });
    of("it deforms in one way", "--clip", L::NoClips { scene: scene() });
    let clip = L::NoSuchClip { scene: scene(), wanted: "fly".to_owned(), clips: vec!["walk".to_owned()] };
    of("no clip 'fly'", "0 (walk)", clip);
    let reason = || "cut short".to_owned();
    for (error, help) in [
        (SceneError::Read { path: file(), source: denied() }, "check the name"),
        (SceneError::too_large(&file(), "a mesh", 9, 8, "most_triangles"), "simplify"),
        (SceneError::syntax(&file(), "line 2"), "export it again"),
        (SceneError::Image { path: file(), image: "a.webp".to_owned(), reason: reason() }, ".png"),
        (SceneError::Sequence { path: file(), problem: reason() }, "without a gap"),
        (SceneError::Internal { path: file(), reason: reason() }, ""),
    ] {
        of("a.glb", help, L::Scene(error));
    }
}

#[test]
fn files_of_rays_say_how_they_are_written() {
    let of = |message: &str, help: &str, error: FileError| check(2, message, help, error);
    let format = |source| FileError::Format { path: file(), source };
    of("a.glb: cannot be read", "check the name", FileError::Unreadable { path: file(), source: denied() });
    of("not a file of rays", ".rays file", FileError::NotRays { path: file() });
    of("not a file of hits", "t and primitive", FileError::NotHits { path: file() });
    of("a.glb: does not begin", "--save-rays", format(FormatError::Magic { format: ".rays" }));
    of("has 3 bytes", "cut short", format(FormatError::Length { bytes: 3, promised: 4 }));
    let content = FormatError::Content { what: "text".to_owned(), wanted: "numbers" };
    of("holds text", "docs/ray-files.md", format(content));
    of("entry 1", "correct the entry", format(FormatError::Entry { index: 1, what: "NaN" }));
    of("holds 9 entries", "split", format(FormatError::TooMany { entries: 9 }));
}

#[cfg(feature = "viewer")]
#[test]
fn windows_say_what_they_need() {
    use rasray_viewer::ViewerError as V;
    check(3, "neither DISPLAY nor", "xvfb-run", V::NoDisplay);
    check(3, "no display for a window: hidden", "xvfb-run", V::NoWindow { source: "hidden".into() });
    let window = V::Window { during: "a frame", source: denied().into() };
    check(3, "a frame: permission denied", "rasray render", window);
    check(2, "no camera 3", "choose another camera", V::NoCamera { index: 3 });
    check(2, "numbers can say", "reset", V::Nowhere);
    check(2, "hu does not count", "another system", V::NotCounted { system: "hu" });
    check(2, "has moved", "pick again", V::Moved);
    check(
        4,
        "2 rays",
        "--system bvh",
        V::from(ExperimentError::Unanswered { system: "hu".to_owned(), rays: 2 }),
    );
    check(2, "no direction", "--target", V::from(LoadError::NoDirection));
}

/// Returns the first error of a type in a chain.
fn found<T: Error + 'static>(error: &AppError) -> Option<&T> {
    let chain = std::iter::successors(error.source(), |error| (*error).source());
    chain.into_iter().find_map(|error| error.downcast_ref())
}

#[test]
fn sources_are_kept_up_to_the_command() {
    let of_file = SceneError::Read { path: file(), source: denied() };
    let error = AppError::from(LoadError::Scene(of_file)).about("frame 3");
    assert_eq!(found(&error).map(io::Error::kind), Some(io::ErrorKind::PermissionDenied));
    assert!(matches!(found(&error), Some(ExperimentError::Load(LoadError::Scene(_)))), "{error:?}");

    let error = AppError::from(FileError::Unreadable { path: file(), source: denied() });
    assert_eq!(found(&error).map(io::Error::kind), Some(io::ErrorKind::PermissionDenied));

    let format = FileError::Format { path: file(), source: FormatError::TooMany { entries: 9 } };
    assert_eq!(found(&AppError::from(format)), Some(&FormatError::TooMany { entries: 9 }));

    let source = FrameError::Tracer(TracerError::Gpu(gpu()));
    let error = AppError::from(ExperimentError::ShadowMaps { points: 0, source });
    let kept: Option<&FrameError> = found(&error);
    assert!(matches!(kept, Some(FrameError::Tracer(TracerError::Gpu(_)))), "{error:?}");

    let row = system("mmrt").option("sort").expect("an option");
    let value = row.parse("x").expect_err("no switch");
    let error =
        AppError::from(ExperimentError::from(SystemsError::Value { system: "mmrt", source: value.clone() }));
    assert_eq!(found(&error), Some(&value));

    assert_eq!(
        found(&AppError::Signals(denied())).map(io::Error::kind),
        Some(io::ErrorKind::PermissionDenied)
    );
}
