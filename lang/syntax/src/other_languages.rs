//! Words of other languages, and how ours says what they say.

use albacore_program::Channel;

/// What to write instead of a word that another language would have here.
pub fn help(word: &str) -> Option<&'static str> {
    Some(match word {
        "null" | "nil" | "None" | "nullptr" | "undefined" => "what is absent is `none`",
        "True" | "TRUE" => "write `true`",
        "False" | "FALSE" => "write `false`",
        "break" => "a loop ends by its condition: write `while CONDITION { … }`, or `finish` to leave the behavior",
        "continue" => "put what else the loop does into an `if`: it then goes round by itself",
        "return" => "a function gives its last expression, and a behavior ends with `finish`",
        "sleep" | "pause" | "delay" => "write `wait for 3 s`",
        "print" | "println" | "printf" | "fprintf" | "disp" | "puts" | "echo" => {
            "write `log \"…\"`; a value stands in it between `{` and `}`"
        }
        "elif" | "elsif" | "elseif" => "write `else if`",
        "def" | "func" | "function" => "a function is `fn NAME(x: TYPE) -> TYPE { … }`",
        "class" | "struct" => "a group of values is `record NAME { field: TYPE }`",
        "import" | "include" | "from" => "write `use MODULE` at the top of the file",
        "use" => "`use` stands at the top of the file, at the left margin",
        "switch" | "case" => "write `match VALUE { NAME { … } else { … } }`",
        "pass" => "leave it out: a block may be empty",
        "repeat" => "write `for n in 1..3 { … }`",
        "range" => "a range is written `1..10`, or `0..<10` without its last number: `for n in 1..10 { … }`",
        "mod" | "rem" | "fmod" => "for the remainder of whole numbers write `a - b * floor(a / b)`",
        "len" | "length" | "size" | "numel" => "the number of elements of a list is `LIST.count`",
        "pi" | "PI" => "angles have units: half a turn is `180 deg`",
        "now" | "time" | "clock" | "date" | "today" | "timestamp" => {
            "the mission's time is `elapsed`, and the date `utc`; `after 5 min` holds from five minutes after the entry on, as in `until after 5 min`"
        }
        "rand" | "random" => "nothing in a mission is left to chance: the same script does the same",
        "int" | "float" | "double" | "string" | "bool" | "auto" | "local" => {
            "write `let NAME = VALUE`: its type is that of the value"
        }
        "fn" | "strategy" | "mission" | "overlay" | "scenario" | "record" | "enum" => {
            "what is declared with it stands at the left margin, outside every block"
        }
        "const" => "`const` stands at the left margin; in a block write `let`",
        "when" | "whenever" => "write `on X { … }` at the top of the behavior; in a table `A -> B on X`",
        "try" | "catch" | "except" | "finally" => {
            "what fails is a value: `VALUE else OTHER` where it may be absent, `abort \"why\" on X` where the mission cannot go on"
        }
        "throw" | "raise" => "write `abort \"why\"`: the mission ends, and its recovery begins",
        "lambda" => "a function has a name: `fn NAME(x: TYPE) -> TYPE { … }`, at the left margin",
        "end" | "endif" | "endwhile" | "endfor" => {
            "a block stands between `{` and `}`; `finish` ends a behavior or a mission"
        }
        "exit" | "quit" => {
            "`finish` ends a behavior or a mission; `abort \"why\"` ends the mission and begins its recovery"
        }
        _ => return maneuver(word).or_else(|| compass(word)),
    })
}

/// Functions of other languages, and how ours says what they give.
pub fn called(name: &str) -> Option<&'static str> {
    Some(match name {
        "bearing" | "azimuth" | "heading_to" => {
            "the heading from one point to another is `(TO - FROM).toward`, that of a vector `VECTOR.toward`"
        }
        "dist" | "distance_to" | "range_to" => "write `distance(FROM, TO)`",
        "hypot" | "norm" | "magnitude" => "the length of a vector is `VECTOR.length`",
        "mean" | "average" | "avg" | "sum" => {
            "add up in a loop: `var total = 0 m`, then `for x in LIST { total = total + x }`; the mean is `total / LIST.count else 0 m`"
        }
        "str" | "string" | "to_string" | "format" | "sprintf" => {
            "a value stands in a text between `{` and `}`: `\"depth {depth}\"`"
        }
        "pow" | "power" => "write `x^2`",
        "log10" => "write `ln(x) / ln(10)`",
        "log2" => "write `ln(x) / ln(2)`",
        "tan" => "write `sin(angle) / cos(angle)`, which is absent where the cosine is zero",
        "atan" | "arctan" => "write `atan2(x, 1)`",
        "asin" | "arcsin" => "write `atan2(x, sqrt(max(0, 1 - x^2)))`",
        "acos" | "arccos" => "write `atan2(sqrt(max(0, 1 - x^2)), x)`",
        _ => return None,
    })
}

