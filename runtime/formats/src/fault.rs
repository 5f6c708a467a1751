//! What is wrong with a file: all of it, each with its place and its mend.

/// So many faults of one file with mends of their own are told; of the others their number.
const KINDS_MAX: usize = 12;
/// So many places of faults with one mend are named; of the others their number.
const NAMED_MAX: u64 = 3;

/// So many characters of a file's own text stand in a message at most.
const QUOTED_MAX: usize = 40;

/// The beginning of a file's own text, for a message: whoever made the file made it as long as it pleased.
pub(crate) fn shortened(text: &str) -> String {
    match text.char_indices().nth(QUOTED_MAX) {
        None => text.to_string(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}

/// The first of some names of a file, for a message.
pub(crate) fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    const MOST: usize = 8;
    let mut names = names.into_iter();
    let told: Vec<String> = names.by_ref().take(MOST).map(shortened).collect();
    told.join(", ") + if names.next().is_some() { ", …" } else { "" }
}

/// A number of a file in few digits: those of single precision where it has no more, and powers of ten where it is enormous.
pub(crate) fn compact(number: f64) -> String {
    let (size, single) = (number.abs(), number as f32);
    match (size == 0.0 || (1e-6..1e15).contains(&size), f64::from(single) == number) {
        (true, true) => single.to_string(),
        (true, false) => number.to_string(),
        (false, true) => format!("{single:e}"),
        (false, false) => format!("{number:e}"),
    }
}

/// A number of things, each called so.
pub(crate) fn counted(count: u64, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

/// One fault of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What is wrong and where: a line, a cell or a byte.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

impl Fault {
    /// A fault and its mend.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Fault {
        Fault { message: message.into(), help: help.into() }
    }
}

/// Why a file could not be read: one fault or more.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", faults.iter().map(|f| format!("{}: {}", f.message, f.help)).collect::<Vec<_>>().join("; "))]
pub struct Unreadable {
    /// All that was found, in the order of the file.
    pub faults: Vec<Fault>,
}

impl Unreadable {
    pub(crate) fn of(fault: Fault) -> Unreadable {
        Unreadable { faults: vec![fault] }
    }
}

/// Collects faults while a file is read. Those with one mend are one fault: of a damage that spoils a thousand cells a person reads
/// where it begins.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    kinds: Vec<FaultGroup>,
    others: u64,
    count: u64,
}

/// Faults with one mend: the first of them in words, and how many there are.
#[derive(Debug)]
struct FaultGroup {
    fault: Fault,
    count: u64,
}

impl FaultGroup {
    fn into_fault(self) -> Fault {
        let FaultGroup { mut fault, count } = self;
        if count > NAMED_MAX {
            fault.message += &format!("; and {} more such", count - NAMED_MAX);
        }
        fault
    }
}

impl Faults {
    pub fn add(&mut self, message: impl Into<String>, help: impl Into<String>) {
        self.push(Fault::new(message, help));
    }

    pub fn push(&mut self, fault: Fault) {
        self.count += 1;
        let has_room = self.kinds.len() < KINDS_MAX;
        match self.kinds.iter_mut().find(|alike| alike.fault.help == fault.help) {
            Some(alike) => {
                alike.count += 1;
                if alike.count <= NAMED_MAX {
                    alike.fault.message += &format!("; {}", fault.message);
                }
            }
            None if has_room => self.kinds.push(FaultGroup { fault, count: 1 }),
            None => self.others += 1,
        }
    }

    /// The value, else its fault is noted.
    pub fn take<T>(&mut self, result: Result<T, Fault>) -> Option<T> {
        result.map_err(|fault| self.push(fault)).ok()
    }

    /// How many there are.
    pub fn count(&self) -> u64 {
        self.count
    }

    pub fn into_unreadable(self) -> Option<Unreadable> {
        let mut faults: Vec<Fault> = self.kinds.into_iter().map(FaultGroup::into_fault).collect();
        if let (Some(last), 1..) = (faults.last(), self.others) {
            let help = last.help.clone();
            faults.push(Fault::new(format!("and {} more faults such as these", self.others), help));
        }
        (!faults.is_empty()).then_some(Unreadable { faults })
    }
}
