//! Options of voxels with axis A-buffers, and the presets.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::words;
use rasray_ads::{Addressing, AdsError, Builder, Counters, Ends};
use rasray_shaders_glsl::constant_ids::voxel as ids;
use rasray_shaders_glsl::constants::voxel as numbers;

/// In which of the three views a fragment is kept, and along which axes a voxel is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// All views keep all; a voxel is searched along the axis of its averaged normal.
    All,
    /// A view keeps what lies in voxels whose averaged normal has its axis.
    Voxel,
    /// A view keeps the triangles that face it most; a voxel is searched along the axes of all its triangles.
    Triangle,
}

words! { Axes { All "all", Voxel "voxel", Triangle "triangle" } }

/// Test of which voxels are occupied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marking {
    /// Only the fragments in it, in the pass that counts or stores them. A voxel that a triangle reaches into
    /// only between the centres of cells counts as empty. Needs [`Axes::All`].
    Fragments,
    /// The triangles that reach into it, in a pass before: no voxel with a part of one counts as empty.
    Triangles,
}

words! { Marking { Fragments "fragments", Triangles "triangles" } }

/// Things that a ray hits in an occupied voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaves {
    /// Its fragments, which the views keep.
    Fragments,
    /// The voxel itself, where the ray enters it; its triangle with the lowest id stands for it. There are no
    /// views and no fragments. Needs [`Axes::Triangle`] and [`Payload::Index`].
    Voxels,
}

words! { Leaves { Fragments "fragments", Voxels "voxels" } }

/// Method of stepping a ray from voxel to voxel. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Traversal {
    /// One voxel after the other.
    Dda,
    /// One voxel after the other, over the empty nodes of a sparse octree, which is built from the voxels.
    Octree,
}

words! { Traversal { Dda "dda", Octree "octree" } }

/// Method of stepping a ray within a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum March {
    /// [`Config::samples`] steps of equal length.
    Samples,
    /// Every cell the ray crosses.
    Exact,
}

words! { March { Samples "samples", Exact "exact" } }

/// When a fragment counts as hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accept {
    /// Between two points of the ray with an even and an odd number of fragments before them in their cells.
    Parity,
    /// The ray intersects the plane of its triangle within the cell. Needs [`March::Exact`].
    Plane,
}

words! { Accept { Parity "parity", Plane "plane" } }

/// Fragments that decide whether a point is inside. Needs [`Accept::Parity`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// All that lie before it in its cell: of closed objects an even number ends before the voxel.
    Column,
    /// Those of them at the depths of the voxel, which need not be of closed objects: elsewhere nothing
    /// flips.
    Voxel,
}

words! { Inside { Column "column", Voxel "voxel" } }

/// Cells that keep a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// Those whose centre the rasterizer covers, with its sub-pixel grid.
    Hardware,
    /// Those whose centre it covers by a watertight test; the rasterizer only proposes.
    Exact,
    /// All that it reaches into. Hits are those of the triangles, and none is lost. Needs [`Axes::Triangle`]
    /// and [`Accept::Plane`].
    Conservative,
}

words! { Coverage { Hardware "hardware", Exact "exact", Conservative "conservative" } }

/// Storage of the lists of cells. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Contiguous fragments: counted, then stored. Once sorted, such lists can be bisected.
    Contiguous,
    /// Each fragment linked to the one before it in its list; stored at once.
    Linked,
    /// Linked pages of [`Config::page`] fragments; stored at once.
    Paged,
}

words! { Storage { Contiguous "sb", Linked "ll", Paged "paged" } }

impl Storage {
    fn number(self) -> u32 {
        match self {
            Self::Contiguous => numbers::VOXEL_STORAGE_CONTIGUOUS,
            Self::Linked => numbers::VOXEL_STORAGE_LINKED,
            Self::Paged => numbers::VOXEL_STORAGE_PAGED,
        }
    }
}

/// Data that a fragment carries in addition to its depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Payload {
    /// Its triangle: 4 bytes. Surfaces come from the posed triangle.
    Index,
    /// Hu's: colour and opacity, normal, terms of the material; 12 bytes, read from a scene. Hits do not name
    /// their triangle and cannot be excluded. Needs [`Accept::Parity`], as the next.
    Material,
    /// Selective's: colour and reflectivity, normal, triangle; 12 bytes, read from a scene.
    Mirror,
}

