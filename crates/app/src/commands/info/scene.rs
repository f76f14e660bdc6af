//! Text about a scene: its contents, its default view and light, and the data that an image of the scene can
//! show.

use super::rows::pair;
use rasray_experiment::SceneInfo;
use rasray_report::{CameraRecord, bytes, columns, grouped, in_line};
use rasray_scene::Motion;

pub(super) fn scene_text(info: &SceneInfo) -> String {
    let mut rows: Vec<_> = info.counts.iter().map(|(name, count)| pair(name, grouped(*count))).collect();
    let added = if info.unlit { "; the default light is added" } else { "" };
    rows.push(pair("environment", format!("{}{added}", info.environment)));
    rows.extend(info.texels.text().map(|text| pair("texels", text)));
    if let Some((low, high)) = info.bounds {
        let size = high - low;
        rows.push(pair("bounds", format!("{low:.3} to {high:.3} m")));
        rows.push(pair("size", format!("{:.3} x {:.3} x {:.3} m", size.x, size.y, size.z)));
    }
    if let Some(saved) = info.one_view_saves {
        rows.push(pair("one view of three", format!("saves {:.2} % of fragments at most", 100.0 * saved)));
    }
    if let Some(sha256) = &info.sha256 {
        rows.push(pair("sha256", sha256));
    }
    if let Some(pose) = &info.pose {
        let clips =
            if pose.clips.is_empty() { String::new() } else { format!(", {}", pose.clips.join(", ")) };
        rows.push(pair("shown at", format!("{} s{clips}", pose.time_s)));
    }
    if info.motion != Motion::Still {
        rows.push(pair("motion", format!("{}, until {:.3} s", info.motion.described(), info.duration_s)));
    }
    rows.push(pair("default view", info.view.described()));
    let mut text = format!("scene {}\n{}", in_line(&info.name), columns(&rows, 2));
    if !info.cameras.is_empty() {
        text += "cameras\n";
        text += &columns(&info.cameras.iter().map(camera_row).collect::<Vec<_>>(), 4);
    }
    if !info.clips.is_empty() {
        text += "clips\n";
        let row = |(index, (name, seconds)): (usize, &(String, f32))| {
            vec![index.to_string(), name.clone(), format!("{seconds:.3} s")]
        };
        text += &columns(&info.clips.iter().enumerate().map(row).collect::<Vec<_>>(), 3);
    }
    text + &needs_text(info)
}

fn needs_text(info: &SceneInfo) -> String {
    let rows: Vec<_> = info
        .needs
        .verdicts()
        .iter()
        .map(|verdict| {
            let word = if verdict.needed { "needed" } else { "-" };
            vec![verdict.term.name().to_owned(), word.to_owned(), verdict.why.clone()]
        })
        .collect();
    let left_out = info.not_uploaded_bytes.map(|count| format!("; not uploaded: {}", bytes(count)));
    format!(
        "needs of --integrator {}{}\n{}",
        info.integrator,
        left_out.unwrap_or_default(),
        columns(&rows, 3)
    )
}

/// Makes the row of a camera: position, name, kind and the framed part of the world.
fn camera_row(camera: &CameraRecord) -> Vec<String> {
    let seen = match (camera.fov_y_degrees, camera.height_m) {
        (Some(angle), _) => format!("{angle:.1} degrees"),
        (_, height) => format!("{:.3} m high", height.unwrap_or_default()),
    };
    let frame = camera
        .aspect_ratio
        .map(|ratio| format!(", framing {ratio:.3}:1; narrower images show more above and below"));
    let seen = seen + &frame.unwrap_or_default();
    vec![camera.index.unwrap_or_default().to_string(), camera.name.clone(), camera.kind.clone(), seen]
}
