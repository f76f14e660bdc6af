//! Command `rasray replicate`.

use super::campaign::Campaign;
use super::sheets::write_sheet;
use crate::arguments::{PaperChoice, ReplicateArguments};
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::Destination;
use crate::terminal;
use rasray_campaign::{Item, PAPERS, Paper, Plan, paper_page, word};
use rasray_experiment::OpenBackend;
use rasray_report::{columns, json_escaped};

/// Items of a paper to make, with their plans.
type Chosen = (&'static Paper, Vec<(&'static Item, Plan)>);

/// Makes tables and figures of papers again; `line` is the command as it was typed.
///
/// # Errors
/// The paper does not have an item; otherwise as for `rasray ablate`.
pub(crate) fn replicate(
    given: &ReplicateArguments,
    line: &str,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let papers: Vec<_> = match given.paper {
        None | Some(PaperChoice::All) => PAPERS.iter().collect(),
        Some(PaperChoice::One(paper)) => vec![paper],
    };
    let campaign = &given.campaign;
    let chosen = chosen(&papers, &given.items, campaign.small)?;
    if given.list {
        return list(&chosen);
    }
    let named = chosen
        .iter()
        .flat_map(|(paper, items)| items.iter().map(move |(item, plan)| (word(paper, item), plan.clone())));
    let plan = Plan::joined("Replication", named);
    let lines =
        Campaign { plan: &plan, about: "tools/plans", given: campaign, line }.make(open, interrupt)?;
    let Some(made) = rasray_report::Campaign::of(&lines) else { return Ok(()) };
    for (paper, items) in &chosen {
        let (page, sheets) = paper_page(paper, items, &made);
        sheets.iter().try_for_each(|sheet| write_sheet(sheet, campaign.folder(), interrupt))?;
        let place = Destination::check(&campaign.folder().join(format!("{}.md", paper.name)))?;
        place.write(json_escaped(&page).as_bytes(), interrupt)?;
    }
    Ok(())
}

/// Returns the items that were asked for; all items of the papers if none were.
fn chosen(papers: &[&'static Paper], names: &[String], small: bool) -> Result<Vec<Chosen>, AppError> {
    if let Some(name) = names.iter().find(|name| papers.iter().all(|paper| paper.item(name).is_none())) {
        let known: Vec<_> =
            papers.iter().flat_map(|paper| paper.items.iter().map(|item| item.name)).collect();
        return Err(AppError::usage(
            format!(
                "there is no item '{name}' in {}",
                papers.iter().map(|paper| paper.name).collect::<Vec<_>>().join(", ")
            ),
            format!("the items: {}", known.join(", ")),
        ));
    }
    let of_paper = |paper: &&'static Paper| {
        let wanted =
            paper.items.iter().filter(|item| names.is_empty() || names.iter().any(|name| name == item.name));
        let plan = |item: &'static Item| {
            let about = format!("tools/plans/{}/{}.toml", paper.name, item.name);
            let plan = item
                .plan(small)
                .map_err(|error| AppError::usage(format!("{about}: {error}"), error.help()))?;
            Ok((item, plan))
        };
        Ok((*paper, wanted.map(plan).collect::<Result<Vec<_>, AppError>>()?))
    };
    let mut all = papers.iter().map(of_paper).collect::<Result<Vec<_>, AppError>>()?;
    all.retain(|(_, items)| !items.is_empty());
    Ok(all)
}

/// Prints the items and their titles.
fn list(chosen: &[Chosen]) -> Result<(), AppError> {
    let rows = chosen.iter().flat_map(|(paper, items)| {
        items.iter().map(|(item, plan)| vec![paper.name.to_owned(), item.name.to_owned(), plan.title.clone()])
    });
    terminal::print(&columns(&rows.collect::<Vec<_>>(), 3))
}
