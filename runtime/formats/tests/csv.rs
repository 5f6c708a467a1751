//! Surveys as text: the two cuts of ETOPO5, local metres, and everything that can be wrong with a file.

#![expect(clippy::unwrap_used, reason = "a test whose survey cannot be read has failed")]

use albacore_formats::Fault;
use albacore_formats::survey::{CELLS_MAX, FILE_BYTES_MAX, Kind, Survey, read};
use albacore_geometry::math::degrees;

/// Two rows of three cells in metres.
const SMALL: &str = "# east 0..20 n=3 north -5..5 n=2 metres\n-1,-2,-3\n-4,-5.5,6\n";

/// The cut of the Challenger Deep.
const MARIANA: &str = include_str!("../../../missions/bathymetry/mariana.csv");

fn faults(text: &str) -> Vec<Fault> {
    read(text.as_bytes()).unwrap_err().faults
}

/// A file that has one fault, which says this and offers a mend.
#[track_caller]
fn wrong(text: &str, expected: &str) {
    let faults = faults(text);
    assert!(matches!(faults.as_slice(), [only] if only.message == expected && !only.help.is_empty()), "{faults:#?}");
}

fn cut(name: &str) -> Survey {
    let path = format!("{}/../../missions/bathymetry/{name}", env!("CARGO_MANIFEST_DIR"));
    read(&std::fs::read(path).unwrap()).unwrap()
}

