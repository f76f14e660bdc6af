//! Options of voxels with axis A-buffers, and their presets.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::{Addressing, AdsError, Builder, Counters, Ends};
use rasray_shaders_glsl::constant_ids::voxel as ids;
use rasray_shaders_glsl::constants::voxel as numbers;

use crate::{Accept, Axes, Coverage, Inside, Leaves, March, Marking, Payload, Storage, Traversal};

/// Options of voxels with axis A-buffers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Cells along a side of each view, 1 to 8192.
    pub resolution: u32,
    /// Number of voxels along a side, 1 to 1024. If absent, the square root of three times the resolution;
    /// with [`Leaves::Voxels`] the resolution, but no more than [`VOXEL_LEAVES_GRID`].
    pub grid: Option<u32>,
    /// Object that a ray hits in an occupied voxel.
    pub leaves: Leaves,
    /// Method of stepping a ray from voxel to voxel. Changes no hit.
    pub traversal: Traversal,
    /// Rule for the view that keeps a fragment.
    pub axes: Axes,
    /// Test of a voxel for occupancy. If absent, [`Marking::Fragments`] with [`Axes::All`], else
    /// [`Marking::Triangles`].
    pub voxels: Option<Marking>,
    /// Method of stepping a ray within a voxel.
    pub march: March,
    /// Steps per voxel, 1 to 64; used only by [`March::Samples`].
    pub samples: u32,
    /// Condition under which a ray hits a fragment.
    pub accept: Accept,
    /// Fragments that decide whether a point is inside; used only by [`Accept::Parity`].
    pub inside: Inside,
    /// Rule for hits at the ends of rays; used only by [`Accept::Parity`] and [`Leaves::Voxels`].
    pub ends: Ends,
    /// Cells that keep a triangle.
    pub coverage: Coverage,
    /// Builder that bins triangles into cells. Changes no hit.
    pub builder: Builder,
    /// Data that a fragment carries.
    pub payload: Payload,
    /// Switch for diagnostics: keeps the triangle of each fragment behind [`Payload::Material`]. Hits then
    /// name the triangle, and nothing else follows: rays do not exclude it, and surfaces stay those of the
    /// payload. Changes no t.
    pub ids: bool,
    /// Storage of lists. Changes no hit.
    pub storage: Storage,
    /// Fragments per page, 1 to 8; used only by [`Storage::Paged`]. Changes no hit.
    pub page: u32,
    /// Switch for sorted lists, in which a search can begin and end within the list; not for
    /// [`Storage::Paged`]. Changes no hit.
    pub sort: bool,
    /// Addressing of pools: descriptors or device addresses. Changes no hit.
    pub addressing: Addressing,
    /// Number of fragments, or of pages of fragments, to allocate for the first build. If absent, the
    /// resolution gives a guess.
    pub fragments: Option<u64>,
    /// Counters of work that rays record. Changes no hit.
    pub counters: Counters,
    /// Work units that a ray may spend in one dispatch. If absent, the default that all structures share.
    /// Changes no hit.
    pub work_budget: Option<u32>,
}

/// Maximum number of voxels along a side that follows from the resolution with [`Leaves::Voxels`]: 72 MiB of
/// voxels.
pub const VOXEL_LEAVES_GRID: u32 = 256;

rasray_ads::configured!(Config);

impl Config {
    /// Returns the options of the repaired structure: each triangle is in the view it faces most, in all
    /// cells that it reaches into. Hits are those of brute force.
    pub fn robust(resolution: u32) -> Self {
        Self { coverage: Coverage::Conservative, ..Self::at_centres(resolution) }
    }

    /// Returns the options of fragments at centres: each triangle is in the view it faces most, in the cells
    /// whose centres it covers. Rays visit every cell and intersect planes.
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

    /// Returns the options of Hu et al.: all views keep all fragments, linked in one pass and sorted, with
    /// surface attributes in each fragment, three steps per voxel, and acceptance by parity.
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

