//! Scenarios of the standard library, as the simulator has them.

use albacore_session::{Plan, Source, load_text};
use albacore_sim::Scenario;

/// A scenario that every script knows, by its name.
pub fn scenario(name: &str) -> Result<Scenario, String> {
    let text = format!("mission idle in {name} within 1 min {{ wait for 1 s }}\n");
    let script = load_text(Source { name: "idle.alb".into(), text: text.into() });
    let plan = Plan::new(&script, "idle.alb", None, None).map_err(|error| format!("`{name}`: {error:?}"))?;
    Ok(Scenario::clone(&plan.scenario))
}