/// What others call what a scenario says, and how ours says it.
pub fn clause(name: &str) -> Option<&'static str> {
    Some(match name {
        "current" | "currents" | "stream" => "write `flow(0.1 m/s toward 90 deg)`",
        "temperature" | "salinity" | "thermocline" | "density" => {
            "the water's are those of `stratification(surface: 10 degC, bottom: 10 degC)`; `ctd()` measures them"
        }
        "depth" | "seabed" | "seafloor" | "water_depth" => "write `bottom(from: 20 m, to: 20 m)`",
        "bathymetry" | "survey" => "write `bottom_grid(\"FILE.csv\")`",
        "wind" => "write what it makes: `waves(height: 50 cm)`, `flow(0.1 m/s toward 90 deg)`",
        "start" | "position" | "location" | "origin" => "write it with the vehicle: `vehicle(kinematic, start: POINT)`",
        _ => return None,
    })
}

/// How the end of a run is called elsewhere.
pub fn end_of_run(name: &str) -> Option<&'static str> {
    Some(match name {
        "status" | "result" | "success" | "succeeded" | "finished" => "write `expect completed`",
        "outcome" | "failed" | "failure" => {
            "write how it ended: `expect completed`, `aborted`, `timed_out`, `aground`, or `not completed`"
        }
        _ => return None,
    })
}

/// What is said of a point of the compass between the four that have names.
macro_rules! unnamed {
    ($degrees:literal) => {
        concat!("write `", $degrees, " deg`: only `north`, `east`, `south` and `west` have names")
    };
}

/// Directions of the compass that have no name here, or a longer one.
fn compass(word: &str) -> Option<&'static str> {
    Some(match word {
        "N" => "if this is a direction write `north`",
        "E" => "if this is a direction write `east`",
        "S" => "if this is a direction write `south`",
        "W" => "if this is a direction write `west`",
        "NNE" => unnamed!("22.5"),
        "NE" | "northeast" | "north_east" => unnamed!("45"),
        "ENE" => unnamed!("67.5"),
        "ESE" => unnamed!("112.5"),
        "SE" | "southeast" | "south_east" => unnamed!("135"),
        "SSE" => unnamed!("157.5"),
        "SSW" => unnamed!("202.5"),
        "SW" | "southwest" | "south_west" => unnamed!("225"),
        "WSW" => unnamed!("247.5"),
        "WNW" => unnamed!("292.5"),
        "NW" | "northwest" | "north_west" => unnamed!("315"),
        "NNW" => unnamed!("337.5"),
        _ => return None,
    })
}

/// Loops that begin with a word of ours: `do { … } while X`, `until X { … }`.
pub fn repeated(word: &str, rest: &str) -> Option<String> {
    let (head, _) = rest.split_once('{').filter(|(head, _)| !head.contains('\n'))?;
    match (word, head.trim()) {
        ("do", "") => Some("write `while X { … }`: what is done once in any case stands before it, too".to_string()),
        ("until", "") => None,
        ("until", condition) => Some(format!(
            "write `while not ({condition}) {{ … }}`, and at what is driven in it when that ends: `steer north until {condition}`"
        )),
        _ => None,
    }
}

/// What other vehicles are told to do, and how ours is told.
fn maneuver(word: &str) -> Option<&'static str> {
    Some(match word {
        "turn" | "left" | "right" | "rotate" => {
            "name the new course first, then steer it: `let aside = heading + 30 deg`, then `steer aside for 20 s`; \
             `+` is to starboard, `-` to port"
        }
        "dive" | "descend" | "climb" | "ascend" | "rise" => {
            "write `keep depth 5 m for 1 min`, or the depth after what is driven: `goto POINT at depth 5 m`"
        }
        "surface" => "write `keep depth 0 m until depth < 0.5 m`",
        "stop" | "halt" | "hover" | "stay" | "station" | "station_keep" | "stationkeep" | "drift" => {
            "write `hold for 5 min` to stay at a place, `wait for 5 min` to go on as before"
        }
        "go" | "move" | "transit" | "drive" | "travel" | "waypoint" | "waypt" => {
            "write `goto POINT`, such as `goto op.center` or `goto position + 100 m toward north`"
        }
        "circle" | "orbit" => "write `loiter POINT, radius: 20 m, turns: 1`",
        "survey" | "lawnmower" | "mow" => "write `for row in AREA.rows(50 m) { follow row }`",
        "each" => "write `on every 10 min { … }`, or `for x in LIST { … }`",
        "set" => "write `with depth 3 m, speed 2 m/s`: it holds to the end of the block",
        _ => return None,
    })
}

/// What to say of a line that begins with the name of an input or setpoint, as if it were a command: `heading 90`.
pub fn command(word: &str, rest: &str) -> Option<String> {
    let value = rest.split(['\n', ';', '{', '}']).next().unwrap_or("").trim_start_matches([':', '=', ' ', '\t']).trim();
    let value = if value.is_empty() { "…" } else { value };
    Some(match word {
        _ if Channel::named(word).is_some() => {
            format!(
                "write `with {word} {value}`, which holds to the end of the block, or `… at {word} {value}` for one statement"
            )
        }
        "heading" => format!("write `steer heading: {value} for 1 min`"),
        "course" => format!("write `steer {value} for 1 min`, or `goto {value}` if that is a point"),
        _ => return None,
    })
}
