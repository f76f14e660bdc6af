//! Options of primitive lists, and their presets.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::words;
use rasray_ads::{Addressing, AdsError, Builder, Counters};
use rasray_shaders_glsl::constant_ids::primitive as ids;
use rasray_shaders_glsl::constants::primitive as numbers;

use crate::{Accept, Coverage, Depths, March, Stop};

/// Storage of the lists of a cell. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Linked nodes with a triangle and the next link, as in the paper: 8 bytes per entry, and one geometry
    /// pass less.
    Linked,
    /// Contiguous triangles, counted before they are stored: 4 bytes per entry.
    Contiguous,
}

words! { Storage { Linked "llb", Contiguous "sb" } }

/// Point at which the faces of the cube touch. Changes no hit where [`Config::is_exact`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Centre {
    /// The eye, as in the paper.
    Eye,
    /// The eye, if it lies within the geometry's bounds or if the bounds are flat; for an eye outside of the
    /// bounds, the nearest point well within them.
    Scene,
    /// A point within the geometry's bounds, or beside them if they are flat, wherever the eye is. A build is
    /// then not stale if only the eye moved.
    Fixed,
}

words! { Centre { Eye "eye", Scene "scene", Fixed "fixed" } }

/// Views that the build draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    /// Six faces of a cube.
    Cube,
    /// View of the camera alone: rays miss everything outside of it (section 5.2, single-view ray tracing). A
    /// build needs a [`rasray_ads::Viewpoint`] with a camera, and the centre is at the eye.
    Camera,
}

words! { Views { Cube "cube", Camera "camera" } }

/// Level of the pyramid with which a ray compares its depths first. Changes no hit where
/// [`Config::is_exact`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PyramidStart {
    /// Finest level: the ray ascends until a block holds something.
    Finest,
    /// Coarsest level, as in the paper: the ray descends until a block holds nothing.
    Coarsest,
}

words! { PyramidStart { Finest "finest", Coarsest "coarsest" } }

/// Options of primitive lists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Pixels along a side of each face, 1 to 8192. Changes no hit where [`Config::is_exact`].
    pub resolution: u32,
    /// Pixels along a side of a tile, 1 to 64. Each tile has its own lists. Changes no hit where
    /// [`Config::is_exact`].
    pub tile: u32,
    /// Depth buckets per tile, 1 to 64. Changes no hit where [`Config::is_exact`].
    pub buckets: u32,
    /// Views that the build draws.
    pub views: Views,
    /// Storage of lists. Changes no hit.
    pub storage: Storage,
    /// Point at which the faces of the cube touch. Changes no hit where [`Config::is_exact`].
    pub centre: Centre,
    /// Builder that bins triangles into tiles. Changes no hit.
    pub builder: Builder,
    /// Switch for the pyramid: depth bounds of blocks of tiles, so that a ray can skip blocks; used only with
    /// [`Config::skip`]. Changes no hit where [`Config::is_exact`].
    pub pyramid: bool,
    /// Level of the pyramid with which a ray compares its depths first.
    pub pyramid_start: PyramidStart,
    /// Tiles that list a triangle.
    pub coverage: Coverage,
    /// Condition under which a ray hits a triangle that it intersects.
    pub accept: Accept,
    /// Point at which a ray ends its search of a tile.
    pub stop: Stop,
    /// Depths of a triangle in a tile, which choose its buckets.
    pub depths: Depths,
    /// Rule by which a ray steps from one tile to the next.
    pub march: March,
    /// Switch for skipping tiles and buckets that the ray's depths cannot reach. Changes no hit where
    /// [`Config::is_exact`].
    pub skip: bool,
    /// Addressing of pools: descriptors or device addresses.
    pub addressing: Addressing,
    /// Number of entries to allocate for the first build. If absent, the number of cells gives a guess.
    pub entries: Option<u64>,
    /// Detail in which rays record their work. Changes no hit.
    pub counters: Counters,
    /// Work units that a ray may spend in one dispatch. If absent, the default that all structures share.
    /// Changes no hit.
    pub work_budget: Option<u32>,
}

