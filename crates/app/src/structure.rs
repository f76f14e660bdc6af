//! Options of acceleration structures, with the words that every system shares.

use clap::{Args, ValueEnum};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

pub use crate::structure_values::{
    Accept, Addressing, Axes, Builder, Centre, Coverage, Depth, Depths, LayerBuild, March, Marking,
    Occupancy, Payload, Stop, Storage, Switch, Views,
};

/// A system the command can run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SystemName {
    /// A-buffers on the faces of a cube and on the camera's view
    Mmrt,
    /// Lists of triangles per tile of a cube's faces: hits are those of the triangles
    Dirt,
    /// Voxels over A-buffers along the three axes
    Hu,
    /// The same with voxels first, and each fragment in one of the A-buffers
    Selective,
    /// Layers of fragments along three axes, each triangle along the one it faces most
    Ldc,
    /// A bounding volume hierarchy with two children per node: the baseline
    Bvh,
    /// Every triangle tested against every ray: what hits are checked against, slow on purpose
    BruteForce,
}

/// How closely a system follows its paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Preset {
    /// The same structure with its errors repaired
    #[default]
    Robust,
    /// The paper's approximations included
    Published,
}

/// What was asked of a structure; what is left out follows the system's preset.
#[derive(Clone, Debug, Default, PartialEq, Args, Serialize, Deserialize)]
#[command(next_help_heading = "Structure (defaults follow the system and its preset)")]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct StructureOptions {
    /// Cells along each side of a view, 1 to 8192
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 8192))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<u32>,
    /// With a camera among --views: columns and rows of its view, 1 to 8192 each, or one number for both; as
    /// --resolution if not given
    #[arg(long, value_name = "WxH", value_parser = crate::arguments::values::cells)]
    #[serde(rename = "camera-resolution", skip_serializing_if = "Option::is_none")]
    pub camera_resolution: Option<String>,
    /// Pixels along each side of a tile: lists are kept per tile, 1 to 64
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 64))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tile: Option<u32>,
    /// Cells along each side of a block of cells, a power of two, 1 to 64
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 64))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub block: Option<u32>,
    /// Levels of blocks of cells, 1 or 2
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 2))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub levels: Option<u32>,
    /// What a block of cells says of the depths in it
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub occupancy: Option<Occupancy>,
    /// How the layers of a depth cube are made
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub build: Option<LayerBuild>,
    /// With --build peel: most layers, a scene with more is refused, 1 to 1024
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 1024))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layers: Option<u32>,
    /// Depth buckets per cell, 1 to 64
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 64))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub buckets: Option<u32>,
    /// Keep the nearest fragments of each cell alone
    #[arg(long, value_enum)]
    #[serde(rename = "single-layer", skip_serializing_if = "Option::is_none")]
    pub single_layer: Option<Switch>,
    /// For diagnostics: keep triangles next to payloads without them, so that hits name them
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ids: Option<Switch>,
    /// With --storage bricks: depth slices, the same for all tiles, 1 to 1024
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 1024))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slices: Option<u32>,
    /// With --storage bricks: keep triangles' corners once more, one behind the other
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corners: Option<Switch>,
    /// How a cell's fragments or triangles are kept
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub storage: Option<Storage>,
    /// Keep what a fragment carries within its list [the other word: --decoupled]
    #[arg(long, value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "on")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inline: Option<Switch>,
    /// Keep what a fragment carries outside its list, the same as --inline=off
    #[arg(long, conflicts_with = "inline")]
    #[serde(skip)]
    pub decoupled: bool,
    /// With --storage paged: fragments per page, 1 to 8; of mmrt 1, 2, 4 or 8
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 8))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub page: Option<u32>,
    /// Voxels along each side of the scene's cube, balanced with --resolution if not given; with --views axes
    /// of triangles, or --storage bricks of voxels, cells along the longest side of the scene, 1 to 1024
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 1024))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<u32>,
    /// In which of the views along the axes a fragment is kept
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axes: Option<Axes>,
    /// What makes a voxel occupied; by default fragments with --axes all, else triangles
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub voxels: Option<Marking>,
    /// What a fragment carries
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub payload: Option<Payload>,
    /// How a ray steps through cells
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub march: Option<March>,
    /// With --march samples: maximum samples per face, or steps per voxel, 1 to 65535
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 65535))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<u32>,
    /// With --march samples: where steps are longer than a cell, each ray looks at a place of its own in them
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jitter: Option<Switch>,
    /// What counts as a hit
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accept: Option<Accept>,
    /// Lists of triangles: where the search of a tile ends
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<Stop>,
    /// Lists of triangles: skip blocks of tiles by their depth bounds
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pyramid: Option<Switch>,
    /// Lists of triangles: what the depths of a triangle in a tile are
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depths: Option<Depths>,
    /// With --accept thickness: metres behind a fragment that count as its inside
    #[arg(long, value_name = "METRES", value_parser = crate::arguments::values::not_negative)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness: Option<f32>,
    /// With --accept tolerance: how far along a view a fragment may be from the ray, a share of the cube's side
    #[arg(long, value_name = "SHARE", value_parser = crate::arguments::values::not_negative)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f32>,
    /// How a fragment keeps its depth
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth: Option<Depth>,
    /// Which cells a triangle is kept in
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coverage: Option<Coverage>,
    /// Sort the fragments of a cell by depth
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sort: Option<Switch>,
    /// Skip empty space
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skip: Option<Switch>,
    /// Which projections are drawn
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub views: Option<Views>,
    /// Lists of triangles: where the faces of the cube meet
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre: Option<Centre>,
    /// Who makes the structure, and how
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub builder: Option<Builder>,
    /// With --builder sah: most triangles of a leaf, 1 to 16
    #[arg(long, value_name = "N", value_parser = crate::arguments::values::whole(1, 16))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leaf: Option<u32>,
    /// How shaders reach the structure's memory
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub addressing: Option<Addressing>,
    /// Capacity at first, fragments or list entries; it grows when it is too small
    #[arg(long, value_name = "N")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capacity: Option<u32>,
}

