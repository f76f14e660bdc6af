//! Names, groups and colours of runs, which agree in every part of the page.

use rasray_report::{Run, grouped};

/// Colours that people with any colour vision can distinguish, after Okabe and Ito. Black is left out because
/// it is invisible on a dark page, and yellow is last because it is faint on a light one.
const COLOURS: [&str; 8] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#8c8c8c", "#d8c83a"];

/// Largest number of hard cases for which each gets plots of its own.
pub(super) const MOST_HARD_CASES: usize = 4;

/// Returns the number of different hard cases that were traced.
pub(super) fn hard_cases(runs: &[Run]) -> usize {
    let mut cases: Vec<&str> = runs.iter().filter_map(|run| Some(run.hard.as_ref()?.id.as_str())).collect();
    cases.sort_unstable();
    cases.dedup();
    cases.len()
}

/// Returns the workload of a run: a hard case, the name of a ray set, or the integrator of an image.
pub(super) fn workload(run: &Run) -> String {
    if let Some(hard) = &run.hard {
        return format!("hard:{}", hard.id);
    }
    match (&run.ray_set, &run.integrator) {
        (Some(set), _) => set.clone(),
        (None, Some(integrator)) => format!("image, {integrator}"),
        (None, None) => "unnamed".to_owned(),
    }
}

/// Returns the positions of the runs that plots show, per workload, in order of appearance. Hard cases are
/// left out if there are too many to plot.
pub(super) fn by_workload(runs: &[Run]) -> Vec<(String, Vec<usize>)> {
    let plotted = |run: &Run| run.hard.is_none() || hard_cases(runs) <= MOST_HARD_CASES;
    let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
    for (index, run) in runs.iter().enumerate().filter(|(_, run)| plotted(run)) {
        let name = workload(run);
        match groups.iter_mut().find(|group| group.0 == name) {
            Some(group) => group.1.push(index),
            None => groups.push((name, vec![index])),
        }
    }
    groups
}

/// Look of a run in plots: one colour per system, one symbol and dash per preset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Look {
    /// Colour as `#rrggbb`.
    pub colour: &'static str,
    /// Name of the marker in the plots' library.
    pub symbol: &'static str,
    /// Name of the dash in the plots' library.
    pub dash: &'static str,
}

/// Returns the look of `run`, by the order in which systems and presets appear in `runs`.
pub(super) fn look(runs: &[Run], run: &Run) -> Look {
    const SYMBOLS: [&str; 4] = ["circle", "square", "diamond", "cross"];
    const DASHES: [&str; 4] = ["solid", "dash", "dot", "dashdot"];
    let system = position(runs.iter().map(|run| run.system.as_str()), &run.system);
    let preset = position(runs.iter().map(|run| run.preset.as_str()), &run.preset);
    Look {
        colour: COLOURS[system % COLOURS.len()],
        symbol: SYMBOLS[preset % SYMBOLS.len()],
        dash: DASHES[preset % DASHES.len()],
    }
}

/// Returns the number of different names before `wanted`.
fn position<'a>(names: impl Iterator<Item = &'a str>, wanted: &str) -> usize {
    let mut seen: Vec<&str> = Vec::new();
    for name in names.take_while(|name| *name != wanted) {
        if !seen.contains(&name) {
            seen.push(name);
        }
    }
    seen.len()
}

/// Writes milliseconds in words; long times have no fractions. A sum of no terms is -0 in Rust, and is
/// written as 0 here.
pub(super) fn milliseconds(value: f64) -> String {
    let value = value + 0.0;
    if value >= 1000.0 {
        grouped(value.round() as u64)
    } else if value >= 100.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.3}")
    }
}

/// Returns the colour of a part of a bar; colours repeat after eight.
pub(super) fn part_colour(index: usize) -> &'static str {
    COLOURS[index % COLOURS.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_report::HardRecord;

    fn run(system: &str, preset: &str, set: &str) -> Run {
        Run {
            system: system.to_owned(),
            preset: preset.to_owned(),
            ray_set: Some(set.to_owned()),
            ..Default::default()
        }
    }

    #[test]
    fn a_system_keeps_its_colour_and_a_preset_its_symbol() {
        let runs = [
            run("mmrt", "robust", "eye"),
            run("mmrt", "published", "eye"),
            run("dirt", "robust", "eye"),
            run("mmrt", "robust", "camera"),
        ];
        let looks: Vec<_> = runs.iter().map(|run| look(&runs, run)).collect();
        assert_eq!(looks[0], looks[3]);
        assert_eq!(looks[0].colour, looks[1].colour);
        assert_ne!(looks[0].symbol, looks[1].symbol);
        assert_ne!(looks[0].dash, looks[1].dash);
        assert_ne!(looks[0].colour, looks[2].colour);
        assert_eq!(looks[0].symbol, looks[2].symbol);
    }

    #[test]
    fn runs_of_one_ray_set_stand_together() {
        let runs = [run("a", "", "eye"), run("a", "", "camera"), run("b", "", "eye")];
        let groups = by_workload(&runs);
        assert_eq!(groups, [("eye".to_owned(), vec![0, 2]), ("camera".to_owned(), vec![1])]);
    }

    #[test]
    fn few_hard_cases_are_plotted_and_many_are_not() {
        for count in [1, MOST_HARD_CASES, MOST_HARD_CASES + 1] {
            let mut runs = vec![run("a", "", "eye")];
            runs.extend((0..count).map(|case| Run {
                hard: Some(HardRecord { id: format!("E{case}"), ..Default::default() }),
                ..run("a", "", "hard")
            }));
            assert_eq!(hard_cases(&runs), count);
            let plotted = if count <= MOST_HARD_CASES { count } else { 0 };
            assert_eq!(by_workload(&runs).len(), 1 + plotted);
        }
    }
}
