//! That a vehicle lies on the bottom: the dialect's state has no flag for it, so errors of our own numbers say it.

use super::message::FromVehicle;

const AGROUND: u32 = 4;
const FREE_AGAIN: u32 = 5;
const AGROUND_TEXT: &str = "aground";
const FREE_AGAIN_TEXT: &str = "free of the bottom again";

/// How a vehicle says that it has run aground, or has come free.
pub fn report(aground: bool) -> FromVehicle {
    let (code, text) = if aground { (AGROUND, AGROUND_TEXT) } else { (FREE_AGAIN, FREE_AGAIN_TEXT) };
    FromVehicle::Error(code, text.to_string())
}

/// Whether an error says that the vehicle lies on the bottom, or that it has come free; none of another error.
pub fn parse(code: u32, text: &str) -> Option<bool> {
    match (code, text) {
        (AGROUND, AGROUND_TEXT) => Some(true),
        (FREE_AGAIN, FREE_AGAIN_TEXT) => Some(false),
        _ => None,
    }
}
