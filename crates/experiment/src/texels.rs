//! Texels of a scene's textures, and images that are made smaller because a device cannot hold the texels of
//! all images.

use crate::backend::TexelCapacity;
use crate::error::ExperimentError;
use rasray_gpu_scene::{Parts, SmallerImage, TEXEL_BYTES, TexelDemand};
use rasray_report::{SmallerImageRecord, bytes};
use rasray_scene::Scene;
use rasray_scene::needs::Needs;
use rasray_scene_source::LoadedScene;
use serde_json::{Value, json};

/// Bytes of texels that every device holds: Vulkan grants each of the buffers 128 MiB.
const HELD_BY_EVERY_DEVICE: u64 = 512 << 20;

/// Returns the needed texels of a scene's textures.
///
/// # Errors
/// The scene refers to data that it does not have.
fn demand(scene: &Scene, needs: &Needs) -> Result<TexelDemand, ExperimentError> {
    Ok(TexelDemand::of(scene, &Parts::from(needs))?)
}

/// Returns the images that must be made smaller for a device.
///
/// # Errors
/// The device cannot hold even images of one texel each.
fn smaller_images(
    demand: &TexelDemand,
    capacity: &TexelCapacity,
) -> Result<Vec<SmallerImage>, ExperimentError> {
    Ok(demand.smaller_images(capacity.texels)?)
}

/// Makes the largest images smaller until the device can hold the texels of all images, and returns a
/// description of the change, if any. Everything that reads the scene afterwards, including the reference,
/// reads the smaller images.
///
/// # Errors
/// The device cannot hold even images of one texel each.
pub fn fit(
    loaded: &mut LoadedScene,
    needs: &Needs,
    capacity: &TexelCapacity,
) -> Result<Option<String>, ExperimentError> {
    let demand = demand(&loaded.scene, needs)?;
    let smaller = smaller_images(&demand, capacity)?;
    let text = described(&smaller, demand.bytes(), capacity);
    smaller.iter().for_each(|image| image.apply(&mut loaded.scene));
    loaded.smaller_images = records(&smaller);
    Ok(text)
}

/// Describes the images that are made smaller, and the reason; `None` if there are none. The largest come
/// first, by the sizes before.
fn described(smaller: &[SmallerImage], demand: u64, capacity: &TexelCapacity) -> Option<String> {
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
        capacity.device,
        bytes(capacity.texels * TEXEL_BYTES),
    ))
}

/// Converts to the records of reports and of `rasray info --json`.
fn records(smaller: &[SmallerImage]) -> Vec<SmallerImageRecord> {
    let record = |image: &SmallerImage| SmallerImageRecord {
        name: image.name.clone(),
        from: image.from,
        to: image.to,
    };
    smaller.iter().map(record).collect()
}

/// Number of bytes of texels, and the consequences for the device in use if not every device can hold that
/// many.
#[derive(Clone, Debug)]
pub struct TexelInfo {
    bytes: u64,
    /// Capacity of the device, and the images that are made smaller for it.
    device: Option<(TexelCapacity, Vec<SmallerImage>)>,
}

impl TexelInfo {
    /// Counts the texels that `needs` asks for. `capacity` opens the device, if there is one; it is called
    /// only if the answer depends on the device.
    ///
    /// # Errors
    /// The scene refers to data that it does not have, or the device cannot hold even images of one texel
    /// each.
    pub fn of(
        scene: &Scene,
        needs: &Needs,
        capacity: impl FnOnce() -> Option<TexelCapacity>,
    ) -> Result<Self, ExperimentError> {
        let demand = demand(scene, needs)?;
        let bytes = demand.bytes();
        if bytes <= HELD_BY_EVERY_DEVICE {
            return Ok(Self { bytes, device: None });
        }
        // Without a device the scene is shown as well, with the bytes alone.
        let Some(capacity) = capacity() else { return Ok(Self { bytes, device: None }) };
        let smaller = smaller_images(&demand, &capacity)?;
        Ok(Self { bytes, device: Some((capacity, smaller)) })
    }

    /// Describes the texels in words; `None` without texels.
    pub fn text(&self) -> Option<String> {
        let held = bytes(HELD_BY_EVERY_DEVICE);
        let total = bytes(self.bytes);
        let text = match &self.device {
            _ if self.bytes == 0 => return None,
            None if self.bytes <= HELD_BY_EVERY_DEVICE => format!("{total}; every device holds {held}"),
            None => format!(
                "{total}; every device holds {held}, and no device is here to say whether it holds more"
            ),
            Some((capacity, smaller)) => match described(smaller, self.bytes, capacity) {
                Some(text) => format!("{total}; a render makes them fit: {text}"),
                None => {
                    format!("{total}; {} holds {}", capacity.device, bytes(capacity.texels * TEXEL_BYTES))
                }
            },
        };
        Some(text)
    }

