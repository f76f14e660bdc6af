//! The paper's rules, each next to the exact one that replaces it.

use rasray_ads::words;

/// Cells that list a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// All cells that the triangle reaches into, decided by a shared function; the rasterizer only proposes
    /// cells.
    Conservative,
    /// Those of these that the rasterizer's own conservative rasterization touches (section 3.2): needs
    /// [`rasray_gpu::Feature::ConservativeRasterization`], and loses what it does not touch.
    ConservativeExtension,
    /// Those whose centre the rasterizer covers (section 4.2.4, where conservative rasterization is missing):
    /// rays that pass a listed triangle's neighbour are lost.
    Hardware,
}

words! {
    Coverage {
        Conservative "conservative",
        ConservativeExtension "conservative-extension",
        Hardware "hardware",
    }
}

/// When a triangle that a ray intersects is a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accept {
    /// By its t, wherever it lies.
    T,
    /// Where the point projects into the tile that listed it (section 4.2.1): rounding at the tiles' borders
    /// loses hits, and so does every tile that the march skips.
    Tile,
}

words! { Accept { T "t", Tile "tile" } }

/// End of the search of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// At buckets behind the best hit.
    Best,
    /// After the first bucket with a hit (section 4.2.1): a nearer hit may be in the next bucket only.
    Bucket,
}

words! { Stop { Best "best", Bucket "bucket" } }

/// Depths of a triangle in a tile, which choose its buckets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depths {
    /// Those of all of it that lies in the tile.
    Clipped,
    /// Those of its plane at the tile's corners (section 4.1.1, as the authors' program clips): part of the
    /// triangle may lie outside of them.
    Corners,
}

words! { Depths { Clipped "clipped", Corners "corners" } }

/// Rule by which a ray goes on from a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum March {
    /// Over the boundary at which it leaves the tile.
    Exact,
    /// Half a pixel beyond that along the longer axis (the authors' program): tiles that are crossed in less
    /// are skipped.
    Jump,
}

words! { March { Exact "exact", Jump "jump" } }
