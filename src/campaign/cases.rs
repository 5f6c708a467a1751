//! What a campaign runs with each seed: one mission, or several cases of a sweep.

use super::seeds::RUNS_MAX;
use crate::exit::Exit;
use crate::message::{self, Said};
use crate::plan::{Choice, Faults, refused};
use albacore_session::campaign::Case as PlannedCase;
use albacore_session::{Plan, Run, SOURCE_BYTES_MAX, read_file};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// No sweep has more cases: each is planned before the first run.
const CASES_MAX: usize = 1_000;
/// The columns of a list of cases that name no parameter.
const OF_CASE: [&str; 3] = ["script", "mission", "scenario"];

/// Which missions, in which worlds, with what changed: all combinations, or the cases of a list.
#[derive(clap::Args)]
pub struct AskedCases {
    /// The script; several for a case of each.
    #[arg(value_name = "MISSION.alb", required = true)]
    scripts: Vec<PathBuf>,
    /// The mission; else the one named like the file, else the only one. Several times for a case of each.
    #[arg(long = "mission", value_name = "MISSION")]
    missions: Vec<String>,
    /// The scenario, by its name or as `FILE.alb#NAME`; else the one that the mission names. Several times for a case of each.
    #[arg(long = "in", value_name = "SCENARIO")]
    scenarios: Vec<String>,
    /// Change a parameter: `lambda=6s`, `cpt_2005.beta=30deg`, `duck_2003.step=2s`.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Change a parameter from case to case: `lambda=2s,4s,6s`. Several times for all combinations.
    #[arg(long = "sweep", value_name = "NAME=A,B,…")]
    sweeps: Vec<Sweep>,
    /// Read the cases from a table, a row for each. Its columns are called `script`, `mission`, `scenario`, or like the parameter that they
    /// set; an empty cell leaves it as it is. Files are seen from the folder of the table.
    #[arg(long = "cases", value_name = "CASES.csv", conflicts_with_all = ["sweeps", "scenarios", "missions"])]
    list: Option<PathBuf>,
}

/// A parameter and its values.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Sweep {
    name: String,
    values: Vec<String>,
}

/// One of the cases, as it is asked for.
#[derive(Clone)]
pub struct Case {
    /// The script.
    pub script: PathBuf,
    /// What of it, in which world.
    pub choice: Choice,
    /// The values that are swept, where this case has them.
    values: Vec<Option<String>>,
}

/// The cases of a campaign, and what is swept.
pub struct Cases {
    /// Each, in the order of their numbers.
    pub all: Vec<Case>,
    /// The parameters that are swept.
    swept: Vec<String>,
}

impl AskedCases {
    /// The cases, or what is wrong with them: message and help.
    pub fn read(&self) -> Result<Cases, (String, String)> {
        let cases = match &self.list {
            Some(list) => self.listed(list)?,
            None => self.combined()?,
        };
        match cases.all.len() {
            0 => Err(("there are no cases".to_string(), "write a row for each into the list of cases".to_string())),
            1..=CASES_MAX => Ok(cases),
            _ => {
                let help = "run several campaigns".to_string();
                Err((format!("the list has more than {CASES_MAX} cases"), help))
            }
        }
    }

