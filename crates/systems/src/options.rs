//! All options that a system may have, as data: purpose, values, and whether an option may change a hit. The
//! command line, its help, the page of options and the tests of invariance are made from these rows. The file
//! of a system says which options the system has, and how it sets them.

use rasray_options::{Least, OptionRow, Unit, Values};

use crate::structure_option::{Group, Hits, StructureOption, of, row, switch, trying, words};

/// Maximum number of cells along a side of a view.
pub const VIEW_LIMIT: u32 = 8192;

use Group::{Diagnostic, Limit, Method, Size, Speed};
use Hits::{MayChange, Same, SameForTriangles, SameWithoutLoss};

/// All options, in the order of help.
pub const OPTIONS: &[StructureOption] = &[
    row(
        "resolution",
        Size,
        SameForTriangles,
        Values::Whole(1, VIEW_LIMIT),
        &["12", "37"],
        "Cells along each side of a view",
    ),
    row(
        "camera-resolution",
        Size,
        SameForTriangles,
        Values::Cells(VIEW_LIMIT),
        &["12", "37"],
        "With a camera among `views`: columns and rows of its view, or one number for both; as `resolution` if \
         not given",
    ),
    row(
        "grid",
        Size,
        SameForTriangles,
        Values::Whole(1, 1024),
        &["8", "24"],
        "Cells along the longest side of the scene or, with `views` cube, columns along each side of a face, by its \
         triangles if not given; voxels along each side of its cube, balanced with `resolution` if not given",
    ),
    row(
        "tile",
        Size,
        SameForTriangles,
        Values::Whole(1, 64),
        &["1", "2", "4", "8"],
        "Pixels along each side of a tile: lists are kept per tile",
    ),
    row(
        "buckets",
        Size,
        SameWithoutLoss,
        Values::Whole(1, 64),
        &["1", "2", "8", "12", "32", "64"],
        "Depth buckets per cell; of mmrt up to 32, and with `storage` llb, dllb or paged alone",
    ),
    row(
        "slices",
        Size,
        SameForTriangles,
        Values::Whole(1, 1024),
        &["8", "64"],
        "Bricks with `views` cube: depth slices, the same for all columns",
    ),
    row(
        "block",
        Size,
        Same,
        Values::Cells(64),
        &["1", "4", "64", "16x2"],
        "Columns and rows of a block of cells, or one number for both: powers of two",
    ),
    row(
        "divisions",
        Size,
        SameForTriangles,
        Values::Whole(0, 3),
        &["0", "1", "2"],
        "Bricks along the axes: maximum number of times that a cell that lists many small triangles is divided into \
         4x4x4 smaller ones",
    ),
    row("levels", Size, Same, Values::Whole(1, 2), &["1", "2"], "Levels of blocks of cells"),
    trying(
        // A camera's view needs a camera, which the scenes of the invariance tests lack.
        &["cube", "axes"],
        words(
            "views",
            Method,
            SameForTriangles,
            &[
                ("cube", "Six faces around the centre"),
                ("cube+camera", "Six faces around the centre, and the camera's view with cells of its own"),
                ("camera", "The camera's view alone"),
                (
                    "axes",
                    "Three along the axes, whatever the eye; for bricks one box of cells that serves all three",
                ),
            ],
            "Projections that are drawn",
        ),
    ),
    words(
        "view-switching",
        Method,
        MayChange,
        &[
            ("exact", "At the side of a view; every view that sees a part of the ray is searched over it"),
            (
                "snap",
                "From half a cell inside of a view to half a cell outside; each part of the ray is searched in one view at \
                 most",
            ),
        ],
        "Point at which a ray passes from one view to the next",
    ),
    words(
        "storage",
        Method,
        Same,
        &[
            ("ll", "One linked list per cell"),
            ("dll", "One doubly linked list per cell"),
            ("llb", "Linked list per depth bucket"),
            ("dllb", "Doubly linked list per depth bucket"),
            ("sb", "Contiguous, counted first"),
            ("paged", "Linked pages of several entries"),
        ],
        "List storage of a cell's fragments or triangles",
    ),
    of(
        OptionRow {
            off_name: Some("decoupled"),
            ..OptionRow::switch(
                "inline",
                "Keep the payload of a fragment within its list [opposite: `decoupled`]",
            )
        },
        Method,
        Same,
    ),
    row(
        "page",
        Method,
        Same,
        Values::Whole(1, 8),
        &["1", "2", "4", "8"],
        "With `storage` paged: fragments per page; of mmrt a power of two",
    ),
    trying(
        // Attributes and normals come from a scene, which plain triangles lack.
        &["index", "plane"],
        words(
            "payload",
            Method,
            SameForTriangles,
            &[
                ("index", "The primitive's index"),
                ("attributes", "Surface attributes, quantised as published"),
                ("normal", "The shading normal alone, quantised as published for ambient occlusion"),
                ("plane", "The plane of its triangle in full, without surface attributes"),
            ],
            "Data that a fragment carries",
        ),
    ),
    trying(
        // Few devices rasterize conservatively.
        &["exact", "conservative", "edge-on", "hardware"],
        words(
            "coverage",
            Method,
            MayChange,
            &[
                ("exact", "Those whose centre is inside, decided by the shared function"),
                (
                    "conservative",
                    "Every cell it reaches into; with fragments, where no fragment represents it",
                ),
                ("edge-on", "As conservative, for triangles that no cell keeps or that are seen edge-on"),
                ("hardware", "Those that the rasterizer covers"),
                (
                    "conservative-extension",
                    "As conservative, where VK_EXT_conservative_rasterization touches them",
                ),
            ],
            "Cells that keep a triangle",
        ),
    ),
    words(
        "accept",
        Method,
        MayChange,
        &[
            ("interval", "Its depth lies in the ray's half-open depth interval in the cell"),
            ("thickness", "As interval, with a thickness behind the fragment"),
            ("tolerance", "Its depth is within a fixed tolerance of the ray's depths in the cell"),
            (
                "slope",
                "The depths that its triangle takes within the cell overlap those of the ray; needs the payload index",
            ),
            (
                "plane",
                "The ray intersects the plane of its triangle within the cell; needs the payload index or plane",
            ),
            (
                "triangle",
                "The ray intersects its triangle, wherever that is; needs the coverage conservative",
            ),
            (
                "parity",
                "An odd number of fragments lies before one point of the ray, and an even number before the next",
            ),
            ("t", "Triangles: by t alone"),
            ("tile", "Triangles: where the point lies in the tile that listed it"),
        ],
        "Condition under which an entry is a hit",
    ),
    row(
        "thickness",
        Method,
        MayChange,
        Values::Number(Unit::Metres, Least::Zero),
        &["0.5"],
        "With `accept` thickness: metres behind a fragment that count as its inside",
    ),
    row(
        "tolerance",
        Method,
        MayChange,
        Values::Number(Unit::Share, Least::Zero),
        &["0.01"],
        "With `accept` tolerance: maximum distance of a fragment from the ray along a view, a share of the cube's side",
    ),
    words(
        "inside",
        Method,
        MayChange,
        &[
            ("column", "All that lie before it in its cell"),
            ("voxel", "Those of them at the depths of the voxel"),
        ],
        "With `accept` parity: fragments that decide whether a point is inside",
    ),
    words(
        "ends",
        Method,
        MayChange,
        &[
            ("touching", "They count like all others"),
            (
                "clear",
                "A ray starts beyond those of the triangle that it leaves, and those where it ends do not count",
            ),
        ],
        "With `accept` tolerance, slope or parity, or `leaves` voxels: fragments as close to an end of the ray as the surface there",
    ),
    words(
        "march",
        Method,
        MayChange,
        &[
            ("samples", "A fixed number of samples along the ray"),
            ("dda", "One step per cell of the longer axis"),
            ("exact", "Every cell that the ray crosses"),
            ("pyramid", "As exact, skipping blocks of cells that hold nothing at the ray's depths"),
            ("jump", "To half a pixel beyond the point where the ray leaves a tile"),
        ],
        "Stepping of a ray through cells",
    ),
    row(
        "samples",
        Method,
        MayChange,
        Values::Whole(1, 65_535),
        &["5"],
        "With `march` samples: maximum samples per face, or steps per voxel",
    ),
    switch(
        "jitter",
        Method,
        MayChange,
        "With `march` samples: where steps are longer than a cell, each ray samples them at an offset of its own",
    ),
    words(
        "stop",
        Method,
        MayChange,
        &[("best", "At buckets behind the best hit"), ("bucket", "After the first bucket with a hit")],
        "Lists of triangles: end of the search of a tile",
    ),
    words(
        "depths",
        Method,
        MayChange,
        &[
            ("clipped", "Those of its part in the tile"),
            ("corners", "Those of its plane at the corners of the tile"),
        ],
        "Lists of triangles: depths of a triangle in a tile",
    ),
    words(
        "depth",
        Method,
        MayChange,
        &[("16", "A half, as a share of the cube's side"), ("32", "A float")],
        "Format of a fragment's depth",
    ),
    words(
        "centre",
        Method,
        SameWithoutLoss,
        &[
            ("eye", "At the eye"),
            ("scene", "At the eye within the scene; for an eye outside, within the middle of the scene"),
            (
                "fixed",
                "Within the middle of the scene wherever the eye is, so that a camera that moves builds nothing",
            ),
        ],
        "Lists of triangles: the centre from which the faces of the cube are seen",
    ),
    words(
        "axes",
        Method,
        SameForTriangles,
        &[
            ("all", "All; a voxel is searched along the axis of its averaged normal"),
            ("voxel", "The one along the axis of its voxel's averaged normal"),
            (
                "triangle",
                "The one that its triangle faces most; a voxel is searched along the axes of all its triangles",
            ),
        ],
        "Views along the axes that keep a fragment",
    ),
    words(
        "voxels",
        Method,
        SameForTriangles,
        &[("fragments", "The fragments in it"), ("triangles", "The triangles that reach into it")],
        "Contents that make a voxel occupied; by default fragments with `axes` all, else triangles",
    ),
    words(
        "leaves",
        Method,
        MayChange,
        &[
            ("fragments", "Its fragments, which the views keep"),
            ("voxels", "The voxel itself, where the ray enters it; there are no views and no fragments"),
        ],
        "Surface that a ray hits in an occupied voxel",
    ),
    words(
        "build",
        Method,
        Same,
        &[("single", "All in one pass, then sorted"), ("peel", "One after the other, by depth peeling")],
        "Method that makes the layers of a depth cube",
    ),
    switch("single-layer", Method, MayChange, "Keep only the nearest fragments of each cell"),
    words(
        "builder",
        Speed,
        Same,
        &[
            ("sah", "A tree by the surface area heuristic, on the host"),
            ("lbvh", "A tree by Morton codes, on the device"),
            ("ploc", "Clusters of triangles merge with near ones by surface area, on the device"),
            ("trbvh", "The tree of lbvh, then its treelets are restructured by surface area, on the device"),
            (
                "refit",
                "The tree of ploc with four children per node, kept while it stays good: then builds only compute boxes",
            ),
            ("raster", "Cells, by drawing"),
            ("binning", "Cells, by computing"),
        ],
        "Algorithm that builds the structure",
    ),
    words(
        "geometry-passes",
        Speed,
        Same,
        &[
            ("1", "Once; the view of a triangle is chosen as it is drawn"),
            ("3", "Once for each view along the axes, which leaves out the triangles of the others"),
        ],
        "Draws of the scene by a pass of the build, with `builder` raster",
    ),
    words(
        "children",
        Speed,
        Same,
        &[("2", "Two"), ("4", "Four, tested together")],
        "Children per node of the tree: 2 with `builder` lbvh unless given, 4 with the others",
    ),
    row(
        "leaf",
        Speed,
        Same,
        Values::Whole(1, 16),
        &["1", "16"],
        "Maximum triangles per leaf: 4 with `builder` sah unless given, and with ploc and refit where nodes have four children; 1 with the others",
    ),
    switch("sort", Speed, Same, "Sort the fragments of a cell by depth"),
    switch("skip", Speed, SameWithoutLoss, "Skip empty space"),
    switch(
        "pyramid",
        Speed,
        SameWithoutLoss,
        "Lists of triangles: skip blocks of tiles by their depth bounds",
    ),
    words(
        "pyramid-start",
        Speed,
        SameWithoutLoss,
        &[
            ("finest", "The finest, then coarser ones until one holds something"),
            ("coarsest", "The coarsest, then finer ones until one holds nothing"),
        ],
        "With `pyramid`: the blocks that a ray compares its depths with first",
    ),
    words(
        "bounds",
        Speed,
        Same,
        &[
            ("geometry", "The fragments that it will have: all triangles are drawn once more"),
            ("boxes", "The boxes around objects that are over it: a box is drawn in place of its triangles"),
        ],
        "Lists by depth bucket: contents that a cell's range of depths encloses",
    ),
    words(
        "occupancy",
        Speed,
        Same,
        &[
            ("bounds", "The smallest and the largest"),
            (
                "slices",
                "The smallest and the largest, and a bit for each of 64 slices of depth that holds something",
            ),
        ],
        "Record of the depths in a block of cells",
    ),
    words(
        "traversal",
        Speed,
        Same,
        &[
            ("dda", "One after the other"),
            ("octree", "As dda, over the empty nodes of a sparse octree, which is built from the voxels"),
        ],
        "Stepping of a ray from voxel to voxel",
    ),
    words(
        "goal",
        Speed,
        Same,
        &[("trace", "Rays"), ("build", "Builds")],
        "Work that the driver's tree is to be fast for",
    ),
    switch("corners", Speed, Same, "Keep a contiguous copy of triangles' corners"),
    words(
        "addressing",
        Speed,
        Same,
        &[("descriptor", "Storage buffers in a descriptor set"), ("address", "64-bit device addresses")],
        "Access of shaders to the structure's memory",
    ),
    row(
        "layers",
        Limit,
        Same,
        Values::Whole(1, 1024),
        &["256", "1024"],
        "With `build` peel: maximum layers; a scene with more is an error",
    ),
    row(
        "capacity",
        Limit,
        // The option changes a capacity, not the stored data: a capacity that is too small grows.
        Same,
        Values::Whole(0, u32::MAX),
        &["0", "1", "1000"],
        "Initial capacity, fragments or list entries; it grows when it is too small",
    ),
    switch(
        "ids",
        Diagnostic,
        // The option changes only the primitive that a hit reports.
        MayChange,
        "Keep triangles next to payloads without them, so that hits report them",
    ),
];

/// Returns the option with this name.
pub fn option(name: &str) -> Option<&'static StructureOption> {
    OPTIONS.iter().find(|option| option.row.name == name)
}
