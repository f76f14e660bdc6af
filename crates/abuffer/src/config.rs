//! Options of the A-buffer and the two presets.

use rasray_ads::{Addressing, AdsError, Builder, Counters};
use rasray_shaders_glsl::constants::abuffer as numbers;

/// How a ray steps through cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum March {
    /// Steps of equal length on the screen, at most [`Config::samples`] a face. Cells between are not
    /// visited.
    Samples,
    /// The same with as many steps as keep each to a cell of the longer axis, as the paper's march without its limit.
    Dda,
    /// Every cell the ray crosses.
    Exact,
    /// The same hits with leaps over blocks of cells that hold nothing at the ray's depths.
    Pyramid,
}

/// When a fragment counts as hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accept {
    /// Its depth lies in the ray's half-open depth interval within the cell.
    Interval,
    /// The same, with each fragment extended away from the eye by [`Config::thickness`].
    Thickness,
    /// The depths that its triangle takes within the cell meet those of the ray. Needs [`Payload::Index`].
    Slope,
    /// The ray meets the plane of its triangle within the cell. Needs [`Payload::Index`].
    Plane,
}

impl Accept {
    /// Whether it looks at the fragment's triangle; then cells store how far triangles reach in depth.
    pub fn needs_triangles(self) -> bool {
        matches!(self, Self::Slope | Self::Plane)
    }
}

/// What a fragment carries beside its node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Payload {
    /// The triangle's id, 4 bytes: plane and surface come from the posed triangle.
    Index,
    /// The paper's quantised attributes, 16 bytes. Needs a scene.
    Attributes,
}

/// Who decides which cells a triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// The rasterizer, with its sub-pixel grid.
    Hardware,
    /// A watertight test of the cell's centre against the triangle; the rasterizer only proposes.
    Exact,
    /// The same, and a triangle that reaches into a cell beside its centre is kept in the cell's fringe: edge-on ones,
    /// silhouettes, and what is smaller than a cell. Rays then test triangles, not their planes, and find what brute force
    /// finds ([`Config::is_exact`]). Needs [`Accept::Plane`].
    Conservative,
}

/// Which views are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    /// Six faces of a cube around the eye: all that is around it.
    Cube,
    /// The same, and what the camera sees, with [`Config::camera_resolution`] cells a side.
    CubeCamera,
    /// What the camera sees and nothing else: rays meet nothing outside of its pyramid.
    Camera,
}

impl Views {
    /// Every choice.
    pub const ALL: [Self; 3] = [Self::Cube, Self::CubeCamera, Self::Camera];

    /// The word of options and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cube => "cube",
            Self::CubeCamera => "cube+camera",
            Self::Camera => "camera",
        }
    }

    /// Whether the faces of the cube are among them.
    pub fn has_cube(self) -> bool {
        self != Self::Camera
    }

    /// Whether the camera's view is among them.
    pub fn has_camera(self) -> bool {
        self != Self::Cube
    }

    fn number(self) -> u32 {
        let cube = if self.has_cube() { numbers::ABUFFER_VIEWS_CUBE } else { 0 };
        cube | if self.has_camera() { numbers::ABUFFER_VIEWS_CAMERA } else { 0 }
    }
}

/// How the fragments of a cell are kept (MMRT table 2). Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// One linked list a cell, read from its near end.
    Ll,
    /// One doubly linked list a cell, read from either end.
    Dll,
    /// A linked list a depth bucket.
    Llb,
    /// A doubly linked list a depth bucket: the paper's own.
    Dllb,
    /// One behind the other, counted first (S-buffer). Sorted lists of a cell are searched by halves.
    Sb,
    /// A linked list of pages a depth bucket; a page holds [`Config::page`] fragments.
    Paged,
}

impl Storage {
    /// Every storage.
    pub const ALL: [Self; 6] = [Self::Ll, Self::Dll, Self::Llb, Self::Dllb, Self::Sb, Self::Paged];

    /// The word of options and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ll => "ll",
            Self::Dll => "dll",
            Self::Llb => "llb",
            Self::Dllb => "dllb",
            Self::Sb => "sb",
            Self::Paged => "paged",
        }
    }

    /// Whether a cell has depth bounds and a list a bucket.
    pub fn is_bucketed(self) -> bool {
        matches!(self, Self::Llb | Self::Dllb | Self::Paged)
    }

    /// Whether nodes link both ways.
    pub fn is_doubly_linked(self) -> bool {
        matches!(self, Self::Dll | Self::Dllb)
    }

    fn number(self) -> u32 {
        match self {
            Self::Ll => numbers::ABUFFER_STORAGE_LL,
            Self::Dll => numbers::ABUFFER_STORAGE_DLL,
            Self::Llb => numbers::ABUFFER_STORAGE_LLB,
            Self::Dllb => numbers::ABUFFER_STORAGE_DLLB,
            Self::Sb => numbers::ABUFFER_STORAGE_SB,
            Self::Paged => numbers::ABUFFER_STORAGE_PAGED,
        }
    }
}

