//! Reader of the MTL file: materials as written, before they are translated.

use std::path::Path;

use super::statements::{Statement, number, statements};
use crate::kinds::Kinds;
use crate::reference::{Place, place};
use rasray_scene::SceneError;
use rasray_scene::remarks::Remarks;

/// Section of one `newmtl`. `None` stands for an absent statement.
#[derive(Clone, Debug, Default)]
pub(super) struct MtlMaterial {
    pub name: String,
    /// `Kd`, the diffuse colour.
    pub diffuse: Option<[f32; 3]>,
    /// `Ks`, the specular colour.
    pub specular: Option<[f32; 3]>,
    /// `Ns`, the exponent of the highlight.
    pub shininess: Option<f32>,
    /// `Ke`, the emission.
    pub emission: Option<[f32; 3]>,
    /// `d`, or one minus `Tr`; `d` counts where both are given.
    pub opacity: Option<f32>,
    /// `Tf`, the factor of light that passes through.
    pub filter: Option<[f32; 3]>,
    /// `Ni`, the index of refraction.
    pub refraction: Option<f32>,
    /// `Pr`, perceptual roughness.
    pub roughness: Option<f32>,
    /// `Pm`, metalness.
    pub metallic: Option<f32>,
    /// `illum`, the illumination model.
    pub illumination: Option<i64>,
    /// True if there is a `map_Ka`, which stands in only if no other colour is given.
    pub has_ambient_map: bool,
    pub diffuse_map: Option<Map>,
    pub emission_map: Option<Map>,
    /// `map_d`, the map of opacity.
    pub opacity_map: Option<Map>,
    /// `norm`, the map of normals in tangent space.
    pub normal_map: Option<Map>,
}

/// Texture reference with the supported options.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    /// Path that the name leads to, from the folder of the MTL file.
    pub place: Place,
    /// Name as written, for names and messages.
    pub name: String,
    /// `-s`, the factors of texture coordinates.
    pub scale: [f32; 2],
    /// `-o`, the offset that is added to texture coordinates.
    pub offset: [f32; 2],
    /// `-clamp on`.
    pub clamp: bool,
    /// `-bm`, the strength of a normal map.
    pub strength: f32,
}

/// Reads all materials of a library.
pub(super) fn parse(
    path: &Path,
    bytes: &[u8],
    remarks: &mut Remarks,
) -> Result<Vec<MtlMaterial>, SceneError> {
    let mut materials: Vec<MtlMaterial> = Vec::new();
    let mut ignored = Kinds::default();
    for statement in statements(bytes) {
        if &*statement.word == b"newmtl" {
            materials.push(MtlMaterial { name: statement.name(), ..MtlMaterial::default() });
        } else if let Some(material) = materials.last_mut() {
            take(path, &statement, material, &mut ignored)?;
        } else {
            ignored.note(&String::from_utf8_lossy(&statement.word));
        }
    }
    report(&ignored, path, remarks);
    Ok(materials)
}

fn take(
    path: &Path,
    statement: &Statement<'_>,
    material: &mut MtlMaterial,
    ignored: &mut Kinds,
) -> Result<(), SceneError> {
    let word = String::from_utf8_lossy(&statement.word).to_ascii_lowercase();
    match word.as_str() {
        "kd" => set(&mut material.diffuse, color(path, statement, ignored)?),
        "ks" => set(&mut material.specular, color(path, statement, ignored)?),
        "ke" => set(&mut material.emission, color(path, statement, ignored)?),
        "tf" => set(&mut material.filter, color(path, statement, ignored)?),
        "ns" => material.shininess = Some(scalar(path, statement)?),
        "ni" => material.refraction = Some(scalar(path, statement)?),
        "d" => material.opacity = Some(scalar(path, statement)?),
        "tr" => {
            let transparency = scalar(path, statement)?;
            material.opacity.get_or_insert(1.0 - transparency);
        }
        "pr" => material.roughness = Some(scalar(path, statement)?),
        "pm" => material.metallic = Some(scalar(path, statement)?),
        "illum" => material.illumination = Some(scalar(path, statement)? as i64),
        "map_kd" => material.diffuse_map = map(path, statement, ignored)?,
        "map_ke" => material.emission_map = map(path, statement, ignored)?,
        "map_d" => material.opacity_map = map(path, statement, ignored)?,
        "norm" | "map_kn" => material.normal_map = map(path, statement, ignored)?,
        "map_ka" => material.has_ambient_map = true,
        // The integrators compute ambient light; reflections are as sharp as the surface is smooth.
        "ka" | "sharpness" => {}
        _ => ignored.note(&word),
    }
    Ok(())
}

fn set<T>(slot: &mut Option<T>, value: Option<T>) {
    if value.is_some() {
        *slot = value;
    }
}