/// All options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Cells along a side of each view, 1 to 8192.
    pub resolution: u32,
    /// Voxels along a side, 1 to 1024. Where absent, the square root of three times the resolution; with
    /// [`Leaves::Voxels`] the resolution, and no more than [`VOXEL_LEAVES_GRID`].
    pub grid: Option<u32>,
    /// Things that rays hit.
    pub leaves: Leaves,
    /// Stepping of rays from voxel to voxel. Changes no hit.
    pub traversal: Traversal,
    /// Views that keep a fragment.
    pub axes: Axes,
    /// Test of which voxels are occupied; fragments where absent and all views keep all, else triangles.
    pub voxels: Option<Marking>,
    /// Stepping of rays within a voxel.
    pub march: March,
    /// Steps per voxel, 1 to 64; only for [`March::Samples`].
    pub samples: u32,
    /// When a fragment counts.
    pub accept: Accept,
    /// Fragments that decide whether a point is inside; only for [`Accept::Parity`].
    pub inside: Inside,
    /// Hits at the ends of rays; only for [`Accept::Parity`] and [`Leaves::Voxels`].
    pub ends: Ends,
    /// Cells that keep a triangle.
    pub coverage: Coverage,
    /// Builder that bins triangles into cells. Changes no hit.
    pub builder: Builder,
    /// Data that a fragment carries.
    pub payload: Payload,
    /// For diagnostics: keep the triangle of each fragment behind [`Payload::Material`]. Hits then name it,
    /// and nothing else follows: it is not excluded, and surfaces stay those of the payload. Changes no t.
    pub ids: bool,
    /// Storage of lists.
    pub storage: Storage,
    /// Fragments per page, 1 to 8; only for [`Storage::Paged`]. Changes no hit.
    pub page: u32,
    /// Sort lists, so that a search can begin and end within; not for [`Storage::Paged`]. Changes no hit.
    pub sort: bool,
    /// Addressing of pools. Changes no hit.
    pub addressing: Addressing,
    /// Fragments, or pages of them, to allocate for the first build; a guess from the resolution where
    /// absent.
    pub fragments: Option<u64>,
    /// Counters that rays record of their work. Changes no hit.
    pub counters: Counters,
    /// Work units a ray may spend in one dispatch; the shared default where absent. Changes no hit.
    pub work_budget: Option<u32>,
}

/// Most voxels along a side that follow from the resolution where voxels are hit themselves: 72 MiB of them.
pub const VOXEL_LEAVES_GRID: u32 = 256;

rasray_ads::configured!(Config);

impl Config {
    /// The repaired structure: each triangle in the view it faces most, in all cells that it reaches into.
    /// Hits are those of brute force.
    pub fn robust(resolution: u32) -> Self {
        Self { coverage: Coverage::Conservative, ..Self::at_centres(resolution) }
    }