impl StructureOptions {
    /// The options that were given, by name, as numbers and words.
    pub fn given(&self) -> Map<String, Value> {
        // By way of text, where a number keeps the digits that were typed: 0.1, not 0.10000000149.
        let text = serde_json::to_string(self).expect("numbers and words");
        let mut given: Map<String, Value> = serde_json::from_str(&text).expect("an object of what was given");
        if self.decoupled {
            given.insert("inline".to_owned(), Value::from("off"));
        }
        given
    }

    /// The options that were given and whose names `keep` accepts.
    pub fn filtered(&self, keep: impl Fn(&str) -> bool) -> Self {
        let map = self.given().into_iter().filter(|(name, _)| keep(name)).collect();
        serde_json::from_value(Value::Object(map)).expect("options read back what they wrote")
    }

    /// These options with those of `over` in place of their own where it has any.
    pub fn overlaid(&self, over: &Self) -> Self {
        let mut map = self.given();
        map.extend(over.given());
        serde_json::from_value(Value::Object(map)).expect("options read back what they wrote")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn same_words<T: ValueEnum + Serialize>() {
        for value in T::value_variants() {
            let typed = value.to_possible_value().expect("no hidden values").get_name().to_owned();
            assert_eq!(serde_json::to_value(value).expect("a word"), serde_json::Value::String(typed));
        }
    }

    #[test]
    fn reports_use_the_words_of_the_command_line() {
        same_words::<SystemName>();
        same_words::<Preset>();
        same_words::<Storage>();
        same_words::<Payload>();
        same_words::<March>();
        same_words::<Accept>();
        same_words::<Stop>();
        same_words::<Depths>();
        same_words::<Coverage>();
        same_words::<Axes>();
        same_words::<Marking>();
        same_words::<Views>();
        same_words::<Depth>();
        same_words::<Occupancy>();
        same_words::<LayerBuild>();
        same_words::<Centre>();
        same_words::<Builder>();
        same_words::<Addressing>();
        same_words::<Switch>();
    }

    #[test]
    fn overlaying_replaces_only_what_is_given() {
        let base = StructureOptions { buckets: Some(4), sort: Some(Switch::On), ..Default::default() };
        let over = StructureOptions { buckets: Some(8), thickness: Some(0.1), ..Default::default() };
        let both = base.overlaid(&over);
        assert_eq!((both.buckets, both.sort, both.thickness), (Some(8), Some(Switch::On), Some(0.1)));
        let kept = both.filtered(|name| name != "buckets");
        assert_eq!((kept.buckets, kept.sort, kept.thickness), (None, Some(Switch::On), Some(0.1)));
        assert_eq!(kept.given().len(), 2);
        assert_eq!(kept.given()["thickness"].to_string(), "0.1");
    }

    #[test]
    fn decoupled_is_another_word_for_not_inline() {
        let base = StructureOptions { inline: Some(Switch::On), ..Default::default() };
        let over = StructureOptions { decoupled: true, ..Default::default() };
        assert_eq!(base.overlaid(&over).inline, Some(Switch::Off));
        assert_eq!(over.overlaid(&base).inline, Some(Switch::On));
    }
}
