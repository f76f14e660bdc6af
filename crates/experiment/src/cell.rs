//! Comparison as a list of cells: each cell is one run, as plain data with a key.

use crate::hard_file::LOADER;
use crate::images::NOISE;
use crate::jobs::{CompareJob, FILE_SET, Frame};
use crate::key::{camera_text, scene_hash, texts};
use crate::system_config::SystemConfig;
use crate::traced_set::GIVEN;
use rasray_ads::StructureKind;
use rasray_hard_cases::{HardFile, Scale};
use rasray_ray_files::{HitsFile, Place, RaysFile, hits_to_npy, write_rays};
use rasray_report::{Cell, CellImage, CellRays, CellRecord, CellView};
use rasray_scene_source::{KeyHash, LoadedScene};
use std::ops::Range;

/// Computes the key of a cell's run: a hash of the program (`program`: version and commit) and of everything
/// that the run depends on, 64 hexadecimal digits. The key does not depend on the device, which a report
/// names.
pub fn cell_key(program: &str, cell: &Cell) -> String {
    let cell = serde_json::to_vec(cell).expect("strings, numbers and maps with string keys");
    KeyHash::default().with("program", program).with("cell", cell).finish()
}

/// Cells of a comparison in the order of its report. The cells of a group are measured together: a set of
/// rays, a hard case, or all images.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellList {
    records: Vec<CellRecord>,
    groups: Vec<Range<usize>>,
}

impl CellList {
    /// Makes the list of these groups for `program` (version and commit).
    pub fn new(program: &str, groups: impl IntoIterator<Item = Vec<Cell>>) -> Self {
        let record = |depends_on: Cell| CellRecord {
            key: cell_key(program, &depends_on),
            depends_on,
            ..CellRecord::default()
        };
        Self::of(groups.into_iter().map(|group| group.into_iter().map(record).collect()))
    }

    /// Makes the list of groups of records, whose places are those of this list.
    pub(crate) fn of(groups: impl IntoIterator<Item = Vec<CellRecord>>) -> Self {
        let mut list = Self::default();
        for group in groups {
            let first = list.records.len();
            list.records.extend(group);
            list.groups.push(first..list.records.len());
        }
        let hash = list.records.iter().fold(KeyHash::default(), |hash, record| {
            let hash = hash.with("cell", &record.key);
            record.campaign.iter().fold(hash, |hash, campaign| {
                hash.with("campaign", serde_json::to_vec(campaign).expect("strings and numbers"))
            })
        });
        let (key, cells) = (hash.finish(), list.records.len() as u32);
        for (place, record) in list.records.iter_mut().enumerate() {
            (record.place, record.cells, record.list) = (place as u32, cells, key.clone());
        }
        list
    }

    /// Returns the number of cells.
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// True if there are no cells.
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// Returns the places of the cells of each group.
    pub fn groups(&self) -> &[Range<usize>] {
        &self.groups
    }

    /// Returns the record of the cell at a place; `None` if there is none.
    pub fn record(&self, place: usize) -> Option<&CellRecord> {
        self.records.get(place)
    }
}

