//! Parts of a scene that a render can observe; the rest need not be uploaded, stored, compiled in or traced.
//!
//! Two things decide whether a [`Term`] is needed: the scene must have it where a ray can hit it,
//! and the workload must look at it. Every verdict comes with a sentence that says why.
//!
//! Positions, indices and the table of draws are always needed and have no term.

mod moving;
mod reads;
mod survey;
mod term;
mod workload;

pub use moving::moving_instances;
pub use term::Term;
pub use workload::Workload;

use crate::Scene;

/// Decision whether a term is needed, with the reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// Term decided on.
    pub term: Term,
    /// True if the render can observe it.
    pub needed: bool,
    /// One sentence, without a full stop.
    pub why: String,
}

/// Verdicts on all terms for a scene and a workload.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Needs {
    verdicts: Vec<Verdict>,
}

impl Needs {
    /// Decides which terms of `scene` the `workload` can observe.
    pub fn of(scene: &Scene, workload: Workload) -> Self {
        let survey = survey::Survey::of(scene, workload);
        let verdicts = Term::ALL
            .into_iter()
            .map(|term| {
                let unseen = survey::unseen(term, workload).map(str::to_owned);
                let found = survey.found(term);
                let needed = unseen.is_none() && found.count > 0;
                Verdict { term, needed, why: unseen.unwrap_or_else(|| found.sentence(term)) }
            })
            .collect();
        Self { verdicts }
    }

    /// Returns needs of all terms, whatever the scene has: a reference that shows that leaving out unneeded
    /// terms changes nothing.
    pub fn all() -> Self {
        let verdict = |term| Verdict { term, needed: true, why: "everything was asked for".to_owned() };
        Self { verdicts: Term::ALL.into_iter().map(verdict).collect() }
    }

    /// Returns these needs with `term` needed; `why` is one sentence without a full stop.
    #[must_use]
    pub fn with(mut self, term: Term, why: &str) -> Self {
        for verdict in self.verdicts.iter_mut().filter(|verdict| verdict.term == term && !verdict.needed) {
            (verdict.needed, verdict.why) = (true, why.to_owned());
        }
        self
    }

    /// True if a term is needed.
    pub fn requires(&self, term: Term) -> bool {
        self.verdicts.iter().any(|verdict| verdict.term == term && verdict.needed)
    }

    /// Returns all verdicts in the order of [`Term::ALL`].
    pub fn verdicts(&self) -> &[Verdict] {
        &self.verdicts
    }
}
