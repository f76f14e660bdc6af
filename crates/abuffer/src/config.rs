//! Options of the A-buffer and the two presets.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::{Addressing, AdsError, Builder, Counters};
use rasray_shaders_glsl::constant_ids::abuffer as ids;

use crate::{Accept, Bounds, Coverage, March, Payload, Storage, ViewSwitching, Views};

/// All options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Cells along a side of each face, 1 to 8192. A power of two keeps cell boundaries exact.
    pub resolution: u32,
    /// Views that are drawn. A view of the camera needs a [`rasray_ads::Viewpoint`] with one.
    pub views: Views,
    /// Columns and rows of the camera's view, 1 to 8192 each; only for views with a camera. If one is even
    /// and the other odd, the smaller one is increased by one ([`Config::camera_cells`]), so that the cells
    /// lie evenly around the axis.
    pub camera_resolution: [u32; 2],
    /// Method by which rays pass from view to view.
    pub view_switching: ViewSwitching,
    /// Storage of a cell's fragments. Changes no hit.
    pub storage: Storage,
    /// Payload within the nodes instead of in a pool of its own. Changes no hit.
    pub inline: bool,
    /// Fragments per page: 1, 2, 4 or 8; only for [`Storage::Paged`]. Changes no hit.
    pub page: u32,
    /// Depth buckets per cell, 1 to 32; only for storages with buckets ([`Storage::is_bucketed`]), and with
    /// all layers. Changes no hit.
    pub buckets: u32,
    /// Keep only the nearest fragments of each cell, as the paper's single-layer variant does; not with
    /// [`Coverage::Conservative`] and [`Coverage::EdgeOn`]. Rays then hit nothing that is behind something
    /// else as seen from the eye.
    pub single_layer: bool,
    /// Method of stepping rays through cells.
    pub march: March,
    /// Maximum of samples per face, 1 to 65535; only for [`March::Samples`].
    pub samples: u32,
    /// Where steps are longer than a cell, each ray places its samples at an offset of its own within them,
    /// not in the middle; only for [`March::Samples`].
    pub jitter: bool,
    /// When a fragment counts.
    pub accept: Accept,
    /// Metres; only for [`Accept::Thickness`]. Default: half the width of a step of the march at the farthest
    /// geometry: `f / n` for `n` cells along a side, or samples per face where these are fewer, and `f` the
    /// largest coordinate of the geometry relative to the eye; more for a camera's view with wider cells.
    pub thickness: Option<f32>,
    /// Data that a fragment carries.
    pub payload: Payload,
    /// For diagnostics: keep the triangle of each fragment behind a payload without it. Hits then name it,
    /// and nothing else follows: it is not excluded, and surfaces stay those of the payload. Changes no t.
    pub ids: bool,
    /// Test of which cells a triangle covers.
    pub coverage: Coverage,
    /// Depths that the bounds of cells enclose. [`Bounds::Boxes`] goes with lists by depth bucket only, with
    /// [`Builder::Raster`], and not with [`Coverage::Hardware`]. Changes no hit.
    pub bounds: Bounds,
    /// Builder that bins triangles into cells. Changes no hit.
    pub builder: Builder,
    /// Sort lists, so that a search can end early. Changes no hit.
    pub sort: bool,
    /// Skip cells and buckets that the ray's depths cannot overlap. Changes no hit.
    pub skip: bool,
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

rasray_ads::configured!(Config);

impl Config {
    /// The repaired structure: cells keep every triangle that reaches into them, rays test triangles and skip
    /// blocks of cells. Hits are those of brute force.
    pub fn robust(resolution: u32) -> Self {
        Self {
            storage: Storage::Ll,
            march: March::Pyramid,
            coverage: Coverage::Conservative,
            ..Self::at_centres(resolution)
        }
    }

