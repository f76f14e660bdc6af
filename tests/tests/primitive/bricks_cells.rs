//! Bricks of cells along the axes: they list exactly the cells that a triangle reaches into, hits are those
//! of brute force on every shape of a scene and from everywhere, and too little capacity for them is noticed.

use std::collections::HashMap;

use rasray_ads::{BruteForce, Check, Hit, Ray, Structure};
use rasray_bricks::{Bricks, Builder, Config, Demand, Views, plan, well_formed};
use rasray_gpu::Timing;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::shapes::{Triangle, closed_box, sphere};
use rasray_tracer::build_until_complete;

fn axes(grid: Option<u32>) -> Config {
    Config { grid, ..Config::new(Views::Axes) }
}

fn built(bench: &Bench, config: Config, triangles: &[Triangle], eye: [f32; 3]) -> Bricks {
    let geometry = bench.geometry(triangles);
    let mut structure = Bricks::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, eye, Timing::None).expect("the build completes");
    structure
}

/// Triangles of all sizes and slopes, and some along the axes.
fn mixed(random: &mut Random) -> Vec<Triangle> {
    let mut triangles: Vec<Triangle> = (0..300)
        .map(|index| {
            let size = [0.02, 0.2, 1.5, 8.0][index % 4];
            let at = random.point(-5.0, 5.0);
            std::array::from_fn(|_| {
                let away = random.point(-size, size);
                std::array::from_fn(|axis| at[axis] + away[axis])
            })
        })
        .collect();
    for index in 0..60 {
        // In a plane across an axis.
        let at = random.point(-5.0, 5.0);
        triangles.push(std::array::from_fn(|_| {
            let mut corner = random.point(-5.0, 5.0);
            corner[index % 3] = at[index % 3];
            corner
        }));
    }
    triangles
}

/// True if a triangle reaches into the box between two corners; in double precision, by cutting it at the six
/// sides.
fn reaches_into(triangle: &[[f64; 3]; 3], lower: [f64; 3], upper: [f64; 3]) -> bool {
    let mut polygon = triangle.to_vec();
    for axis in 0..3 {
        for (side, sign) in [(lower[axis], 1.0), (upper[axis], -1.0)] {
            let inside = |p: &[f64; 3]| sign * (p[axis] - side);
            let mut kept = Vec::new();
            for (from, to) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
                if inside(from) >= 0.0 {
                    kept.push(*from);
                }
                if (inside(from) < 0.0) != (inside(to) < 0.0) {
                    let share = inside(from) / (inside(from) - inside(to));
                    kept.push(std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis])));
                }
            }
            polygon = kept;
        }
    }
    !polygon.is_empty()
}

/// Counts of [`check_lists`]: cells of each level, entries, and those of a triangle that reaches into the
/// cell without margins.
#[derive(Debug)]
struct Listed {
    of_levels: [usize; 4],
    entries: usize,
    reached: usize,
    depths: [u32; 3],
}

