//! Mix-ups in sound scripts, each of a kind that a type, a range or a limit can tell: all are refused, where they
//! were made, in words that the snapshot shows.
//!
//! What no type can tell is left out by construction, and named in `docs/mix-ups.md`.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

mod mutate;
mod slips;

use albacore_session::{Diagnostic, Severity, load};
use mutate::{Edit, Kind, Text};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// So many mix-ups of all kinds together.
const MIXUPS: usize = 182;

/// The sound scripts: of the standard library those that hold code, the missions, the gallery, and two written for the purpose.
const SCRIPTS: [&str; 31] = [
    "stdlib/amp.alb",
    "stdlib/bathymetry.alb",
    "stdlib/calendar.alb",
    "stdlib/cpt.alb",
    "stdlib/features.alb",
    "stdlib/filters.alb",
    "stdlib/maneuver.alb",
    "stdlib/maps.alb",
    "stdlib/safety.alb",
    "stdlib/search.alb",
    "missions/box.alb",
    "missions/deepest_point.alb",
    "missions/duck_single.alb",
    "missions/duck_single_2005.alb",
    "missions/gallery/boundary_transects.alb",
    "missions/gallery/docking.alb",
    "missions/gallery/four_regions.alb",
    "missions/gallery/infotaxis.alb",
    "missions/gallery/isobath.alb",
    "missions/gallery/lawn_mower_and_record.alb",
    "missions/gallery/leader_follower.alb",
    "missions/gallery/median_of_five.alb",
    "missions/gallery/pid_low_pass.alb",
    "missions/gallery/sample_every_20_min.alb",
    "missions/gallery/sampler_beside_a_survey.alb",
    "missions/gallery/surge_cast.alb",
    "missions/gallery/three_point_reacquire.alb",
    "missions/gallery/tide_start.alb",
    "missions/gallery/waypoint_table.alb",
    "tests/mixups/stations.alb",
    "tests/mixups/transect.alb",
];

#[test]
fn sound_scripts_are_sound() {
    for script in SCRIPTS {
        let loaded = load(Path::new(script), None, &[]).unwrap();
        assert!(loaded.findings.is_empty(), "{script}: {:#?}", loaded.findings);
    }
}

#[test]
fn mix_ups_are_refused() {
    let texts: Vec<Text> = SCRIPTS.iter().map(|path| Text::new(path, std::fs::read_to_string(path).unwrap())).collect();
    let mut shown = String::new();
    let mut missed = String::new();
    let mut count = 0;
    for (kind, wanted) in Kind::ALL {
        let edits = mutate::choose(kind, &texts, wanted);
        assert_eq!(edits.len(), wanted, "there are too few places for {kind:?}");
        writeln!(shown, "## {}\n", kind.title()).unwrap();
        for edit in edits {
            count += 1;
            let text = &texts[edit.text];
            match refused(text, &edit) {
                Some(finding) => show(&mut shown, text, &edit, &finding),
                None => writeln!(missed, "{kind:?}: {}", place(text, &edit)).unwrap(),
            }
        }
    }
    assert_eq!(count, MIXUPS);
    assert!(missed.is_empty(), "not refused where they were made:\n{missed}");
    insta::assert_snapshot!(shown);
}

/// The error that a mix-up gives on its own line.
fn refused(text: &Text, edit: &Edit) -> Option<Diagnostic> {
    let path = scratch(text.path);
    std::fs::write(&path, text.with(edit)).unwrap();
    let script = load(&path, None, &[]).unwrap();
    let name = path.display().to_string();
    let is_here = |f: &&Diagnostic| {
        let mut labels = f.labels.iter().map(|(span, _)| *span);
        labels
            .any(|span| *script.sources.get(span.file).name == *name && script.sources.line_column(span).0 == edit.line)
    };
    script.findings.iter().filter(|f| f.severity == Severity::Error).find(is_here).cloned()
}

/// Each script has a folder of its own, and keeps its name: missions are found by it.
fn scratch(path: &str) -> PathBuf {
    let path = Path::new(path);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mixups").join(path.file_stem().unwrap());
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(path.file_name().unwrap())
}

fn place(text: &Text, edit: &Edit) -> String {
    let mutated = text.with(edit);
    format!("{}:{}: {}", text.path, edit.line, mutated.lines().nth(edit.line - 1).unwrap().trim())
}

fn show(shown: &mut String, text: &Text, edit: &Edit, finding: &Diagnostic) {
    let labels: Vec<&str> =
        finding.labels.iter().map(|(_, text)| text.as_str()).filter(|text| !text.is_empty()).collect();
    writeln!(shown, "{}   [{} -> {}]", place(text, edit), edit.from, edit.to).unwrap();
    writeln!(shown, "    × {} ({})", finding.message, labels.join(", ")).unwrap();
    writeln!(shown, "    = {}\n", finding.help.as_deref().unwrap_or("NO HELP")).unwrap();
}
