//! Options of the A-buffer and the two presets.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::{Addressing, AdsError, Builder, Counters};
use rasray_shaders_glsl::constant_ids::abuffer as ids;

use crate::{Accept, Bounds, Coverage, March, Payload, Storage, ViewSwitching, Views};

/// Options of an A-buffer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Cells along a side of each face, 1 to 8192. A power of two keeps cell boundaries exact.
    pub resolution: u32,
    /// Views that the build draws. A view of the camera needs a [`rasray_ads::Viewpoint`] with a camera.
    pub views: Views,
    /// Columns and rows of the camera's view, 1 to 8192 each; used only by views with a camera. If one is
    /// even and the other odd, the smaller one is increased by one ([`Config::camera_cells`]), so that the
    /// cells lie evenly around the axis.
    pub camera_resolution: [u32; 2],
    /// Method by which a ray passes from one view to the next.
    pub view_switching: ViewSwitching,
    /// Storage of a cell's fragments. Changes no hit.
    pub storage: Storage,
    /// Place of the payload: within the nodes if true, in a pool of its own if false. Changes no hit.
    pub inline: bool,
    /// Fragments per page: 1, 2, 4 or 8; used only by [`Storage::Paged`]. Changes no hit.
    pub page: u32,
    /// Depth buckets per cell, 1 to 32; used only by storages with buckets ([`Storage::is_bucketed`]) that
    /// keep all layers. Changes no hit.
    pub buckets: u32,
    /// Switch for the paper's single-layer variant, which keeps only the nearest fragments of each cell.
    /// Cannot be combined with [`Coverage::Conservative`] or [`Coverage::EdgeOn`]. Rays then hit nothing that
    /// is behind something else as seen from the eye.
    pub single_layer: bool,
    /// Method of stepping rays through cells.
    pub march: March,
    /// Maximum number of samples per face, 1 to 65535; used only by [`March::Samples`].
    pub samples: u32,
    /// Switch for jittered samples; used only by [`March::Samples`]. Where steps are longer than a cell, each
    /// ray places its samples at an offset of its own within the steps, not in the middle.
    pub jitter: bool,
    /// Condition under which a ray hits a fragment.
    pub accept: Accept,
    /// Thickness of fragments, in metres; used only by [`Accept::Thickness`]. Default: half the width of a
    /// step of the march at the farthest geometry, `f / n`, where `n` is the number of cells along a side, or
    /// of samples per face if these are fewer, and `f` is the largest coordinate of the geometry relative to
    /// the eye. The default is larger for a camera's view with wider cells.
    pub thickness: Option<f32>,
    /// Data that a fragment carries.
    pub payload: Payload,
    /// Switch for diagnostics: keeps the triangle of each fragment behind a payload that does not include it.
    /// Hits then name the triangle, and nothing else follows: rays do not exclude it, and surfaces stay those
    /// of the payload. Changes no t.
    pub ids: bool,
    /// Test that decides which cells a triangle covers.
    pub coverage: Coverage,
    /// Source of the depth bounds of cells. [`Bounds::Boxes`] needs lists by depth bucket and
    /// [`Builder::Raster`], and cannot be combined with [`Coverage::Hardware`]. Changes no hit.
    pub bounds: Bounds,
    /// Builder that bins triangles into cells. Changes no hit.
    pub builder: Builder,
    /// Switch for sorted lists, in which a search can end early. Changes no hit.
    pub sort: bool,
    /// Switch for skipping cells and buckets that the ray's depths cannot overlap. Changes no hit.
    pub skip: bool,
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

rasray_ads::configured!(Config);

impl Config {
    /// Returns the options of the repaired structure: cells keep every triangle that reaches into them, and
    /// rays test triangles and skip blocks of cells. Hits are those of brute force.
    pub fn robust(resolution: u32) -> Self {
        Self {
            storage: Storage::Ll,
            march: March::Pyramid,
            coverage: Coverage::Conservative,
            ..Self::at_centres(resolution)
        }
    }

    /// Returns the options of fragments without conservative lists: cells keep the triangles that cover their
    /// centres, and rays visit every cell and intersect planes.
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

    /// Returns the paper's approximations: 100 samples per face with a jitter per ray, fragments as voxels of
    /// one thickness, quantised attributes, the rasterizer's own coverage, and rays that are snapped from
    /// view to view. The paper also has a view of its camera: where builds are told of a camera, choose
    /// [`Views::CubeCamera`] with the columns and rows of the image.
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

    /// Checks the ranges of all options and their combinations.
    ///
    /// # Errors
    /// The first option that is out of range, or the first combination that is not possible.
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

    /// Checks that the configuration finds depth bounds before it stores fragments, and that boxes can
    /// enclose these fragments.
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

    /// Returns true if every hit equals that of brute force: cells keep every triangle that reaches into
    /// them, and rays visit every cell that they cross, all around the eye.
    pub fn is_exact(&self) -> bool {
        self.tests_triangles()
            && matches!(self.march, March::Exact | March::Pyramid)
            && self.views.has_cube()
            && self.view_switching == ViewSwitching::Exact
    }

    /// Returns the columns and rows of the camera's view, both even or both odd, without the border.
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

    /// Returns true if the other options allow cells to keep triangles that do not cover their centres.
    pub fn may_test_triangles(&self) -> bool {
        self.accept == Accept::Plane && self.payload == Payload::Index && !self.single_layer
    }

    /// Returns true if cells keep triangles that do not cover their centres, in conservative lists.
    pub(crate) fn has_conservative_lists(&self) -> bool {
        matches!(self.coverage, Coverage::Conservative | Coverage::EdgeOn)
    }

    /// Returns true if rays test the triangles of fragments, not the planes of these triangles.
    pub(crate) fn tests_triangles(&self) -> bool {
        self.coverage == Coverage::Conservative
    }

    /// Returns the number of sets of marks of triangles. One set marks the triangles that cells keep. With
    /// [`Coverage::EdgeOn`] there are two, since marks decide what conservative lists keep: one set marks the
    /// triangles that have a fragment, the other the triangles of conservative lists.
    pub(crate) fn mark_sets(&self) -> u64 {
        if self.coverage == Coverage::EdgeOn { 2 } else { 1 }
    }

    /// Returns true if cells store the smallest and largest depth of their fragments.
    pub(crate) fn has_ends(&self) -> bool {
        self.storage.is_bucketed() || self.march == March::Pyramid || self.single_layer
    }

    /// Returns true if the build finds depth bounds before it stores fragments.
    pub(crate) fn has_bounds_pass(&self) -> bool {
        self.storage.is_bucketed() || self.single_layer
    }

    /// Returns true if a cell keeps its fragments in several lists by depth. A single layer has one list,
    /// whatever the storage.
    pub(crate) fn has_buckets(&self) -> bool {
        self.storage.is_bucketed() && !self.single_layer
    }

    /// Returns the number of lists per cell.
    pub fn lists(&self) -> u32 {
        if self.has_buckets() { self.buckets } else { 1 }
    }

    /// Returns the ending of the names of the shader modules that trace this configuration: how rays step,
    /// and what they test.
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

    /// Returns the specialisation constants, as pairs of id and bits.
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

    /// Returns the options as pairs of name and value, for reports.
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

    /// Returns the chosen code paths as pairs of name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        vec![
            ("builder", self.builder.name().to_owned()),
            ("coverage", self.coverage.name().to_owned()),
            ("addressing", self.addressing.name().to_owned()),
        ]
    }
}