/// Checks every list of bricks of a scene with that many cells along it against clipping in double precision.
fn check_lists(bench: &Bench, config: Config, grid: u32, triangles: &[Triangle]) -> Listed {
    let divisions = config.divisions.expect("the test says how often");
    let structure = built(bench, config, triangles, [0.0; 3]);
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents, triangles.len() as u32).expect("bricks are well formed");
    let header = &contents.header;
    let cells = contents.cells().expect("bricks are well formed");
    let mut of_levels = [0; 4];
    let (mut reached, mut entries) = (0, 0);
    let mut lists = HashMap::new();
    let in_double: Vec<_> = triangles.iter().map(|triangle| triangle.map(|p| p.map(f64::from))).collect();
    for cell in &cells {
        of_levels[cell.level as usize] += 1;
        let finer = header.depths.map(|depth| f64::from(1 << (2 * depth.min(cell.level))));
        let per_metre: [f64; 3] =
            std::array::from_fn(|axis| f64::from(header.cells_per_metre[axis]) * finer[axis]);
        let along = f64::from(grid) * finer.into_iter().fold(1.0, f64::max);
        let margin: [f64; 3] =
            std::array::from_fn(|axis| f64::from(header.rounding) * per_metre[axis] + 2.0e-6 * along);
        let sides = |share: f64| {
            [0.0, 1.0].map(|side| {
                std::array::from_fn::<f64, 3, _>(|axis| {
                    let beyond = share * margin[axis] * (2.0 * side - 1.0);
                    let at = (f64::from(cell.place[axis]) + side + beyond) / per_metre[axis];
                    at + f64::from(header.cells_lower[axis]) + f64::from(header.centre[axis])
                })
            })
        };
        let list = contents.list(cell.list).expect("lists are well formed");
        lists.insert((cell.level, cell.place), list);
        entries += list.len();
        let [near, exact, far] = [0.9, 0.0, 1.5].map(sides);
        for (primitive, triangle) in in_double.iter().enumerate() {
            let outside = |axis: usize| {
                triangle.iter().all(|p| p[axis] < far[0][axis])
                    || triangle.iter().all(|p| p[axis] > far[1][axis])
            };
            let lists = list.contains(&(primitive as u32));
            if !lists && (0..3).any(outside) {
                continue;
            }
            let reaches = |[lower, upper]: [[f64; 3]; 2]| reaches_into(triangle, lower, upper);
            assert!(!lists || reaches(far), "{cell:?} lists {triangle:?}");
            assert!(lists || !reaches(near), "{cell:?} does not list {triangle:?}");
            reached += usize::from(reaches(exact));
        }
    }
    // Cells that list nothing hold nothing: places of triangles are in a cell that lists them.
    let mut random = Random::new(44);
    for (primitive, triangle) in in_double.iter().enumerate() {
        for _ in 0..20 {
            let [u, v] = [(); 2].map(|()| f64::from(random.between(0.0, 1.0)));
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let in_cells: [f64; 3] = std::array::from_fn(|axis| {
                let at = triangle[0][axis]
                    + u * (triangle[1][axis] - triangle[0][axis])
                    + v * (triangle[2][axis] - triangle[0][axis]);
                (at - f64::from(header.centre[axis]) - f64::from(header.cells_lower[axis]))
                    * f64::from(header.cells_per_metre[axis])
            });
            let found = (0..=divisions).find_map(|level| {
                let place = std::array::from_fn(|axis| {
                    (in_cells[axis] * f64::from(1 << (2 * header.depths[axis].min(level)))) as u32
                });
                lists.get(&(level, place))
            });
            assert!(
                found.is_some_and(|list| list.contains(&(primitive as u32))),
                "nothing lists {triangle:?} at {in_cells:?}"
            );
        }
    }
    Listed { of_levels, entries, reached, depths: header.depths }
}

/// Crowds of small triangles among larger ones, the second crowd of smaller ones within the first.
fn crowded(random: &mut Random) -> Vec<Triangle> {
    let mut triangles = mixed(random);
    for (count, spread, size) in [(2000, 1.0, 0.03), (2000, 0.05, 0.002)] {
        triangles.extend((0..count).map(|_| -> Triangle {
            let at = random.point(-spread, spread);
            std::array::from_fn(|_| {
                let away = random.point(-size, size);
                std::array::from_fn(|axis| at[axis] + away[axis])
            })
        }));
    }
    triangles
}

/// Every cell that a triangle reaches into lists it, and none that is farther from it than the margins; also
/// those of divided cells.
#[test]
fn cells_list_what_reaches_into_them_and_nothing_else() {
    let bench = Bench::new();
    let triangles = crowded(&mut Random::new(41));
    for (grid, divisions, builder) in [
        (24, 0, Builder::Binning),
        (61, 1, Builder::Binning),
        (24, 3, Builder::Binning),
        (24, 0, Builder::Raster),
        (24, 2, Builder::Raster),
    ] {
        let config = Config { builder, divisions: Some(divisions), ..axes(Some(grid)) };
        let listed = check_lists(&bench, config, grid, &triangles);
        println!("{grid} cells: {listed:?}");
        assert_eq!(listed.depths, [divisions; 3]);
        assert_eq!(listed.of_levels.iter().filter(|&&cells| cells > 0).count(), divisions as usize + 1);
        let Listed { entries, reached, .. } = listed;
        assert!(reached > 5000 && entries < reached + reached / 20, "{entries} entries for {reached}");
    }
}

