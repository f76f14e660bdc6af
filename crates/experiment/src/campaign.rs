//! Campaign as a list of cells: the cells of many comparisons, each once.

use crate::cell::CellList;
use crate::images::NOISE;
use rasray_report::{CampaignRecord, Cell, CellRecord, ExperimentRecord};
use std::collections::{BTreeMap, BTreeSet};

/// Cells of a comparison as an experiment asks for them.
#[derive(Clone, Debug, PartialEq)]
pub struct ExperimentCells {
    /// Record of the experiment.
    pub experiment: ExperimentRecord,
    /// Cells of the comparison.
    pub cells: CellList,
    /// Places of the cells that the experiment leaves out.
    pub excluded: BTreeSet<usize>,
}

impl ExperimentCells {
    /// Returns the places of the wanted cells, by group. The image's error by noise alone is wanted where an
    /// image is.
    fn groups(&self) -> impl Iterator<Item = Vec<usize>> {
        self.cells.groups().iter().map(|group| {
            let wanted = group.clone().filter(|place| !self.excluded.contains(place));
            let is_noise = |place: &usize| {
                self.cells.record(*place).is_some_and(|record| record.depends_on.system == NOISE.0)
            };
            let places: Vec<_> = wanted.collect();
            if places.iter().all(is_noise) { Vec::new() } else { places }
        })
    }
}

/// All cells of a campaign. A cell that several comparisons ask for is made once, by the first of them.
#[derive(Clone, Debug, PartialEq)]
pub struct CampaignCells {
    list: CellList,
    /// Cells that each comparison makes: a map from places in its own list to places in the list of the
    /// campaign.
    made_by: Vec<BTreeMap<usize, usize>>,
}

impl CampaignCells {
    /// Collects the cells of these comparisons under a title.
    pub fn new(title: &str, comparisons: &[ExperimentCells]) -> Self {
        let mut groups: Vec<Vec<CellRecord>> = Vec::new();
        let mut places: BTreeMap<String, [usize; 2]> = BTreeMap::new();
        let mut made_by = Vec::new();
        let mut made = 0;
        for comparison in comparisons {
            let mut own = BTreeMap::new();
            for group in comparison.groups() {
                let mut records: Vec<CellRecord> = Vec::new();
                for place in group {
                    let Some(record) = comparison.cells.record(place) else { continue };
                    let at = *places.entry(record.key.clone()).or_insert_with(|| {
                        own.insert(place, made);
                        made += 1;
                        records.push(CellRecord {
                            campaign: Some(CampaignRecord {
                                title: title.to_owned(),
                                ..CampaignRecord::default()
                            }),
                            ..record.clone()
                        });
                        [groups.len(), records.len() - 1]
                    });
                    let group = if at[0] == groups.len() { &mut records } else { &mut groups[at[0]] };
                    let campaign = group[at[1]].campaign.get_or_insert_default();
                    if campaign.experiments.last() != Some(&comparison.experiment) {
                        campaign.experiments.push(comparison.experiment.clone());
                    }
                }
                if !records.is_empty() {
                    groups.push(records);
                }
            }
            made_by.push(own);
        }
        Self { list: CellList::of(groups), made_by }
    }

    /// Returns all cells, each once, in the groups of the comparisons.
    pub fn list(&self) -> &CellList {
        &self.list
    }

    /// Returns the cells that a comparison, given by its place, makes: a map from places in its own list to
    /// places in the list of the campaign.
    pub fn made_by(&self, comparison: usize) -> &BTreeMap<usize, usize> {
        &self.made_by[comparison]
    }

    /// Returns the dependencies of the cells, in their order.
    pub fn cells(&self) -> impl Iterator<Item = &Cell> {
        (0..self.list.len()).filter_map(|place| Some(&self.list.record(place)?.depends_on))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(system: &str, spp: u32) -> Cell {
        Cell { system: system.to_owned(), seed: spp, ..Cell::default() }
    }

    fn asked(place: u32, groups: &[&[&Cell]], excluded: &[usize]) -> ExperimentCells {
        let experiment = ExperimentRecord { place, name: format!("e{place}"), ..ExperimentRecord::default() };
        let cells =
            CellList::new("1", groups.iter().map(|group| group.iter().map(|cell| (*cell).clone()).collect()));
        ExperimentCells { experiment, cells, excluded: excluded.iter().copied().collect() }
    }

    #[test]
    fn a_cell_of_several_comparisons_is_made_once_by_the_first() {
        let (a, b, c) = (cell("mmrt", 1), cell("bvh", 1), cell("hu", 2));
        let comparisons =
            [asked(0, &[&[&a, &b]], &[]), asked(1, &[&[&c, &b], &[&a]], &[]), asked(1, &[&[&a]], &[])];
        let campaign = CampaignCells::new("title", &comparisons);
        assert_eq!(campaign.list().groups(), [0..2, 2..3]);
        assert_eq!(campaign.cells().collect::<Vec<_>>(), [&a, &b, &c]);
        assert_eq!(campaign.made_by(0), &BTreeMap::from([(0, 0), (1, 1)]));
        assert_eq!((campaign.made_by(1), campaign.made_by(2)), (&BTreeMap::from([(0, 2)]), &BTreeMap::new()));
        let names = |place: usize| {
            let record = campaign.list().record(place).expect("a cell");
            assert_eq!((record.place as usize, record.cells), (place, 3));
            let campaign = record.campaign.as_ref().expect("of a campaign");
            campaign.experiments.iter().map(|one| one.name.clone()).collect::<Vec<_>>()
        };
        assert_eq!(
            (names(0), names(1), names(2)),
            (vec!["e0".into(), "e1".into()], vec!["e0".into(), "e1".into()], vec!["e1".into()])
        );
    }

    #[test]
    fn what_is_left_out_is_not_made_and_noise_alone_is_not_either() {
        let noise = cell(NOISE.0, 1);
        let (hu, mmrt, bvh) = (cell("hu", 3), cell("mmrt", 1), cell("bvh", 1));
        let made = |excluded: &[usize]| {
            let campaign = CampaignCells::new("", &[asked(0, &[&[&hu], &[&mmrt, &bvh, &noise]], excluded)]);
            campaign.made_by(0).keys().copied().collect::<Vec<_>>()
        };
        assert_eq!((made(&[]), made(&[2])), (vec![0, 1, 2, 3], vec![0, 1, 3]));
        assert_eq!(made(&[1, 2]), [0]);
        assert!(made(&[0, 1, 2]).is_empty());
    }

    #[test]
    fn a_list_is_known_by_what_shows_its_cells_too() {
        let of = |place| CampaignCells::new("", &[asked(place, &[&[&cell("hu", 3)]], &[])]);
        let key = |campaign: &CampaignCells| campaign.list().record(0).expect("a cell").list.clone();
        assert_eq!(key(&of(1)), key(&of(1)));
        assert_ne!(key(&of(1)), key(&of(2)));
    }
}
