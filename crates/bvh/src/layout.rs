//! Sizes of the pools, and the items that passes of a build work on, by plain arithmetic without a device.

use rasray_ads::kit::Scan;
use rasray_ads::{AdsError, Sizes};
use rasray_shaders_glsl::constants::ads::BUILD_GROUP_SIZE;
use rasray_shaders_glsl::constants::bvh::{
    BVH_CLUSTER_WORDS, BVH_CLUSTERS, BVH_CLUSTERS_KEPT, BVH_DIGIT_VALUES, BVH_LEAF_SHIFT, BVH_SORT_CHUNK,
    BVH_TREELET, BVH_TREELET_CLASSES, BVH_TREELET_ROUNDS, BVH_UNION,
};

use crate::{Builder, Children, Config, Node, NodeOfFour, Pool, Record};

/// Name of the structure in errors.
pub(crate) const NAME: &str = "bvh";

/// Words of a triangle's box in the scratch pool of a build on the host. The boxes come before the order of
/// the leaves.
pub(crate) const BOX_WORDS: u64 = 6;

/// Words behind the clusters of a tree that later builds may keep: with them the begins of levels fit
/// (levels.glsl).
const LEVELS_WORDS: u64 = 2;

// Parts of the scratch pool are used again. The numbers of chains take the place of the counts of a chunk's
// digits. The sizes and chains of all classes, fewer than two words per triangle, take the place of the keys,
// which had four. The list of nodes of four takes the place of all counts.
const _: () = assert!(BVH_TREELET_ROUNDS * BVH_TREELET_CLASSES <= BVH_DIGIT_VALUES && BVH_TREELET > 1);
const _: () = assert!(BVH_SORT_CHUNK <= BVH_DIGIT_VALUES);
const _: () = assert!(size_of::<Node>() == size_of::<NodeOfFour>());
// Each invocation has an equal number of clusters, and merging has to make fewer of them.
const _: () = assert!(BVH_CLUSTERS.is_multiple_of(BUILD_GROUP_SIZE) && BVH_CLUSTERS_KEPT < BVH_CLUSTERS);

/// Returns the words of the scratch pool.
fn scratch_words(builder: Builder, triangles: u64) -> u64 {
    match builder {
        Builder::Sah => (BOX_WORDS + 1) * triangles,
        Builder::Lbvh | Builder::Ploc | Builder::Trbvh | Builder::Refit => {
            let counts = digit_counts(triangles);
            let boxes = match builder {
                Builder::Ploc => u64::from(BVH_CLUSTER_WORDS) * triangles,
                Builder::Refit => u64::from(BVH_CLUSTER_WORDS) * triangles + LEVELS_WORDS,
                _ => 6 * unions(triangles),
            };
            4 * triangles + counts + Scan::sums(counts) + boxes
        }
    }
}

/// Returns the number of chunks in which the device sorts keys.
pub(crate) fn sort_chunks(triangles: u64) -> u64 {
    triangles.div_ceil(BVH_SORT_CHUNK.into())
}

/// Returns how many keys of each chunk have each value of a digit: the number of these counts.
pub(crate) fn digit_counts(triangles: u64) -> u64 {
    u64::from(BVH_DIGIT_VALUES) * sort_chunks(triangles)
}

/// Returns the classes of subtrees from `first` on that a tree may have, each with its greatest number of
/// chains: at most half as many as the class before.
pub(crate) fn treelet_classes(triangles: u32, first: u32) -> impl Iterator<Item = (u32, u32)> {
    (first..BVH_TREELET_CLASSES)
        .map(move |class| (class, (triangles / BVH_TREELET).checked_shr(class).unwrap_or(0)))
        .take_while(|(_, chains)| *chains > 0)
}

/// Returns the number of boxes in each level of unions above the triangles, up to the level with a single
/// box.
pub(crate) fn union_levels(triangles: u64) -> impl Iterator<Item = u64> {
    let above = |count: &u64| (*count > 1).then(|| count.div_ceil(BVH_UNION.into()));
    std::iter::successors(Some(triangles), above).skip(1)
}

fn unions(triangles: u64) -> u64 {
    union_levels(triangles).sum()
}