    /// All combinations; what is given last changes from case to case.
    fn combined(&self) -> Result<Cases, (String, String)> {
        if self.scripts.len() > 1 && !self.missions.is_empty() {
            let help = "leave out `--mission`, or list the cases with `--cases`";
            return Err(("`--mission` chooses of one script, and there are several".to_string(), help.to_string()));
        }
        let whole = |script: &PathBuf| script.canonicalize().unwrap_or(script.clone()).display().to_string();
        twice("the script", self.scripts.iter().map(whole))?;
        twice("the mission", self.missions.iter().cloned())?;
        twice("the scenario", self.scenarios.iter().cloned())?;
        twice("the sweep of", self.sweeps.iter().map(|sweep| sweep.name.clone()))?;
        let optional = |names: &[String]| match names {
            [] => vec![None],
            names => names.iter().cloned().map(Some).collect(),
        };
        let sizes = [self.scripts.len(), self.missions.len(), self.scenarios.len()].into_iter();
        let count = sizes
            .chain(self.sweeps.iter().map(|sweep| sweep.values.len()))
            .fold(1usize, |n, m| n.saturating_mul(m.max(1)));
        if count > CASES_MAX {
            let help = "sweep fewer values, or run several campaigns".to_string();
            return Err((format!("{count} cases are more than {CASES_MAX}"), help));
        }
        let mut all = Vec::new();
        for script in &self.scripts {
            for mission in optional(&self.missions) {
                for scenario in optional(&self.scenarios) {
                    let choice = Choice { mission: mission.clone(), scenario, set: self.set.clone() };
                    all.push(Case { script: script.clone(), choice, values: Vec::new() });
                }
            }
        }
        for sweep in &self.sweeps {
            let with = |case: &Case, value: &String| {
                let mut case = case.clone();
                case.choice.set.push(format!("{}={value}", sweep.name));
                case.values.push(Some(value.clone()));
                case
            };
            all = all.iter().flat_map(|case| sweep.values.iter().map(move |value| with(case, value))).collect();
        }
        Ok(Cases { all, swept: self.sweeps.iter().map(|sweep| sweep.name.clone()).collect() })
    }

    /// The cases of a list.
    fn listed(&self, list: &Path) -> Result<Cases, (String, String)> {
        let shown = list.display();
        let unread = |why: String| {
            let help = "a list of cases is a CSV whose first line names `script`, `mission`, `scenario`, or parameters";
            (format!("`{shown}` cannot be read: {why}"), help.to_string())
        };
        let [script] = self.scripts.as_slice() else {
            let help = "name one, and the others in a column `script`";
            return Err(("a list of cases is of one script, and there are several".to_string(), help.to_string()));
        };
        let text = read_file(list, SOURCE_BYTES_MAX as u64).map_err(|error| unread(error.to_string()))?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
        let names: Vec<String> =
            reader.headers().map_err(|error| unread(error.to_string()))?.iter().map(str::to_string).collect();
        if let Some(empty) = names.iter().position(String::is_empty) {
            return Err(unread(format!("its column {} has no name", empty + 1)));
        }
        twice("the column", names.iter().cloned())?;
        if let [only] = names.as_slice()
            && only.contains([';', '\t'])
        {
            return Err(unread("its columns are not parted by commas".to_string()));
        }
        let is_meant = |name: &String| OF_CASE.contains(&name.to_lowercase().as_str());
        if let Some(name) = names.iter().find(|name| is_meant(name) && !OF_CASE.contains(&name.as_str())) {
            return Err(unread(format!("its column `{name}` is called `{}`", name.to_lowercase())));
        }
        let swept: Vec<String> = names.iter().filter(|name| !OF_CASE.contains(&name.as_str())).cloned().collect();
        let mut all = Vec::new();
        for row in reader.records().take(CASES_MAX + 1) {
            let row = row.map_err(|error| unread(error.to_string()))?;
            let cell = |name: &str| {
                let at = names.iter().position(|other| other == name)?;
                row.get(at).filter(|cell| !cell.is_empty()).map(str::to_string)
            };
            let values: Vec<Option<String>> = swept.iter().map(|name| cell(name)).collect();
            let set = swept.iter().zip(&values).filter_map(|(name, value)| Some(format!("{name}={}", value.as_ref()?)));
            let set = self.set.iter().cloned().chain(set).collect();
            // Files are found from the folder of the list, as they are from that of a script.
            let beside = |name: String| list.parent().unwrap_or(Path::new("")).join(name);
            let scenario = cell("scenario").map(|scenario| match scenario.split_once('#') {
                Some((file, name)) => format!("{}#{name}", beside(file.to_string()).display()),
                None => scenario,
            });
            let choice = Choice { mission: cell("mission"), scenario, set };
            all.push(Case { script: cell("script").map_or_else(|| script.clone(), beside), choice, values });
        }
        Ok(Cases { all, swept })
    }
}