    /// Fragments alone: each triangle in the view it faces most, in cells whose centres it covers; every
    /// cell, planes.
    pub fn at_centres(resolution: u32) -> Self {
        Self {
            resolution,
            grid: None,
            leaves: Leaves::Fragments,
            traversal: Traversal::Dda,
            axes: Axes::Triangle,
            voxels: None,
            march: March::Exact,
            samples: 3,
            accept: Accept::Plane,
            inside: Inside::Column,
            ends: Ends::Clear,
            coverage: Coverage::Exact,
            builder: Builder::Raster,
            payload: Payload::Index,
            ids: false,
            storage: Storage::Contiguous,
            page: 4,
            sort: true,
            addressing: Addressing::Descriptor,
            fragments: None,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// Hu et al.: everything in all views, linked in one pass and sorted, surface attributes in each
    /// fragment, three steps per voxel, and parities.
    pub fn published_hu(resolution: u32) -> Self {
        Self {
            axes: Axes::All,
            march: March::Samples,
            accept: Accept::Parity,
            coverage: Coverage::Hardware,
            payload: Payload::Material,
            storage: Storage::Linked,
            ..Self::at_centres(resolution)
        }
    }

    /// Frid Kastrati and Goswami: voxels first, then each fragment in the view of its voxel, in pages of
    /// four.
    pub fn published_selective(resolution: u32) -> Self {
        Self {
            axes: Axes::Voxel,
            payload: Payload::Mirror,
            storage: Storage::Paged,
            ..Self::published_hu(resolution)
        }
    }

    /// Voxels along a side.
    pub fn grid(&self) -> u32 {
        let balanced = match self.leaves {
            Leaves::Fragments => (3.0 * f64::from(self.resolution)).sqrt().round() as u32,
            Leaves::Voxels => self.resolution.min(VOXEL_LEAVES_GRID),
        };
        self.grid.unwrap_or(balanced).clamp(1, numbers::VOXEL_GRID_LIMIT)
    }

    /// True if cells may keep all that reaches into them ([`Coverage::Conservative`]).
    pub fn may_test_triangles(&self) -> bool {
        self.axes == Axes::Triangle && self.accept == Accept::Plane && self.leaves == Leaves::Fragments
    }

    /// Test of which voxels are occupied.
    pub fn marking(&self) -> Marking {
        let one_pass = self.axes == Axes::All;
        self.voxels.unwrap_or(if one_pass { Marking::Fragments } else { Marking::Triangles })
    }

    /// True if lists are sorted: not those in pages.
    pub fn sorts(&self) -> bool {
        self.sort && self.storage != Storage::Paged && self.leaves == Leaves::Fragments
    }

    /// True if a list is searched by bisection; else a search may have to read all of it.
    pub(crate) fn bisects(&self) -> bool {
        self.sort && self.storage == Storage::Contiguous
    }

    /// True if a hit may lie before or behind the surface, so that [`Config::ends`] matter.
    fn has_ends(&self) -> bool {
        self.accept == Accept::Parity || self.leaves == Leaves::Voxels
    }

    /// Checks ranges and combinations.
    ///
    /// # Errors
    /// The first option out of range, or the combination that is not possible.
    pub fn validate(&self) -> Result<(), AdsError> {
        check_range("resolution", self.resolution, 1..=8192, "1 to 8192 cells along a side")?;
        check_range(
            "grid",
            self.grid.unwrap_or(1),
            1..=numbers::VOXEL_GRID_LIMIT,
            "1 to 1024 voxels along a side",
        )?;
        check_range("samples", self.samples, 1..=64, "1 to 64 steps per voxel")?;
        check_range("page", self.page, 1..=8, "1 to 8 fragments per page")?;
        check_work_budget(self.work_budget, false)?;
        if self.accept == Accept::Plane && self.march == March::Samples {
            return Err(AdsError::Option {
                option: "accept",
                value: "plane".to_owned(),
                expected: "plane acceptance needs the march `exact`, since samples are points and planes count in a cell",
            });
        }
        if self.coverage == Coverage::Hardware && self.builder == Builder::Binning {
            return Err(AdsError::Option {
                option: "builder",
                value: self.builder.name().to_owned(),
                expected: "the binning builder does not draw: use builder `raster` with coverage `hardware`",
            });
        }
        if self.marking() == Marking::Fragments && self.axes != Axes::All {
            return Err(AdsError::Option {
                option: "voxels",
                value: "fragments".to_owned(),
                expected: "fragments mark voxels only with the axes `all`; with others use `triangles`",
            });
        }
        if self.coverage == Coverage::Conservative && !self.may_test_triangles() {
            return Err(AdsError::Option {
                option: "coverage",
                value: "conservative".to_owned(),
                expected: "cells that keep all that reaches into them need the axes `triangle`, the acceptance `plane` \
                           and the leaves `fragments`; otherwise use the coverage `exact`",
            });
        }
        let is_plain = self.axes == Axes::Triangle && self.payload == Payload::Index;
        if self.leaves == Leaves::Voxels && !is_plain {
            return Err(AdsError::Option {
                option: "leaves",
                value: "voxels".to_owned(),
                expected: "voxels are hit themselves only with the axes `triangle` and the payload `index`",
            });
        }
        if self.ids && self.payload != Payload::Material {
            return Err(AdsError::Option {
                option: "ids",
                value: "on".to_owned(),
                expected: "only the attributes of hu lack the triangle: with others leave it off",
            });
        }
        if self.accept == Accept::Plane && self.payload != Payload::Index {
            return Err(AdsError::Option {
                option: "accept",
                value: "plane".to_owned(),
                expected: "plane acceptance needs the payload `index`, which leaves surfaces to the triangle",
            });
        }
        Ok(())
    }

    /// Words of a fragment: its depth, its payload, and the triangle that is kept for diagnostics; without
    /// links.
    pub fn fragment_words(&self) -> u64 {
        let payload = match self.payload {
            Payload::Index => 1,
            Payload::Material | Payload::Mirror => 3,
        };
        1 + payload + u64::from(self.ids)
    }

    /// Specialisation constants: id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        let axes = match self.axes {
            Axes::All => numbers::VOXEL_AXES_ALL,
            Axes::Voxel => numbers::VOXEL_AXES_VOXEL,
            Axes::Triangle => numbers::VOXEL_AXES_TRIANGLE,
        };
        let marking = match self.marking() {
            Marking::Fragments => numbers::VOXEL_MARKED_BY_FRAGMENTS,
            Marking::Triangles => numbers::VOXEL_MARKED_BY_TRIANGLES,
        };
        let march = match self.march {
            March::Samples => numbers::VOXEL_MARCH_SAMPLES,
            March::Exact => numbers::VOXEL_MARCH_EXACT,
        };
        let accept = match self.accept {
            Accept::Parity => numbers::VOXEL_ACCEPT_PARITY,
            Accept::Plane => numbers::VOXEL_ACCEPT_PLANE,
        };
        let coverage = match self.coverage {
            Coverage::Hardware => numbers::VOXEL_COVERAGE_HARDWARE,
            Coverage::Exact => numbers::VOXEL_COVERAGE_EXACT,
            Coverage::Conservative => numbers::VOXEL_COVERAGE_CONSERVATIVE,
        };
        let payload = match self.payload {
            Payload::Index => numbers::VOXEL_PAYLOAD_INDEX,
            Payload::Material => numbers::VOXEL_PAYLOAD_MATERIAL,
            Payload::Mirror => numbers::VOXEL_PAYLOAD_MIRROR,
        };
        let leaves = match self.leaves {
            Leaves::Fragments => numbers::VOXEL_LEAVES_FRAGMENTS,
            Leaves::Voxels => numbers::VOXEL_LEAVES_VOXELS,
        };
        let traversal = match self.traversal {
            Traversal::Dda => numbers::VOXEL_TRAVERSAL_DDA,
            Traversal::Octree => numbers::VOXEL_TRAVERSAL_OCTREE,
        };
        let ends = if self.has_ends() { self.ends } else { Ends::Touching };
        let inside = match self.inside {
            Inside::Column => numbers::VOXEL_INSIDE_COLUMN,
            Inside::Voxel => numbers::VOXEL_INSIDE_VOXEL,
        };
        vec![
            (ids::VOXEL_INSIDE, inside),
            (ids::VOXEL_ENDS, ends.number()),
            (ids::VOXEL_LEAVES, leaves),
            (ids::VOXEL_TRAVERSAL, traversal),
            (ids::VOXEL_AXES, axes),
            (ids::VOXEL_MARCH, march),
            (ids::VOXEL_ACCEPT, accept),
            (ids::VOXEL_COVERAGE, coverage),
            (ids::VOXEL_PAGE, self.page),
            (ids::VOXEL_SORT, u32::from(self.sorts())),
            (ids::VOXEL_PAYLOAD, payload),
            (ids::VOXEL_STORAGE, self.storage.number()),
            (ids::VOXEL_IDS, u32::from(self.ids)),
            (ids::VOXEL_MARKED, marking),
        ]
    }