rasray_ads::configured!(Config);

impl Config {
    /// Returns the options of the exact structure: every tile lists all triangles that reach into it, and
    /// every hit equals that of brute force.
    pub fn robust(resolution: u32) -> Self {
        Self {
            resolution,
            tile: 2,
            buckets: 16,
            views: Views::Cube,
            storage: Storage::Contiguous,
            centre: Centre::Scene,
            builder: Builder::Binning,
            pyramid: true,
            pyramid_start: PyramidStart::Finest,
            coverage: Coverage::Conservative,
            accept: Accept::T,
            stop: Stop::Best,
            depths: Depths::Clipped,
            march: March::Exact,
            skip: true,
            addressing: Addressing::Descriptor,
            entries: None,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// Returns the options of the paper's structure: linked lists, 20 buckets, and the paper's rules, which
    /// lose some hits.
    pub fn published(resolution: u32) -> Self {
        Self {
            builder: Builder::Raster,
            buckets: 20,
            storage: Storage::Linked,
            centre: Centre::Eye,
            accept: Accept::Tile,
            stop: Stop::Bucket,
            depths: Depths::Corners,
            march: March::Jump,
            ..Self::robust(resolution)
        }
    }

    /// Returns true if every hit equals that of brute force: no option is a rule of the paper that loses
    /// hits.
    pub fn is_exact(&self) -> bool {
        self.lossy_rule().is_none()
    }

    /// Returns the first option with a rule that loses hits, as option and value.
    fn lossy_rule(&self) -> Option<(&'static str, &'static str)> {
        let robust = Self::robust(1);
        [
            (self.accept == robust.accept, ("accept", "tile")),
            (self.stop == robust.stop, ("stop", "bucket")),
            (self.depths == robust.depths, ("depths", "corners")),
            (self.march == robust.march, ("march", "jump")),
            (self.coverage == robust.coverage, ("coverage", self.coverage.name())),
            (self.views == robust.views, ("views", "camera")),
        ]
        .into_iter()
        .find_map(|(kept, rule)| (!kept).then_some(rule))
    }

    /// Returns the number of views with tiles of their own.
    pub fn view_count(&self) -> u32 {
        match self.views {
            Views::Cube => 6,
            Views::Camera => 1,
        }
    }

    /// Returns the point at which views touch. The camera's view always has the eye as its centre.
    pub(crate) fn centre(&self) -> Centre {
        match self.views {
            Views::Cube => self.centre,
            Views::Camera => Centre::Eye,
        }
    }

    /// Returns the number of tiles along a side of a face. Tiles are the cells of the march, and the last
    /// tile of a row may reach beyond the face's pixels.
    pub fn tiles(&self) -> u32 {
        self.resolution.div_ceil(self.tile.max(1))
    }

    /// Returns true if there are blocks of cells, that is, a pyramid that rays use.
    pub(crate) fn has_pyramid(&self) -> bool {
        self.pyramid && self.skip
    }

    /// Checks the ranges of all options and their combinations.
    ///
    /// # Errors
    /// The first option that is out of range, or the first combination that is not possible.
    pub fn validate(&self) -> Result<(), AdsError> {
        check_range("resolution", self.resolution, 1..=8192, "1 to 8192 pixels along a side")?;
        check_range("tile", self.tile, 1..=64, "1 to 64 pixels along a side")?;
        check_range("buckets", self.buckets, 1..=64, "1 to 64 buckets per tile")?;
        if self.coverage != Coverage::Conservative && self.builder == Builder::Binning {
            let expected = "the binning builder does not draw: use builder `raster`";
            let value = self.coverage.name().to_owned();
            return Err(AdsError::Option { option: "coverage", value, expected });
        }
        if self.views == Views::Camera && self.centre == Centre::Fixed {
            let expected = "the camera's view is seen from the eye: use centre `eye`, or views `cube`";
            return Err(AdsError::Option { option: "centre", value: "fixed".to_owned(), expected });
        }
        check_work_budget(self.work_budget, false)
    }

    /// Returns the specialisation constants, as pairs of id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        let storage = match self.storage {
            Storage::Linked => numbers::PRIMITIVE_STORAGE_LINKED,
            Storage::Contiguous => numbers::PRIMITIVE_STORAGE_CONTIGUOUS,
        };
        let coverage = match self.coverage {
            Coverage::Hardware => numbers::PRIMITIVE_COVERAGE_HARDWARE,
            Coverage::Conservative => numbers::PRIMITIVE_COVERAGE_CONSERVATIVE,
            Coverage::ConservativeExtension => numbers::PRIMITIVE_COVERAGE_EXTENSION,
        };
        let accept = match self.accept {
            Accept::T => numbers::PRIMITIVE_ACCEPT_T,
            Accept::Tile => numbers::PRIMITIVE_ACCEPT_TILE,
        };
        let stop = match self.stop {
            Stop::Best => numbers::PRIMITIVE_STOP_BEST,
            Stop::Bucket => numbers::PRIMITIVE_STOP_BUCKET,
        };
        let depths = match self.depths {
            Depths::Clipped => numbers::PRIMITIVE_DEPTHS_CLIPPED,
            Depths::Corners => numbers::PRIMITIVE_DEPTHS_CORNERS,
        };
        let march = match self.march {
            March::Exact => numbers::PRIMITIVE_MARCH_EXACT,
            March::Jump => numbers::PRIMITIVE_MARCH_JUMP,
        };
        let pyramid = match self.pyramid_start {
            _ if !self.has_pyramid() => numbers::PRIMITIVE_PYRAMID_OFF,
            PyramidStart::Finest => numbers::PRIMITIVE_PYRAMID_FINEST,
            PyramidStart::Coarsest => numbers::PRIMITIVE_PYRAMID_COARSEST,
        };
        let views = match self.views {
            Views::Cube => numbers::PRIMITIVE_VIEWS_CUBE,
            Views::Camera => numbers::PRIMITIVE_VIEWS_CAMERA,
        };
        let centre = match self.centre() {
            Centre::Eye => numbers::PRIMITIVE_CENTRE_EYE,
            Centre::Scene => numbers::PRIMITIVE_CENTRE_SCENE,
            Centre::Fixed => numbers::PRIMITIVE_CENTRE_FIXED,
        };
        vec![
            (ids::PRIMITIVE_BUCKETS, self.buckets),
            (ids::PRIMITIVE_STORAGE, storage),
            (ids::PRIMITIVE_COVERAGE, coverage),
            (ids::PRIMITIVE_SKIP, u32::from(self.skip)),
            (ids::PRIMITIVE_PYRAMID, pyramid),
            (ids::PRIMITIVE_ACCEPT, accept),
            (ids::PRIMITIVE_STOP, stop),
            (ids::PRIMITIVE_DEPTHS, depths),
            (ids::PRIMITIVE_MARCH, march),
            (ids::PRIMITIVE_CENTRE, centre),
            (ids::PRIMITIVE_VIEWS, views),
        ]
    }

    /// Returns the options as pairs of name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let switch = |on| if on { "on" } else { "off" }.to_owned();
        vec![
            ("storage", self.storage.name().to_owned()),
            ("resolution", self.resolution.to_string()),
            ("tile", self.tile.to_string()),
            ("buckets", self.buckets.to_string()),
            ("pyramid", switch(self.has_pyramid())),
            ("pyramid-start", self.pyramid_start.name().to_owned()),
            ("coverage", self.coverage.name().to_owned()),
            ("accept", self.accept.name().to_owned()),
            ("stop", self.stop.name().to_owned()),
            ("depths", self.depths.name().to_owned()),
            ("march", self.march.name().to_owned()),
            ("skip", switch(self.skip)),
            ("centre", self.centre().name().to_owned()),
            ("views", self.views.name().to_owned()),
        ]
    }

    /// Returns the chosen code paths as pairs of name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        vec![("builder", self.builder.name().to_owned()), ("addressing", self.addressing.name().to_owned())]
    }
}