impl Cases {
    /// What the columns of what is swept are to be called. Where all values are numbers in one unit, that is in the name, and the cells are
    /// numbers: `lambda=2s,4s` is a column `lambda_s`.
    pub fn columns(&self) -> Vec<String> {
        let name = |(at, name): (usize, &String)| match self.unit(at) {
            Some("%") => format!("{name}_percent"),
            Some(unit) if !unit.is_empty() => {
                format!("{name}_{}", unit.replace(|c: char| !c.is_ascii_alphanumeric(), "_"))
            }
            _ => name.clone(),
        };
        self.swept.iter().enumerate().map(name).collect()
    }

    /// What a case has in these columns.
    pub fn cells(&self, case: &Case) -> Vec<String> {
        let cell = |(at, value): (usize, &Option<String>)| {
            let value = value.as_deref().unwrap_or_default();
            match (self.unit(at), measure(value)) {
                (Some(_), Some((number, _))) => number.to_string(),
                _ => value.to_string(),
            }
        };
        case.values.iter().enumerate().map(cell).collect()
    }

    /// The unit of all values of what is swept, if they are numbers in one.
    fn unit(&self, at: usize) -> Option<&str> {
        let mut units =
            self.all.iter().filter_map(|case| case.values.get(at)?.as_deref()).map(|value| Some(measure(value)?.1));
        let first = units.next()??;
        units.all(|unit| unit == Some(first)).then_some(first)
    }

    /// Plans each, or says what stands in the way: before a file is begun.
    pub fn planned(&self, faults: &Faults, seed: u64) -> Result<Vec<PlannedCase>, Exit> {
        let faults = faults.read()?;
        let mut said = Said::default();
        let plan = |case: &Case, said: &mut Said| -> Result<Plan, Exit> {
            let plan = case.choice.planned(&case.script, said)?;
            let plan = plan.with_faults(&faults).map_err(|error| refused(&error))?;
            // What no seed can run is said, too.
            Run::new(&plan, seed).map_err(|error| refused(&error))?;
            Ok(plan)
        };
        let mut planned = Vec::new();
        for (number, case) in (1..).zip(&self.all) {
            match plan(case, &mut said) {
                Ok(plan) => planned.push(PlannedCase { plan, swept: self.cells(case) }),
                Err(exit) => {
                    if self.all.len() > 1 {
                        let what = [vec![case.script.display().to_string()], case.choice.words()].concat().join(" ");
                        message::error(&format!("case {number} cannot be run: {what}"), None);
                    }
                    return Err(exit);
                }
            }
        }
        Ok(planned)
    }

    /// An error if so many seeds of each case are too many.
    pub fn fit(&self, seeds: u64) -> Result<(), String> {
        let (cases, most) = (self.all.len() as u64, RUNS_MAX);
        match seeds.checked_mul(cases).is_some_and(|runs| runs <= most) {
            true => Ok(()),
            false => {
                Err(format!("{cases} cases of {seeds} seeds are more than the {most} runs that a campaign has at most"))
            }
        }
    }
}

impl FromStr for Sweep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "a sweep is `NAME=A,B,…`, such as `lambda=2s,4s,6s`";
        let (name, values) = text.split_once('=').ok_or(form)?;
        let values: Vec<String> = parted(values).map(|value| value.trim().to_string()).collect();
        if name.trim().is_empty() || values.iter().any(String::is_empty) {
            return Err(form.to_string());
        }
        twice("the value", values.iter().cloned()).map_err(|(message, _)| message)?;
        Ok(Sweep { name: name.trim().to_string(), values })
    }
}

