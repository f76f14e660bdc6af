//! Accuracy of a run: hits against the oracle, images against the reference, and hard cases against their
//! statements.

use crate::absent::absent;
use rasray_metrics::{HitConfusion, Rate};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Errors of hits against the oracle. Counts are over unambiguous rays, unless their name says otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Accuracy {
    /// Number of rays whose answer was compared.
    pub rays: u64,
    /// Number of rays that no f32 program can decide.
    pub ambiguous: u64,
    /// Number of ambiguous rays whose answer is none of the candidates.
    pub ambiguous_lost: u64,
    /// Number of hits that were not found.
    pub missed: u64,
    /// Number of hits reported where there is nothing.
    pub false_hits: u64,
    /// Number of hits on another primitive; absent where the structure does not know the primitive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrong_primitive: Option<u64>,
    /// Number of hits with a t that the rounding of a careful f32 test does not explain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub t_off: Option<u64>,
    /// Number of hits with a finite t that the oracle has as well; the percentiles below are over these hits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dt_rel_count: Option<u64>,
    /// Median of |dt|/t over common hits.
    #[serde(default, skip_serializing_if = "absent")]
    pub dt_rel_p50: Option<f64>,
    /// 90th percentile of |dt|/t.
    #[serde(default, skip_serializing_if = "absent")]
    pub dt_rel_p90: Option<f64>,
    /// 99th percentile of |dt|/t.
    #[serde(default, skip_serializing_if = "absent")]
    pub dt_rel_p99: Option<f64>,
    /// 99.9th percentile of |dt|/t.
    #[serde(default, skip_serializing_if = "absent")]
    pub dt_rel_p999: Option<f64>,
    /// Largest |dt|/t.
    #[serde(default, skip_serializing_if = "absent")]
    pub dt_rel_max: Option<f64>,
    /// Number of answers that are not finite numbers.
    pub non_finite: u64,
    /// Rates with their intervals by name: `missed`, `false_hits`, `wrong_primitive`, `t_off`,
    /// `ambiguous_lost`, `ambiguous_wrong`, `non_finite`; and `errors` where a law bounds the share of
    /// errors. A rate whose event could not have happened is absent.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub rates: BTreeMap<String, RateRecord>,
}

impl From<&HitConfusion> for Accuracy {
    fn from(confusion: &HitConfusion) -> Self {
        let dt = confusion.dt_rel;
        let rates = [
            ("missed", Some(confusion.missed)),
            ("false_hits", Some(confusion.false_hits)),
            ("wrong_primitive", confusion.wrong_primitive),
            ("t_off", Some(confusion.t_off)),
            ("ambiguous_lost", Some(confusion.ambiguous_lost)),
            ("ambiguous_wrong", Some(confusion.ambiguous_wrong)),
            ("non_finite", Some(confusion.non_finite)),
        ];
        let rates = rates.into_iter();
        Self {
            rays: confusion.rays,
            ambiguous: confusion.ambiguous,
            ambiguous_lost: confusion.ambiguous_lost.count + confusion.ambiguous_wrong.count,
            missed: confusion.missed.count,
            false_hits: confusion.false_hits.count,
            wrong_primitive: confusion.wrong_primitive.map(|rate| rate.count),
            t_off: Some(confusion.t_off.count),
            dt_rel_count: dt.map(|dt| dt.count as u64),
            dt_rel_p50: dt.map(|dt| dt.p50),
            dt_rel_p90: dt.map(|dt| dt.p90),
            dt_rel_p99: dt.map(|dt| dt.p99),
            dt_rel_p999: dt.map(|dt| dt.p999),
            dt_rel_max: dt.map(|dt| dt.max),
            non_finite: confusion.non_finite.count,
            rates: rates.filter_map(|(name, rate)| Some((name.to_owned(), RateRecord::of(rate?)?))).collect(),
        }
    }
}

