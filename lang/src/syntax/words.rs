//! The words of the grammar that mean nothing by themselves: the tree has no place for them.

use super::Rule;

pub(super) fn is_word(rule: Rule) -> bool {
    use Rule::*;
    matches!(
        rule,
        kw_abort
            | kw_after
            | kw_and
            | kw_at
            | kw_becomes
            | kw_behavior
            | kw_by
            | kw_const
            | kw_do
            | kw_else
            | kw_enum
            | kw_fn
            | kw_for
            | kw_if
            | kw_in
            | kw_keep
            | kw_let
            | kw_log
            | kw_loop
            | kw_match
            | kw_memory
            | kw_mission
            | kw_no
            | kw_not
            | kw_of
            | kw_on
            | kw_or
            | kw_overlay
            | kw_override
            | kw_record
            | kw_report
            | kw_scenario
            | kw_signal
            | kw_start
            | kw_strategy
            | kw_test
            | kw_then
            | kw_toward
            | kw_until
            | kw_watch
            | kw_use
            | kw_var
            | kw_while
            | kw_with
            | kw_within
            | w_amend
            | w_area
            | w_back
            | w_clause
            | w_vehicle
            | w_expect
            | w_first
            | w_fresh
            | w_input
            | w_limits
            | w_recovery
            | w_requires
            | w_run
            | w_runs
            | w_seed
            | w_seeds
            | w_snapshot
            | w_switches
            | w_unit
            | arrow
            | entry_end
    )
}