/// Lists the cells of a comparison on a scene: for each set of rays all systems and files of hits, then all
/// images and the reference with another seed. Places are those of [`CompareJob::only`].
pub fn compare_cells(program: &str, loaded: &LoadedScene, job: &CompareJob<'_>) -> CellList {
    // This pattern makes whoever adds a field decide whether the field changes a run. `loaded` stands for the
    // scene.
    let CompareJob {
        scene: _,
        camera,
        systems,
        ray_sets,
        rays,
        frame,
        image,
        lists,
        // These fields change only the additional data that is kept.
        figures: _,
        keep: _,
        replay: _,
        repetitions,
        rays_file,
        hits_files,
        needs,
        only: _,
    } = job;
    let Frame { integrator, width, height, spp, adaptive, seed, sampler, primary, occluder, back_faces } =
        frame;
    let pose = loaded.pose.as_ref();
    let needed = needs.verdicts().iter().filter(|verdict| verdict.needed);
    let cell = Cell {
        scene: loaded.scene.name.clone(),
        content: scene_hash(KeyHash::default(), loaded).finish(),
        time_s: pose.map(|pose| pose.time_s),
        clips: pose.map(|pose| pose.clips.clone()).unwrap_or_default(),
        view: Some(CellView {
            camera: camera_text(camera),
            size: [*width, *height],
            back_faces: back_faces.name().to_owned(),
        }),
        needs: Some(needed.map(|verdict| verdict.term.name().to_owned()).collect()),
        seed: *seed,
        repetitions: *repetitions,
        ..Cell::default()
    };
    let drawn =
        ray_sets.iter().map(|set| CellRays { set: set.name().to_owned(), count: *rays, content: None });
    let sets = drawn.chain(rays_file.as_ref().map(rays_of_file));
    let mut groups: Vec<_> = sets
        .map(|rays| on_rays(&Cell { rays: Some(rays), lists: *lists, ..cell.clone() }, systems, hits_files))
        .collect();
    if *image {
        let image = CellImage {
            integrator: integrator.name().to_owned(),
            options: texts(&integrator.values()),
            spp: *spp,
            adaptive: adaptive.map(|rule| format!("{} {}", rule.threshold, rule.least)),
            sampler: sampler.name().to_owned(),
            primary: primary.name().to_owned(),
            occluder: occluder.name().to_owned(),
            shadow_resolution: occluder.resolution(),
            shadow_points: occluder.points(),
        };
        let cell = Cell { image: Some(image), ..cell };
        let noise = Cell { system: NOISE.0.to_owned(), preset: NOISE.1.to_owned(), ..cell.clone() };
        groups.push(systems.iter().map(|system| of_system(&cell, system)).chain([noise]).collect());
    }
    CellList::new(program, groups)
}

/// Subject of a hard case.
#[derive(Clone, Copy, Debug)]
pub enum HardSubject<'a> {
    /// Case of triangles and rays, by id.
    Rays(&'a str),
    /// Case that is a file.
    File(&'a HardFile),
}

/// Lists the cells of hard cases: for each case all systems and files of hits, whose places are those of
/// [`HardJob::only`](crate::HardJob::only); for a case that is a file the loader. `scale` sets the size of
/// the cases.
pub fn hard_cells<'a>(
    program: &str,
    cases: impl IntoIterator<Item = HardSubject<'a>>,
    systems: &[SystemConfig],
    hits_files: &[HitsFile],
    scale: Scale,
    repetitions: u32,
) -> CellList {
    let Scale { rays, seed, full } = scale;
    let group = |case: HardSubject<'_>| match case {
        HardSubject::Rays(id) => {
            let content = KeyHash::default().with("hard", id).with("full", [u8::from(full)]).finish();
            let rays = CellRays { set: id.to_owned(), count: rays as u32, content: None };
            let cell = Cell {
                scene: format!("hard:{id}"),
                content,
                rays: Some(rays),
                seed: seed as u32,
                repetitions,
                ..Cell::default()
            };
            on_rays(&cell, systems, hits_files)
        }
        HardSubject::File(file) => vec![Cell {
            scene: format!("hard:{}", file.id),
            content: KeyHash::default().with(file.name, &file.bytes).finish(),
            system: LOADER.0.to_owned(),
            preset: LOADER.1.to_owned(),
            ..Cell::default()
        }],
    };
    CellList::new(program, cases.into_iter().map(group))
}

/// Lists the cells of a set of rays.
fn on_rays(cell: &Cell, systems: &[SystemConfig], hits_files: &[HitsFile]) -> Vec<Cell> {
    let given = hits_files.iter().map(|file| Cell {
        system: file.name.clone(),
        preset: GIVEN.to_owned(),
        hits: Some(hash_of("hits", &file.hits, |hits| hits_to_npy(hits, StructureKind::Primitive)).finish()),
        ..cell.clone()
    });
    systems.iter().map(|system| of_system(cell, system)).chain(given).collect()
}

fn of_system(cell: &Cell, config: &SystemConfig) -> Cell {
    // The reason for the choice does not change a run.
    let SystemConfig { system, preset, options, variant, chosen: _ } = config;
    Cell {
        system: system.name.to_owned(),
        preset: preset.name().to_owned(),
        variant: variant.clone(),
        options: texts(options),
        ..cell.clone()
    }
}