fn deepest(survey: &Survey) -> f64 {
    survey.depths.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// A cell under water is a local minimum of the bottom if none of its eight neighbours is as deep.
fn hollows(survey: &Survey) -> usize {
    let (rows, columns) = (survey.north.count as usize, survey.east.count as usize);
    let at = |row: usize, column: usize| survey.depths[row * columns + column];
    let is_hollow = |row: usize, column: usize| {
        let around = (row - 1..=row + 1).flat_map(|r| (column - 1..=column + 1).map(move |c| (r, c)));
        at(row, column) > 0.0 && around.filter(|cell| *cell != (row, column)).all(|(r, c)| at(r, c) < at(row, column))
    };
    (1..rows - 1).flat_map(|row| (1..columns - 1).map(move |c| (row, c))).filter(|(r, c)| is_hollow(*r, *c)).count()
}

#[test]
fn the_cuts_of_etopo5_are_what_their_origin_says() {
    let mariana = cut("mariana.csv");
    assert_eq!((mariana.kind, mariana.north.count, mariana.east.count), (Kind::Geodetic, 49, 60));
    assert_eq!((deepest(&mariana), hollows(&mariana)), (10_376.0, 31));
    assert!((degrees(mariana.north.last) - 14.0).abs() < 1e-12);
    let maine = cut("gulf_of_maine.csv");
    assert_eq!((maine.north.count, maine.east.count, hollows(&maine)), (43, 60, 49));
    assert_eq!((maine.depths[0], maine.depths[59], maine.depths[60]), (49.0, 2302.0, 46.0));
}

#[test]
fn a_survey_in_metres_keeps_its_places_and_turns_elevations_into_depths() {
    let survey = read(SMALL.as_bytes()).unwrap();
    assert_eq!(
        (survey.kind, survey.north.first, survey.north.last, survey.east.step()),
        (Kind::Local, -5.0, 5.0, 10.0)
    );
    assert_eq!(survey.depths, [1.0, 2.0, 3.0, 4.0, 5.5, -6.0]);
    let depths = read(SMALL.replace("metres", "depth in metres").as_bytes()).unwrap().depths;
    assert_eq!(depths, [-1.0, -2.0, -3.0, -4.0, -5.5, 6.0]);
}

#[test]
fn remarks_blank_lines_and_the_line_ends_of_others_count_for_nothing() {
    let dressed = SMALL.replace("\n-4", "\n\n# a remark\n -4 ").replace('\n', "\r\n");
    assert_eq!(read(format!("\u{feff}{dressed}\r\n").as_bytes()), read(SMALL.as_bytes()));
}

#[test]
fn rows_and_cells_that_are_too_many_or_too_few_are_counted() {
    wrong(&SMALL.replace("-1,-2,-3", "-1,-2"), "line 2 has 2 cells, and the head says n=3");
    wrong(&SMALL.replace("5.5,6", "5.5,6,7"), "line 3 has 4 cells, and the head says n=3");
    wrong(&SMALL.replace("-4,-5.5,6\n", ""), "there is 1 row, and the head says n=2");
    wrong(&format!("{SMALL}1,2,3\n4,5,6"), "there are 4 rows, and the head says n=2");
}

#[test]
fn cells_that_hold_nothing_or_no_number_are_named() {
    wrong(&SMALL.replace("-5.5", "NaN"), "line 3, cell 2: `NaN` is no data");
    wrong(&SMALL.replace("-5.5", "inf"), "line 3, cell 2: `inf` is no data");
    wrong(&SMALL.replace("-5.5", ""), "line 3, cell 2 is empty");
    wrong(&SMALL.replace("-5.5", "-99999"), "line 3, cell 2: -99999 m is neither water nor land on earth");
    wrong(&SMALL.replace("-5.5", "5m"), "line 3, cell 2: `5m` is no number");
    wrong(
        &SMALL.replace("metres", "metres nodata=-999").replace("-5.5", "-999.0"),
        "line 3, cell 2: `-999.0` is no data",
    );
}

#[test]
fn a_mark_that_nobody_declared_is_known_by_standing_apart() {
    let apart = "line 3, cell 2: -9999 lies far from the cells about it, as a mark for no data does";
    wrong(&SMALL.replace("-5.5", "-9999"), apart);
    wrong(&SMALL.replace("-5.5", "-9999.00").replace("metres", "metres nodata=-1e9"), apart);
    let help = faults(&SMALL.replace("-5.5", "-9999")).remove(0).help;
    assert!(help.contains("`nodata=-9999`") && help.contains("`nodata=none`"), "{help}");
    let meant = read(SMALL.replace("-5.5", "-9999").replace("metres", "metres nodata=none").as_bytes());
    assert_eq!(meant.unwrap().depths[4], 9_999.0);
    let down = SMALL.replace("metres", "depth in metres");
    wrong(&down.replace("-5.5", "9999"), &apart.replace("-9999", "9999"));
    // After a row that cannot be read the others keep their lines.
    let found = faults("# east 0..1 n=2 north 0..2 n=3 metres\n-1\n\n-2,x\n-3,-9999\n");
    let found: Vec<&str> = found.iter().map(|fault| fault.message.as_str()).collect();
    let apart = "line 5, cell 2: -9999 lies far from the cells about it, as a mark for no data does";
    assert_eq!(found, ["line 2 has 1 cell, and the head says n=2", "line 4, cell 2: `x` is no number", apart]);
}

#[test]
fn a_remark_does_not_turn_the_bottom_upside_down() {
    wrong(&SMALL.replace("metres", "metres, sounded by the depth sounder"), "line 1 says `depth`, but not of what");
    wrong(&SMALL.replace("metres", "metres depth"), "line 1 says `depth`, but not of what");
    for said in ["depth metres", "Depths in Metres", "depth in m"] {
        assert_eq!(read(SMALL.replace("metres", said).as_bytes()).unwrap().depths[0], -1.0, "{said}");
    }
    wrong("# east 0..1 n=2 north 0..1 n=2 metres\n1,2\n3,4\n", "no cell lies under water");
}

/// Where the bottom reaches as deep as a mark, one is known by the cells about it, and a depth too.
#[test]
fn a_lone_mark_in_a_real_grid_is_known_by_its_neighbours() {
    let with = |line: usize, cell: usize, value: &str| {
        let mut rows: Vec<Vec<&str>> = MARIANA.lines().map(|row| row.split(',').collect()).collect();
        rows[line - 1][cell - 1] = value;
        rows.iter().map(|row| row.join(",") + "\n").collect::<String>()
    };
    wrong(
        &with(22, 31, "-9999"),
        "line 22, cell 31: -9999 lies far from the cells about it, as a mark for no data does",
    );
    wrong(&with(22, 31, "-999"), "line 22, cell 31: -999 lies far from the cells about it, as a mark for no data does");
    // In the trench the cells about it are of -9414 to -10153 m.
    assert_eq!(read(with(19, 31, "-9999").as_bytes()).unwrap().depths[17 * 60 + 30], 9_999.0);
}

#[test]
fn an_axis_that_descends_is_mended_in_the_head() {
    let found = faults(&SMALL.replace("0..20", "20..0"));
    let mend = "give the smaller end first: rows run from south to north, the cells of a row from west to east";
    assert_eq!(found.iter().map(|fault| fault.help.as_str()).collect::<Vec<_>>(), [mend]);
}

/// A file that is one long word gets a message of a line.
#[test]
fn messages_do_not_grow_with_the_file() {
    let long = "7".repeat(1_000_000);
    for text in [
        SMALL.replace("metres", &format!("metres nodata={long}x")),
        SMALL.replace("-5.5", &long),
        SMALL.replace("-5.5", &format!("{long}x")),
        SMALL.replace("metres", &format!("metres nodata={long}")).replace("-5.5", &long),
        SMALL.replace("n=3", &format!("n={long}")),
        SMALL.replace("0..20", &format!("{long}..20")),
    ] {
        for Fault { message, help } in faults(&text) {
            assert!(message.len() < 200 && help.len() < 200, "{message}: {help}");
        }
    }
}

#[test]
fn all_faults_are_told_at_once_but_not_without_end() {
    let found = faults(&SMALL.replace("-2", "two").replace("-5.5", "nan").replace("n=2", "n=3"));
    let found: Vec<&str> = found.iter().map(|fault| fault.message.as_str()).collect();
    assert_eq!(
        found,
        [
            "line 2, cell 2: `two` is no number",
            "line 3, cell 2: `nan` is no data",
            "there are 2 rows, and the head says n=3"
        ]
    );
    let many = format!("# east 0..1 n=2 north 0..99 n=100 metres\n{}", "a,b\n".repeat(100));
    let found = faults(&many);
    let told = "line 2, cell 1: `a` is no number; line 2, cell 2: `b` is no number; line 3, cell 1: `a` is no number; \
         and 197 more such";
    assert_eq!((found.len(), found[0].message.as_str()), (1, told));
}

#[test]
fn heads_that_say_too_little_or_what_cannot_be() {
    wrong("1,2\n3,4\n", "line 1 is no head line: nothing tells where the cells lie");
    wrong("", "the file is empty");
    wrong("# metres\n1,2\n", "line 1 gives no `lat` or `north`");
    wrong(&SMALL.replace(" metres", ""), "line 1 does not say in which unit the depths are");
    for unit in ["feet", "fathoms", "yards", "mm", "centimetres", "centimeters", "decimeter", "Kilometres"] {
        wrong(&SMALL.replace("metres", unit), &format!("line 1 says `{unit}`: depths are read in metres"));
        let said = format!("metres, elevations in [{unit}]");
        wrong(&SMALL.replace("metres", &said), &format!("line 1 says `[{unit}]`: depths are read in metres"));
    }
    wrong(&SMALL.replace("n=3 ", "n=x "), "line 1: `east` is not followed by its ends and its count");
    // Which of the two points is the one of the number?
    wrong(&SMALL.replace("0..20", "0...5"), "line 1: `east` is not followed by its ends and its count");
    let n = SMALL.replace("n=3", "n=18446744073709551615");
    wrong(&n, &format!("`east` has 18446744073709551615 places: {CELLS_MAX} cells are read at most"));
    wrong(&SMALL.replace("0..20", "0..1e308"), "the survey runs eastward from 0 to 1e308 metres");
    wrong(&SMALL.replace("0..20", "0..1e-320"), "the survey's places lie 5e-321 m apart eastward");
    wrong(&SMALL.replace('\n', "\r"), "the file is one line: it ends its lines with carriage returns alone");
    wrong(&SMALL.replace("0..20", "20..0"), "`east` runs from 20 to 0: it must ascend");
    wrong(&SMALL.replace("0..20", "0..inf"), "`east` runs from 0 to inf");
    wrong(&SMALL.replace("0..20 n=3", "0..20 n=1"), "`east` has 1 place: a grid has two or more");
    wrong(&SMALL.replace("east", "lon"), "line 1 mixes degrees and metres: `north` and `lon`");
    wrong(&SMALL.replace("metres", "metres east 0..9 n=2"), "line 1 gives two axes such as `east`");
    wrong(
        &SMALL.replace("metres", "metres nodata=-9999 nodata=none"),
        "line 1 says `nodata=` twice, then `nodata=none`",
    );
    wrong(
        &SMALL.replace("metres", "metres, rows north->south"),
        "line 1 says `north->south`: rows run from south to north",
    );
    wrong("# lon 0..20 n=3 lat 80..95 n=2 metres\n1,2,3\n4,5,6\n", "latitudes run from 80 to 95 degrees");
    wrong("# lon 0..2000 n=3 lat 80..85 n=2 metres\n1,2,3\n4,5,6\n", "longitudes run from 0 to 2000 degrees");
}

#[test]
fn sizes_beyond_the_limits_are_refused_before_anything_is_made() {
    wrong(
        "# east 0..9e6 n=4000000 north 0..9e6 n=4000000 metres\n1,2\n",
        &format!("the grid has 4000000 rows of 4000000 cells: {CELLS_MAX} cells are read at most"),
    );
    let large = vec![b' '; FILE_BYTES_MAX as usize + 1];
    assert_eq!(read(&large).unwrap_err().faults[0].message, "the file has 40.0 MB: 40 MB are read at most");
    // What the head promises and the file does not hold takes no room.
    wrong("# east 0..9 n=2000 north 0..9 n=2000 metres\n", "there are 0 rows, and the head says n=2000");
}

#[test]
fn files_of_other_kinds_are_told_by_their_name() {
    let of = |bytes: &[u8]| read(bytes).unwrap_err().faults.remove(0);
    let hdf = of(b"\x89HDF\r\n\x1a\n\0\0\0");
    assert!(hdf.message.contains("HDF5") && hdf.help.contains("nccopy -k classic"), "{hdf:?}");
    let behind = [vec![0; 1024], b"\x89HDF\r\n\x1a\n\0\0".to_vec()].concat();
    assert!(of(&behind).message.contains("HDF5"), "behind a block of the user's own");
    assert!(of(b"NCOLS 4\nnrows 3\n").message.contains("Esri ASCII"));
    assert!(of(b"CDF\x05\0\0\0\0").help.contains("nccopy -k classic"));
    assert!(of(b"II*\0rest").message.contains("TIFF"));
    assert!(of(b"ncols 4\nnrows 3\n").message.contains("Esri ASCII"));
    assert_eq!(of(b"# a\n\xff\xfe\n").message, "byte 4, on line 2, is no text in UTF-8: neither CSV nor NetCDF");
}

#[test]
fn a_text_cut_anywhere_is_refused_or_ends_within_its_last_number() {
    let whole = read(SMALL.as_bytes()).unwrap();
    for end in 0..SMALL.len() - 2 {
        assert!(read(&SMALL.as_bytes()[..end]).is_err(), "cut at byte {end}");
    }
    assert_eq!(read(SMALL.trim_end().as_bytes()).unwrap(), whole);
}

/// Every byte replaced by every other: what was read of it is whole.
#[test]
fn a_text_with_any_byte_changed_is_read_or_refused_without_harm() {
    for at in 0..SMALL.len() {
        for flip in 1..=255 {
            let mut changed = SMALL.as_bytes().to_vec();
            changed[at] ^= flip;
            match read(&changed) {
                Ok(survey) => {
                    assert_eq!(survey.depths.len() as u32, survey.north.count * survey.east.count);
                    assert!(survey.depths.iter().all(|depth| depth.is_finite()));
                }
                Err(unreadable) => {
                    assert!(unreadable.faults.iter().all(|f| !f.message.is_empty() && !f.help.is_empty()))
                }
            }
        }
    }
}

/// The mend that is offered, applied, mends.
#[test]
fn a_bottom_that_is_all_land_is_turned_round() {
    for (head, cells, mend, mended) in [
        ("metres", "1,2\n3,4", "`depth in metres`", "depth in metres"),
        ("depth in metres", "-1,-2\n-3,-4", "`metres` alone", "metres"),
    ] {
        let text = |head: &str| format!("# east 0..1 n=2 north 0..1 n=2 {head}\n{cells}\n");
        wrong(&text(head), "no cell lies under water");
        assert!(faults(&text(head))[0].help.contains(mend), "{head}");
        assert_eq!(read(text(mended).as_bytes()).unwrap().depths, [1.0, 2.0, 3.0, 4.0]);
    }
}

#[test]
fn ends_of_an_axis_are_two_places() {
    let text = "# lon -75.75..-75.75 n=2 lat 10..12 n=2 metres\n-1,-2\n-3,-4\n";
    wrong(text, "`lon` runs from -75.75 to -75.75: these are one place");
    assert!(faults(text)[0].help.contains("of the first cell and of the last"));
}
