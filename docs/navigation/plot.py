"""Draws the pictures of docs/navigation.md from runs of missions/navigation_2016.alb that were exported as tables.

    python3 docs/navigation/plot.py RUNS docs/navigation

RUNS has a folder for each scenario, with `export/track.csv` in it.
"""

import csv
import math
import sys
from pathlib import Path

# Colours: what is believed or off, three standard deviations, the way, the way while an instrument is silent.
ERROR, BAND, WAY, SILENT = "#0072b2", "#0072b2", "#333", "#d55e00"
INK, PALE, GRID, GROUND = "#1a1a1a", "#555", "#dfe5ea", "#f6f9fb"
# True biases: what each axis of the inertial unit has.
TRUE_BIAS = {"gyro_bias": 10.0, "accelerometer_bias": 0.05}
TRANSPONDER = (0.0, 0.0)
MRAD = 1000 * math.pi / 180


def read(path):
    """The rows of a track that tell of the navigation, once a second: names without their units, and numbers."""
    rows = []
    with open(path, newline="", encoding="utf-8") as table:
        lines = csv.reader(table)
        names = [name.split(" (")[0] for name in next(lines)]
        wanted = [
            (at, name)
            for at, name in enumerate(names)
            if name.startswith("navigation.") or name in ("time", "truth.north", "truth.east")
        ]
        mark = names.index("navigation.nees")
        for line in lines:
            if line[mark]:
                rows.append({name: float(line[at] or "nan") for at, name in wanted})
    return rows


def series(rows, state, scale=1.0):
    """Times, errors and standard deviations of a state."""
    return (
        [row["time"] for row in rows],
        [scale * row[f"navigation.error.{state}"] for row in rows],
        [scale * row[f"navigation.sigma.{state}"] for row in rows],
    )


def thin(times, values, bins):
    """The least and the greatest of each stretch of time, in their order."""
    size = max(1, math.ceil(len(values) / bins))
    kept = []
    for start in range(0, len(values), size):
        places = range(start, min(start + size, len(values)))
        low, high = min(places, key=values.__getitem__), max(places, key=values.__getitem__)
        kept += [(times[at], values[at]) for at in sorted({low, high})]
    return kept


def ticks(low, high, about):
    """Round numbers between two: some so many, and three at least."""
    raw = (high - low) / about
    unit = 10 ** math.floor(math.log10(raw))
    marks = []
    for step in (unit * x for x in (10, 5, 2, 1, 0.5, 0.2) if unit * x < 2.5 * raw):
        marks = [step * at for at in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]
        if len(marks) >= max(3, about - 1):
            break
    return marks


def label(x):
    return f"{x:.10g}".replace("-", "−")


class Picture:
    """An SVG as text."""

    def __init__(self, width, height, title, told):
        self.size = (width, height)
        self.parts = [
            f'<rect width="{width}" height="{height}" fill="#fff"/>',
            f'<text x="20" y="30" font-size="18" font-weight="bold" fill="{INK}">{title}</text>',
            f'<text x="20" y="50" font-size="13" fill="{PALE}">{told}</text>',
        ]
        self.clips = 0

    def text(self, x, y, what, **more):
        attributes = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in more.items())
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" font-size="12" fill="{PALE}"{attributes}>{what}</text>')

    def write(self, path):
        width, height = self.size
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
            "font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">"
        )
        text = "\n".join([head, *self.parts, "</svg>", ""])
        Path(path).write_text(text, encoding="utf-8")
        print(path, len(text.encode()))