    /// Returns the fields of `rasray info --json`.
    pub fn json(&self) -> Value {
        let mut fields = json!({ "bytes": self.bytes, "held_by_every_device_bytes": HELD_BY_EVERY_DEVICE });
        if let Some((capacity, smaller)) = &self.device {
            fields["device"] = capacity.device.as_str().into();
            fields["held_bytes"] = (capacity.texels * TEXEL_BYTES).into();
            fields["smaller_images"] = json!(records(smaller));
        }
        fields
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_scene::needs::Workload;
    use rasray_scene_source::load;
    use std::ffi::OsStr;

    fn loaded() -> LoadedScene {
        load(OsStr::new("atrium")).expect("built in")
    }

    #[test]
    fn what_fits_stays_and_what_does_not_is_named() {
        let needs = |loaded: &LoadedScene| Needs::of(&loaded.scene, Workload::ALL);
        let mut whole = loaded();
        let asked = demand(&whole.scene, &needs(&whole)).expect("whole");
        assert!(asked.texels() > 100);
        let capacity = |texels| TexelCapacity { texels, device: "a small device".to_owned() };
        let sizes = |loaded: &LoadedScene| -> Vec<_> {
            loaded.scene.images.iter().map(|image| (image.width, image.height)).collect()
        };
        let before = sizes(&whole);
        let needed = needs(&whole);
        assert_eq!(fit(&mut whole, &needed, &capacity(asked.texels())).expect("room"), None);
        assert_eq!((sizes(&whole), whole.record().smaller_images), (before.clone(), Vec::new()));

        let said = fit(&mut whole, &needed, &capacity(asked.texels() / 8)).expect("room").expect("words");
        let records = whole.record().smaller_images;
        assert!(!records.is_empty() && sizes(&whole) != before);
        for record in &records {
            assert!(record.to[0] < record.from[0] && !record.name.is_empty(), "{record:?}");
        }
        assert!(demand(&whole.scene, &needed).expect("whole").texels() <= asked.texels() / 8);
        let smaller = asked.smaller_images(asked.texels() / 8).expect("room");
        let text = described(&smaller, asked.bytes(), &capacity(asked.texels() / 8)).expect("something");
        assert_eq!(said, text);
        let largest = records.iter().map(|record| record.from[0]).max().expect("some");
        assert!(
            text.contains(&format!(" instead of {largest}x")) && text.contains("a small device"),
            "{text}"
        );
        // The call fails if even one texel per image is too much.
        let error = fit(&mut loaded(), &needed, &capacity(0)).expect_err("no room");
        assert!(error.to_string().contains("more than the 0"), "{error}");
    }

    fn info(bytes: u64, device: Option<(u64, Vec<SmallerImage>)>) -> TexelInfo {
        let device = device
            .map(|(texels, smaller)| (TexelCapacity { texels, device: "a device".to_owned() }, smaller));
        TexelInfo { bytes, device }
    }

    fn text(info: &TexelInfo) -> String {
        info.text().expect("there are texels")
    }

    #[test]
    fn the_text_says_what_a_render_does() {
        assert_eq!(info(0, None).text(), None);
        assert_eq!(text(&info(3 << 20, None)), "3.00 MiB; every device holds 512.00 MiB");
        assert!(text(&info(1 << 30, None)).ends_with("no device is here to say whether it holds more"));
        let held = info(1 << 30, Some((1 << 29, Vec::new())));
        assert_eq!(text(&held), "1.00 GiB; a device holds 2.00 GiB");
        assert_eq!(held.json()["held_bytes"], 1u64 << 31);
        assert_eq!(held.json()["smaller_images"], json!([]));
        assert!(info(5, None).json().get("device").is_none());
    }

    #[test]
    fn the_device_is_asked_only_where_it_matters() {
        let scene = rasray_scene::builtin::builtin("atrium").expect("a name").expect("no parameters");
        let info = TexelInfo::of(&scene, &Needs::all(), || panic!("every device holds so few texels"));
        let info = info.expect("the scene is whole");
        assert!(info.bytes > 0 && info.device.is_none());
        assert_eq!(info.json()["bytes"], info.bytes);
    }
}
