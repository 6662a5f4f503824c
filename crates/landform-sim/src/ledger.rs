//! Budgets: what a process conserves, what crossed each border, and the check that both agree.

use std::collections::BTreeMap;

use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use serde::{Deserialize, Serialize};

use crate::field::{NodeField, stored_values};
use crate::nodes::Space;
use crate::sums::sum;

/// An amount that a process conserves but for what crosses borders.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// Name of the account in the ledger: `sand`, `rock`, `water`.
    pub account: &'static str,
    /// Unit of the amounts.
    pub unit: &'static str,
    /// Largest gap accepted, as a share of the largest total so far.
    pub tolerance: f64,
    /// Measures the amount that is there.
    pub measure: fn(&World) -> f64,
    /// Measures the magnitudes that add up to it: what rounding is compared with where positive
    /// and negative amounts cancel, as those of elevations do.
    pub magnitude: fn(&World) -> f64,
}

impl Budget {
    /// The volume in m³ of a field of thicknesses in metres, conserved to `tolerance`.
    pub fn volume<F: NodeField<Value = f64>>(tolerance: f64) -> Self {
        Self {
            account: F::NAME,
            unit: "m3",
            tolerance,
            measure: volume::<F>,
            magnitude: magnitude::<F>,
        }
    }
}

/// Volume under a field of thicknesses: its sum times the area of a node, in m³.
fn volume<F: NodeField<Value = f64>>(world: &World) -> f64 {
    let area = world.resource::<Space>().spacing().powi(2);
    sum(stored_values::<F>(world)) * area
}

/// Volume above and below zero of a field of heights, in m³.
fn magnitude<F: NodeField<Value = f64>>(world: &World) -> f64 {
    let area = world.resource::<Space>().spacing().powi(2);
    stored_values::<F>(world).iter().map(|value| value.abs()).sum::<f64>() * area
}

/// One account: what was there, what came, what went, what is there.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Account {
    /// Unit of the amounts.
    pub unit: String,
    /// Amount when the stage that opened the account began.
    pub initial: f64,
    /// Amount by the latest measurement.
    pub now: f64,
    /// What came in, by where.
    pub entered: BTreeMap<String, f64>,
    /// What went out, by where.
    pub left: BTreeMap<String, f64>,
    /// Largest gap between measured and expected amount, as a share of the largest total.
    pub largest_gap: f64,
}

impl Account {
    /// Amount that should be there.
    pub fn expected(&self) -> f64 {
        self.initial + self.entered.values().sum::<f64>() - self.left.values().sum::<f64>()
    }
}

/// The accounts of a run by name.
#[derive(Resource, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    accounts: BTreeMap<String, Account>,
}

impl Ledger {
    /// Books an amount that came into `account` at `place` (a border, a source).
    pub fn enter(&mut self, account: &str, place: &str, amount: f64) {
        let entered = &mut self.accounts.entry(account.to_owned()).or_default().entered;
        *entered.entry(place.to_owned()).or_default() += amount;
    }

    /// Books an amount that went out of `account` at `place` (a border, a sink).
    pub fn leave(&mut self, account: &str, place: &str, amount: f64) {
        let left = &mut self.accounts.entry(account.to_owned()).or_default().left;
        *left.entry(place.to_owned()).or_default() += amount;
    }

    /// The accounts by name.
    pub fn accounts(&self) -> &BTreeMap<String, Account> {
        &self.accounts
    }

    /// Opens the account of a budget with the amount that is there. When an earlier stage kept
    /// the account, what changed since is booked to processes that keep no budget.
    pub(crate) fn open(&mut self, budget: &Budget, amount: f64) {
        let opening = Account {
            unit: budget.unit.to_owned(),
            initial: amount,
            now: amount,
            ..Account::default()
        };
        let account = self.accounts.entry(budget.account.to_owned()).or_insert(opening);
        let change = amount - account.expected();
        if change.abs() > budget.tolerance * amount.abs().max(account.initial.abs()) {
            let place = "processes without a budget";
            match change > 0.0 {
                true => self.enter(budget.account, place, change),
                false => self.leave(budget.account, place, -change),
            }
        }
    }

    /// Compares the amount that is there with the books: `Err` holds (expected, measured).
    pub(crate) fn check(
        &mut self,
        budget: &Budget,
        measured: f64,
        magnitude: impl FnOnce() -> f64,
    ) -> Result<(), (f64, f64)> {
        let Some(account) = self.accounts.get_mut(budget.account) else { return Ok(()) };
        let expected = account.expected();
        let turnover = account.initial.abs() + account.entered.values().sum::<f64>();
        let largest = turnover.max(measured.abs()).max(f64::MIN_POSITIVE);
        let mut gap = (measured - expected).abs() / largest;
        if gap > budget.tolerance {
            gap = (measured - expected).abs() / largest.max(magnitude());
        }
        account.now = measured;
        account.largest_gap = account.largest_gap.max(gap);
        if gap <= budget.tolerance { Ok(()) } else { Err((expected, measured)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BUDGET: Budget = Budget {
        account: "sand",
        unit: "m3",
        tolerance: 1e-12,
        measure: |_| 0.0,
        magnitude: |_| 0.0,
    };

    #[test]
    fn books_that_agree_pass_and_a_leak_is_found() {
        let mut ledger = Ledger::default();
        ledger.open(&BUDGET, 100.0);
        ledger.enter("sand", "west border", 5.0);
        ledger.leave("sand", "east border", 2.0);
        assert_eq!(ledger.check(&BUDGET, 103.0, || 0.0), Ok(()));
        assert_eq!(ledger.check(&BUDGET, 102.999, || 0.0), Err((103.0, 102.999)));
        assert_eq!(ledger.accounts()["sand"].now, 102.999);
    }
    #[test]
    fn rounding_is_compared_with_what_cancels() {
        let mut ledger = Ledger::default();
        ledger.open(&BUDGET, 1e-6);
        assert_eq!(ledger.check(&BUDGET, 1.1e-6, || 1e6), Ok(()));
        assert!(ledger.check(&BUDGET, 1.1e-6, || 1.0).is_err());
    }
}
