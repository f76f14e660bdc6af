//! Keys of pictures: if two keys are equal, one program makes equal pictures.

use crate::jobs::{Frame, RenderJob};
use rasray_options::OptionValues;
use rasray_scene::Camera;
use rasray_scene_source::{KeyHash, LoadedScene};
use std::collections::BTreeMap;

/// Computes the key of the picture that a job makes of a scene, 64 hexadecimal digits: a hash of everything
/// that decides the picture's values. That is the program (`program`: version and commit), the contents of
/// all files read or the built-in's name, the time, the camera, the system with its options, the integrator,
/// the size, the samples, the sampler and the seed, and the selection of additional images.
///
/// The key does not depend on the device, although light may differ in its last bits between devices. Neither
/// does it depend on the share of the samples: all shares of a picture have the key of the whole.
pub fn picture_key(program: &str, loaded: &LoadedScene, job: &RenderJob<'_>) -> String {
    // This pattern makes whoever adds a field decide whether the field changes the picture. `loaded` stands
    // for the scene and its moment.
    let RenderJob {
        scene: _,
        moment: _,
        camera,
        system,
        // The refresh does not change hits.
        refresh: _,
        frame,
        shard: _,
        aovs,
        before,
        needs: _,
        repetitions: _,
    } = job;
    let Frame { integrator, width, height, spp, adaptive, seed, sampler, primary, occluder, back_faces } =
        frame;
    let size = [width, height];
    let options = texts(&system.options);
    scene_hash(KeyHash::default().with("program", program), loaded)
        .with("camera", camera_text(camera))
        .with("system", format!("{} {} {options:?}", system.system.name, system.preset.name()))
        .with("integrator", format!("{} {:?}", integrator.name(), texts(&integrator.values())))
        .with("frame", format!("{size:?} {spp} {seed} {sampler:?} {primary:?} {occluder:?} {back_faces:?}"))
        .with("adaptive", format!("{adaptive:?}"))
        .with("aovs", format!("{aovs:?}"))
        .with(
            "before",
            format!("{:?}", before.as_ref().map(|it| (it.moment.seconds, camera_text(&it.camera)))),
        )
        .finish()
}

/// Hashes everything that a scene was made from, and the moment at which it is shown.
pub(crate) fn scene_hash(hash: KeyHash, loaded: &LoadedScene) -> KeyHash {
    hash.with("scene", &loaded.content)
        .with("file", loaded.sha256.as_deref().unwrap_or_default())
        .with("time", format!("{:?}", loaded.pose.as_ref().map(|pose| (pose.time_s, &pose.clips))))
        .with("smaller images", format!("{:?}", loaded.smaller_images))
}

/// Writes every property of a camera that a picture depends on. Numbers are written so that each reads back
/// exactly.
pub(crate) fn camera_text(camera: &Camera) -> String {
    let Camera { name: _, world_from_camera, projection, aspect_ratio, lens } = camera;
    format!("{world_from_camera:?} {projection:?} {aspect_ratio:?} {lens:?}")
}

