//! What can go wrong with a link, as a person reads it.

use albacore_vehicle::VehicleError;

/// What is wrong, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct LinkError {
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

impl LinkError {
    /// An error and its remedy.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        LinkError { message: message.into(), help: help.into() }
    }

    /// A name that is none of those that there are.
    pub(crate) fn unknown(what: &str, name: &str, known: &[&str]) -> Self {
        let help = albacore_wording::help(name, known.iter().copied()).unwrap_or_default();
        LinkError::new(format!("there is no {what} `{name}`"), help)
    }
}

/// The vehicle port knows one sentence.
impl From<LinkError> for VehicleError {
    fn from(error: LinkError) -> Self {
        VehicleError(format!("{}: {}", error.message, error.help))
    }
}
