//! Tables and figures of the papers, each with a plan.

use crate::plan::{Plan, PlanError};

/// Paper whose tables and figures are replicated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paper {
    /// Name of the paper's system.
    pub name: &'static str,
    /// Authors, title and year.
    pub cited: &'static str,
    /// Tables and figures, in the order of the paper.
    pub items: &'static [Item],
}

/// Table or figure of a paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// Name of the item, such as `table1` or `fig7`.
    pub name: &'static str,
    text: &'static str,
}

macro_rules! items {
    ($paper:literal: $($name:literal),* $(,)?) => {
        &[$(Item {
            name: $name,
            text: include_str!(concat!("../../../tools/plans/", $paper, "/", $name, ".toml")),
        }),*]
    };
}

/// All papers that are replicated.
pub const PAPERS: [Paper; 5] = [
    Paper {
        name: "mmrt",
        cited: "Vardis, Vasilakis, Papaioannou: A multiview and multilayer approach for interactive ray tracing, I3D 2016",
        items: items!("mmrt": "table1", "table2", "fig7", "fig8", "fig9", "fig10", "fig11", "fig12"),
    },
    Paper {
        name: "dirt",
        cited: "Vardis, Vasilakis, Papaioannou: DIRT: Deferred Image-based Ray Tracing, HPG 2016",
        items: items!("dirt": "table1", "table2", "table3", "fig7", "fig8", "fig9", "fig10", "fig11", "text"),
    },
    Paper {
        name: "hu",
        cited: "Hu, Huang, Zhang, Yuan, Li: Ray tracing via GPU rasterization, The Visual Computer 30, 2014",
        items: items!("hu": "table1", "fig1", "fig6", "fig7", "fig8", "fig9", "fig10", "fig11"),
    },
    Paper {
        name: "selective",
        cited: "Frid Kastrati, Goswami: Selective rasterized ray-traced reflections on the GPU, 2017",
        items: items!("selective": "table1", "table2", "table3", "fig5", "fig6", "fig7", "fig8"),
    },
    Paper {
        name: "ldc",
        cited: "Bürger, Hertel, Krüger, Westermann: GPU Rendering of Secondary Effects, VMV 2007",
        items: items!("ldc": "table1", "fig1", "fig2", "fig10"),
    },
];

impl Paper {
    /// Returns the paper of a system.
    pub fn named(name: &str) -> Option<&'static Self> {
        PAPERS.iter().find(|paper| paper.name == name)
    }

    /// Returns the item with this name.
    pub fn item(&self, name: &str) -> Option<&'static Item> {
        self.items.iter().find(|item| item.name == name)
    }
}

impl Item {
    /// Returns the item's plan; `small` chooses its small sizes.
    ///
    /// # Errors
    /// There are none for the plans of this program, all of which a test reads.
    pub fn plan(&self, small: bool) -> Result<Plan, PlanError> {
        Plan::read(self.text, small)
    }
}

/// Returns the prefix of the names of an item's experiments.
pub fn word(paper: &Paper, item: &Item) -> String {
    format!("{} {}", paper.name, item.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_has_a_plan_that_reads_in_both_sizes() {
        for (paper, item) in PAPERS.iter().flat_map(|paper| paper.items.iter().map(move |item| (paper, item)))
        {
            for small in [false, true] {
                let plan =
                    item.plan(small).unwrap_or_else(|error| panic!("{} {}: {error}", paper.name, item.name));
                assert!(!plan.about.is_empty() && plan.title != "Campaign", "{} {}", paper.name, item.name);
                let words = plan.comparisons().map(|(_, one)| one.words.clone());
                let size = match (paper.name, item.name) {
                    ("mmrt", "fig12") => "--size=800x800",
                    _ if small => "--size=144x96",
                    _ => "--size=640x360",
                };
                assert!(
                    words.into_iter().all(|words| words.contains(&size.to_owned())),
                    "{} {}",
                    paper.name,
                    item.name
                );
            }
        }
        assert_eq!(
            Paper::named("hu").and_then(|paper| paper.item("fig6")).map(|item| item.name),
            Some("fig6")
        );
        assert!(Paper::named("none").is_none());
    }
}
