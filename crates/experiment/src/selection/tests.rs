use super::*;
use crate::{Frame, Primary};
use rasray_ads::AdsError;
use rasray_scene::needs::Workload;
use rasray_scene::{Camera, Projection};
use rasray_systems::SYSTEMS;

fn options(given: &[(&str, &str)]) -> OptionValues {
    let read = |(name, text): &(&str, &str)| {
        let row = &rasray_systems::option(name).expect("an option").row;
        (row.name, row.parse(text).expect("a value of it"))
    };
    given.iter().map(read).collect()
}

fn with_buckets() -> OptionValues {
    options(&[("buckets", "4")])
}

fn frame(primary: Primary) -> Frame {
    Frame {
        integrator: rasray_integrators::IntegratorRow::named("raycast").expect("registered").into(),
        width: 720,
        height: 480,
        spp: 1,
        adaptive: None,
        seed: 1,
        sampler: crate::Sampler::Sobol,
        primary,
        occluder: crate::OccluderKind::Structure,
        back_faces: rasray_scene::BackFaces::Camera,
    }
}

fn system(name: &str) -> &'static System {
    System::named(name).expect("a system of the registry")
}

#[test]
fn published_fragments_carry_what_their_paper_keeps_for_occlusion() {
    let (occlusion, path) = (Workload::VISIBILITY, Workload::ALL);
    let plain = OptionValues::default();
    for system in SYSTEMS {
        let Ok(config) = one_system(system, Preset::Published, &plain) else { continue };
        let payload = config.clone().serving(occlusion).options.text("payload");
        assert_eq!(payload.as_deref(), system.frame.and_then(|frame| frame.occlusion_payload));
        assert!(config.clone().serving(occlusion).spec().is_ok());
        assert_eq!(config.clone().serving(path), config);
    }
    let given = options(&[("payload", "attributes")]);
    for (preset, options) in [(Preset::Published, &given), (Preset::Robust, &plain)] {
        let config = one_system(system("mmrt"), preset, options).expect("valid");
        assert_eq!(config.clone().serving(occlusion), config);
    }
    assert_eq!(system("mmrt").frame.and_then(|frame| frame.occlusion_payload), Some("normal"));
    let plane = options(&[("payload", "plane")]);
    let plane = one_system(system("mmrt"), Preset::Robust, &plane).expect("valid");
    assert!(plane.shortcoming(path).expect("white surfaces").contains("`payload` plane"));
    assert_eq!(plane.shortcoming(occlusion), None);
    let attributes = one_system(system("mmrt"), Preset::Published, &given).expect("valid");
    assert_eq!(attributes.shortcoming(path), None);
}

#[test]
fn published_views_are_those_of_the_paper() {
    let eye = glam::DVec3::new(0.0, 0.0, 4.0);
    let camera = rasray_scene::default_view::camera_looking_at("", eye, glam::DVec3::ZERO, 1.0);
    let plain = OptionValues::default();
    for system in SYSTEMS {
        for preset in [Preset::Robust, Preset::Published] {
            let Ok(config) = one_system(system, preset, &plain) else { continue };
            for primary in Primary::ALL {
                let seen = config.clone().seen_by(&camera, &frame(primary));
                let draws = preset == Preset::Published || primary == Primary::Fragments;
                let views = system.frame.and_then(|frame| frame.camera_views).filter(|_| draws);
                assert_eq!(seen.options.text("views").as_deref(), views);
                assert_eq!(seen.options.text("camera-resolution").as_deref(), views.map(|_| "720x480"));
                seen.spec().expect("the options go together");
            }
        }
    }
    assert_eq!(system("mmrt").frame.and_then(|frame| frame.camera_views), Some("cube+camera"));
    let traced = frame(Primary::Trace);
    let published = one_system(system("mmrt"), Preset::Published, &plain).expect("valid");
    let parallel = Camera { projection: Projection::Orthographic { half_height: 1.0 }, ..camera.clone() };
    assert_eq!(published.clone().seen_by(&parallel, &traced), published);
    let given = options(&[("views", "cube")]);
    let given = one_system(system("mmrt"), Preset::Published, &given).expect("valid");
    assert_eq!(given.clone().seen_by(&camera, &traced), given);
}