/// Returns options by name, as they are written.
pub(crate) fn texts(values: &OptionValues) -> BTreeMap<String, String> {
    values.iter().map(|(name, value)| (name.to_owned(), value.to_string())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::{Aov, AovSelection, FrameBefore, OccluderKind, Primary, Refresh};
    use crate::{Adaptive, IntegratorRow, IntegratorSpec, Shard, one_system};
    use rasray_options::Value;
    use rasray_scene::needs::Needs;
    use rasray_scene::{BackFaces, Lens, Moment, Sampler};
    use rasray_scene_source::{default_view, load};
    use rasray_systems::{Preset, SYSTEMS};
    use std::collections::BTreeSet;
    use std::ffi::OsStr;

    fn integrator(name: &str) -> IntegratorSpec {
        IntegratorRow::named(name).expect("it is registered").into()
    }

    fn frame() -> Frame {
        Frame {
            integrator: integrator("path"),
            width: 4,
            height: 3,
            spp: 8,
            adaptive: None,
            seed: 1,
            sampler: Sampler::Sobol,
            primary: Primary::Trace,
            occluder: OccluderKind::Structure,
            back_faces: BackFaces::Camera,
        }
    }

    fn job(loaded: &LoadedScene) -> RenderJob<'_> {
        let system = one_system(&SYSTEMS[0], Preset::Robust, &OptionValues::default());
        RenderJob {
            scene: &loaded.scene,
            moment: None,
            camera: default_view(&loaded.scene).camera,
            system: system.expect("the default"),
            refresh: Refresh::All,
            frame: frame(),
            shard: None,
            aovs: AovSelection::default(),
            before: None,
            needs: Needs::all(),
            repetitions: 0,
        }
    }

    fn before(job: &RenderJob<'_>, seconds: f64) -> FrameBefore {
        FrameBefore { moment: Moment { seconds, clips: Vec::new() }, camera: job.camera.clone() }
    }

    #[test]
    fn whatever_changes_a_picture_changes_its_key_and_nothing_else_does() {
        let loaded = load(OsStr::new("cornell")).expect("built in");
        let key = |change: &dyn Fn(&mut RenderJob<'_>)| {
            let mut job = job(&loaded);
            change(&mut job);
            picture_key("1", &loaded, &job)
        };
        let first = key(&|_| ());
        let set = |job: &mut RenderJob<'_>, option, value: Value| {
            job.frame.integrator = job.frame.integrator.with(option, value).expect("valid");
        };
        let changes: [&dyn Fn(&mut RenderJob<'_>); 24] = [
            &|job| job.frame.spp = 4,
            &|job| job.frame.adaptive = Some(Adaptive { threshold: 0.1, least: 4 }),
            &|job| job.frame.adaptive = Some(Adaptive { threshold: 0.2, least: 4 }),
            &|job| job.frame.adaptive = Some(Adaptive { threshold: 0.1, least: 5 }),
            &|job| job.aovs = Aov::Samples.into(),
            &|job| job.frame.seed = 2,
            &|job| job.frame.width = 5,
            &|job| job.frame.sampler = Sampler::Pcg,
            &|job| job.frame.back_faces = BackFaces::None,
            &|job| job.frame.occluder = OccluderKind::ShadowMaps { resolution: 1024, points: 0 },
            &|job| job.frame.occluder = OccluderKind::ShadowMaps { resolution: 512, points: 0 },
            &|job| job.frame.occluder = OccluderKind::ShadowMaps { resolution: 512, points: 4 },
            &|job| set(job, "shadow-terminator", "offset".into()),
            &|job| set(job, "bounces", 3.into()),
            &|job| set(job, "glass-shadows", "opaque".into()),
            &|job| job.frame.integrator = integrator("ao"),
            &|job| {
                job.frame.integrator = integrator("ao");
                set(job, "ao-distance", 1.0e-30.into());
            },
            &|job| job.aovs = Aov::Depth.into(),
            &|job| job.before = Some(before(job, 0.0)),
            &|job| job.before = Some(before(job, 1.0)),
            &|job| job.camera.world_from_camera.translation.x = 1.0e-300,
            &|job| job.camera.lens = Some(Lens { aperture: 0.1, focus: 1.0 }),
            &|job| job.camera.lens = Some(Lens { aperture: 0.1, focus: 2.0 }),
            &|job| job.system.options = OptionValues::default().with("tile", 4),
        ];
        let keys: BTreeSet<_> = changes.iter().map(|change| key(change)).chain([first.clone()]).collect();
        assert_eq!(keys.len(), changes.len() + 1);
        assert_ne!(picture_key("2", &loaded, &job(&loaded)), first, "another program");
        let same: [&dyn Fn(&mut RenderJob<'_>); 5] = [
            &|job| set(job, "bounces", 8.into()),
            &|job| job.repetitions = 3,
            &|job| job.refresh = Refresh::Moving,
            &|job| job.shard = Shard::new(2, 4),
            &|job| job.camera.name = "another".to_owned(),
        ];
        assert!(same.iter().all(|change| key(change) == first));
    }
}