    /// Returns the options of Frid Kastrati and Goswami: voxels come first, then each fragment in the view of
    /// its voxel, in pages of four.
    pub fn published_selective(resolution: u32) -> Self {
        Self {
            axes: Axes::Voxel,
            payload: Payload::Mirror,
            storage: Storage::Paged,
            ..Self::published_hu(resolution)
        }
    }

    /// Returns the number of voxels along a side.
    pub fn grid(&self) -> u32 {
        let balanced = match self.leaves {
            Leaves::Fragments => (3.0 * f64::from(self.resolution)).sqrt().round() as u32,
            Leaves::Voxels => self.resolution.min(VOXEL_LEAVES_GRID),
        };
        self.grid.unwrap_or(balanced).clamp(1, numbers::VOXEL_GRID_LIMIT)
    }

    /// Returns true if the other options allow cells to keep all triangles that reach into them
    /// ([`Coverage::Conservative`]).
    pub fn may_test_triangles(&self) -> bool {
        self.axes == Axes::Triangle && self.accept == Accept::Plane && self.leaves == Leaves::Fragments
    }

    /// Returns the test of voxels for occupancy: the chosen one, or the one that follows from
    /// [`Config::axes`].
    pub fn marking(&self) -> Marking {
        let one_pass = self.axes == Axes::All;
        self.voxels.unwrap_or(if one_pass { Marking::Fragments } else { Marking::Triangles })
    }

    /// Returns true if lists are sorted. Lists in pages never are.
    pub fn sorts(&self) -> bool {
        self.sort && self.storage != Storage::Paged && self.leaves == Leaves::Fragments
    }

    /// Returns true if a search bisects a list. Otherwise a search may have to read all of the list.
    pub(crate) fn bisects(&self) -> bool {
        self.sort && self.storage == Storage::Contiguous
    }

    /// Returns true if a hit may lie before or behind the surface, so that [`Config::ends`] matters.
    fn has_ends(&self) -> bool {
        self.accept == Accept::Parity || self.leaves == Leaves::Voxels
    }

    /// Checks the ranges of all options and their combinations.
    ///
    /// # Errors
    /// The first option that is out of range, or the first combination that is not possible.
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

    /// Returns the words of a fragment: its depth, its payload, and the triangle that is kept for
    /// diagnostics, without links.
    pub fn fragment_words(&self) -> u64 {
        let payload = match self.payload {
            Payload::Index => 1,
            Payload::Material | Payload::Mirror => 3,
        };
        1 + payload + u64::from(self.ids)
    }

    /// Returns the specialisation constants, as pairs of id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        let ends = if self.has_ends() { self.ends } else { Ends::Touching };
        vec![
            (ids::VOXEL_INSIDE, self.inside.number()),
            (ids::VOXEL_ENDS, ends.number()),
            (ids::VOXEL_LEAVES, self.leaves.number()),
            (ids::VOXEL_TRAVERSAL, self.traversal.number()),
            (ids::VOXEL_AXES, self.axes.number()),
            (ids::VOXEL_MARCH, self.march.number()),
            (ids::VOXEL_ACCEPT, self.accept.number()),
            (ids::VOXEL_COVERAGE, self.coverage.number()),
            (ids::VOXEL_PAGE, self.page),
            (ids::VOXEL_SORT, u32::from(self.sorts())),
            (ids::VOXEL_PAYLOAD, self.payload.number()),
            (ids::VOXEL_STORAGE, self.storage.number()),
            (ids::VOXEL_IDS, u32::from(self.ids)),
            (ids::VOXEL_MARKED, self.marking().number()),
        ]
    }

    /// Returns the options as pairs of name and value, for reports.
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

    /// Returns the chosen code paths as pairs of name and value, for reports.
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

    /// Checks the number of voxels against the paper's rule of thumb: 64 voxels for 1280 cells, about as many
    /// for 1024.
    #[test]
    fn the_grid_follows_the_resolution() {
        for (resolution, grid) in [(1280, 62), (1024, 55), (512, 39), (1, 2), (8192, 157)] {
            assert_eq!(Config::robust(resolution).grid(), grid);
        }
        assert_eq!(Config { grid: Some(64), ..Config::robust(1024) }.grid(), 64);
    }
}