/// Everything that may be chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Cells a side of each face, 1 to 8192. A power of two keeps cell boundaries exact.
    pub resolution: u32,
    /// Which views are drawn. A view of the camera needs a [`rasray_ads::Viewpoint`] with one.
    pub views: Views,
    /// Cells a side of the camera's view, 1 to 8192, whatever its aspect; only for views with a camera.
    pub camera_resolution: u32,
    /// How a cell's fragments are kept. Changes no hit.
    pub storage: Storage,
    /// Payload within the nodes instead of in a pool of its own. Changes no hit.
    pub inline: bool,
    /// Fragments a page: 1, 2, 4 or 8; only for [`Storage::Paged`]. Changes no hit.
    pub page: u32,
    /// Depth buckets a cell, 1 to 32; only for storages with buckets ([`Storage::is_bucketed`]). Changes no hit.
    pub buckets: u32,
    /// How rays step.
    pub march: March,
    /// Most samples a face, 1 to 65535; only for [`March::Samples`].
    pub samples: u32,
    /// When a fragment counts.
    pub accept: Accept,
    /// Metres; only for [`Accept::Thickness`].
    pub thickness: f32,
    /// What a fragment carries.
    pub payload: Payload,
    /// Who decides coverage.
    pub coverage: Coverage,
    /// Who puts triangles into cells. Changes no hit.
    pub builder: Builder,
    /// Sort lists, so that a search can end early. Changes no hit.
    pub sort: bool,
    /// Skip cells and buckets that the ray's depths cannot meet. Changes no hit.
    pub skip: bool,
    /// How pools are reached. Changes no hit.
    pub addressing: Addressing,
    /// Fragments, or pages of them, to make room for before the first build; a guess from the resolution where
    /// absent.
    pub fragments: Option<u64>,
    /// How much of their work rays record. Changes no hit.
    pub counters: Counters,
    /// Work units a ray may spend in one dispatch; the shared default where absent. Changes no hit.
    pub work_budget: Option<u32>,
}