/// Cells are not divided along an axis where they are no wider than their margins, and are along the others.
#[test]
fn cells_of_a_flat_scene_are_divided_within_its_plane() {
    let bench = Bench::new();
    for axis in 0..3 {
        let mut triangles = crowded(&mut Random::new(42));
        triangles.iter_mut().flatten().for_each(|corner| corner[axis] = 2.0);
        // A triangle across another axis is a line now, which no cell lists.
        triangles.retain(|[a, b, c]| {
            let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
            let side = |p: &[f32; 3]| [p[u] - a[u], p[v] - a[v]].map(f64::from);
            let ([bu, bv], [cu, cv]) = (side(b), side(c));
            bu * cv != bv * cu
        });
        let config = Config { divisions: Some(3), ..axes(Some(24)) };
        let listed = check_lists(&bench, config, 24, &triangles);
        println!("flat along axis {axis}: {listed:?}");
        let depths: [u32; 3] = std::array::from_fn(|at| if at == axis { 0 } else { 3 });
        assert_eq!(listed.depths, depths);
        assert!(listed.of_levels.iter().all(|&cells| cells > 0), "{listed:?}");
        let Listed { entries, reached, .. } = listed;
        assert!(reached > 5000 && entries < reached + reached / 20, "{entries} entries for {reached}");
    }
}

/// Rays from within the bounds and from outside of them, some along an axis and some along the scene's
/// planes.
fn rays_at(random: &mut Random, [lower, upper]: [[f32; 3]; 2], count: usize) -> Vec<Ray> {
    let extent: [f32; 3] = std::array::from_fn(|axis| upper[axis] - lower[axis]);
    let longest = extent.into_iter().fold(0.0, f32::max);
    let longest = if longest > 0.0 { longest } else { 1.0 };
    let within = |random: &mut Random| -> [f32; 3] {
        std::array::from_fn(|axis| lower[axis] + random.between(0.0, 1.0) * extent[axis])
    };
    (0..count)
        .map(|index| {
            let target = within(random);
            let distance = [0.5, 2.0, 20.0][index % 3] * longest;
            let origin = match index % 5 {
                0 => within(random),
                1 => {
                    let mut origin = target;
                    origin[index / 5 % 3] += if index / 15 % 2 == 0 { distance } else { -distance };
                    origin
                }
                _ => {
                    let away = random.direction();
                    std::array::from_fn(|axis| target[axis] + distance * away[axis])
                }
            };
            towards(origin, target)
        })
        .filter(|ray| ray.direction != [0.0; 3])
        .collect()
}

/// Scenes without thickness, without an inside, without size, and of many sizes.
fn shapes(random: &mut Random) -> Vec<(String, Vec<Triangle>)> {
    let tiny = |random: &mut Random, at: [f32; 3], size: f32| -> Triangle {
        std::array::from_fn(|_| {
            let away = random.point(-size, size);
            std::array::from_fn(|axis| at[axis] + away[axis])
        })
    };
    let mut shapes: Vec<(String, Vec<Triangle>)> = (0..3)
        .map(|axis| {
            let mut flat = mixed(random);
            flat.iter_mut().flatten().for_each(|corner| corner[axis] = 2.0);
            (format!("flat along axis {axis}"), flat)
        })
        .collect();
    shapes.push(("one triangle".to_owned(), vec![tiny(random, [1.0e3, -5.0, 7.0], 2.0)]));
    shapes.push(("a point".to_owned(), vec![[[3.0; 3]; 3]; 5]));
    shapes.push(("a line".to_owned(), vec![[[0.0; 3], [1.0, 2.0, 3.0], [2.0, 4.0, 6.0]]]));
    let mut needle = closed_box([0.0; 3], [1000.0, 0.1, 0.1]);
    needle.extend((0..200).map(|k| tiny(random, [5.0 * k as f32, 0.05, 0.05], 0.04)));
    shapes.push(("a long box".to_owned(), needle));
    let mut huge = vec![[[-1.0e4, -1.0e4, -1.0e4], [1.0e4, 1.0e4, -1.0e4], [1.0e4, -1.0e4, 1.0e4]]];
    huge.extend((0..300).map(|_| {
        let at = random.point(-1.0, 1.0);
        tiny(random, at, 0.05)
    }));
    shapes.push(("a huge triangle among tiny ones".to_owned(), huge));
    for scale in [1.0e-12_f32, 1.0e12] {
        let scaled = sphere([0.0, 0.5, 0.0], 1.5, 8).into_iter().map(|t| t.map(|p| p.map(|x| x * scale)));
        shapes.push((format!("a sphere scaled by {scale:e}"), scaled.collect()));
    }
    let mut sizes = closed_box([-10.0; 3], [10.0; 3]);
    sizes.extend(sphere([-3.0, 0.5, -2.0], 1.5, 10));
    sizes.extend(sphere([1.0, 0.25, 0.5], 0.003, 8));
    shapes.push(("a room".to_owned(), sizes));
    shapes
}