/// The texts between commas that stand in no brackets and in no text.
fn parted(text: &str) -> impl Iterator<Item = &str> {
    let (mut depth, mut quoted, mut escaped) = (0i32, false, false);
    text.split(move |c: char| {
        match c {
            _ if std::mem::take(&mut escaped) => {}
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            '(' | '[' | '{' if !quoted => depth += 1,
            ')' | ']' | '}' if !quoted => depth -= 1,
            _ => {}
        }
        c == ',' && depth == 0 && !quoted
    })
}

/// The number of a value and its unit, if it is written as one number with one unit, or without.
fn measure(value: &str) -> Option<(f64, &str)> {
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
    let end = value.find(|c: char| !is_of_number(c)).unwrap_or(value.len());
    // `1e-3 m` has an exponent, `1 eV` would have none.
    let exponent = value[end..].strip_prefix(['e', 'E']).and_then(|rest| {
        let digits = rest.strip_prefix(['-', '+']).unwrap_or(rest);
        let count = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
        (count > 0).then(|| 1 + (rest.len() - digits.len()) + count)
    });
    let (number, unit) = value.split_at(end + exponent.unwrap_or(0));
    let number = number.parse::<f64>().ok().filter(|number| number.is_finite())?;
    let unit = unit.trim();
    (unit.is_empty() || unit.split('/').count() <= 2 && unit.split('/').all(is_unit)).then_some((number, unit))
}

/// Whether a text is a unit with a power, if it has one: `s`, `m2`, `s^0.5`, `%`. What is computed with a number is none.
fn is_unit(text: &str) -> bool {
    let name = text.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.');
    let name = name.strip_suffix('^').unwrap_or(name);
    !name.is_empty() && name.chars().all(|c| c.is_alphabetic() || matches!(c, '%' | '°'))
}

/// An error if one of the names is there twice.
fn twice(what: &str, names: impl Iterator<Item = String>) -> Result<(), (String, String)> {
    let mut known = BTreeSet::new();
    match names.into_iter().find(|name| !known.insert(name.clone())) {
        Some(name) => Err((format!("{what} `{name}` is given twice"), "leave one of them out".to_string())),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Sweep, measure};

    #[test]
    fn a_sweep_is_parted_at_the_commas_between_its_values() {
        let read = |text: &str| text.parse::<Sweep>().map(|sweep| (sweep.name, sweep.values));
        let values = |values: &[&str]| values.iter().map(|value| value.to_string()).collect::<Vec<_>>();
        assert_eq!(read("lambda=2s, 4s,6 s"), Ok(("lambda".to_string(), values(&["2s", "4s", "6 s"]))));
        let places = read("at=point(north: 1 m, east: 2 m),[a, b],\"x,\\\",y\"").map(|(_, values)| values);
        assert_eq!(places, Ok(values(&["point(north: 1 m, east: 2 m)", "[a, b]", "\"x,\\\",y\""])));
        assert_eq!(read("lambda=2s").map(|(_, values)| values.len()), Ok(1));
        for text in ["lambda", "=2s", "lambda=", "lambda=2s,,4s", "lambda=2s,", "lambda=2s,2s", ""] {
            assert!(read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_measure_is_a_number_with_a_unit() {
        let cases = [
            ("2s", Some((2.0, "s"))),
            ("0.5 m/s", Some((0.5, "m/s"))),
            ("1e-3 m2/s", Some((1e-3, "m2/s"))),
            ("-3 %", Some((-3.0, "%"))),
            ("7", Some((7.0, ""))),
            ("1.5E+2", Some((150.0, ""))),
            ("bad", None),
            ("36°10.8'N", None),
            ("1 m/s^0.5", Some((1.0, "m/s^0.5"))),
            ("2 * 3 s", None),
            ("2*3s", None),
            ("10s/2", None),
            ("10s-4s", None),
            ("2 s+", None),
            ("1..2", None),
            ("", None),
        ];
        assert!(
            cases.iter().all(|(text, expected)| measure(text) == *expected),
            "{:?}",
            cases.map(|(text, _)| measure(text))
        );
    }
}
