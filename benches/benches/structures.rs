//! Build and trace times of every registered system: `cargo bench --bench structures -- [SCENE] [RAYS]`.
//!
//! Prints, for every registered system and preset that the device can run, the median build time, and the
//! median, least and greatest trace time of random rays, alternated between systems in one process. Times of
//! software devices are for ratios on that device. For errors beside speed use `rasray compare`.

use std::ops::ControlFlow;

use rasray_benches::setting::{SEED, Setting};
use rasray_experiment::{Contestant, OptionValues, SystemConfig, incoherent_rays, trace_in_turns};
use rasray_metrics::median;
use rasray_systems::SYSTEMS;

const REPETITIONS: u32 = 5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Setting { name, rays, device, stage, .. } =
        Setting::read("cargo bench --bench structures", "spheres:10k", 4096)?;
    println!("{}, {name}, {rays} incoherent rays, medians of {REPETITIONS}", device.name());
    let mut systems = Vec::new();
    for (system, preset) in
        SYSTEMS.iter().flat_map(|system| system.presets.iter().map(move |preset| (system, *preset)))
    {
        let config = SystemConfig::new(system, preset, OptionValues::default());
        let missing = device.lacks(&config.spec()?.requirements()?);
        if missing.is_empty() {
            systems.push(config);
        } else {
            let missing = missing.join(", ");
            println!("{} {} is left out: the device lacks {missing}", system.name, preset.name());
        }
    }
    let mut contestants =
        Contestant::all(&device, &stage, &systems, stage.scene.eye(), REPETITIONS, &mut |_| {
            ControlFlow::Continue(())
        })?
        .unwrap_or_default();
    let rays = incoherent_rays(stage.scene.geometry().bounds(), SEED, rays);
    let traces = trace_in_turns(&device, &mut contestants, &rays, REPETITIONS)?;
    println!(
        "{:<24} {:>12} {:>12} {:>22} {:>10}",
        "system", "build ms", "trace ms", "least to greatest", "Mrays/s"
    );
    for (contestant, traced) in contestants.iter().zip(&traces) {
        let run = contestant.run(&device)?;
        let name = format!("{} {}", run.system, run.preset);
        let trace = median(&traced.milliseconds);
        let shown =
            |value: Option<f64>, digits| value.map_or("-".to_owned(), |value| format!("{value:.digits$}"));
        let least = traced.milliseconds.iter().copied().reduce(f64::min);
        let greatest = traced.milliseconds.iter().copied().reduce(f64::max);
        let speed = trace.map(|trace| rays.len() as f64 / trace / 1.0e3);
        println!(
            "{name:<24} {:>12} {:>12} {:>22} {:>10}",
            shown(run.times.build_ms, 2),
            shown(trace, 2),
            format!("{} to {}", shown(least, 2), shown(greatest, 2)),
            shown(speed, 3)
        );
    }
    Ok(())
}
