use super::*;
use rasray_reference::oracle::Oracle;

#[test]
fn what_is_no_library_is_missing_and_said_with_how_to_get_one() {
    let folder = std::env::temp_dir();
    for name in [Path::new("/nowhere/libembree4.so.4"), Path::new("libNoSuchLibrary.so.7"), &folder] {
        let error = Embree::load(name, 1).expect_err("there is none");
        let text = error.to_string();
        assert!(matches!(error, EmbreeError::Missing { .. }), "{text}");
        for word in [name.to_str().expect("plain text"), "pip install embreex", LIBRARY_VARIABLE] {
            assert!(text.contains(word), "{text}");
        }
    }
}

/// Checks that another library is unsuitable; this test uses the C library.
#[cfg(target_os = "linux")]
#[test]
fn another_library_is_unsuitable() {
    let error = Embree::load(Path::new("libc.so.6"), 1).expect_err("not a tracer");
    assert!(matches!(error, EmbreeError::Unsuitable { .. }), "{error}");
}

/// Makes two sheets, each a height field, one above the other: positions and indices.
fn sheets(cells: u32) -> (Vec<[f32; 3]>, Vec<u32>) {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for sheet in 0..2 {
        let first = positions.len() as u32;
        for place in 0..(cells + 1) * (cells + 1) {
            let [x, z] = [place % (cells + 1), place / (cells + 1)].map(|step| step as f32 / cells as f32);
            positions.push([x, sheet as f32 + 0.1 * (7.0 * x).sin() * (5.0 * z).cos(), z]);
        }
        for cell in 0..cells * cells {
            let corner = first + cell % cells + cell / cells * (cells + 1);
            let [right, below] = [corner + 1, corner + cells + 1];
            indices.extend([corner, right, below, right, below + 1, below]);
        }
    }
    (positions, indices)
}

#[test]
fn hits_are_the_oracles_in_packets_of_every_width() {
    let embree = match Embree::find(2) {
        Ok(embree) => embree,
        Err(error) => return eprintln!("skipped: {error}"),
    };
    assert!(embree.version().starts_with("Embree 4."), "{}", embree.version());
    assert_eq!(embree.threads(), 2);
    assert!([1, 4, 8, 16].contains(&embree.packet_width()));
    let (positions, indices) = sheets(12);
    let oracle = Oracle::new(&positions, &indices, None).expect("indices are in range");
    // The rays start above and between the sheets and go down. They are 1,001, so that the last packets are
    // not full; some end early.
    let ray = |index: u32| {
        let [x, z] = [2_654_435_761_u32, 2_246_822_519]
            .map(|factor| (index.wrapping_mul(factor) >> 8) as f32 / 16_777_216.0);
        let ray = Ray::new([x, if index.is_multiple_of(2) { 2.0 } else { 0.5 }, z], [0.3 - x, -1.0, 0.6 - z]);
        Ray { t_max: if index.is_multiple_of(5) { 0.7 } else { f32::INFINITY }, ..ray }
    };
    let mut rays: Vec<_> = (0..1001).map(ray).collect();
    let truth = |rays: &[Ray]| -> Vec<_> {
        rays.iter().map(|ray| oracle.closest(&rasray_experiment::oracle_ray(ray))).collect()
    };
    // Every third ray excludes the triangle that it would hit, and so hits the one behind.
    let open = truth(&rays);
    for (ray, verdict) in rays.iter_mut().zip(open).step_by(3) {
        ray.exclude_primitive = verdict.outcome.hit().map_or(PRIMITIVE_NONE, |(primitive, _)| primitive);
    }
    assert!(rays.iter().filter(|ray| ray.exclude_primitive != PRIMITIVE_NONE).count() > 200);
    let verdicts = truth(&rays);
    let hits = verdicts.iter().filter(|verdict| verdict.outcome.hit().is_some()).count();
    assert!((200..900).contains(&hits), "{hits}");
    for quality in [Quality::Low, Quality::Medium, Quality::High] {
        for robust in [false, true] {
            let options = TreeOptions { quality, robust };
            let tree = embree.build(&positions, &indices, options).expect("a tree");
            assert!(tree.build_milliseconds() > 0.0);
            for width in [1, 4, 8, 16] {
                let traced = tree.trace(&rays, TraceMode::Closest, width).expect("traced");
                let shadows = tree.trace(&rays, TraceMode::Occluded, width).expect("traced");
                assert_eq!((traced.hits.len(), shadows.hits.len()), (rays.len(), rays.len()));
                for (index, (verdict, hit)) in verdicts.iter().zip(&traced.hits).enumerate() {
                    if verdict.ambiguous {
                        continue;
                    }
                    let place = format!("ray {index}, {options:?}, {width} at a time");
                    let truth = verdict.outcome.hit();
                    assert_eq!(hit.and_then(|hit| hit.primitive), truth.map(|(id, _)| id), "{place}");
                    assert_eq!(shadows.hits[index].is_some(), truth.is_some(), "{place}");
                    if let (Some(hit), Some((_, t))) = (hit, truth) {
                        assert!((f64::from(hit.t) - t).abs() <= 1.0e-5 * t, "{place}: {} for {t}", hit.t);
                    }
                }
            }
            let error = tree.trace(&rays, TraceMode::Closest, 5).expect_err("no packets of five");
            assert!(error.to_string().contains("packets of 5"), "{error}");
        }
    }
    let options = TreeOptions { quality: Quality::Medium, robust: false };
    for indices in [&[0, 1, 9999][..], &[0, 1]] {
        let error = embree.build(&positions, indices, options).expect_err("no triangles");
        assert!(matches!(error, EmbreeError::Failed(_)), "{error}");
    }
}
