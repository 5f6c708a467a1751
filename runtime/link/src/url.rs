//! Where a link goes and what is spoken on it: `serial:/dev/ttyUSB0?dialect=recon&baud=57600`.

use crate::dialect::{Dialect, Settings};
use crate::dialects::ALL;
use crate::error::LinkError;
use std::fmt;

const SCHEMES: [&str; 3] = ["serial", "udp", "pty"];
/// What a URL may set whatever is spoken; dialects have settings besides.
const SETTINGS: [&str; 3] = ["dialect", "baud", "local"];

/// Where a link goes, and what is spoken on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Url {
    /// Where it goes.
    pub place: Place,
    /// What is spoken.
    pub dialect: &'static Dialect,
    /// What it sets for the dialect.
    pub settings: Settings,
}

/// Where a link goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A serial line: the device's path, and bits a second; 8 data bits, no parity, one stop bit.
    Serial(String, u32),
    /// UDP, one message a datagram.
    Udp {
        /// The other end; for who serves, the address to listen at.
        host: String,
        /// Its port; for who serves, the port to listen at.
        port: u16,
        /// The port of this end; 0 takes any.
        local: u16,
    },
    /// A new pseudo terminal, for who serves: the other end opens it like a serial line.
    Pty,
}

/// A URL as it is written: what is spoken may be left to who knows the vehicle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenUrl {
    text: String,
    /// Its bits a second are 0 where only the dialect says them.
    place: Place,
    dialect: Option<&'static Dialect>,
    settings: Settings,
}

impl WrittenUrl {
    /// Reads a URL. An error says what is wrong with it and what there is instead.
    pub fn parse(text: &str) -> Result<Self, LinkError> {
        let (place, query) = text.split_once('?').unwrap_or((text, ""));
        let Some((scheme, rest)) = place.split_once(':') else {
            return Err(LinkError::new(format!("`{text}` is no link"), format!("write {}", examples())));
        };
        let settings = settings(query)?;
        let get = |name: &str| settings.iter().find(|(n, _)| *n == name).map(|(_, value)| *value);
        let only_for = |name: &str, wanted: &str| match get(name) {
            Some(_) if scheme != wanted => Err(LinkError::new(
                format!("`{name}` says nothing of `{scheme}:`"),
                format!("leave it out; it belongs to `{wanted}:`"),
            )),
            _ => Ok(()),
        };
        only_for("baud", "serial")?;
        only_for("local", "udp")?;
        let dialect = get("dialect").map(Dialect::named).transpose();
        let like = dialect.as_ref().ok().copied().flatten().unwrap_or(Dialect::example());
        let place = match scheme {
            "serial" if rest.is_empty() => {
                let help = format!("write `serial:/dev/ttyUSB0?dialect={like}`");
                return Err(LinkError::new("`serial:` names no device", help));
            }
            "serial" => match get("baud").map(|baud| whole("baud", baud)).transpose()? {
                Some(0) => {
                    return Err(LinkError::new("a line of 0 baud carries nothing", "write a number such as 57600"));
                }
                baud => Place::Serial(rest.to_string(), baud.unwrap_or(0)),
            },
            "udp" => udp(rest, get("local").map_or(Ok(0), |local| whole("local", local))?, like)?,
            "pty" if rest.is_empty() => Place::Pty,
            "pty" => {
                let help =
                    format!("write `pty:?dialect={like}` to make one, or `serial:{rest}` to open one that is there");
                return Err(LinkError::new(format!("`pty:` makes a new terminal and takes no `{rest}`"), help));
            }
            "tcp" => {
                let help = format!(
                    "there is `udp:HOST:PORT?dialect={like}`; or join the connection to a pseudo terminal, and open that: \
                     `serial:/dev/pts/N?dialect={like}`"
                );
                return Err(LinkError::new("links over `tcp:` are not built yet", help));
            }
            _ => return Err(LinkError::unknown("kind of link", scheme, &SCHEMES)),
        };
        let of_dialect = settings.iter().filter(|(name, _)| !SETTINGS.contains(name));
        let of_dialect = of_dialect.map(|(name, value)| ((*name).to_string(), (*value).to_string())).collect();
        Ok(WrittenUrl { text: text.to_string(), place, dialect: dialect?, settings: Settings::new(of_dialect) })
    }

    /// Whether it leaves open what is spoken.
    pub fn is_silent(&self) -> bool {
        self.dialect.is_none()
    }

