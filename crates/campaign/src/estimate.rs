//! Estimates of the time of cells, from cells that were made.

use rasray_report::{Cell, Report};
use std::collections::BTreeMap;
use std::fmt;
use std::time::Duration;

/// Estimate of the work and the time of cells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// Number of rays that are traced, with all repetitions.
    pub rays: u64,
    /// Number of samples of images.
    pub samples: u64,
    /// Time of those cells that can be estimated.
    pub time: Duration,
    /// Number of cells that cannot be estimated, since no cell of their system and kind was made.
    pub unknown: usize,
}

/// Estimates cells from the cells that were made: cells of one system and kind (rays or images) take equal
/// time per ray or sample. The estimate does not include the time of the oracle and of reference images.
pub fn estimate<'a>(
    cells: impl IntoIterator<Item = &'a Cell>,
    made: impl IntoIterator<Item = &'a Report>,
) -> Estimate {
    // Milliseconds and work, by system and kind.
    let mut known: BTreeMap<(&str, bool), (f64, f64)> = BTreeMap::new();
    for (cell, run) in
        made.into_iter().filter_map(|line| Some((&line.cell.as_ref()?.depends_on, line.runs.first()?)))
    {
        let repeated = f64::from(cell.repetitions + 1);
        let built = run.times.build_ms.unwrap_or(0.0) * repeated;
        let time = match cell.image {
            Some(_) => run.times.frame_ms.or(run.times.image_ms),
            None => run.times.trace_ms.map(|trace| built + trace * repeated),
        };
        if let Some(time) = time {
            let sum = known.entry((&cell.system, cell.image.is_some())).or_default();
            *sum = (sum.0 + time, sum.1 + work(cell));
        }
    }
    let mut estimate = Estimate::default();
    for cell in cells {
        let work = work(cell);
        match cell.image {
            Some(_) => estimate.samples += work as u64,
            None => estimate.rays += work as u64,
        }
        match known.get(&(cell.system.as_str(), cell.image.is_some())) {
            Some((ms, of)) if *of > 0.0 => estimate.time += Duration::from_secs_f64(0.001 * work * ms / of),
            _ => estimate.unknown += 1,
        }
    }
    estimate
}

/// Returns the number of rays with all repetitions, or the number of samples of an image.
fn work(cell: &Cell) -> f64 {
    let rays = cell.rays.as_ref().map_or(0.0, |rays| f64::from(rays.count));
    let pixels = cell.view.as_ref().map_or(0.0, |view| f64::from(view.size[0]) * f64::from(view.size[1]));
    match &cell.image {
        Some(image) => pixels * f64::from(image.spp),
        None => rays * f64::from(cell.repetitions + 1),
    }
}

impl fmt::Display for Estimate {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rays, samples, time, unknown } = *self;
        write!(formatter, "{rays} rays, {samples} samples of images")?;
        if time > Duration::ZERO {
            let minutes = time.as_secs_f64() / 60.0;
            write!(formatter, "; about {minutes:.1} minutes on the device by the runs that are there")?;
        }
        match unknown {
            0 => Ok(()),
            count => write!(formatter, "; nothing is there to tell the time of {count} runs by"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_report::{CellImage, CellRays, CellRecord, CellView, Device, Origin, Run, SceneRecord, Times};

    fn cell(system: &str, rays: u32) -> Cell {
        let rays = CellRays { count: rays, ..CellRays::default() };
        Cell { system: system.to_owned(), rays: Some(rays), repetitions: 3, ..Cell::default() }
    }

    #[test]
    fn times_grow_with_the_work_of_a_system() {
        let times = Times { build_ms: Some(100.0), trace_ms: Some(150.0), ..Times::default() };
        let run = Run { times, ..Run::default() };
        let report = Report::new(Origin::default(), Device::default(), SceneRecord::default(), vec![run]);
        let record = CellRecord { depends_on: cell("mmrt", 1000), ..CellRecord::default() };
        let made = Report { cell: Some(record), ..report };
        // 4000 rays take 4 x 250 ms.
        let one = estimate(&[cell("mmrt", 10_000)], [&made]);
        assert_eq!((one.rays, one.time, one.unknown), (40_000, Duration::from_secs(10), 0));
        let view = CellView { size: [10, 5], ..CellView::default() };
        let image = CellImage { spp: 4, ..CellImage::default() };
        let image = Cell { view: Some(view), image: Some(image), rays: None, ..cell("mmrt", 0) };
        let all = estimate(&[cell("bvh", 1), image, cell("mmrt", 1)], [&made]);
        assert_eq!((all.samples, all.rays, all.unknown), (200, 8, 2));
        assert!(all.to_string().contains("of 2 runs"), "{all}");
    }
}
