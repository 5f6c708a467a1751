//! Surveys in NetCDF classic: files that other software made, every fault that they may have, and bytes at random.

#![expect(clippy::unwrap_used, reason = "a test whose survey cannot be read has failed")]

mod writer;

use albacore_formats::survey::{CELLS_MAX, Kind, Survey, read};
use albacore_formats::{Fault, Unreadable};
use writer::File;
use writer::Values::{Doubles, Floats, Shorts, Text};

fn data(name: &str) -> Vec<u8> {
    std::fs::read(format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn csv_cut() -> Survey {
    let path = format!("{}/../../missions/bathymetry/gulf_of_maine.csv", env!("CARGO_MANIFEST_DIR"));
    read(&std::fs::read(path).unwrap()).unwrap()
}

fn faults(file: &File) -> Vec<Fault> {
    read(&file.bytes(1)).unwrap_err().faults
}

/// A file that has one fault, which says this and offers a mend.
#[track_caller]
fn wrong(file: File, expected: &str) {
    let faults = faults(&file);
    assert!(matches!(faults.as_slice(), [only] if only.message == expected && !only.help.is_empty()), "{faults:#?}");
}

/// What scipy and the netCDF library wrote (tests/data/make.py) is what the CSV says.
#[test]
fn files_that_other_software_made_are_read() {
    let cut = csv_cut();
    for name in ["gulf_of_maine.nc", "gulf_of_maine_packed.nc"] {
        let survey = read(&data(name)).unwrap();
        assert_eq!((survey.kind, &survey.depths), (Kind::Geodetic, &cut.depths), "{name}");
        assert_eq!((survey.north.count, survey.east.count), (43, 60));
        let off = [survey.north.first - cut.north.first, survey.east.last - cut.east.last];
        assert!(
            off.iter().all(|off| off.abs() < 2.7e-7),
            "{name}: half a unit of single precision about 290 degrees: {off:?}"
        );
    }
    let metres = read(&data("metres.nc")).unwrap();
    assert_eq!((metres.kind, metres.north.first, metres.east.last), (Kind::Local, -15.0, 40.0));
    assert_eq!(metres.depths, (0..20).map(f64::from).collect::<Vec<_>>());
    let hdf5 = read(&data("metres_hdf5.nc")).unwrap_err().faults.remove(0);
    assert!(hdf5.message.contains("HDF5") && hdf5.help.contains("nccopy -k classic"), "{hdf5:?}");
}

#[test]
fn both_versions_of_the_format_say_the_same() {
    let survey = read(&File::small().bytes(1)).unwrap();
    assert_eq!(survey.depths, [1.0, 2.0, 3.0, 4.0, 5.5, -6.0]);
    assert_eq!(read(&File::small().bytes(2)), Ok(survey));
}

#[test]
fn scale_offset_and_sense_are_honoured() {
    let packed = |attributes: &[(&'static str, writer::Values)]| {
        let file = File::small().with("elevation", |v| {
            v.values = Shorts(vec![2, 4, 6, 8, 10, -2]);
            v.attributes.extend_from_slice(attributes);
        });
        read(&file.bytes(1)).unwrap().depths
    };
    assert_eq!(packed(&[]), [-2.0, -4.0, -6.0, -8.0, -10.0, 2.0]);
    let scale = ("scale_factor", Doubles(vec![0.5]));
    let offset = ("add_offset", Doubles(vec![-100.0]));
    assert_eq!(packed(&[scale.clone(), offset]), [99.0, 98.0, 97.0, 96.0, 95.0, 101.0]);
    assert_eq!(packed(&[scale, ("positive", Text("down"))]), [1.0, 2.0, 3.0, 4.0, 5.0, -1.0]);
    assert_eq!(packed(&[("standard_name", Text("sea_floor_depth_below_sea_surface"))])[0], 2.0);
}

#[test]
fn no_data_is_named_whatever_stands_for_it() {
    let shorts = |fill: &[(&'static str, writer::Values)], cell: i16| {
        File::small().with("elevation", |v| {
            v.values = Shorts(vec![-1, -2, -3, -4, cell, -6]);
            v.attributes.extend_from_slice(fill);
        })
    };
    let filled = |value| ("_FillValue", Shorts(vec![value]));
    wrong(shorts(&[filled(-999)], -999), "`elevation(1, 1)` is no data (-999)");
    wrong(shorts(&[("missing_value", Doubles(vec![-998.0, -999.0]))], -998), "`elevation(1, 1)` is no data (-998)");
    wrong(shorts(&[], -32_767), "`elevation(1, 1)` is no data (-32767)");
    wrong(shorts(&[], 9_999), "`elevation(1, 1)` is 9999: neither water nor land on earth");
    wrong(
        numbers(Doubles(vec![-1.0, -2.0, -3.0, -4.0, 1e300, -6.0]), &[]),
        "`elevation(1, 1)` is 1e300: neither water nor land on earth",
    );
    let not_a_number =
        File::small().with("elevation", |v| v.values = Doubles(vec![-1.0, f64::NAN, -3.0, 0.0, 0.0, 0.0]));
    wrong(not_a_number, "`elevation(0, 1)` is no data (NaN)");
}

/// One damage is one fault: the first cells are named, and the others counted.
#[test]
fn cells_of_one_damage_are_told_together() {
    let damage = Doubles(vec![f64::NAN, f64::NAN, f64::NAN, f64::NAN, 1e300, f64::NAN]);
    let found = faults(&numbers(damage, &[]));
    let found: Vec<&str> = found.iter().map(|fault| fault.message.as_str()).collect();
    let nothing = "`elevation(0, 0)` is no data (NaN); `elevation(0, 1)` is no data (NaN); `elevation(0, 2)` is no data \
         (NaN); and 2 more such";
    assert_eq!(found, [nothing, "`elevation(1, 1)` is 1e300: neither water nor land on earth"]);
}

/// The small file with other numbers, and what is said of them beside their unit.
fn numbers(values: writer::Values, said: &[(&'static str, writer::Values)]) -> File {
    File::small().with("elevation", |v| {
        v.values = values;
        v.attributes.extend_from_slice(said);
    })
}

#[test]
fn a_mark_that_nobody_declared_is_known_by_standing_apart() {
    let cells = |mark: f64| Doubles(vec![-12.0, -14.0, -16.0, -12.0, mark, -13.0]);
    let apart =
        |mark: f64| format!("`elevation(1, 1)` is {mark}: far from the cells about it, as a mark for no data is");
    wrong(numbers(cells(-9_999.0), &[]), &apart(-9_999.0));
    wrong(numbers(cells(-999.0), &[]), &apart(-999.0));
    let down = Doubles(vec![12.0, 14.0, 16.0, 12.0, 9_999.0, 13.0]);
    wrong(numbers(down, &[("positive", Text("down"))]), &apart(9_999.0));
    let help = faults(&numbers(cells(-9_999.0), &[])).remove(0).help;
    assert!(help.contains("`ncatted -a _FillValue,elevation,o,d,-9999 FILE.nc`"), "{help}");
    // Another mark that is declared says nothing of this one; a range in which it lies does.
    wrong(numbers(cells(-9_999.0), &[("_FillValue", Doubles(vec![f64::NAN]))]), &apart(-9_999.0));
    let range = ("valid_range", Doubles(vec![-11_000.0, 9_000.0]));
    assert_eq!(read(&numbers(cells(-9_999.0), &[range]).bytes(1)).unwrap().depths[4], 9_999.0);
    // Packed, a mark of the stored numbers is a depth like any.
    let packed = Shorts(vec![-120, -140, -160, -120, -32_768, -130]);
    wrong(numbers(packed, &[("scale_factor", Doubles(vec![0.1]))]), &apart(-32_768.0));
    let halves = Shorts(vec![-24, -28, -32, -24, -19_998, -26]);
    wrong(numbers(halves, &[("scale_factor", Doubles(vec![0.5]))]), &apart(-19_998.0));
}

/// In the Gulf of Maine the water is as deep as this mark, but not beside the shore.
#[test]
fn a_lone_mark_in_a_real_grid_is_known_by_its_neighbours() {
    let mut bytes = data("gulf_of_maine.nc");
    let row = [-1.0_f32, -11.0, -1.0, -10.0].map(f32::to_be_bytes).concat();
    let at = bytes.windows(row.len()).position(|window| window == row).unwrap() + 4;
    bytes[at..at + 4].copy_from_slice(&(-999.0_f32).to_be_bytes());
    let found = read(&bytes).unwrap_err().faults;
    let expected = "`elevation(18, 1)` is -999: far from the cells about it, as a mark for no data is";
    assert!(found.len() == 1 && found[0].message == expected, "{found:#?}");
}

/// NetCDF Users Guide, appendix A.
#[test]
fn a_valid_range_is_honoured_as_it_is_stored_or_as_it_is_meant() {
    let cells = || Shorts(vec![-10, -20, -30, -10, -90, -30]);
    let outside = "`elevation(1, 1)` is no data: -90 is outside its valid range";
    wrong(numbers(cells(), &[("valid_range", Shorts(vec![-50, 0]))]), outside);
    wrong(numbers(cells(), &[("valid_min", Shorts(vec![-50]))]), outside);
    wrong(numbers(cells(), &[("valid_max", Doubles(vec![100.0])), ("valid_min", Shorts(vec![-89]))]), outside);
    let scale = ("scale_factor", Doubles(vec![0.1]));
    wrong(numbers(cells(), &[scale.clone(), ("valid_min", Shorts(vec![-50]))]), outside);
    wrong(numbers(cells(), &[scale.clone(), ("valid_min", Doubles(vec![-5.0]))]), outside);
    assert!(read(&numbers(cells(), &[scale, ("valid_min", Doubles(vec![-50.0]))]).bytes(1)).is_ok());
    let pair = "`elevation:valid_range` is no pair of numbers that ascend";
    wrong(numbers(cells(), &[("valid_range", Shorts(vec![0, -50]))]), pair);
    wrong(numbers(cells(), &[("valid_range", Shorts(vec![0]))]), pair);
}

#[test]
fn a_text_where_numbers_belong_is_refused() {
    let cells = || Doubles(vec![-10.0, -20.0, -30.0, -10.0, -90.0, -30.0]);
    for name in ["scale_factor", "add_offset", "_FillValue", "missing_value", "valid_range", "valid_min", "valid_max"] {
        let file = numbers(cells(), &[(name, Text("0.1"))]);
        let help = faults(&file).remove(0).help;
        assert_eq!(help, format!("write the number: `ncatted -a {name},elevation,o,d,0.1 FILE.nc`"));
        wrong(file, &format!("`elevation:{name}` is the text `0.1`, where numbers belong"));
        let many = numbers(cells(), &[(name, Doubles(vec![1.0; 100_000]))]);
        wrong(many, &format!("`elevation:{name}` has 100000 values: 16 are the most"));
    }
    wrong(numbers(cells(), &[("scale_factor", Doubles(vec![1.0, 2.0]))]), "`elevation:scale_factor` has 2 values");
    wrong(numbers(Text("abcdef"), &[]), "`elevation` holds text, and no numbers");
}

#[test]
fn whole_numbers_without_a_sign_and_marks_in_another_precision_are_known() {
    let depths = |said: &[(&'static str, writer::Values)]| {
        let said = [&[("positive", Text("down"))], said].concat();
        read(&numbers(Shorts(vec![1, 2, 3, 4, 5, -26_000]), &said).bytes(1))
    };
    assert!(depths(&[]).is_err(), "26 km high");
    let quarter = ("scale_factor", Doubles(vec![0.25]));
    assert_eq!(depths(&[quarter.clone(), ("_Unsigned", Text("true"))]).unwrap().depths[5], 9_884.0);
    let filled = depths(&[quarter, ("_Unsigned", Text("true")), ("_FillValue", Shorts(vec![-26_000]))]);
    assert_eq!(filled.unwrap_err().faults[0].message, "`elevation(1, 2)` is no data (39536)");
    let single = Floats(vec![-10.0, -20.5, -20.1, -10.0, -20.0, -30.0]);
    let found = faults(&numbers(single, &[("missing_value", Doubles(vec![-20.1]))]));
    assert!(found.len() == 1 && found[0].message == "`elevation(0, 2)` is no data (-20.1)", "{found:#?}");
}

/// A file that says much in little room, or little in much, gets a message of a few lines.
#[test]
fn messages_do_not_grow_with_the_file() {
    let long = |letters: usize| -> &'static str { "e".repeat(letters).leak() };
    let units = File::small().with("elevation", |v| v.attributes = vec![("units", Text(long(1_000_000)))]);
    let named = File::small().with("elevation", |v| {
        v.name = long(200);
        v.attributes.clear();
    });
    let sense = numbers(Doubles(vec![-1.0; 6]), &[("positive", Text(long(1_000_000)))]);
    let scale = numbers(Doubles(vec![-1.0; 6]), &[("scale_factor", Text(long(1_000_000)))]);
    // A variable over a thousand dimensions, all of one long name.
    let mut wide = File::small();
    wide.dimensions.push((long(250), 1));
    wide.variables[1].dimensions = vec![2; 1000];
    let mut axis = File::small().with("x", |v| v.name = long(200));
    axis.dimensions[1].0 = long(200);
    axis.variables[1].values = Doubles(vec![3.0, 2.0, 1.0]);
    for file in [units, named, sense, scale, wide, axis] {
        for Fault { message, help } in faults(&file) {
            assert!(message.len() < 600 && help.len() < 400, "{} {}: {message}", message.len(), help.len());
        }
    }
    wrong(
        File::small().with("elevation", |v| v.name = long(300)),
        "the header is wrong before byte 180: the name of a variable is 300 bytes long: 256 are the most",
    );
}

/// An attack: of two of one name the first was taken, and the second lost without a word.
#[test]
fn two_of_one_name_are_refused() {
    let twice = |name: &str| format!("two {name}");
    let mut axes = File::small();
    axes.variables.push(axes.variables[1].clone());
    let mut lengths = File::small();
    lengths.dimensions.push(("x", 5));
    let units = File::small().with("elevation", |v| v.attributes.extend([("units", Text("m")), ("units", Text("ft"))]));
    for (file, what) in [(axes, "variables"), (lengths, "dimensions"), (units, "attributes")] {
        let told = faults(&file);
        assert!(told.iter().any(|fault| fault.message.contains(&twice(what))), "{told:?}");
    }
}

#[test]
fn degrees_in_all_their_spellings() {
    let globe = |lat: &'static str, lon: &'static str| {
        let mut file = File::small();
        file.dimensions = vec![("lat", 2), ("lon", 3)];
        for (variable, (name, units)) in file.variables.iter_mut().zip([("lat", lat), ("lon", lon)]) {
            (variable.name, variable.attributes) = (name, vec![("units", Text(units))]);
        }
        file
    };
    let spellings = [("degree", "degree"), ("degrees", ""), ("degree_N", "degree_E"), ("degreesN", "degreesE")];
    for (lat, lon) in [("degrees_north", "degrees_east"), ("degree_north", "degree_east")].into_iter().chain(spellings)
    {
        assert_eq!(read(&globe(lat, lon).bytes(1)).unwrap().kind, Kind::Geodetic, "{lat} {lon}");
    }
    wrong(
        globe("metres north", "degrees"),
        "`lat` is in `metres north`: it is neither latitude, longitude, nor metres of `y` or `x`",
    );
}

/// A band across the 180th meridian, or across the one of Greenwich, in the numbers that the file has for it.
#[test]
fn longitudes_that_begin_anew_go_on() {
    let band = |places: [f64; 3]| {
        let mut file = File::small();
        file.dimensions = vec![("lat", 2), ("lon", 3)];
        for (variable, (name, units)) in
            file.variables.iter_mut().zip([("lat", "degrees_north"), ("lon", "degrees_east")])
        {
            (variable.name, variable.attributes) = (name, vec![("units", Text(units))]);
        }
        file.with("lon", |v| v.values = Doubles(places.to_vec()))
    };
    let read = |places| read(&band(places).bytes(1)).unwrap();
    assert_eq!(read([179.5, -180.0, -179.5]), read([179.5, 180.0, 180.5]));
    assert_eq!(read([359.5, 0.0, 0.5]), read([-0.5, 0.0, 0.5]));
    wrong(band([0.5, 0.0, -0.5]), "`lon(1)` is 0 after 0.5: it must ascend");
    wrong(band([0.0, 200.0, 400.0]), "longitudes run from 0 to 400 degrees");
}

#[test]
fn a_single_row_and_a_bottom_without_water_are_told_as_what_they_are() {
    let mut row = File::small();
    row.dimensions[0].1 = 1;
    row.variables[0].values = Doubles(vec![3.0]);
    wrong(row, "`y` has 1 place: a grid has two or more");
    let dry = numbers(Doubles(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), &[]);
    assert!(faults(&dry)[0].help.contains("`positive = \"down\"`"));
    wrong(dry, "no cell lies under water");
    let below = Doubles(vec![-1.0, -2.0, -3.0, -4.0, -5.0, -6.0]);
    let down = numbers(below.clone(), &[("positive", Text("down"))]);
    assert!(faults(&down)[0].help.contains("`positive = \"up\"`"));
    wrong(down, "no cell lies under water");
    assert!(read(&numbers(below, &[("positive", Text("up"))]).bytes(1)).is_ok());
    let far = File::small().with("y", |v| v.values = Doubles(vec![0.0, 3e9]));
    wrong(far, "the survey runs northward from 0 to 3000000000 metres");
}

#[test]
fn units_and_sense_that_are_not_known() {
    let units = |variable, units| File::small().with(variable, |v| v.attributes = vec![("units", Text(units))]);
    wrong(units("elevation", "feet"), "`elevation` is in `feet`: depths are read in metres");
    wrong(
        File::small().with("elevation", |v| v.attributes.clear()),
        "`elevation` has no units: depths are read in metres",
    );
    wrong(units("x", "km"), "`x` is in `km`: it is neither latitude, longitude, nor metres of `y` or `x`");
    wrong(units("x", "degrees_east"), "`elevation(y, x)` runs over northing and longitude");
    wrong(
        File::small().with("elevation", |v| v.attributes.push(("positive", Text("sideways")))),
        "`elevation:positive` is `sideways`",
    );
    wrong(
        File::small().with("elevation", |v| v.attributes.push(("scale_factor", Doubles(vec![0.0])))),
        "`elevation:scale_factor` is 0",
    );
}

#[test]
fn axes_that_do_not_ascend_evenly_or_are_not_there() {
    let places = |places: &[f64]| File::small().with("x", |v| v.values = Doubles(places.to_vec()));
    wrong(places(&[20.0, 10.0, 0.0]), "`x(1)` is 10 after 20: it must ascend");
    wrong(places(&[0.0, 10.0, 21.0]), "`x` is not evenly spaced: `x(1)` is 10, evenly it were 10.5");
    wrong(places(&[0.0, f64::NAN, 20.0]), "`x(1)` is NaN");
    assert!(read(&places(&[0.0, 10.02, 20.0]).bytes(1)).is_ok(), "the rounding of single precision");
    let mut without = File::small();
    without.variables.remove(1);
    wrong(without, "the dimension `x` of `elevation` has no variable `x(x)`");
    let mut exchanged = File::small().with("elevation", |v| v.dimensions = vec![1, 0]);
    wrong(exchanged.clone(), "`elevation(x, y)` runs over easting and northing");
    exchanged.variables[2].dimensions = vec![0];
    exchanged.variables[2].values = Doubles(vec![1.0, 2.0]);
    wrong(exchanged, "no variable has two dimensions: the file holds `y(y)`, `x(x)`, `elevation(y)`");
    let mut two = File::small();
    two.variables.push(writer::Variable { name: "roughness", ..two.variables[2].clone() });
    assert!(read(&two.bytes(1)).is_ok(), "one of them has a name for it");
    wrong(
        two.with("elevation", |v| v.name = "smoothness"),
        "which variable is the bottom? There is `smoothness`, `roughness`",
    );
}

#[test]
fn lengths_that_no_file_holds_take_no_room() {
    let mut file = File::small();
    file.dimensions = vec![("y", 2_000_000_000), ("x", 2_000_000_000)];
    let found = faults(&file);
    let both = ["y", "x"].map(|name| format!("`{name}` has 2000000000 values: {CELLS_MAX} are read at most"));
    assert_eq!((found.len(), &found[0].message), (1, &both.join("; ")), "both axes are told");
    file.dimensions = vec![("y", 3_000_000), ("x", 3)];
    let begin = file.bytes(1).len() as u64 - (2 + 3 + 6) * 8;
    let (end, held) = (begin + 24_000_000, file.bytes(1).len());
    assert_eq!(
        faults(&file)[0].message,
        format!("the file is cut off: the 3000000 values of `y` are bytes {begin} to {end}, and it has {held}")
    );
    file.dimensions = vec![("y", 0), ("x", 3)];
    wrong(file, "`y` has `y`, a dimension without a fixed length");
}

/// The header tells that the values come last: without their last byte there is no survey.
#[test]
fn a_file_cut_at_any_byte_is_refused_and_the_place_is_told() {
    for version in [1, 2] {
        let whole = File::small().bytes(version);
        for end in 4..whole.len() {
            let found = read(&whole[..end]).unwrap_err().faults;
            assert!(found.iter().all(|f| f.message.starts_with("the file is cut off: ")), "cut at {end}: {found:?}");
            assert!(found[0].message.ends_with(&format!("and it has {end}")), "{found:?}");
        }
    }
    let whole = data("gulf_of_maine.nc");
    assert!((0..whole.len()).all(|end| read(&whole[..end]).is_err()), "scipy's begins with an even more padded header");
}

/// The room that a survey takes, in numbers.
fn room(read: &Result<Survey, Unreadable>) -> usize {
    read.as_ref().map_or(0, |survey| survey.depths.capacity())
}

/// Every byte replaced by every other: what was read of it is whole, and takes no more room than the file has.
#[test]
fn a_file_with_any_byte_changed_is_read_or_refused_without_harm() {
    for version in [1, 2] {
        let whole = File::small().bytes(version);
        let mut refused = 0;
        for at in 0..whole.len() {
            for flip in 1..=255 {
                let mut changed = whole.clone();
                changed[at] ^= flip;
                let found = read(&changed);
                assert!(room(&found) <= changed.len());
                match found {
                    Ok(survey) => {
                        assert_eq!(survey.depths.len() as u32, survey.north.count * survey.east.count);
                        assert!(survey.depths.iter().all(|depth| depth.is_finite()));
                    }
                    Err(unreadable) => {
                        assert!(unreadable.faults.iter().all(|f| !f.message.is_empty() && !f.help.is_empty()));
                        refused += 1;
                    }
                }
            }
        }
        assert!(refused > whole.len() * 255 / 4, "most changes of a header are noticed: {refused}");
    }
}
