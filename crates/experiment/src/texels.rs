//! Images that are made smaller because a device does not hold the texels of all.

use crate::backend::TexelRoom;
use crate::error::ExperimentError;
use crate::scene_source::LoadedScene;
use rasray_gpu_scene::{GpuSceneError, Parts, SmallerImage, TEXEL_BYTES, TexelDemand};
use rasray_report::{SmallerImageRecord, bytes};
use rasray_scene::Scene;
use rasray_scene::needs::Needs;

/// Bytes of texels that every device holds: Vulkan grants each of the buffers 128 MiB.
pub const HELD_BY_EVERY_DEVICE: u64 = 512 << 20;

/// The texels that the textures of a scene have as far as they are needed.
///
/// # Errors
/// The scene names what it does not have.
pub fn demand(scene: &Scene, needs: &Needs) -> Result<TexelDemand, ExperimentError> {
    TexelDemand::of(scene, &Parts::from(needs)).map_err(refused)
}

/// Which images a device does not hold as they are.
///
/// # Errors
/// Even images of one texel each are too many.
pub fn smaller_images(demand: &TexelDemand, room: &TexelRoom) -> Result<Vec<SmallerImage>, ExperimentError> {
    demand.smaller_images(room.texels).map_err(refused)
}

/// Makes the largest images smaller until the device holds the texels of all, and says in words what it did, if anything.
/// Whoever reads the scene afterwards, the reference too, reads these images.
///
/// # Errors
/// Even images of one texel each are too many.
pub fn fit(
    loaded: &mut LoadedScene,
    needs: &Needs,
    room: &TexelRoom,
) -> Result<Option<String>, ExperimentError> {
    let demand = demand(&loaded.scene, needs)?;
    let smaller = smaller_images(&demand, room)?;
    let text = described(&smaller, demand.bytes(), room);
    smaller.iter().for_each(|image| image.apply(&mut loaded.scene));
    loaded.smaller_images = records(&smaller);
    Ok(text)
}

/// What is made smaller, and why; nothing where nothing is. The largest come first: they were so before, too.
pub fn described(smaller: &[SmallerImage], demand: u64, room: &TexelRoom) -> Option<String> {
    let first = smaller.iter().max_by_key(|image| image.from.map(u64::from).iter().product::<u64>())?;
    let ([width, height], [to_width, to_height]) = (first.from, first.to);
    let what = match smaller {
        [_] => format!("image `{}` is", first.name),
        many => format!("{} images are made smaller, the largest, `{}`, is", many.len(), first.name),
    };
    Some(format!(
        "{what} read as {to_width}x{to_height} instead of {width}x{height}: the texels of all textures with their \
         smaller levels are {}, and {} holds {}",
        bytes(demand),
        room.device,
        bytes(room.texels * TEXEL_BYTES),
    ))
}

/// As reports and `rasray info --json` name them.
pub fn records(smaller: &[SmallerImage]) -> Vec<SmallerImageRecord> {
    let record = |image: &SmallerImage| SmallerImageRecord {
        name: image.name.clone(),
        from: image.from,
        to: image.to,
    };
    smaller.iter().map(record).collect()
}

fn refused(error: GpuSceneError) -> ExperimentError {
    ExperimentError::device(error, "use fewer textures, or another --device")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_scene::builtin;
    use rasray_scene::needs::{Integrator, Workload};

    fn loaded() -> LoadedScene {
        let scene = builtin::builtin("atrium").expect("a name").expect("no parameters");
        LoadedScene { scene, triangles: 0, sha256: None, smaller_images: Vec::new() }
    }

    #[test]
    fn what_fits_stays_and_what_does_not_is_named() {
        let needs = |loaded: &LoadedScene| {
            Needs::of(&loaded.scene, Workload { integrator: Integrator::Path, bounces: 8 })
        };
        let mut whole = loaded();
        let asked = demand(&whole.scene, &needs(&whole)).expect("whole");
        assert!(asked.texels() > 100);
        let room = |texels| TexelRoom { texels, device: "a small device".to_owned() };
        let sizes = |loaded: &LoadedScene| -> Vec<_> {
            loaded.scene.images.iter().map(|image| (image.width, image.height)).collect()
        };
        let before = sizes(&whole);
        let needed = needs(&whole);
        assert_eq!(fit(&mut whole, &needed, &room(asked.texels())).expect("room"), None);
        assert_eq!((sizes(&whole), whole.record().smaller_images), (before.clone(), Vec::new()));

        let said = fit(&mut whole, &needed, &room(asked.texels() / 8)).expect("room").expect("words");
        let records = whole.record().smaller_images;
        assert!(!records.is_empty() && sizes(&whole) != before);
        for record in &records {
            assert!(record.to[0] < record.from[0] && !record.name.is_empty(), "{record:?}");
        }
        assert!(demand(&whole.scene, &needed).expect("whole").texels() <= asked.texels() / 8);
        let smaller = asked.smaller_images(asked.texels() / 8).expect("room");
        let text = described(&smaller, asked.bytes(), &room(asked.texels() / 8)).expect("something");
        assert_eq!(said, text);
        let largest = records.iter().map(|record| record.from[0]).max().expect("some");
        assert!(
            text.contains(&format!(" instead of {largest}x")) && text.contains("a small device"),
            "{text}"
        );
        // None where even one texel an image is too much.
        let error = fit(&mut loaded(), &needed, &room(0)).expect_err("no room");
        assert!(error.to_string().contains("more than the 0"), "{error}");
    }
}