fn rays_of_file(file: &RaysFile) -> CellRays {
    let (point, origins) = match &file.place {
        Place::Point(point) => (*point, &[][..]),
        Place::World(origins) => ([0.0; 3], &origins[..]),
    };
    let hash = hash_of("rays", &file.rays, |rays| write_rays(rays, point)).with(
        "origins",
        hash_of("origins", origins, |origins| {
            origins.iter().flatten().flat_map(|x| x.to_le_bytes()).collect()
        })
        .finish(),
    );
    CellRays { set: FILE_SET.to_owned(), count: file.rays.len() as u32, content: Some(hash.finish()) }
}

/// Hashes many values, of which only a part is in memory as bytes at a time.
fn hash_of<T>(name: &str, values: &[T], bytes: impl Fn(&[T]) -> Vec<u8>) -> KeyHash {
    values.chunks(HASHED).fold(KeyHash::default(), |hash, values| hash.with(name, bytes(values)))
}

/// Number of values that are hashed at a time.
const HASHED: usize = 1 << 16;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{IntegratorRow, OccluderKind, Primary, RaySet, Sampler, one_system};
    use rasray_ads::{Hit, Ray};
    use rasray_options::OptionValues;
    use rasray_scene::BackFaces;
    use rasray_scene::needs::Needs;
    use rasray_scene_source::{default_view, load};
    use rasray_systems::{Preset, System};
    use std::collections::BTreeSet;

    fn system(name: &str, options: OptionValues) -> SystemConfig {
        let system = System::named(name).expect("a system of the registry");
        one_system(system, Preset::Robust, &options).expect("valid")
    }

    fn hits(t: f32) -> HitsFile {
        HitsFile { name: "other".to_owned(), hits: vec![Hit { t, primitive: 1, a: 0.25, b: 0.5 }] }
    }

    fn rays(z: f32) -> RaysFile {
        RaysFile { rays: vec![Ray::new([0.0; 3], [0.0, 0.0, z])], place: Place::Point([0.0; 3]) }
    }

    fn job(loaded: &LoadedScene) -> CompareJob<'_> {
        CompareJob {
            scene: &loaded.scene,
            camera: default_view(&loaded.scene).camera,
            systems: vec![system("mmrt", OptionValues::default()), system("bvh", OptionValues::default())],
            ray_sets: vec![RaySet::Incoherent, RaySet::Camera],
            rays: 100,
            frame: Frame {
                integrator: IntegratorRow::named("path").expect("it is registered").into(),
                width: 4,
                height: 3,
                spp: 8,
                adaptive: None,
                seed: 1,
                sampler: Sampler::Sobol,
                primary: Primary::Trace,
                occluder: OccluderKind::Structure,
                back_faces: BackFaces::Camera,
            },
            image: true,
            figures: false,
            lists: false,
            repetitions: 2,
            rays_file: Some(rays(1.0)),
            hits_files: vec![hits(1.0)],
            keep: false,
            replay: None,
            needs: Needs::all(),
            only: None,
        }
    }

    #[test]
    fn a_comparison_is_a_list_of_cells_each_with_a_key_of_its_own() {
        let loaded = load("cornell".as_ref()).expect("built in");
        let list = compare_cells("1", &loaded, &job(&loaded));
        // The groups are three sets with two systems and a file each, then two images and the noise.
        assert_eq!(list.groups(), [0..3, 3..6, 6..9, 9..12]);
        let records: Vec<_> = (0..list.len()).map(|place| list.record(place).expect("a cell")).collect();
        let shape = |place: usize| {
            let Cell { system, rays, image, .. } = &records[place].depends_on;
            (system.as_str(), rays.as_ref().map(|rays| rays.set.as_str()), image.is_some())
        };
        assert_eq!(shape(0), ("mmrt", Some("incoherent"), false));
        assert_eq!(shape(5), ("other", Some("camera"), false));
        assert_eq!(shape(7), ("bvh", Some("file"), false));
        assert_eq!((shape(10), shape(11)), (("bvh", None, true), ("reference", None, true)));
        let keys: BTreeSet<_> = records.iter().map(|record| &record.key).collect();
        assert_eq!((keys.len(), list.record(12)), (12, None));
        assert_eq!(list, compare_cells("1", &loaded, &job(&loaded)));
        let text = serde_json::to_string(&records[9]).expect("plain data");
        assert_eq!(&serde_json::from_str::<CellRecord>(&text).expect("it reads back"), records[9]);
    }

    #[test]
    fn whatever_changes_a_run_changes_its_key_and_nothing_else_does() {
        type Change = dyn Fn(&mut CompareJob<'_>);
        let loaded = load("cornell".as_ref()).expect("built in");
        let keys = |change: &Change| -> Vec<String> {
            let mut job = job(&loaded);
            change(&mut job);
            let list = compare_cells("1", &loaded, &job);
            (0..list.len()).map(|place| list.record(place).expect("a cell").key.clone()).collect()
        };
        let first = keys(&|_| ());
        let changed = |change: &Change| -> Vec<usize> {
            let now = keys(change);
            (0..first.len()).filter(|place| now[*place] != first[*place]).collect()
        };
        let all: Vec<_> = (0..12).collect();
        let every: [&Change; 6] = [
            &|job| job.frame.seed = 2,
            &|job| job.frame.width = 5,
            &|job| job.frame.back_faces = BackFaces::None,
            &|job| job.repetitions = 3,
            &|job| job.camera.world_from_camera.translation.x = 1.0e-300,
            &|job| job.needs = Needs::of(job.scene, job.frame.workload()),
        ];
        assert!(every.iter().all(|change| changed(change) == all));
        assert_ne!(compare_cells("2", &loaded, &job(&loaded)).record(0).expect("a cell").key, first[0]);
        let some: [(&Change, &[usize]); 13] = [
            (&|job| job.lists = true, &[0, 1, 2, 3, 4, 5, 6, 7, 8]),
            (&|job| job.rays = 99, &[0, 1, 2, 3, 4, 5]),
            (&|job| job.ray_sets[1] = RaySet::Bounce, &[3, 4, 5]),
            (&|job| job.rays_file = Some(rays(-1.0)), &[6, 7, 8]),
            (&|job| job.hits_files = vec![hits(2.0)], &[2, 5, 8]),
            (
                &|job| job.systems[0] = system("mmrt", OptionValues::default().with("buckets", 4)),
                &[0, 3, 6, 9],
            ),
            (&|job| job.systems[1].variant = Some("leaf=2".to_owned()), &[1, 4, 7, 10]),
            (&|job| job.frame.spp = 4, &[9, 10, 11]),
            (&|job| job.frame.sampler = Sampler::Pcg, &[9, 10, 11]),
            (&|job| job.frame.primary = Primary::Raster, &[9, 10, 11]),
            (&|job| job.frame.occluder = OccluderKind::ALL[1], &[9, 10, 11]),
            (&|job| job.frame.occluder = OccluderKind::ShadowMaps { resolution: 7, points: 0 }, &[9, 10, 11]),
            (&|job| job.frame.occluder = OccluderKind::ShadowMaps { resolution: 7, points: 4 }, &[9, 10, 11]),
        ];
        for (number, (change, places)) in some.iter().enumerate() {
            assert_eq!(changed(change), *places, "change {number}");
        }
        let nothing: [&Change; 5] = [
            &|job| job.figures = true,
            &|job| job.keep = true,
            &|job| job.only = Some(BTreeSet::from([3])),
            &|job| job.camera.name = "another".to_owned(),
            &|job| job.systems[0].chosen = Some("a reason".to_owned()),
        ];
        assert!(nothing.iter().all(|change| changed(change).is_empty()));
    }

    #[test]
    fn hard_cases_are_cells_too() {
        let systems = [system("bvh", OptionValues::default()), system("mmrt", OptionValues::default())];
        let file = rasray_hard_cases::files().next().expect("a file");
        let cases = [HardSubject::Rays("E5"), HardSubject::File(&file)];
        let list = |scale| hard_cells("1", cases, &systems, &[], scale, 1);
        let quick = list(Scale::QUICK);
        assert_eq!(quick.groups(), [0..2, 2..3]);
        let key = |list: &CellList, place| list.record(place).expect("a cell").key.clone();
        for other in [
            Scale { rays: 9, ..Scale::QUICK },
            Scale { seed: 9, ..Scale::QUICK },
            Scale { full: true, ..Scale::QUICK },
        ] {
            let other = list(other);
            assert!(key(&other, 0) != key(&quick, 0) && key(&other, 1) != key(&quick, 1));
            assert_eq!(key(&other, 2), key(&quick, 2), "a file has no rays");
        }
    }
}
