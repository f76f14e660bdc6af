//! Command `rasray ablate`.

use super::campaign::{Campaign, read_plan};
use crate::arguments::AblateArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use rasray_experiment::OpenBackend;

/// Makes every comparison of a plan; `line` is the command as it was typed.
///
/// # Errors
/// Errors that can be found without a device are reported before a device is opened.
pub(crate) fn ablate(
    given: &AblateArguments,
    line: &str,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let plan = read_plan(&given.plan, given.campaign.small)?;
    let about = given.plan.display().to_string();
    Campaign { plan: &plan, about: &about, given: &given.campaign, line }.make(open, interrupt)?;
    Ok(())
}