/// Rate of an event, and the confidence in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RateRecord {
    /// Number of times that the event happened.
    pub count: u64,
    /// Number of trials, at least 1.
    pub of: u64,
    /// Rate `count / of`.
    pub rate: f64,
    /// Method by which the intervals were computed.
    pub bound: Bound,
    /// Interval of the true rate with 95 % confidence.
    pub interval: [f64; 2],
    /// Interval that is wide enough for the intervals of all rates of the report to hold together, see
    /// [`crate::Statistics`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family_interval: Option<[f64; 2]>,
}

/// Method of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bound {
    /// Two-sided interval of Clopper and Pearson.
    ClopperPearson,
    /// One-sided interval 3 / of at 95 %, for an event that never or always happened.
    OneSided,
}

impl RateRecord {
    /// Makes the record of a rate; `None` if nothing was tried.
    pub fn of(rate: Rate) -> Option<Self> {
        let bound = if rate.is_one_sided() { Bound::OneSided } else { Bound::ClopperPearson };
        Some(Self {
            count: rate.count,
            of: rate.total,
            rate: rate.value()?,
            bound,
            interval: rate.interval()?,
            family_interval: None,
        })
    }

    /// Returns the counts in the type of the metrics.
    pub fn counted(&self) -> Rate {
        Rate { count: self.count, total: self.of }
    }
}

/// Errors of an image against the reference. Figures in linear light are over the pixels that are finite.
/// Displayed values are linear values at exposure 1, clamped to [0, 1], with the sRGB curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageError {
    /// Mean over the pixels of LDR-FLIP of displayed values, 67 pixels per degree, in [0, 1].
    #[serde(default, skip_serializing_if = "absent")]
    pub flip_mean: Option<f64>,
    /// 99th percentile of FLIP over the pixels.
    #[serde(default, skip_serializing_if = "absent")]
    pub flip_p99: Option<f64>,
    /// FLIP of the worst pixel.
    #[serde(default, skip_serializing_if = "absent")]
    pub flip_max: Option<f64>,
    /// Share of the pixels whose FLIP is above 0.1.
    #[serde(default, skip_serializing_if = "absent")]
    pub flip_visible: Option<f64>,
    /// Root of the mean of (R - r)^2 over pixels and channels, linear.
    #[serde(default, skip_serializing_if = "absent")]
    pub rmse: Option<f64>,
    /// Relative mean squared error, the mean of (R - r)^2 / (r^2 + 0.01), linear.
    #[serde(default, skip_serializing_if = "absent")]
    pub relmse: Option<f64>,
    /// Relative mean squared error without the greatest 0.1 % of the terms of `relmse`.
    #[serde(default, skip_serializing_if = "absent")]
    pub relmse_trimmed: Option<f64>,
    /// Mean of R - r, linear.
    #[serde(default, skip_serializing_if = "absent")]
    pub bias: Option<f64>,
    /// Standard error of `bias` if pixels err independently.
    #[serde(default, skip_serializing_if = "absent")]
    pub bias_sigma: Option<f64>,
    /// Peak signal-to-noise ratio, 10 log10(1 / MSE) of displayed values, decibels; absent also where the
    /// images are equal.
    #[serde(default, skip_serializing_if = "absent")]
    pub psnr: Option<f64>,
    /// Mean structural similarity of displayed luma in windows of 11 x 11 pixels with sigma 1.5; 1 for equal
    /// images.
    #[serde(default, skip_serializing_if = "absent")]
    pub ssim: Option<f64>,
    /// Number of pixels with a channel that is NaN or infinite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub non_finite: Option<u64>,
}

/// Target of a hard case and whether a run meets it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HardRecord {
    /// Identifier of the case.
    pub id: String,
    /// Description of the case, one line.
    pub title: String,
    /// Quantity that is measured.
    pub measure: String,
    /// Demand on structures of this kind.
    pub target: String,
    /// Number of triangles of the case, including those that loaders drop.
    pub triangles: u64,
    /// True if the target was met; absent where one run cannot tell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub met: Option<bool>,
    /// Reason for the verdict.
    pub reason: String,
    /// Number of rays whose answer neither the oracle nor the statement of the case allows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rejected: Option<u64>,
    /// Number of the first rejected ray, for `--replay`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_rejected: Option<u64>,
    /// Number of rays that a watertight test cannot miss but that got no hit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lost: Option<u64>,
}
