//! The words that options of structures take, the same for every system.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// How a cell's fragments or triangles are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Storage {
    /// One linked list per cell
    Ll,
    /// One doubly linked list per cell
    Dll,
    /// Linked list per depth bucket
    Llb,
    /// Doubly linked list per depth bucket
    Dllb,
    /// One behind the other, counted first
    Sb,
    /// One behind the other in cells of tile and depth slice, in bricks that say where nothing is
    Bricks,
    /// Linked pages of several
    Paged,
}

/// What a fragment carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Payload {
    /// The primitive's index
    Index,
    /// Surface attributes, quantised as published
    Attributes,
    /// The shading normal alone, quantised as published for ambient occlusion
    Normal,
    /// The plane of its triangle in full, and nothing to shade by
    Plane,
}

/// How a ray steps through cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum March {
    /// A fixed number of samples along the ray
    Samples,
    /// A step for each cell of the longer axis
    Dda,
    /// Every cell that the ray crosses
    Exact,
    /// The same with leaps over blocks of cells that hold nothing at the ray's depths
    Pyramid,
    /// From where the ray leaves a tile half a pixel on
    Jump,
}

/// When what a ray meets is a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Accept {
    /// Its depth lies in the ray's half-open depth interval in the cell
    Interval,
    /// The same with a thickness behind the fragment
    Thickness,
    /// Its depth is within a fixed tolerance of the ray's depths in the cell
    Tolerance,
    /// The depths that its triangle takes within the cell meet those of the ray; needs the payload index
    Slope,
    /// The ray meets the plane of its triangle within the cell; needs the payload index or plane
    Plane,
    /// An odd number of fragments lies before one point of the ray, and an even number before the next
    Parity,
    /// Triangles: by t alone
    T,
    /// Triangles: where the point lies in the tile that listed it
    Tile,
}

/// Where the search of a tile ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stop {
    /// At buckets behind the best hit
    Best,
    /// After the first bucket with a hit
    Bucket,
}

/// What the depths of a triangle in a tile are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Depths {
    /// Those of all of it that lies in the tile
    Clipped,
    /// Those of its plane at the corners of the tile
    Corners,
}

/// Which cells a triangle is kept in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coverage {
    /// Centre of the cell inside, decided by the shared function
    Exact,
    /// Every cell it reaches into; of fragments, where nothing else stands for it
    Conservative,
    /// The same of triangles that no cell keeps or that are seen edge-on
    EdgeOn,
    /// Whatever the rasterizer covers
    Hardware,
}

/// In which of the views along the axes a fragment is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axes {
    /// In all; a voxel is searched along the axis of its averaged normal
    All,
    /// In that of its voxel's averaged normal
    Voxel,
    /// In the one that its triangle faces most; a voxel is searched along the axes of all its triangles
    Triangle,
}

/// What makes a voxel one in which something lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Marking {
    /// The fragments in it
    Fragments,
    /// The triangles that reach into it
    Triangles,
}

/// Which projections are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Views {
    /// Six faces around the centre
    Cube,
    /// The same, and what the camera sees, with cells of its own
    #[value(name = "cube+camera")]
    #[serde(rename = "cube+camera")]
    CubeCamera,
    /// What the camera sees and nothing else
    Camera,
    /// Three along the axes, which do not depend on the eye; of triangles one box of cells that serves all three
    Axes,
}

/// How a fragment keeps its depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
pub enum Depth {
    /// A half, as a share of the cube's side
    #[value(name = "16")]
    #[serde(rename = "16")]
    Bits16,
    /// A float
    #[value(name = "32")]
    #[serde(rename = "32")]
    Bits32,
}

/// What a block of cells says of the depths in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Occupancy {
    /// The smallest and the largest
    Bounds,
    /// The same, and which of 64 slices of depth hold something
    Slices,
}

/// How the layers of a depth cube are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LayerBuild {
    /// All in one pass, then sorted
    Single,
    /// One after the other, by depth peeling
    Peel,
}

/// Where the six faces of a cube meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Centre {
    /// At the eye
    Eye,
    /// At the eye within the scene; for an eye outside, within the middle of the scene
    Scene,
}

/// Who makes a structure, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Builder {
    /// A tree by the surface area heuristic, on the host
    Sah,
    /// A tree by Morton codes, on the device
    Lbvh,
    /// Lists of triangles, by drawing
    Raster,
    /// Lists of triangles, by computing
    Binning,
}

/// How shaders reach a structure's memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Addressing {
    /// Storage buffers in a descriptor set
    Descriptor,
    /// 64-bit device addresses
    Address,
}

/// A switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Switch {
    /// Yes
    On,
    /// No
    Off,
}