/// Reads three numbers, or one that stands for three. Spectral and CIE colours are ignored.
fn color(
    path: &Path,
    statement: &Statement<'_>,
    ignored: &mut Kinds,
) -> Result<Option<[f32; 3]>, SceneError> {
    if let Some(form @ (b"spectral" | b"xyz")) = statement.words().next() {
        ignored.note(&format!(
            "{} {}",
            String::from_utf8_lossy(&statement.word),
            String::from_utf8_lossy(form)
        ));
        return Ok(None);
    }
    let (color, count) = statement.numbers::<3>(path, 1)?;
    finite(path, statement, &color)?;
    Ok(Some(if count == 1 { [color[0]; 3] } else { color }))
}

/// Reads the last word, because options such as `-halo` stand before the number.
fn scalar(path: &Path, statement: &Statement<'_>) -> Result<f32, SceneError> {
    let Some(word) = statement.words().last() else {
        let word = String::from_utf8_lossy(&statement.word);
        return Err(SceneError::syntax(path, format!("{}: `{word}` needs a number", statement.place())));
    };
    let value = number(word).ok_or_else(|| statement.not_a_number(path, word))?;
    finite(path, statement, &[value])?;
    Ok(value)
}

fn finite(path: &Path, statement: &Statement<'_>, values: &[f32]) -> Result<(), SceneError> {
    if values.iter().all(|value| value.is_finite()) {
        return Ok(());
    }
    let word = String::from_utf8_lossy(&statement.word);
    Err(SceneError::syntax(path, format!("{}: `{word}` has a number that is not finite", statement.place())))
}

/// Reads options and a file name, which is the rest of the line and may hold spaces.
fn map(path: &Path, statement: &Statement<'_>, ignored: &mut Kinds) -> Result<Option<Map>, SceneError> {
    let words: Vec<&[u8]> = statement.words().collect();
    let mut found = Map {
        place: Place::Outside { reason: "is empty", beside: None },
        name: String::new(),
        scale: [1.0; 2],
        offset: [0.0; 2],
        clamp: false,
        strength: 1.0,
    };
    let is_normal_map = matches!(&*statement.word.to_ascii_lowercase(), b"norm" | b"map_kn");
    let mut next = 0;
    while let Some(option) = words.get(next).and_then(|word| word.strip_prefix(b"-")) {
        let numbers: Vec<f32> = words[next + 1..].iter().map_while(|word| number(word)).take(3).collect();
        let pair = |missing: f32| {
            [0, 1].map(|axis| numbers.get(axis).copied().filter(|value| value.is_finite()).unwrap_or(missing))
        };
        next += 1 + match option {
            b"s" => {
                found.scale = pair(1.0);
                numbers.len()
            }
            b"o" => {
                found.offset = pair(0.0);
                numbers.len()
            }
            b"clamp" => {
                found.clamp = words.get(next + 1).is_some_and(|word| word.eq_ignore_ascii_case(b"on"));
                1
            }
            // Both blends are on by default, and textures are always filtered here.
            b"blendu" | b"blendv" => {
                if words.get(next + 1).is_some_and(|word| word.eq_ignore_ascii_case(b"off")) {
                    ignored.note(&format!("{} -{} off", lossy(&statement.word), lossy(option)));
                }
                1
            }
            b"bm" if is_normal_map => {
                found.strength = pair(1.0)[0];
                1
            }
            b"t" | b"mm" => {
                ignored.note(&format!("{} -{}", lossy(&statement.word), lossy(option)));
                numbers.len()
            }
            b"bm" | b"boost" | b"texres" | b"imfchan" | b"type" | b"cc" => {
                ignored.note(&format!("{} -{}", lossy(&statement.word), lossy(option)));
                1
            }
            // A file name that begins with a dash.
            _ => break,
        };
    }
    let name =
        words.get(next..).unwrap_or_default().iter().map(|word| lossy(word)).collect::<Vec<_>>().join(" ");
    if name.is_empty() {
        ignored.note(&format!("{} without a file", lossy(&statement.word)));
        return Ok(None);
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    found.place = place(folder, &name);
    found.name = name;
    Ok(Some(found))
}

fn lossy(word: &[u8]) -> String {
    String::from_utf8_lossy(word).into_owned()
}

/// Notes remarks on statements and options that have no effect here.
fn report(ignored: &Kinds, path: &Path, remarks: &mut Remarks) {
    // Height fields have a warning of their own: their effect is missed most.
    let is_bump = |what: &str| what.starts_with("map_bump") || what.starts_with("bump");
    let (bumps, others) = (ignored.list(is_bump), ignored.list(|what| !is_bump(what)));
    let place = path.display().to_string();
    if !bumps.is_empty() {
        let text = format!(
            "height maps are not supported and were ignored: {bumps}; convert them to normal maps and name them by `norm`"
        );
        remarks.note("height-map", &place, text);
    }
    if !others.is_empty() {
        remarks.note("unsupported-material-statements", place, format!("ignored: {others}"));
    }
}