    /// Options as name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let payload = if self.payload == Payload::Index { "index" } else { "attributes" };
        if self.leaves == Leaves::Voxels {
            return vec![
                ("leaves", self.leaves.name().to_owned()),
                ("grid", self.grid().to_string()),
                ("ends", self.ends.name().to_owned()),
            ];
        }
        let mut options = vec![
            ("storage", self.storage.name().to_owned()),
            ("resolution", self.resolution.to_string()),
            ("grid", self.grid().to_string()),
            ("axes", self.axes.name().to_owned()),
            ("voxels", self.marking().name().to_owned()),
            ("march", self.march.name().to_owned()),
            ("accept", self.accept.name().to_owned()),
            ("payload", payload.to_owned()),
        ];
        if self.accept == Accept::Parity {
            options.push(("inside", self.inside.name().to_owned()));
            options.push(("ends", self.ends.name().to_owned()));
        }
        if self.payload == Payload::Material {
            options.push(("ids", if self.ids { "on" } else { "off" }.to_owned()));
        }
        if self.storage == Storage::Contiguous {
            options.push(("sort", if self.sort { "on" } else { "off" }.to_owned()));
        }
        if self.storage == Storage::Paged {
            options.push(("page", self.page.to_string()));
        }
        if self.march == March::Samples {
            options.push(("samples", self.samples.to_string()));
        }
        options
    }

    /// Paths as name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        vec![
            ("builder", self.builder.name().to_owned()),
            ("coverage", self.coverage.name().to_owned()),
            ("traversal", self.traversal.name().to_owned()),
            ("addressing", self.addressing.name().to_owned()),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's rule of thumb: 64 voxels for 1280 cells, about as many for 1024.
    #[test]
    fn the_grid_follows_the_resolution() {
        for (resolution, grid) in [(1280, 62), (1024, 55), (512, 39), (1, 2), (8192, 157)] {
            assert_eq!(Config::robust(resolution).grid(), grid);
        }
        assert_eq!(Config { grid: Some(64), ..Config::robust(1024) }.grid(), 64);
    }
}
