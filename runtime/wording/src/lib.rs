//! What messages are made of: the name that was probably meant, lists of names, distances.

mod suggest;

pub use suggest::{either, help, listed, nearest};

/// A distance, m, in words. Beyond 1000 km no local plane gives it.
pub fn distance(metres: f64) -> String {
    match metres {
        m if m < 1.0 => format!("{m:.2} m"),
        m if m < 10_000.0 => format!("{m:.0} m"),
        m if m < 1_000_000.0 => format!("{:.0} km", m / 1000.0),
        _ => "more than 1000 km".to_string(),
    }
}
