//! Rules of the paper, each next to the exact rule that replaces it.

use rasray_ads::words;

/// Cells that list a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// All cells that the triangle reaches into. A shared function decides; the rasterizer only proposes
    /// cells.
    Conservative,
    /// Cells that the triangle reaches into and that the rasterizer's own conservative rasterization touches
    /// (section 3.2). Needs [`rasray_gpu::Feature::ConservativeRasterization`], and loses the cells that the
    /// rasterizer does not touch.
    ConservativeExtension,
    /// Cells whose centre the rasterizer covers (section 4.2.4, for devices without conservative
    /// rasterization). A ray that passes only through a neighbour of the cells that list a triangle misses
    /// the triangle.
    Hardware,
}

words! {
    Coverage {
        Conservative "conservative",
        ConservativeExtension "conservative-extension",
        Hardware "hardware",
    }
}

/// Condition under which a ray hits a triangle that it intersects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accept {
    /// The intersection's t is within the ray's range, wherever its point lies.
    T,
    /// The point projects into the tile that lists the triangle (section 4.2.1). Rounding at the tiles'
    /// borders loses hits, and so does every tile that the march skips.
    Tile,
}

words! { Accept { T "t", Tile "tile" } }

/// Point at which a ray ends its search of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// At the first bucket that lies behind the best hit.
    Best,
    /// After the first bucket with a hit (section 4.2.1), although a nearer hit may be in the next bucket
    /// only.
    Bucket,
}

words! { Stop { Best "best", Bucket "bucket" } }

/// Depths of a triangle in a tile, which choose its buckets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depths {
    /// Depths of the whole part of the triangle that lies in the tile.
    Clipped,
    /// Depths of the triangle's plane at the tile's corners (section 4.1.1, as the authors' program clips).
    /// Part of the triangle may lie outside of these depths.
    Corners,
}

words! { Depths { Clipped "clipped", Corners "corners" } }

/// Rule by which a ray steps from one tile to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum March {
    /// Rays step over the boundary at which they leave the tile.
    Exact,
    /// Rays step half a pixel beyond that boundary along the longer axis (the authors' program), and skip
    /// tiles that they would cross in less.
    Jump,
}

words! { March { Exact "exact", Jump "jump" } }
