//! Files that loaders must refuse with a typed error, and similar files that they must read.

use super::catalogue::{Targets, catalogue_row};
use super::gltf_text::GltfText;
use rasray_scene::{Scene, SceneError};

/// Scene file with the required outcome of loading it.
#[derive(Clone, Debug)]
pub struct HardFile {
    /// Short and unique id: the catalogue's number with a variant.
    pub id: &'static str,
    /// One line that describes the file.
    pub title: &'static str,
    /// Name of the measured quantity.
    pub measure: &'static str,
    /// Demands on each kind of structure.
    pub target: Targets,
    /// File name, whose extension tells the format.
    pub name: &'static str,
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Required outcome of loading.
    pub loading: Loading,
}

/// Required outcome of loading a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loading {
    /// An error of this kind; the command ends with exit code 2.
    Refused(Refusal),
    /// A scene of so many triangles, with a warning of this kind if one is given.
    Read {
        /// Number of triangles of all instances.
        triangles: usize,
        /// Kind of the only warning.
        warning: Option<&'static str>,
    },
}

/// Reason why a loader refuses a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// A triangle refers to a vertex that does not exist.
    IndexOutOfRange,
    /// The file contradicts itself.
    Invalid,
    /// A limit is exceeded.
    TooLarge,
}

impl Loading {
    /// True if loading had this outcome.
    pub fn describes(self, loaded: &Result<Scene, SceneError>) -> bool {
        match (self, loaded) {
            (Self::Refused(refusal), Err(error)) => match refusal {
                Refusal::IndexOutOfRange => matches!(error, SceneError::IndexOutOfRange { .. }),
                Refusal::Invalid => matches!(error, SceneError::Invalid { .. }),
                Refusal::TooLarge => matches!(error, SceneError::TooLarge { .. }),
            },
            (Self::Read { triangles, warning }, Ok(scene)) => {
                let placed = |mesh: usize| scene.meshes[mesh].triangle_count();
                let count: usize = scene.instances.iter().map(|instance| placed(instance.mesh)).sum();
                count == triangles
                    && scene.warnings.iter().map(|warning| warning.kind).eq(warning.iter().copied())
            }
            _ => false,
        }
    }
}

struct Entry {
    id: &'static str,
    title: &'static str,
    name: &'static str,
    text: fn() -> String,
    loading: Loading,
}

const fn refused(
    id: &'static str,
    title: &'static str,
    name: &'static str,
    text: fn() -> String,
    refusal: Refusal,
) -> Entry {
    Entry { id, title, name, text, loading: Loading::Refused(refusal) }
}

const fn read(
    id: &'static str,
    title: &'static str,
    text: fn() -> String,
    triangles: usize,
    warning: Option<&'static str>,
) -> Entry {
    Entry { id, title, name: "file.gltf", text, loading: Loading::Read { triangles, warning } }
}

const GLTF: &str = "file.gltf";
const OBJ: &str = "file.obj";