/// Returns the number of clusters with which each level of merging begins. The first level begins with the
/// records.
pub(crate) fn cluster_levels(triangles: u64) -> impl Iterator<Item = u64> {
    let (merged, kept) = (u64::from(BVH_CLUSTERS), u64::from(BVH_CLUSTERS_KEPT));
    let above =
        move |count: &u64| (*count > merged).then(|| kept * (count / merged) + (count % merged).min(kept));
    std::iter::successors(Some(triangles), above)
}

/// Returns the maximum number of inner nodes of a tree over `triangles` triangles. With two children per node
/// there is one fewer than there are leaves. A node of four that has fewer children has leaves only: with w
/// nodes of four children and v others, of two leaves at least, 4 w + 2 v children and w + v - 1 of them
/// nodes leave at most (2 n - 1) / 3 nodes.
pub(crate) fn most_nodes(children: Children, triangles: u64) -> u64 {
    match children {
        Children::Two => triangles.saturating_sub(1),
        Children::Four => (2 * triangles).saturating_sub(1) / 3,
    }
}

/// Returns the number of invocations that compute the boxes of a level of a kept tree with this many nodes of
/// four children: about as many as such a level has nodes.
pub(crate) fn level_invocations(level: u32, nodes: u32) -> u32 {
    nodes.checked_shr(level).unwrap_or(0).max(1)
}

/// Returns the number of nodes of two children from which the device makes nodes of four. They lie behind the
/// tree in the pool of nodes, and are as large.
pub(crate) fn pair_elements(config: &Config, triangles: u64) -> u64 {
    match (config.made_children(), config.builder) {
        (Children::Two, _) | (_, Builder::Sah) => 0,
        (Children::Four, Builder::Lbvh | Builder::Ploc | Builder::Trbvh | Builder::Refit) => {
            most_nodes(Children::Two, triangles)
        }
    }
}

/// Returns the sizes of the pools of a tree over `triangles` triangles.
///
/// # Errors
/// An option is out of range, or there are more triangles than a leaf's 27 bits can address.
pub fn plan(config: &Config, triangles: u64) -> Result<Sizes, AdsError> {
    config.validate()?;
    let limit = (1 << BVH_LEAF_SHIFT) - 1;
    if triangles > limit {
        return Err(AdsError::PoolTooLarge { structure: NAME, pool: "records", elements: triangles, limit });
    }
    let nodes = most_nodes(config.made_children(), triangles) + pair_elements(config, triangles);
    let pool = |pool, elements, bytes: usize| (pool, elements, bytes as u64);
    Sizes::of(
        NAME,
        [
            pool(Pool::Nodes, nodes, config.made_children().node_bytes()),
            pool(Pool::Records, triangles, size_of::<Record>()),
            pool(Pool::Scratch, scratch_words(config.builder, triangles), size_of::<u32>()),
        ],
    )
}

/// Bytes of a tree by the formula of `docs/systems/bvh.md`, for counted nodes and triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Bytes that traces read: header 112, 64 per node, 40 per triangle.
    pub traced: u64,
    /// Bytes that only the build uses. With [`Builder::Sah`] 28 per triangle. With the others 16 per
    /// triangle, 1024 for every 256 triangles, 4 for every 1024 triangles, and 24 per union of four boxes
    /// (including unions of unions), each rounded up, or with [`Builder::Ploc`] and [`Builder::Refit`] in
    /// place of the unions 28 per triangle, and 8 more with the latter; and for nodes of four 64 per triangle
    /// after the first.
    pub scratch: u64,
}

impl FormulaBytes {
    /// Returns the sum of both parts.
    pub fn total(&self) -> u64 {
        self.traced + self.scratch
    }
}

