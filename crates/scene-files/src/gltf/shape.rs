//! Schema of the format: the members of the elements, and the kinds of their values.
//!
//! The schema has all members of the typed tree. A tree that passes can be converted to the typed tree; whole
//! numbers that are written as `1.0`, and `null` members, are brought into its form.

use Kind::{
    Code, Extensions, Flag, List, Map, Number, Numbers, Object, OpenCode, OpenWord, Size, Text, Whole, Word,
};

/// Kind of the values that a member may have.
pub(super) enum Kind {
    /// Index, stride or number of the format: at most what 32 bits hold.
    Whole,
    /// Length or offset in bytes or elements: at most what 64 bits hold.
    Size,
    Number,
    /// Array of exactly so many numbers.
    Numbers(usize),
    Text,
    Flag,
    /// One of these words.
    Word(&'static [&'static str]),
    /// One of these numbers.
    Code(&'static [u64]),
    /// One of these words, or another, which is refused where it is used.
    OpenWord(&'static [&'static str]),
    /// One of these numbers, or another, which is refused where it is used.
    OpenCode(&'static [u64]),
    List(&'static Kind),
    /// Object with any names, whose values have one kind.
    Map(&'static Kind),
    Object(&'static [Member]),
    /// Extensions of an element; the listed ones are supported.
    Extensions(&'static [Member]),
}

/// Member of an object.
pub(super) struct Member {
    pub name: &'static str,
    pub kind: Kind,
    pub required: bool,
}

const fn may(name: &'static str, kind: Kind) -> Member {
    Member { name, kind, required: false }
}

const fn must(name: &'static str, kind: Kind) -> Member {
    Member { name, kind, required: true }
}

const NAME: Member = may("name", Text);
const PLAIN: Member = may("extensions", Extensions(&[]));

/// Schema of the whole file.
pub(super) const ROOT: Kind = Object(&[
    must("asset", Object(ASSET)),
    may("accessors", List(&Object(ACCESSOR))),
    may("animations", List(&Object(ANIMATION))),
    may("buffers", List(&Object(BUFFER))),
    may("bufferViews", List(&Object(VIEW))),
    may("cameras", List(&Object(CAMERA))),
    may("extensionsRequired", List(&Text)),
    may("extensionsUsed", List(&Text)),
    may("images", List(&Object(IMAGE))),
    may("materials", List(&Object(MATERIAL))),
    may("meshes", List(&Object(MESH))),
    may("nodes", List(&Object(NODE))),
    may("samplers", List(&Object(SAMPLER))),
    may("scene", Whole),
    may("scenes", List(&Object(SCENE))),
    may("skins", List(&Object(SKIN))),
    may("textures", List(&Object(TEXTURE))),
    may("extensions", Extensions(&[may("KHR_lights_punctual", Object(LIGHTS))])),
]);

const ASSET: &[Member] =
    &[must("version", Text), may("minVersion", Text), may("generator", Text), may("copyright", Text), PLAIN];

const ACCESSOR: &[Member] = &[
    may("bufferView", Whole),
    may("byteOffset", Size),
    must("count", Size),
    must("componentType", OpenCode(&[5120, 5121, 5122, 5123, 5125, 5126])),
    must("type", OpenWord(&["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"])),
    may("normalized", Flag),
    may("sparse", Object(SPARSE)),
    NAME,
    PLAIN,
];

const SPARSE: &[Member] = &[
    must("count", Size),
    must(
        "indices",
        Object(&[
            must("bufferView", Whole),
            may("byteOffset", Size),
            must("componentType", OpenCode(&[5121, 5123, 5125])),
            PLAIN,
        ]),
    ),
    must("values", Object(&[must("bufferView", Whole), may("byteOffset", Size), PLAIN])),
    PLAIN,
];

const ANIMATION: &[Member] = &[
    may(
        "channels",
        List(&Object(&[
            must("sampler", Whole),
            must(
                "target",
                Object(&[
                    may("node", Whole),
                    must("path", OpenWord(&["translation", "rotation", "scale", "weights"])),
                    PLAIN,
                ]),
            ),
            PLAIN,
        ])),
    ),
    may(
        "samplers",
        List(&Object(&[
            must("input", Whole),
            must("output", Whole),
            may("interpolation", Word(&["LINEAR", "STEP", "CUBICSPLINE"])),
            PLAIN,
        ])),
    ),
    NAME,
    PLAIN,
];

const BUFFER: &[Member] = &[may("byteLength", Size), may("uri", Text), NAME, PLAIN];

/// Schema of `EXT_meshopt_compression` and `KHR_meshopt_compression`.
const COMPRESSED: Kind = Object(&[
    must("buffer", Whole),
    may("byteOffset", Size),
    must("byteLength", Size),
    must("byteStride", Whole),
    must("count", Size),
    must("mode", OpenWord(&["ATTRIBUTES", "TRIANGLES", "INDICES"])),
    may("filter", OpenWord(&["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"])),
]);

const VIEW: &[Member] = &[
    must("buffer", Whole),
    must("byteLength", Size),
    may("byteOffset", Size),
    may("byteStride", Whole),
    may("target", Whole),
    NAME,
    may(
        "extensions",
        Extensions(&[may("EXT_meshopt_compression", COMPRESSED), may("KHR_meshopt_compression", COMPRESSED)]),
    ),
];

const CAMERA: &[Member] = &[
    must("type", OpenWord(&["perspective", "orthographic"])),
    may(
        "perspective",
        Object(&[
            must("yfov", Number),
            must("znear", Number),
            may("zfar", Number),
            may("aspectRatio", Number),
            PLAIN,
        ]),
    ),
    may(
        "orthographic",
        Object(&[
            must("xmag", Number),
            must("ymag", Number),
            must("zfar", Number),
            must("znear", Number),
            PLAIN,
        ]),
    ),
    NAME,
    PLAIN,
];

const IMAGE: &[Member] = &[may("bufferView", Whole), may("mimeType", Text), may("uri", Text), NAME, PLAIN];

const MATERIAL: &[Member] = &[
    may("alphaCutoff", Number),
    may("alphaMode", Word(&["OPAQUE", "MASK", "BLEND"])),
    may("doubleSided", Flag),
    may("emissiveFactor", Numbers(3)),
    may("emissiveTexture", Object(INFO)),
    may("normalTexture", Object(&[INDEX, SET, may("scale", Number), TRANSFORM])),
    may("occlusionTexture", Object(&[INDEX, SET, may("strength", Number), TRANSFORM])),
    may(
        "pbrMetallicRoughness",
        Object(&[
            may("baseColorFactor", Numbers(4)),
            may("baseColorTexture", Object(INFO)),
            may("metallicFactor", Number),
            may("roughnessFactor", Number),
            may("metallicRoughnessTexture", Object(INFO)),
            PLAIN,
        ]),
    ),
    may(
        "extensions",
        Extensions(&[
            may(
                "KHR_materials_anisotropy",
                Object(&[
                    may("anisotropyStrength", Number),
                    may("anisotropyRotation", Number),
                    may("anisotropyTexture", Object(INFO)),
                ]),
            ),
            may("KHR_materials_emissive_strength", Object(&[may("emissiveStrength", Number)])),
            may("KHR_materials_ior", Object(&[may("ior", Number)])),
            may(
                "KHR_materials_specular",
                Object(&[
                    may("specularFactor", Number),
                    may("specularTexture", Object(INFO)),
                    may("specularColorFactor", Numbers(3)),
                    may("specularColorTexture", Object(INFO)),
                ]),
            ),
            may(
                "KHR_materials_transmission",
                Object(&[may("transmissionFactor", Number), may("transmissionTexture", Object(INFO))]),
            ),
            may("KHR_materials_unlit", Object(&[])),
            may(
                "KHR_materials_volume",
                Object(&[
                    may("thicknessFactor", Number),
                    may("thicknessTexture", Object(INFO)),
                    may("attenuationDistance", Number),
                    may("attenuationColor", Numbers(3)),
                ]),
            ),
        ]),
    ),
    NAME,
];

const INDEX: Member = must("index", Whole);
const SET: Member = may("texCoord", Whole);
const TRANSFORM: Member = may(
    "extensions",
    Extensions(&[may(
        "KHR_texture_transform",
        Object(&[
            may("offset", Numbers(2)),
            may("rotation", Number),
            may("scale", Numbers(2)),
            may("texCoord", Whole),
        ]),
    )]),
);
const INFO: &[Member] = &[INDEX, SET, TRANSFORM];

const MESH: &[Member] = &[
    must(
        "primitives",
        List(&Object(&[
            must("attributes", Map(&Whole)),
            may("indices", Whole),
            may("material", Whole),
            may("mode", OpenCode(&[0, 1, 2, 3, 4, 5, 6])),
            may("targets", List(&Map(&Whole))),
            may("extensions", Extensions(&[may("KHR_draco_mesh_compression", Object(DRACO))])),
        ])),
    ),
    may("weights", List(&Number)),
    NAME,
    PLAIN,
];

const DRACO: &[Member] = &[must("bufferView", Whole), must("attributes", Map(&Whole))];

const NODE: &[Member] = &[
    may("camera", Whole),
    may("children", List(&Whole)),
    may("matrix", Numbers(16)),
    may("mesh", Whole),
    may("rotation", Numbers(4)),
    may("scale", Numbers(3)),
    may("translation", Numbers(3)),
    may("skin", Whole),
    may("weights", List(&Number)),
    may(
        "extensions",
        Extensions(&[
            may("EXT_mesh_gpu_instancing", Object(&[may("attributes", Map(&Whole))])),
            may("KHR_lights_punctual", Object(&[must("light", Whole)])),
        ]),
    ),
    NAME,
];

const LIGHTS: &[Member] = &[must(
    "lights",
    List(&Object(&[
        must("type", OpenWord(&["directional", "point", "spot"])),
        may("color", Numbers(3)),
        may("intensity", Number),
        may("range", Number),
        may("spot", Object(&[may("innerConeAngle", Number), may("outerConeAngle", Number)])),
        NAME,
        PLAIN,
    ])),
)];

const SCENE: &[Member] = &[may("nodes", List(&Whole)), NAME, PLAIN];

const SKIN: &[Member] =
    &[may("inverseBindMatrices", Whole), may("joints", List(&Whole)), may("skeleton", Whole), NAME, PLAIN];

const TEXTURE: &[Member] = &[
    may("sampler", Whole),
    may("source", Whole),
    NAME,
    may("extensions", Extensions(&[may("KHR_texture_basisu", Object(&[may("source", Whole)]))])),
];

const SAMPLER: &[Member] = &[
    may("magFilter", Code(&[9728, 9729])),
    may("minFilter", Code(&[9728, 9729, 9984, 9985, 9986, 9987])),
    may("wrapS", Code(&[10497, 33071, 33648])),
    may("wrapT", Code(&[10497, 33071, 33648])),
    NAME,
    PLAIN,
];