    /// The URL, with what the vehicle is known to speak where it does not say it itself.
    pub fn of_vehicle(self, speaks: Option<&'static Dialect>) -> Result<Url, LinkError> {
        let WrittenUrl { text, mut place, dialect, settings } = self;
        let Some(dialect) = dialect.or(speaks) else {
            let sign = if text.contains('?') { '&' } else { '?' };
            let like = Dialect::example();
            let help =
                format!("write `{text}{sign}dialect={like}`, or `dialect({like})` in the `vehicle` of the scenario");
            return Err(LinkError::new(format!("`{text}` does not say what the vehicle speaks"), help));
        };
        if !dialect.schemes.contains(&place.scheme()) {
            let help = format!("it is spoken over `{}:`", dialect.schemes.join(":`, `"));
            return Err(LinkError::new(format!("`{dialect}` is not spoken over `{}:`", place.scheme()), help));
        }
        if let Some(name) = settings.names().find(|name| !dialect.settings.contains(name)) {
            return Err(LinkError::new(format!("`{name}` says nothing of `{dialect}`"), "leave it out"));
        }
        // What of its settings cannot be is the dialect's to say, and is said before anything is opened.
        (dialect.controller)(&settings)?;
        if let Place::Serial(_, baud @ 0) = &mut place {
            *baud = dialect.baud;
        }
        Ok(Url { place, dialect, settings })
    }
}

impl Url {
    /// Reads a URL that says what is spoken.
    pub fn parse(text: &str) -> Result<Self, LinkError> {
        WrittenUrl::parse(text)?.of_vehicle(None)
    }
}

/// What a URL looks like, for those who write something else.
fn examples() -> String {
    let like = Dialect::example();
    let port = like.udp_port;
    format!(
        "`serial:/dev/ttyUSB0?dialect={like}`, `udp:192.168.1.20:{port}?dialect={like}` or, to serve, `pty:?dialect={like}`"
    )
}

fn settings(query: &str) -> Result<Vec<(&str, &str)>, LinkError> {
    let mut settings: Vec<(&str, &str)> = Vec::new();
    for part in query.split('&').filter(|part| !part.is_empty()) {
        let Some((name, value)) = part.split_once('=') else {
            return Err(LinkError::new(format!("`{part}` sets nothing"), format!("write `{part}=VALUE`")));
        };
        let of_dialects = ALL.iter().flat_map(|dialect| dialect.settings.iter().copied());
        let known: Vec<&str> = SETTINGS.into_iter().chain(of_dialects).collect();
        if !known.contains(&name) {
            return Err(LinkError::unknown("setting of a link", name, &known));
        }
        if settings.iter().any(|(n, _)| *n == name) {
            return Err(LinkError::new(format!("`{name}` is set twice"), "leave one of them out"));
        }
        settings.push((name, value));
    }
    Ok(settings)
}

fn udp(rest: &str, local: u16, like: &Dialect) -> Result<Place, LinkError> {
    let missing = || {
        let help = format!("write `udp:HOST:PORT`; vehicles of this kind use {}", like.udp_port);
        LinkError::new(format!("`udp:{rest}` has no port"), help)
    };
    let (host, port) = rest.rsplit_once(':').ok_or_else(missing)?;
    if port.is_empty() {
        return Err(missing());
    }
    if host.is_empty() {
        return Err(LinkError::new(
            format!("`udp:{rest}` has no address"),
            format!("write `udp:HOST:{port}`; who serves listens at `udp:0.0.0.0:{port}`"),
        ));
    }
    let port = whole("port", port)?;
    Ok(Place::Udp { host: host.to_string(), port, local })
}

/// A whole number that fits its place.
fn whole<N: std::str::FromStr>(name: &str, text: &str) -> Result<N, LinkError> {
    text.parse().map_err(|_| {
        let largest = if name == "baud" { "a number such as 57600" } else { "a number from 0 to 65535" };
        LinkError::new(format!("`{text}` is no {name}"), format!("write {largest}"))
    })
}

impl fmt::Display for Url {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}?dialect={}", self.place, self.dialect)
    }
}