    /// Fragments alone: cells keep the triangles that cover their centres, rays visit every cell and meet
    /// planes.
    pub fn at_centres(resolution: u32) -> Self {
        Self {
            resolution,
            views: Views::Cube,
            camera_resolution: [resolution; 2],
            view_switching: ViewSwitching::Exact,
            storage: Storage::Dllb,
            inline: false,
            page: 4,
            buckets: 4,
            single_layer: false,
            march: March::Exact,
            samples: 100,
            jitter: false,
            accept: Accept::Plane,
            thickness: None,
            payload: Payload::Index,
            ids: false,
            coverage: Coverage::Exact,
            bounds: Bounds::Geometry,
            builder: Builder::Raster,
            sort: true,
            skip: true,
            addressing: Addressing::Descriptor,
            fragments: None,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// The paper's approximations: 100 samples per face with a jitter per ray, fragments as voxels of one
    /// thickness, quantised attributes, the rasterizer's own coverage, rays that are snapped from view to
    /// view. The paper has a view of its camera as well: [`Views::CubeCamera`] with the columns and rows of
    /// the image, where builds are told of a camera.
    pub fn published(resolution: u32) -> Self {
        Self {
            view_switching: ViewSwitching::Snap,
            march: March::Samples,
            jitter: true,
            accept: Accept::Thickness,
            payload: Payload::Attributes,
            coverage: Coverage::Hardware,
            ..Self::at_centres(resolution)
        }
    }

    /// Checks ranges and combinations.
    ///
    /// # Errors
    /// The first option out of range, or the combination that is not possible.
    pub fn validate(&self) -> Result<(), AdsError> {
        check_range("resolution", self.resolution, 1..=8192, "1 to 8192 cells along a side")?;
        for side in self.camera_resolution {
            check_range("camera-resolution", side, 1..=8192, "1 to 8192 columns and rows")?;
        }
        check_range("buckets", self.buckets, 1..=32, "1 to 32 buckets per cell")?;
        check_range("samples", self.samples, 1..=65535, "1 to 65535 samples per face")?;
        if ![1, 2, 4, 8].contains(&self.page) {
            return Err(AdsError::Option {
                option: "page",
                value: self.page.to_string(),
                expected: "1, 2, 4 or 8 fragments per page",
            });
        }
        check_work_budget(self.work_budget, true)?;
        let thickness = self.thickness.unwrap_or(0.0);
        if !(thickness >= 0.0 && thickness.is_finite()) {
            return Err(AdsError::Option {
                option: "thickness",
                value: thickness.to_string(),
                expected: "a finite length in metres, 0 or more",
            });
        }
        let plane = self.accept == Accept::Plane && self.payload == Payload::Plane;
        if self.accept.needs_triangles() && self.payload != Payload::Index && !plane {
            return Err(AdsError::Option {
                option: "accept",
                value: self.accept.name().to_owned(),
                expected: "the acceptances plane and slope need the payload `index`, which identifies the triangle; \
                           plane also goes with the payload `plane`",
            });
        }
        if self.ids && self.payload == Payload::Index {
            return Err(AdsError::Option {
                option: "ids",
                value: "on".to_owned(),
                expected: "the payload `index` identifies triangles already: leave it off",
            });
        }
        if self.coverage == Coverage::Hardware && self.builder == Builder::Binning {
            return Err(AdsError::Option {
                option: "builder",
                value: self.builder.name().to_owned(),
                expected: "the binning builder does not draw: use builder `raster` with coverage `hardware`",
            });
        }
        self.validate_bounds()?;
        if self.has_conservative_lists() && self.single_layer {
            return Err(AdsError::Option {
                option: "single-layer",
                value: "on".to_owned(),
                expected: "the coverages conservative and edge-on keep triangles behind others: leave it off",
            });
        }
        if self.has_conservative_lists() && !self.may_test_triangles() {
            return Err(AdsError::Option {
                option: "coverage",
                value: self.coverage.name().to_owned(),
                expected: "the coverages conservative and edge-on test triangles, which fragments identify with \
                           `accept=plane` and `payload=index` only",
            });
        }
        Ok(())
    }

    /// Checks that there are bounds before fragments are stored, and that boxes can enclose these.
    fn validate_bounds(&self) -> Result<(), AdsError> {
        let expected = match self.bounds {
            Bounds::Boxes if !self.has_buckets() => {
                "boxes give bounds to lists by depth bucket: use storage `llb`, `dllb` or `paged`, with all layers"
            }
            Bounds::Boxes if self.builder == Builder::Binning => {
                "the binning builder does not draw boxes: use builder `raster`"
            }
            Bounds::Boxes if self.coverage == Coverage::Hardware => {
                "the rasterizer's depths may lie outside of boxes: use coverage `exact`"
            }
            Bounds::Geometry | Bounds::Boxes => return Ok(()),
        };
        Err(AdsError::Option { option: "bounds", value: self.bounds.name().to_owned(), expected })
    }

    /// True if every hit equals that of brute force: cells keep every triangle that reaches into them, and
    /// rays visit every cell that they cross, all around the eye.
    pub fn is_exact(&self) -> bool {
        self.tests_triangles()
            && matches!(self.march, March::Exact | March::Pyramid)
            && self.views.has_cube()
            && self.view_switching == ViewSwitching::Exact
    }

    /// Columns and rows of the camera's view, both even or both odd; border not counted.
    pub fn camera_cells(&self) -> [u32; 2] {
        let [columns, rows] = self.camera_resolution;
        if columns % 2 == rows % 2 {
            [columns, rows]
        } else if columns < rows {
            [columns + 1, rows]
        } else {
            [columns, rows + 1]
        }
    }

    /// True if cells may keep triangles outside of their centres, with the other options that there are.
    pub fn may_test_triangles(&self) -> bool {
        self.accept == Accept::Plane && self.payload == Payload::Index && !self.single_layer
    }

    /// True if cells keep triangles outside of their centres.
    pub(crate) fn has_conservative_lists(&self) -> bool {
        matches!(self.coverage, Coverage::Conservative | Coverage::EdgeOn)
    }

    /// True if rays intersect fragments by their triangles, not by the planes of these.
    pub(crate) fn tests_triangles(&self) -> bool {
        self.coverage == Coverage::Conservative
    }

    /// Sets of marks of triangles: those with a fragment, and where these decide what conservative lists
    /// keep, those that it does.
    pub(crate) fn mark_sets(&self) -> u64 {
        if self.coverage == Coverage::EdgeOn { 2 } else { 1 }
    }

    /// True if cells know the smallest and largest depth of their fragments.
    pub(crate) fn has_ends(&self) -> bool {
        self.storage.is_bucketed() || self.march == March::Pyramid || self.single_layer
    }

    /// True if depth bounds are found before fragments are stored.
    pub(crate) fn has_bounds_pass(&self) -> bool {
        self.storage.is_bucketed() || self.single_layer
    }

    /// True if the fragments of a cell are kept by depth in several lists: a single layer has one list,
    /// whatever the storage.
    pub(crate) fn has_buckets(&self) -> bool {
        self.storage.is_bucketed() && !self.single_layer
    }

    /// Lists per cell.
    pub fn lists(&self) -> u32 {
        if self.has_buckets() { self.buckets } else { 1 }
    }

    /// The ending of the names of the modules that trace it: how rays step, and what they test.
    pub(crate) fn trace_variant(&self) -> String {
        let steps = match self.march {
            March::Exact => "cells",
            March::Pyramid => "skips",
            March::Samples | March::Dda => "samples",
        };
        let tests = match self.accept {
            Accept::Plane if self.tests_triangles() => "triangles",
            Accept::Plane => "planes",
            Accept::Interval | Accept::Thickness | Accept::Slope => "depths",
        };
        format!(".{steps}.{tests}")
    }

    /// Specialisation constants: id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        vec![
            (ids::ABUFFER_BUCKETS, self.lists()),
            (ids::ABUFFER_MARCH, self.march.number()),
            (ids::ABUFFER_ACCEPT, self.accept.number()),
            (ids::ABUFFER_SORT, u32::from(self.sort)),
            (ids::ABUFFER_SKIP, u32::from(self.skip)),
            (ids::ABUFFER_PAYLOAD, self.payload.number()),
            (ids::ABUFFER_COVERAGE, self.coverage.number()),
            (ids::ABUFFER_STORAGE, self.storage.number()),
            (ids::ABUFFER_INLINE, u32::from(self.inline)),
            (ids::ABUFFER_PAGE, self.page),
            (ids::ABUFFER_VIEWS, self.views.number()),
            (ids::ABUFFER_SINGLE_LAYER, u32::from(self.single_layer)),
            (ids::ABUFFER_IDS, u32::from(self.ids)),
            (ids::ABUFFER_JITTER, u32::from(self.jitter)),
            (ids::ABUFFER_VIEW_SWITCHING, self.view_switching.number()),
            (ids::ABUFFER_BOUNDS_OF, self.bounds.number()),
        ]
    }

