//! The numbered rules of time, each shown by small scripts whose behavior traces are the snapshots.
//!
//! A new script's trace is read against its rule before it is accepted: `cargo insta review`.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Plan, Run, Running, load};
use std::path::Path;

/// No rule needs more ticks than this to be shown.
const TICKS_MAX: u64 = 1_000;

#[test]
fn rules() {
    insta::glob!("rules/*.alb", |path| {
        let path = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
        insta::assert_snapshot!(events(path));
    });
}

/// What happens when the only mission of a script runs, without samples and digest: only order and time matter here.
fn events(path: &Path) -> String {
    let script = load(path, None, &[]).unwrap();
    assert!(script.is_sound(), "{}: {:#?}", path.display(), script.findings);
    let plan = Plan::new(&script, &path.display().to_string(), None, None).unwrap();
    let mut run = Run::new(&plan, 1).unwrap();
    while run.step() == Running::On {
        assert!(run.tick() < TICKS_MAX, "{} does not end", path.display());
    }
    run.trace().switches()
}