impl Place {
    /// The kind of link.
    fn scheme(&self) -> &'static str {
        match self {
            Place::Serial(..) => "serial",
            Place::Udp { .. } => "udp",
            Place::Pty => "pty",
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Serial(path, _) => write!(f, "serial:{path}"),
            Place::Udp { host, port, .. } => write!(f, "udp:{host}:{port}"),
            Place::Pty => f.write_str("pty:"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialects::recon::DIALECT as RECON;

    #[test]
    fn what_is_meant_is_read() {
        let serial = Url::parse("serial:/dev/ttyUSB0?dialect=recon&baud=9600").unwrap();
        assert_eq!(serial.place, Place::Serial("/dev/ttyUSB0".into(), 9600));
        assert_eq!(serial.to_string(), "serial:/dev/ttyUSB0?dialect=recon");
        let usual = Url::parse("serial:/dev/ttyS1?dialect=recon").unwrap();
        assert_eq!(usual.place, Place::Serial("/dev/ttyS1".into(), 57_600));
        let udp = Url::parse("udp:[::1]:23456?dialect=recon&local=23456").unwrap();
        assert_eq!(udp.place, Place::Udp { host: "[::1]".into(), port: 23456, local: 23456 });
        assert_eq!(Url::parse("pty:?dialect=recon").unwrap().place, Place::Pty);
    }

    #[test]
    fn a_url_that_is_silent_takes_what_the_vehicle_speaks() {
        let url = |text: &str, speaks| WrittenUrl::parse(text).and_then(|url| url.of_vehicle(speaks));
        let text = url("serial:/dev/x?baud=9600", Some(&RECON)).unwrap();
        assert_eq!(text, Url::parse("serial:/dev/x?baud=9600&dialect=recon").unwrap());
        assert_eq!(url("pty:", Some(&RECON)), Url::parse("pty:?dialect=recon"));
        assert!(
            WrittenUrl::parse("pty:").unwrap().is_silent()
                && !WrittenUrl::parse("pty:?dialect=recon").unwrap().is_silent()
        );
        assert!(url("pty:", None).unwrap_err().help.contains("`dialect(recon)` in the `vehicle`"));
        assert!(url("pty:?dialect=rekon", Some(&RECON)).unwrap_err().help.contains("did you mean `recon`?"));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_remedy() {
        for (text, message, help) in [
            ("/dev/ttyUSB0", "is no link", "serial:/dev/ttyUSB0"),
            ("seriel:/dev/x?dialect=recon", "no kind of link `seriel`", "did you mean `serial`?"),
            ("carrier-pigeon:x?dialect=recon", "no kind of link", "`pty`, `serial` and `udp`"),
            ("tcp:10.0.0.1:23456?dialect=recon", "`tcp:` are not built yet", "udp:HOST:PORT"),
            ("serial:/dev/x?dialect=recon&baud=0", "0 baud", "57600"),
            ("udp:10.0.0.1?dialect=recon", "has no port", "23456"),
            ("udp:10.0.0.1:?dialect=recon", "has no port", "23456"),
            ("udp::23456?dialect=recon", "has no address", "udp:0.0.0.0:23456"),
            ("udp:10.0.0.1:70000?dialect=recon", "`70000` is no port", "65535"),
            ("serial:?dialect=recon", "names no device", "/dev/ttyUSB0"),
            ("serial:/dev/x", "does not say what the vehicle speaks", "`serial:/dev/x?dialect=recon`"),
            ("serial:/dev/x?baud=9600", "does not say", "`serial:/dev/x?baud=9600&dialect=recon`"),
            ("serial:/dev/x?dialect=recn", "no dialect `recn`", "did you mean `recon`?"),
            ("serial:/dev/x?dialect=semaphore", "no dialect `semaphore`", "there is `recon`"),
            ("serial:/dev/x?dialect=recon&baud=fast", "`fast` is no baud", "57600"),
            ("serial:/dev/x?dialect=recon&bauds=9600", "no setting of a link `bauds`", "did you mean `baud`?"),
            ("serial:/dev/x?dialect", "sets nothing", "dialect=VALUE"),
            ("serial:/dev/x?dialect=recon&dialect=recon", "set twice", "leave one"),
            ("udp:h:1?dialect=recon&baud=9600", "says nothing of `udp:`", "leave it out"),
            ("pty:/dev/pts/3?dialect=recon", "makes a new terminal", "serial:/dev/pts/3"),
        ] {
            let error = Url::parse(text).unwrap_err();
            assert!(error.message.contains(message), "{text}: {}", error.message);
            assert!(error.help.contains(help), "{text}: {}", error.help);
        }
    }
}