    /// Options as name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let switch = |on: bool| if on { "on" } else { "off" }.to_owned();
        let mut options = vec![
            ("storage", self.storage.name().to_owned()),
            ("inline", switch(self.inline)),
            ("resolution", self.resolution.to_string()),
            ("march", self.march.name().to_owned()),
            ("accept", self.accept.name().to_owned()),
            ("payload", self.payload.name().to_owned()),
            ("single-layer", switch(self.single_layer)),
            ("views", self.views.name().to_owned()),
            ("view-switching", self.view_switching.name().to_owned()),
            ("sort", switch(self.sort)),
            ("skip", switch(self.skip)),
        ];
        if self.payload != Payload::Index {
            options.push(("ids", switch(self.ids)));
        }
        if self.views.has_camera() {
            let [columns, rows] = self.camera_cells();
            options.push(("camera-resolution", format!("{columns}x{rows}")));
        }
        if self.has_buckets() {
            options.push(("buckets", self.buckets.to_string()));
            options.push(("bounds", self.bounds.name().to_owned()));
        }
        if self.storage == Storage::Paged {
            options.push(("page", self.page.to_string()));
        }
        if self.march == March::Samples {
            options.push(("samples", self.samples.to_string()));
            options.push(("jitter", switch(self.jitter)));
        }
        if self.accept == Accept::Thickness {
            let thickness = self.thickness.map_or_else(|| "auto".to_owned(), |metres| metres.to_string());
            options.push(("thickness", thickness));
        }
        options
    }

    /// Paths as name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        vec![
            ("builder", self.builder.name().to_owned()),
            ("coverage", self.coverage.name().to_owned()),
            ("addressing", self.addressing.name().to_owned()),
        ]
    }
}