/// Computes the bytes by the formula of `docs/systems/bvh.md`. It shares no code with [`plan`], so that the
/// two check each other.
pub fn formula_bytes(config: &Config, nodes: u64, triangles: u64) -> FormulaBytes {
    let scratch = match config.builder {
        Builder::Sah => 28 * triangles,
        Builder::Lbvh | Builder::Ploc | Builder::Trbvh | Builder::Refit => {
            let (mut unions, mut level) = (0, triangles);
            while level > 1 {
                level = level.div_ceil(4);
                unions += level;
            }
            let boxes = match config.builder {
                Builder::Ploc => 28 * triangles,
                Builder::Refit => 28 * triangles + 8,
                _ => 24 * unions,
            };
            let chunks = triangles.div_ceil(256);
            let pairs = match config.made_children() {
                Children::Four => 64 * (triangles.max(1) - 1),
                Children::Two => 0,
            };
            pairs + 16 * triangles + 1024 * chunks + 4 * chunks.div_ceil(4) + boxes
        }
    };
    FormulaBytes { traced: 112 + 64 * nodes + 40 * triangles, scratch }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_equals_formula() {
        let kinds =
            [Builder::Sah, Builder::Lbvh, Builder::Ploc, Builder::Trbvh, Builder::Refit].map(Config::new);
        let numbers = |config| {
            let made =
                [Children::Two, Children::Four].map(|children| Config { children: Some(children), ..config });
            made.into_iter().filter(|config: &Config| {
                config.builder != Builder::Refit || config.made_children() == Children::Four
            })
        };
        for config in kinds.into_iter().flat_map(numbers) {
            for triangles in [1_u64, 2, 255, 256, 257, 12_345, 300_000] {
                let sizes = plan(&config, triangles).expect("options are in range");
                let nodes = most_nodes(config.made_children(), triangles);
                assert_eq!(
                    sizes.bytes(),
                    formula_bytes(&config, nodes, triangles).total(),
                    "{config:?} {triangles}"
                );
                assert_ne!(sizes.bytes(), formula_bytes(&config, nodes + 1, triangles).total());
            }
        }
    }

    /// Subtrees of a class have at least twice as many records as those of the class before, and chains are
    /// disjoint.
    #[test]
    fn classes_of_treelets_have_half_as_many_chains_each() {
        let chains = |triangles, first| treelet_classes(triangles, first).collect::<Vec<_>>();
        assert_eq!(chains(BVH_TREELET - 1, 0), []);
        assert_eq!(chains(BVH_TREELET, 0), [(0, 1)]);
        assert_eq!(chains(BVH_TREELET, 1), []);
        assert_eq!(chains(5 * BVH_TREELET, 0), [(0, 5), (1, 2), (2, 1)]);
        assert_eq!(chains(5 * BVH_TREELET, 1), [(1, 2), (2, 1)]);
        let most = (1 << BVH_LEAF_SHIFT) - 1;
        assert_eq!(treelet_classes(most, 0).last(), Some((24, 1)), "fewer than {BVH_TREELET_CLASSES}");
    }

    #[test]
    fn every_chunk_counts_every_value_of_a_digit() {
        let chunk = u64::from(BVH_SORT_CHUNK);
        assert_eq!([0, 1, chunk, chunk + 1].map(sort_chunks), [0, 1, 1, 2]);
        assert_eq!(digit_counts(chunk + 1), 2 * u64::from(BVH_DIGIT_VALUES));
    }

    #[test]
    fn what_cannot_be_named_is_refused() {
        let config = Config::new(Builder::Sah);
        assert!(plan(&config, 0).is_ok());
        assert!(plan(&config, 1 << 27).expect_err("it is refused").to_string().contains("records"));
        let refused = |config| plan(&config, 1).expect_err("the option is out of range").to_string();
        assert!(refused(Config { leaf: Some(17), ..config }).contains("leaf is 17"));
        assert!(refused(Config { leaf: Some(0), ..config }).contains("leaf is 0"));
        assert!(refused(Config { work_budget: Some(0), ..config }).contains("work budget"));
        let of_two = Config { children: Some(Children::Two), ..Config::new(Builder::Refit) };
        assert!(refused(of_two).contains("children is 2"));
        assert!(plan(&Config::new(Builder::Refit), 1).is_ok());
        for builder in [Builder::Lbvh, Builder::Ploc, Builder::Trbvh] {
            let config = Config::new(builder);
            // The options that such a tree has may also be given.
            assert!(plan(&Config { children: Some(Children::Two), leaf: Some(1), ..config }, 1).is_ok());
            let two = Config { children: Some(Children::Two), ..config };
            let leaf = refused(Config { leaf: Some(4), ..two });
            assert!(leaf.contains("leaf is 4") && leaf.contains("builder `sah`"), "{leaf}");
        }
    }
}