const FILES: &[Entry] = &[
    refused(
        "C6-end",
        "index equal to the number of vertices",
        GLTF,
        || indexed(&[0, 1, 3]),
        Refusal::IndexOutOfRange,
    ),
    refused("C6-beyond", "index one beyond that", GLTF, || indexed(&[0, 4, 2]), Refusal::IndexOutOfRange),
    refused(
        "C6-greatest",
        "greatest index that 32 bits hold",
        GLTF,
        || indexed(&[u32::MAX, 1, 2]),
        Refusal::IndexOutOfRange,
    ),
    refused(
        "C6-incomplete",
        "indices that make no whole triangles",
        GLTF,
        || indexed(&[0, 1, 2, 0]),
        Refusal::Invalid,
    ),
    refused(
        "C6-obj-end",
        "OBJ face that names one vertex too many",
        OBJ,
        || obj("1 2 4"),
        Refusal::IndexOutOfRange,
    ),
    refused(
        "C6-obj-greatest",
        "OBJ face that names the greatest vertex of 32 bits",
        OBJ,
        || obj("1 2 4294967295"),
        Refusal::IndexOutOfRange,
    ),
    refused(
        "C6-obj-zero",
        "OBJ face that names vertex 0, which there is none of",
        OBJ,
        || obj("0 1 2"),
        Refusal::Invalid,
    ),
    refused(
        "C6-obj-before",
        "OBJ face that counts back beyond the first vertex",
        OBJ,
        || obj("-1 -2 -4"),
        Refusal::Invalid,
    ),
    refused(
        "C6-strip-end",
        "strip with an index equal to the number of vertices",
        GLTF,
        || drawn(5, &[0, 1, 2, 3]),
        Refusal::IndexOutOfRange,
    ),
    read("C6-strip", "strip", || drawn(5, &[0, 1, 2, 1]), 2, Some("degenerate-triangles")),
    read("C6-fan", "fan", || drawn(6, &[0, 1, 2]), 1, None),
    read("C6-points", "points", || drawn(0, &[0, 1, 2]), 0, Some("points")),
    read("C6-lines", "lines", || drawn(1, &[0, 1]), 0, Some("lines")),
    refused(
        "T5-self",
        "node that is its own child",
        GLTF,
        || nodes(r#"[{"mesh":0,"children":[0]}]"#.into()),
        Refusal::Invalid,
    ),
    refused(
        "T5-cycle",
        "three nodes in a cycle",
        GLTF,
        || nodes(r#"[{"children":[1]},{"children":[2]},{"mesh":0,"children":[0]}]"#.into()),
        Refusal::Invalid,
    ),
    refused(
        "T5-two-parents",
        "node with two parents",
        GLTF,
        || nodes(r#"[{"children":[2]},{"children":[2]},{"mesh":0}]"#.into()),
        Refusal::Invalid,
    ),
    refused("T5-deep", "chain of 100,000 nodes", GLTF, || nodes(chain(100_000)), Refusal::TooLarge),
    read("T5-chain", "chain as long as the limit", || nodes(chain(512)), 1, None),
];

/// Iterates over the ids and titles of all files.
pub(super) fn titles() -> impl Iterator<Item = (&'static str, &'static str)> {
    FILES.iter().map(|entry| (entry.id, entry.title))
}

/// Returns the ids of all files.
pub fn file_ids() -> Vec<&'static str> {
    FILES.iter().map(|entry| entry.id).collect()
}

/// Iterates over all files, made one at a time.
pub fn files() -> impl Iterator<Item = HardFile> {
    FILES.iter().map(|entry| {
        let row = catalogue_row(entry.id).expect("a test looks every file up");
        HardFile {
            id: entry.id,
            title: entry.title,
            measure: row.measure,
            target: row.target,
            name: entry.name,
            bytes: (entry.text)().into_bytes(),
            loading: entry.loading,
        }
    })
}

fn indexed(indices: &[u32]) -> String {
    drawn(4, indices)
}

fn drawn(mode: u32, indices: &[u32]) -> String {
    GltfText { mode, indices: indices.to_vec(), ..GltfText::triangle() }.text()
}

fn nodes(nodes: String) -> String {
    GltfText { nodes, ..GltfText::triangle() }.text()
}

/// Makes a chain of nodes; the last one shows the mesh.
fn chain(length: usize) -> String {
    let mut nodes: Vec<String> = (1..length).map(|child| format!(r#"{{"children":[{child}]}}"#)).collect();
    nodes.push(r#"{"mesh":0}"#.to_owned());
    format!("[{}]", nodes.join(","))
}

fn obj(face: &str) -> String {
    format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf {face}\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_scene_files::LoadOptions;

    /// Loads a file as the command does: from a folder, by extension.
    fn load(file: &HardFile) -> Result<Scene, SceneError> {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let path = folder.path().join(file.name);
        std::fs::write(&path, &file.bytes).expect("the file can be written");
        rasray_scene_files::load(&path, &LoadOptions::default())
    }

    #[test]
    fn every_file_is_refused_or_read_as_stated() {
        for file in files() {
            let loaded = load(&file);
            assert!(
                file.loading.describes(&loaded),
                "{} ({}): {:?} is stated, {:?} came",
                file.id,
                file.title,
                file.loading,
                loaded.map(|scene| (scene.instances.len(), scene.warnings))
            );
        }
    }

    #[test]
    fn another_statement_is_noticed() {
        let stated = [
            Loading::Refused(Refusal::IndexOutOfRange),
            Loading::Refused(Refusal::Invalid),
            Loading::Refused(Refusal::TooLarge),
            Loading::Read { triangles: 1, warning: None },
        ];
        for file in files().filter(|file| stated.contains(&file.loading)) {
            let loaded = load(&file);
            for statement in stated {
                assert_eq!(statement.describes(&loaded), statement == file.loading, "{}", file.id);
            }
        }
        // The file with its index in range is read.
        let repaired = GltfText::triangle().text();
        let loaded = rasray_scene_files::gltf::from_slice(
            "file.gltf".as_ref(),
            repaired.as_bytes(),
            &LoadOptions::default(),
        );
        assert!(Loading::Read { triangles: 1, warning: None }.describes(&loaded));
        let mut ids = file_ids();
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| pair[0] != pair[1]));
    }
}
