//! The mission that the benchmark holds the machine against, written by hand, does the same to the bit: else there would be
//! nothing to compare.

#![expect(clippy::unwrap_used, reason = "a test whose mission cannot run has failed")]

#[path = "../benches/tick/hand_written/mod.rs"]
#[expect(dead_code, reason = "the benchmark needs all of it")]
mod hand_written;
#[path = "../benches/tick/recording.rs"]
#[expect(dead_code, reason = "the benchmark needs all of it")]
mod recording;

use hand_written::Mission;
use recording::Recording;

#[test]
fn machine_and_hand_give_the_same_commands() {
    let recording = Recording::new("missions/duck_single_2005.alb", "cpt_2005");
    assert!(recording.snapshots.len() - recording.begin > 3000);
    let mut mission = Mission::new().unwrap();
    for (tick, (snapshot, command)) in recording.snapshots.iter().zip(&recording.commands).enumerate() {
        assert_eq!(mission.step(snapshot), *command, "tick {tick}");
    }
}