#[test]
fn values_that_do_not_go_together_are_refused_before_a_device_is_opened() {
    let options = options(&[("accept", "plane")]);
    let error = one_system(system("mmrt"), Preset::Published, &options).expect_err("no plane in attributes");
    assert!(matches!(error, ExperimentError::Ads(AdsError::Option { .. })), "{error:?}");
    assert!(error.to_string().contains("payload"), "{error}");
    assert!(one_system(system("mmrt"), Preset::Robust, &options).is_ok());
}

#[test]
fn an_option_of_another_system_is_refused_by_name() {
    let error =
        one_system(system("brute-force"), Preset::Robust, &with_buckets()).expect_err("not its option");
    assert!(matches!(error, ExperimentError::Selection(SelectionError::NoOption { .. })), "{error:?}");
    assert!(error.to_string().contains("buckets"), "{error}");
    assert!(one_system(system("mmrt"), Preset::Robust, &with_buckets()).is_ok());
}

#[test]
fn in_a_comparison_an_option_goes_to_those_who_have_it() {
    let names = [system("mmrt"), system("brute-force"), system("mmrt")];
    let presets = [Preset::Published, Preset::Robust];
    let configs =
        several_systems(&names, &presets, &with_buckets(), &["mmrt.samples=50".to_owned()]).expect("valid");
    let shape: Vec<_> =
        configs.iter().map(|c| (c.system.name, c.preset, c.options.text("buckets"))).collect();
    assert_eq!(
        shape,
        [
            ("mmrt", Preset::Published, Some("4".to_owned())),
            ("mmrt", Preset::Robust, Some("4".to_owned())),
            ("brute-force", Preset::Robust, None),
        ]
    );
    assert_eq!(configs[0].options.text("samples").as_deref(), Some("50"));
}

#[test]
fn several_values_make_as_many_contestants() {
    let assigned = ["mmrt.samples=50,100".to_owned(), "mmrt.sort=on,off".to_owned()];
    let names = [system("mmrt"), system("brute-force")];
    let configs =
        several_systems(&names, &[Preset::Robust], &OptionValues::default(), &assigned).expect("valid");
    let shape: Vec<_> =
        configs.iter().map(|c| (c.system.name, c.options.text("samples"), c.options.text("sort"))).collect();
    assert_eq!(shape.len(), 5);
    assert_eq!(shape[4], ("brute-force", None, None));
    let variants: Vec<_> = configs.iter().map(|config| config.variant.as_deref()).collect();
    let of = |samples, sort| format!("samples={samples} sort={sort}");
    assert_eq!(variants[0], Some(of(50, "on").as_str()));
    assert_eq!(variants[3], Some(of(100, "off").as_str()));
    assert_eq!(variants[4], None);
    for (index, samples) in [(0, 50), (1, 50), (2, 100), (3, 100)] {
        assert_eq!((shape[index].0, shape[index].1.clone()), ("mmrt", Some(samples.to_string())));
    }
    assert!(shape[0].2.is_some() && shape[0].2 != shape[1].2 && shape[0].2 == shape[2].2);
}

#[test]
fn in_a_comparison_what_nobody_has_is_refused() {
    let evaluate = [system("brute-force")];
    let plain = OptionValues::default();
    assert!(several_systems(&evaluate, &[Preset::Robust], &with_buckets(), &[]).is_err());
    assert!(several_systems(&evaluate, &[Preset::Published], &plain, &[]).is_err());
    for bad in [
        "mmrt.samples=50",
        "mmrt",
        "nobody.sort=on",
        "brute-force.sort=on",
        "mmrt.sort=x",
        "mmrt.sort=on,x",
        "mmrt.sort=on,",
    ] {
        let error = several_systems(&evaluate, &[Preset::Robust], &plain, &[bad.to_owned()]).expect_err(bad);
        assert!(matches!(error, ExperimentError::Selection(_)), "{error:?}");
    }
}
