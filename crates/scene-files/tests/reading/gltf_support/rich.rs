//! One file that uses every part of the format that is read.

use super::{data_uri, floats};

/// Makes a 2x2 PNG.
pub fn png() -> Vec<u8> {
    let texels =
        image::RgbaImage::from_fn(2, 2, |x, y| image::Rgba([x as u8 * 255, y as u8 * 255, 128, 255]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    texels.write_to(&mut bytes, image::ImageFormat::Png).expect("writing to memory cannot fail");
    bytes.into_inner()
}

/// Buffer views under construction: appended bytes, each view aligned to four.
#[derive(Default)]
struct Binary {
    bytes: Vec<u8>,
    views: Vec<String>,
}

impl Binary {
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let (start, length) = (self.bytes.len(), bytes.len());
        self.views.push(format!(r#"{{"buffer":0,"byteOffset":{start},"byteLength":{length}}}"#));
        self.bytes.extend(bytes);
        self.views.len() - 1
    }
}

fn accessor(view: usize, component: u32, count: usize, kind: &str) -> String {
    format!(r#"{{"bufferView":{view},"componentType":{component},"count":{count},"type":"{kind}"}}"#)
}

/// Makes JSON and binary of the file: three nodes, a skinned and morphed quad, instances, a light, a camera,
/// a clip. `{BUFFER}` in the JSON stands for the text after the length of the buffer.
fn parts() -> (String, Vec<u8>) {
    let mut binary = Binary::default();
    let quad = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
    let positions = binary.view(&quad);
    let normals = binary.view(&floats(&[0.0, 0.0, 1.0].repeat(4)));
    let tangents = binary.view(&floats(&[1.0, 0.0, 0.0, 1.0].repeat(4)));
    let uvs = binary.view(&[0, 0, 255, 0, 0, 255, 255, 255]);
    let colors = binary.view(&[255, 128, 0, 255].repeat(4));
    let indices = binary.view(&[0, 1, 2, 2, 1, 3]);
    let joints = binary.view(&[0; 16]);
    let weights = binary.view(&floats(&[1.0, 0.0, 0.0, 0.0].repeat(4)));
    let bind = binary
        .view(&floats(&[1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]));
    let sparse_indices = binary.view(&[1, 3]);
    let sparse_values = binary.view(&floats(&[0.0, 0.0, 0.5, 0.0, 0.0, 0.25]));
    let places = binary.view(&floats(&[0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 5.0, 0.0]));
    let times = binary.view(&floats(&[0.0, 1.5]));
    let turns = binary.view(&floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0]));
    let image = binary.view(&png());
    let accessors = [
        accessor(positions, 5126, 4, "VEC3"),
        accessor(normals, 5126, 4, "VEC3"),
        accessor(tangents, 5126, 4, "VEC4"),
        accessor(uvs, 5121, 4, "VEC2").replace("\"count\"", "\"normalized\":true,\"count\""),
        accessor(colors, 5121, 4, "VEC4").replace("\"count\"", "\"normalized\":true,\"count\""),
        accessor(indices, 5121, 6, "SCALAR"),
        accessor(joints, 5121, 4, "VEC4"),
        accessor(weights, 5126, 4, "VEC4"),
        accessor(bind, 5126, 1, "MAT4"),
        format!(
            r#"{{"componentType":5126,"count":4,"type":"VEC3","sparse":{{"count":2,
            "indices":{{"bufferView":{sparse_indices},"componentType":5121}},"values":{{"bufferView":{sparse_values}}}}}}}"#
        ),
        accessor(places, 5126, 3, "VEC3"),
        accessor(times, 5126, 2, "SCALAR"),
        accessor(turns, 5126, 2, "VEC4"),
    ];
    let attributes = r#""POSITION":0,"NORMAL":1,"TANGENT":2,"TEXCOORD_0":3,"COLOR_0":4"#;
    let texture = r#"{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0],"rotation":0.1,"scale":[2,2]}}}"#;
    let length = binary.bytes.len();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"name":"main","nodes":[0,3]}}],
"extensionsUsed":["KHR_lights_punctual","EXT_mesh_gpu_instancing","KHR_texture_transform","KHR_materials_volume"],
"buffers":[{{"byteLength":{length}{{BUFFER}}}}],
"bufferViews":[{}],
"accessors":[{}],
"images":[{{"bufferView":{image},"mimeType":"image/png","name":"texels"}}],
"samplers":[{{"magFilter":9728,"minFilter":9987,"wrapS":33071,"wrapT":33648}}],
"textures":[{{"sampler":0,"source":0}}],
"materials":[{{"name":"glass","pbrMetallicRoughness":{{"baseColorFactor":[1,0.5,0.25,1],"baseColorTexture":{texture},
"metallicFactor":0,"roughnessFactor":0.5}},"normalTexture":{texture},"emissiveFactor":[1,1,1],
"extensions":{{"KHR_materials_transmission":{{"transmissionFactor":1,"transmissionTexture":{texture}}},
"KHR_materials_ior":{{"ior":1.3}},"KHR_materials_emissive_strength":{{"emissiveStrength":5}},
"KHR_materials_specular":{{"specularFactor":0.5}},
"KHR_materials_volume":{{"thicknessFactor":0.1,"attenuationDistance":2,"attenuationColor":[1,0.5,0.5]}}}}}},
{{"name":"leaf","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,"extensions":{{"KHR_materials_unlit":{{}}}}}}],
"meshes":[{{"name":"quad","weights":[0.5],"primitives":[{{"attributes":{{{attributes},"JOINTS_0":6,"WEIGHTS_0":7}},
"indices":5,"material":0,"targets":[{{"POSITION":9}}]}}]}},
{{"name":"copies","primitives":[{{"attributes":{{{attributes}}},"indices":5,"material":1}}]}}],
"skins":[{{"joints":[1],"inverseBindMatrices":8}}],
"cameras":[{{"type":"perspective","perspective":{{"yfov":0.8,"znear":0.1}}}}],
"animations":[{{"name":"turn","samplers":[{{"input":11,"output":12}}],
"channels":[{{"sampler":0,"target":{{"node":1,"path":"rotation"}}}}]}}],
"extensions":{{"KHR_lights_punctual":{{"lights":[{{"type":"spot","intensity":40,"spot":{{"outerConeAngle":0.5}}}}]}}}},
"nodes":[{{"name":"body","mesh":0,"skin":0,"children":[1,2]}},
{{"name":"joint","translation":[0,0,1]}},
{{"name":"eye","camera":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1],
"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}},
{{"name":"field","mesh":1,"rotation":[0,1,0,1],"scale":[1,-2,1],
"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":10}}}}}}}}]}}"#,
        binary.views.join(",\n"),
        accessors.join(",\n")
    );
    (json, binary.bytes)
}

/// Returns the file as GLB.
pub fn rich_glb() -> Vec<u8> {
    let (json, binary) = parts();
    super::glb(&json.replace("{BUFFER}", ""), &binary)
}

/// Returns the file as text, its buffer in a `data:` URI.
pub fn rich_gltf() -> Vec<u8> {
    let (json, binary) = parts();
    json.replace("{BUFFER}", &format!(r#","uri":"{}""#, data_uri(&binary))).into_bytes()
}