#[test]
fn every_shape_of_a_scene_is_traced_as_by_brute_force() {
    let bench = Bench::new();
    let mut random = Random::new(43);
    for (what, triangles) in shapes(&mut random) {
        let geometry = bench.geometry(&triangles);
        let rays = rays_at(&mut random, geometry.bounds(), 2000);
        let reference =
            BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
        let expected = bench.trace(&reference, &rays).hits;
        let hit = expected.iter().filter(|hit| hit.is_hit()).count();
        println!("{what}: {hit} of {} rays hit", rays.len());
        assert!(hit > 100 || what.starts_with("a point") || what.starts_with("a line"), "{what}: {hit}");
        let undivided = |config| Config { divisions: Some(0), ..config };
        for config in [
            axes(None),
            axes(Some(8)),
            undivided(axes(Some(100))),
            Config { skip: false, ..axes(Some(33)) },
            undivided(Config { skip: false, ..axes(Some(33)) }),
        ] {
            for eye in [[0.0; 3], [0.0, 1.0e5, 0.0]] {
                let structure = built(&bench, config, &triangles, eye);
                let hits = bench.trace(&structure, &rays).hits;
                for (ray, (found, expected)) in hits.iter().zip(&expected).enumerate() {
                    assert_eq!(
                        bits(found),
                        bits(expected),
                        "{what}, {config:?}, eye at {eye:?}: {:?}",
                        rays[ray]
                    );
                }
                for (ray, occluded) in bench.occluded(&structure, &rays).into_iter().enumerate() {
                    assert_eq!(occluded, expected[ray].is_hit(), "{what}, {config:?}: {:?}", rays[ray]);
                }
                assert_eq!(structure.status(0).expect("the header is readable").corrupted, 0, "{what}");
            }
        }
    }
}

/// Another geometry may need more bricks; with fewer than it needs, no partial structure is built.
#[test]
fn missing_capacity_for_bricks_is_noticed() {
    let bench = Bench::new();
    let room = closed_box([-10.0; 3], [10.0; 3]);
    let flat: Vec<Triangle> = vec![[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]];
    let mut structure = built(&bench, axes(Some(32)), &flat, [0.0; 3]);
    structure.set_geometry(bench.device(), &bench.geometry(&room)).expect("it fits");
    build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None)
        .expect("the build completes");
    let rays = Random::new(5).rays(500, -9.0, 9.0);
    let expected = bench.trace(&structure, &rays).hits;
    assert!(expected.iter().all(Hit::is_hit));

    for grid in [[0; 3], [4; 3], [32, 32, 28]] {
        let few = Demand {
            entries: 1 << 16,
            near: 0,
            records: 1 << 16,
            bricks: 0,
            cells: 1 << 16,
            triangles: 12,
            grid,
        };
        structure.resize(bench.device(), &plan(&axes(Some(32)), &few).expect("in range")).expect("it fits");
        let status = bench.build_once(&mut structure, [0.0; 3]);
        assert!(!status.complete, "{grid:?}: {status:?}");
        let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
            panic!("{status:?} does not grow")
        };
        structure.resize(bench.device(), &sizes).expect("it fits");
        assert!(bench.build_once(&mut structure, [0.0; 3]).complete, "{grid:?}");
        assert_eq!(bench.trace(&structure, &rays).hits, expected);
    }
}
