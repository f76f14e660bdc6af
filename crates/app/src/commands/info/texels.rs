//! The texels of a scene's textures, and what a device that does not hold them all makes of them.

use super::rows::pair;
use crate::error::AppError;
use rasray_experiment::TexelRoom;
use rasray_experiment::texels::{self, HELD_BY_EVERY_DEVICE, described, records};
use rasray_gpu_scene::{SmallerImage, TEXEL_BYTES};
use rasray_report::bytes;
use rasray_scene::Scene;
use rasray_scene::needs::Needs;
use serde_json::{Value, json};

/// Bytes, and what the device in use does with them where not every device holds them.
#[derive(Debug)]
pub(super) struct TexelInfo {
    bytes: u64,
    device: Option<(TexelRoom, Vec<SmallerImage>)>,
}

impl TexelInfo {
    /// Counts the texels that `needs` asks for. `room` opens the device: it is called only where the result depends on
    /// it.
    pub(super) fn of(
        scene: &Scene,
        needs: &Needs,
        room: impl FnOnce() -> Result<TexelRoom, AppError>,
    ) -> Result<Self, AppError> {
        let demand = texels::demand(scene, needs)?;
        let bytes = demand.bytes();
        if bytes <= HELD_BY_EVERY_DEVICE {
            return Ok(Self { bytes, device: None });
        }
        // Without a device the scene is shown all the same.
        let Ok(room) = room() else { return Ok(Self { bytes, device: None }) };
        let smaller = texels::smaller_images(&demand, &room)?;
        Ok(Self { bytes, device: Some((room, smaller)) })
    }

    /// Rows of the text form.
    pub(super) fn rows(&self) -> Vec<Vec<String>> {
        let held = bytes(HELD_BY_EVERY_DEVICE);
        let total = bytes(self.bytes);
        let text = match &self.device {
            _ if self.bytes == 0 => return Vec::new(),
            None if self.bytes <= HELD_BY_EVERY_DEVICE => format!("{total}; every device holds {held}"),
            None => format!(
                "{total}; every device holds {held}, and no device is here to say whether it holds more"
            ),
            Some((room, smaller)) => match described(smaller, self.bytes, room) {
                Some(text) => format!("{total}; a render makes them fit: {text}"),
                None => format!("{total}; {} holds {}", room.device, bytes(room.texels * TEXEL_BYTES)),
            },
        };
        vec![pair("texels", text)]
    }

    /// Fields of the JSON form.
    pub(super) fn json(&self) -> Value {
        let mut fields = json!({ "bytes": self.bytes, "held_by_every_device_bytes": HELD_BY_EVERY_DEVICE });
        if let Some((room, smaller)) = &self.device {
            fields["device"] = room.device.as_str().into();
            fields["held_bytes"] = (room.texels * TEXEL_BYTES).into();
            fields["smaller_images"] = json!(records(smaller));
        }
        fields
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn info(bytes: u64, device: Option<(u64, Vec<SmallerImage>)>) -> TexelInfo {
        let device =
            device.map(|(texels, smaller)| (TexelRoom { texels, device: "a device".to_owned() }, smaller));
        TexelInfo { bytes, device }
    }

    fn text(info: &TexelInfo) -> String {
        info.rows().concat().join(" ")
    }

    #[test]
    fn the_text_says_what_a_render_does() {
        assert!(info(0, None).rows().is_empty());
        assert_eq!(text(&info(3 << 20, None)), "texels 3.00 MiB; every device holds 512.00 MiB");
        assert!(text(&info(1 << 30, None)).ends_with("no device is here to say whether it holds more"));
        let held = info(1 << 30, Some((1 << 29, Vec::new())));
        assert_eq!(text(&held), "texels 1.00 GiB; a device holds 2.00 GiB");
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