class Chart:
    """A frame of a picture with axes."""

    def __init__(self, picture, box, across, up, name, unit, log=False, last=True, x_name="time (s)"):
        self.picture, self.box, self.across, self.up, self.log = picture, box, across, up, log
        x, y, width, height = box
        parts = picture.parts
        picture.clips += 1
        self.clip = f"c{picture.clips}"
        parts.append(f'<clipPath id="{self.clip}"><rect x="{x}" y="{y}" width="{width}" height="{height}"/></clipPath>')
        parts.append(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{GROUND}"/>')
        if log:
            marks = [10.0**at for at in range(math.ceil(math.log10(up[0])), math.floor(math.log10(up[1])) + 1)]
        else:
            marks = ticks(*up, max(3, height // 60))
        lines = [f"M{x} {self.y(mark):.1f}h{width}" for mark in marks]
        for mark in marks:
            picture.text(x - 6, self.y(mark) + 4, label(mark), text_anchor="end")
        for mark in ticks(*across, max(4, width // 90)):
            lines.append(f"M{self.x(mark):.1f} {y}v{height}")
            if last:
                picture.text(self.x(mark), y + height + 16, label(mark), text_anchor="middle")
        parts.append(f'<path d="{"".join(lines)}" stroke="{GRID}" fill="none"/>')
        middle = y + height / 2
        turn = f"rotate(-90 {x - 50} {middle:.1f})"
        picture.text(x - 50, middle, f"{name} ({unit})", text_anchor="middle", transform=turn)
        if last:
            picture.text(x + width / 2, y + height + 34, x_name, text_anchor="middle")

    def x(self, value):
        x, _, width, _ = self.box
        return x + width * (value - self.across[0]) / (self.across[1] - self.across[0])

    def y(self, value):
        _, y, _, height = self.box
        low, high = self.up
        if self.log:
            low, high, value = math.log10(low), math.log10(high), math.log10(max(value, 1e-9))
        return y + height * (high - value) / (high - low)

    def d(self, points):
        """A path, in steps from point to point: tenths of a pixel, and none far off the frame."""
        _, y, _, height = self.box
        shown = [
            (round(10 * self.x(a)), round(10 * min(max(self.y(b), y - 50), y + height + 50))) for a, b in points
        ]
        if not shown:
            return ""
        steps = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(shown, shown[1:])]
        moved = " ".join(f"{x / 10:g} {y / 10:g}" for x, y in steps)
        return f"M{shown[0][0] / 10:g} {shown[0][1] / 10:g}l{moved}"

    def line(self, points, colour=ERROR, width=1.1, dash=""):
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.picture.parts.append(
            f'<path clip-path="url(#{self.clip})" d="{self.d(points)}" fill="none" stroke="{colour}" '
            f'stroke-width="{width}" stroke-linejoin="round"{dashed}/>'
        )

    def band(self, times, sigmas, centre=0.0, bins=130):
        """Three standard deviations to each side, the greatest of each stretch of time."""
        size = max(1, math.ceil(len(times) / bins))
        most = [(times[at], max(sigmas[at : at + size])) for at in range(0, len(times), size)]
        most.append((times[-1], sigmas[-1]))
        outline = [(t, centre + 3 * s) for t, s in most] + [(t, centre - 3 * s) for t, s in reversed(most)]
        self.picture.parts.append(
            f'<path clip-path="url(#{self.clip})" d="{self.d(outline)}Z" fill="{BAND}" fill-opacity="0.15"/>'
        )

    def shade(self, begin, end):
        _, y, _, height = self.box
        left, right = self.x(max(begin, self.across[0])), self.x(min(end, self.across[1]))
        self.picture.parts.append(
            f'<rect x="{left:.1f}" y="{y}" width="{right - left:.1f}" height="{height}" fill="{SILENT}" fill-opacity="0.08"/>'
        )


def reach(errors, sigmas):
    """How far an axis goes to both sides: errors are in it, and the band but for what is rare."""
    band = sorted(3 * sigma for sigma in sigmas)[int(0.97 * len(sigmas))]
    return 1.05 * max(band, max(abs(error) for error in errors))


def errors_of(picture, rows, panels, box, across, shaded):
    """Charts one below the other of errors with their bands."""
    x, y, width, height = box
    high = (height - 12 * (len(panels) - 1)) / len(panels)
    for at, (state, name, unit, scale) in enumerate(panels):
        times, errors, sigmas = series(rows, state, scale)
        most = reach(errors, sigmas)
        frame = (x, round(y + at * (high + 12)), width, round(high))
        chart = Chart(picture, frame, across, (-most, most), name, unit, last=at == len(panels) - 1)
        if shaded:
            chart.shade(*shaded)
        chart.band(times, sigmas)
        chart.line(thin(times, errors, 280))


def way(picture, rows, box, silent):
    """A map: the way as it was, and of what colour while an instrument was silent."""
    x, y, width, height = box
    parts = {WAY: [], SILENT: []}
    north = [row["truth.north"] for row in rows]
    east = [row["truth.east"] for row in rows]
    middle_n, middle_e = (max(north) + min(north)) / 2, (max(east) + min(east)) / 2
    scale = 1.06 * max((max(north) - min(north)) / height, (max(east) - min(east)) / width)
    across = (middle_e - scale * width / 2, middle_e + scale * width / 2)
    up = (middle_n - scale * height / 2, middle_n + scale * height / 2)
    chart = Chart(picture, box, across, up, "north", "m", x_name="east (m)")
    for row in rows[:: max(1, len(rows) // 500)]:
        is_silent = silent and silent[0] <= row["time"] < silent[1]
        parts[SILENT if is_silent else WAY].append(row)
    for colour, part in parts.items():
        pieces, last = [], None
        for row in part:
            if last is None or row["time"] - last > 100:
                pieces.append([])
            pieces[-1].append((row["truth.east"], row["truth.north"]))
            last = row["time"]
        for piece in pieces:
            chart.line(piece, colour)
    place = (chart.x(TRANSPONDER[1]), chart.y(TRANSPONDER[0]))
    picture.parts.append(f'<circle cx="{place[0]:.1f}" cy="{place[1]:.1f}" r="4" fill="{INK}"/>')


POSITION = [("north", "north", "m", 1), ("east", "east", "m", 1), ("down", "down", "m", 1)]


def experiment(runs, out, scenario, file, title, told, silent):
    """A map, and the errors of the position."""
    rows = runs(scenario)
    picture = Picture(960, 470, title, told)
    way(picture, rows, (80, 70, 260, 350), silent)
    errors_of(picture, rows, POSITION, (430, 70, 510, 350), (0, 10000), silent)
    picture.write(out / file)


def biases(runs, out):
    rows = [row for row in runs("as_it_is") if row["time"] <= 200]
    told = "Scenario as_it_is, seed 1. Line: estimate. Band: three standard deviations. Dashed: the true bias."
    picture = Picture(960, 420, "Biases of the inertial unit", told)
    groups = [("accelerometer_bias", "accelerometer", "m/s²", 1), ("gyro_bias", "gyroscope", "mrad/s", MRAD)]
    for down, (group, name, unit, scale) in enumerate(groups):
        truth = TRUE_BIAS[group]
        for right, axis in enumerate("xyz"):
            times, errors, sigmas = series(rows, f"{group}.{axis}", scale)
            frame = (80 + 305 * right, 70 + 165 * down, 230, 145)
            up = (-truth, 3 * truth)
            chart = Chart(picture, frame, (0, 200), up, f"{name} {axis}", unit, last=down == 1)
            chart.band(times, sigmas, truth)
            chart.line([(0, truth), (200, truth)], INK, 1, "5 4")
            chart.line([(t, truth + error) for t, error in thin(times, errors, 200)], ERROR, 1.4)
    picture.write(out / "biases.svg")


def attitude(runs, out):
    rows = [row for row in runs("modelled") if row["time"] >= 5000]
    told = "Scenario modelled, seed 1, while the Doppler log is silent. Band: three standard deviations."
    picture = Picture(960, 470, "Errors of the attitude, aided by the hull's equations", told)
    panels = [("roll", "roll", "mrad", MRAD), ("pitch", "pitch", "mrad", MRAD), ("yaw", "yaw", "mrad", MRAD)]
    errors_of(picture, rows, panels, (90, 70, 850, 350), (5000, 10000), None)
    picture.write(out / "attitude.svg")


def believed(row, axis):
    return row[f"truth.{axis}"] + row[f"navigation.error.{axis}"]


def by_turns(runs, out):
    """Range and azimuth to the transponder, and the place."""
    rows = runs("by_turns")
    told = "Scenario by_turns, seed 1. Band: three standard deviations. Azimuth is left out within 100 m of the transponder."
    picture = Picture(960, 520, "The transponder is heard for 50 s and silent for 50 s", told)
    ranges, azimuths = [], []
    for row in rows:
        here = (row["truth.north"] - TRANSPONDER[0], row["truth.east"] - TRANSPONDER[1])
        there = (believed(row, "north") - TRANSPONDER[0], believed(row, "east") - TRANSPONDER[1])
        ranges.append((row["time"], math.hypot(*there) - math.hypot(*here)))
        if math.hypot(*here) > 100:
            turn = math.atan2(there[1], there[0]) - math.atan2(here[1], here[0])
            azimuths.append((row["time"], 1000 * math.remainder(turn, 2 * math.pi)))
    for right, (name, unit, points) in enumerate([("range", "m", ranges), ("azimuth", "mrad", azimuths)]):
        most = 1.05 * max(abs(value) for _, value in points)
        chart = Chart(picture, (90 + 470 * right, 70, 380, 180), (0, 10000), (-most, most), name, unit, last=False)
        chart.line(thin([t for t, _ in points], [value for _, value in points], 280))
    for right, (state, name, unit, _) in enumerate(POSITION[:2]):
        times, errors, sigmas = series(rows, state)
        most = reach(errors, sigmas)
        chart = Chart(picture, (90 + 470 * right, 265, 380, 200), (0, 10000), (-most, most), name, unit)
        chart.band(times, sigmas)
        chart.line(thin(times, errors, 280))
    picture.write(out / "experiment_5.svg")


def neither(runs, out):
    """On a logarithmic axis: how far off, with what it expects, in three ways."""
    told = "Seed 1. Lines: how far off the position is. Dashed: three standard deviations. Shaded: no velocity and no transponder."
    picture = Picture(960, 470, "Neither velocity nor transponder for 5000 s", told)
    chart = Chart(picture, (90, 70, 850, 350), (3500, 10000), (0.03, 1e6), "error", "m", log=True)
    chart.shade(4000, 9000)
    kinds = [
        ("neither", ERROR, "as in the paper (neither)"),
        ("neither_bounded", SILENT, "the velocity bounded (neither_bounded)"),
        ("neither_modelled", "#009e73", "the hull's equations (neither_modelled)"),
    ]
    for at, (scenario, colour, name) in enumerate(kinds):
        rows = [row for row in runs(scenario) if row["time"] >= 3500]
        times = [row["time"] for row in rows]
        off = [math.hypot(row["navigation.error.north"], row["navigation.error.east"]) for row in rows]
        known = [
            3 * math.hypot(row["navigation.sigma.north"], row["navigation.sigma.east"]) / math.sqrt(2) for row in rows
        ]
        chart.line(thin(times, known, 110), colour, 1.1, "5 4")
        chart.line(thin(times, off, 240), colour, 1.3)
        chart.picture.parts.append(f'<path d="M105 {86 + 18 * at}h24" stroke="{colour}" stroke-width="2"/>')
        picture.text(136, 90 + 18 * at, name)
    picture.write(out / "experiment_4.svg")


def main():
    folder, out = Path(sys.argv[1]), Path(sys.argv[2])
    kept = {}

    def runs(scenario):
        if scenario not in kept:
            kept[scenario] = read(folder / scenario / "export" / "track.csv")
        return kept[scenario]

    band = "Band: three standard deviations. Dot: the transponder"
    biases(runs, out)
    told = f"Scenario no_transponder, seed 1. {band}, which it does not hear."
    experiment(runs, out, "no_transponder", "experiment_1.svg", "No transponder", told, None)
    told = f"Scenario no_velocity, seed 1. {band}. Orange: the Doppler log is silent."
    experiment(runs, out, "no_velocity", "experiment_2.svg", "No velocity from 5000 s on", told, (5000, 10001))
    told = f"Scenario modelled, seed 1. {band}. Orange: the Doppler log is silent."
    title = "The hull's equations in place of the Doppler log from 5000 s on"
    experiment(runs, out, "modelled", "experiment_3.svg", title, told, (5000, 10001))
    attitude(runs, out)
    neither(runs, out)
    by_turns(runs, out)


main()