impl Config {
    /// The repaired structure: exact march, plane acceptance, triangle ids.
    pub fn robust(resolution: u32) -> Self {
        Self {
            resolution,
            views: Views::Cube,
            camera_resolution: resolution,
            storage: Storage::Dllb,
            inline: false,
            page: 4,
            buckets: 4,
            march: March::Exact,
            samples: 100,
            accept: Accept::Plane,
            thickness: 0.0,
            payload: Payload::Index,
            coverage: Coverage::Exact,
            builder: Builder::Raster,
            sort: true,
            skip: true,
            addressing: Addressing::Descriptor,
            fragments: None,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// The paper's approximations: 100 samples a face, half-open depth intervals, quantised
    /// attributes, the rasterizer's own coverage.
    pub fn published(resolution: u32) -> Self {
        Self {
            march: March::Samples,
            accept: Accept::Interval,
            payload: Payload::Attributes,
            coverage: Coverage::Hardware,
            ..Self::robust(resolution)
        }
    }

    /// Checks ranges and combinations.
    ///
    /// # Errors
    /// The first option out of range, or the combination that is not possible.
    pub fn validate(&self) -> Result<(), AdsError> {
        let range = |option, value: u32, lowest, highest, expected| {
            if (lowest..=highest).contains(&value) {
                Ok(())
            } else {
                Err(AdsError::Option { option, value: value.to_string(), expected })
            }
        };
        range("resolution", self.resolution, 1, 8192, "1 to 8192 cells a side")?;
        range("camera-resolution", self.camera_resolution, 1, 8192, "1 to 8192 cells a side")?;
        range("buckets", self.buckets, 1, 32, "1 to 32 buckets a cell")?;
        range("samples", self.samples, 1, 65535, "1 to 65535 samples a face")?;
        if ![1, 2, 4, 8].contains(&self.page) {
            return Err(AdsError::Option {
                option: "page",
                value: self.page.to_string(),
                expected: "1, 2, 4 or 8 fragments a page",
            });
        }
        // A dispatch that resumes a search counts its cell before it reads an entry.
        let budget = self.work_budget.unwrap_or(u32::MAX);
        range("work budget", budget, 2, u32::MAX, "2 units or more a dispatch, or rays make no progress")?;
        if !(self.thickness >= 0.0 && self.thickness.is_finite()) {
            return Err(AdsError::Option {
                option: "thickness",
                value: self.thickness.to_string(),
                expected: "a finite length in metres, 0 or more",
            });
        }
        if self.accept.needs_triangles() && self.payload != Payload::Index {
            return Err(AdsError::Option {
                option: "accept",
                value: format!("{:?}", self.accept).to_lowercase(),
                expected: "the acceptances plane and slope need the payload `index`, which names the triangle",
            });
        }
        if self.coverage == Coverage::Hardware && self.builder == Builder::Binning {
            return Err(AdsError::Option {
                option: "builder",
                value: self.builder.name().to_owned(),
                expected: "the binning builder does not draw: with coverage `hardware` take builder raster",
            });
        }
        if self.has_fringe() && self.accept != Accept::Plane {
            return Err(AdsError::Option {
                option: "coverage",
                value: "conservative".to_owned(),
                expected: "conservative coverage tests triangles, which fragments name with `accept=plane` only",
            });
        }
        Ok(())
    }

    /// Whether every hit is that of brute force: cells keep every triangle that reaches into them, and rays visit every cell
    /// that they cross, all around the eye.
    pub fn is_exact(&self) -> bool {
        self.has_fringe() && matches!(self.march, March::Exact | March::Pyramid) && self.views.has_cube()
    }

    /// Whether cells keep triangles beside their centres.
    pub(crate) fn has_fringe(&self) -> bool {
        self.coverage == Coverage::Conservative
    }

    /// Whether cells know the smallest and largest depth of their fragments.
    pub(crate) fn has_ends(&self) -> bool {
        self.storage.is_bucketed() || self.march == March::Pyramid
    }

    /// Lists a cell.
    pub fn lists(&self) -> u32 {
        if self.storage.is_bucketed() { self.buckets } else { 1 }
    }

    /// Specialisation constants: id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        vec![
            (10, self.lists()),
            (
                11,
                match self.march {
                    March::Samples => numbers::ABUFFER_MARCH_SAMPLES,
                    March::Dda => numbers::ABUFFER_MARCH_DDA,
                    March::Exact => numbers::ABUFFER_MARCH_EXACT,
                    March::Pyramid => numbers::ABUFFER_MARCH_PYRAMID,
                },
            ),
            (
                12,
                match self.accept {
                    Accept::Interval => numbers::ABUFFER_ACCEPT_INTERVAL,
                    Accept::Thickness => numbers::ABUFFER_ACCEPT_THICKNESS,
                    Accept::Slope => numbers::ABUFFER_ACCEPT_SLOPE,
                    Accept::Plane => numbers::ABUFFER_ACCEPT_PLANE,
                },
            ),
            (13, u32::from(self.sort)),
            (14, u32::from(self.skip)),
            (
                15,
                match self.payload {
                    Payload::Index => numbers::ABUFFER_PAYLOAD_INDEX,
                    Payload::Attributes => numbers::ABUFFER_PAYLOAD_ATTRIBUTES,
                },
            ),
            (
                16,
                match self.coverage {
                    Coverage::Hardware => numbers::ABUFFER_COVERAGE_HARDWARE,
                    Coverage::Exact => numbers::ABUFFER_COVERAGE_EXACT,
                    Coverage::Conservative => numbers::ABUFFER_COVERAGE_CONSERVATIVE,
                },
            ),
            (17, self.storage.number()),
            (18, u32::from(self.inline)),
            (19, self.page),
            (20, self.views.number()),
        ]
    }

    /// Options as name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let lower = |value: &dyn std::fmt::Debug| format!("{value:?}").to_lowercase();
        let switch = |on: bool| if on { "on" } else { "off" }.to_owned();
        let mut options = vec![
            ("storage", self.storage.name().to_owned()),
            ("inline", switch(self.inline)),
            ("resolution", self.resolution.to_string()),
            ("march", lower(&self.march)),
            ("accept", lower(&self.accept)),
            ("payload", lower(&self.payload)),
            ("views", self.views.name().to_owned()),
            ("sort", switch(self.sort)),
            ("skip", switch(self.skip)),
        ];
        if self.views.has_camera() {
            options.push(("camera-resolution", self.camera_resolution.to_string()));
        }
        if self.storage.is_bucketed() {
            options.push(("buckets", self.buckets.to_string()));
        }
        if self.storage == Storage::Paged {
            options.push(("page", self.page.to_string()));
        }
        if self.march == March::Samples {
            options.push(("samples", self.samples.to_string()));
        }
        if self.accept == Accept::Thickness {
            options.push(("thickness", self.thickness.to_string()));
        }
        options
    }

    /// Paths as name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        let lower = |value: &dyn std::fmt::Debug| format!("{value:?}").to_lowercase();
        vec![
            ("builder", self.builder.name().to_owned()),
            ("coverage", lower(&self.coverage)),
            ("addressing", self.addressing.name().to_owned()),
        ]
    }
}
