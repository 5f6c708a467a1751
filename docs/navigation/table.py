"""Prints the tables of docs/navigation.md from tables of campaigns.

    python3 docs/navigation/table.py errors navigation.csv       (errors, experiment by experiment)
    python3 docs/navigation/table.py consistency navigation.csv  (whether the filter knows how far off it is)
    python3 docs/navigation/table.py claims navigation.csv       (the paper's bounds)
    python3 docs/navigation/table.py biases RUNS                 (RUNS: exported runs, a folder for each)
    python3 docs/navigation/table.py boundary boundary.csv
    python3 docs/navigation/table.py source duck.csv
    python3 docs/navigation/table.py faults faults.csv RUNS      (RUNS: a folder for each scenario, with a run of one seed)

In brackets are 95 % intervals: Wilson's of shares, by order of medians, by the normal distribution of means.
"""

import csv
import math
import statistics
import sys
from pathlib import Path

Z = 1.96
MRAD = 1000 * math.pi / 180
# A fault begins and ends, s.
FAULT = (600.0, 1200.0)


def wilson(hits, n):
    """A share with its interval, in percent."""
    share, square = hits / n, Z * Z
    centre = (share + square / (2 * n)) / (1 + square / n)
    half = Z / (1 + square / n) * (share * (1 - share) / n + square / (4 * n * n)) ** 0.5
    return f"{hits} of {n} ({100 * max(0, centre - half):.0f}..{100 * min(1, centre + half):.0f} %)"


def number(x, digits=2):
    """So many digits that matter."""
    if x == 0:
        return "0"
    if abs(x) >= 1000:
        return f"{x:,.0f}"
    return f"{x:.{max(0, digits - 1 - math.floor(math.log10(abs(x))))}f}"


def median(values, unit="", scale=1.0):
    """A median with its interval, by the order of the values."""
    values = sorted(scale * value for value in values)
    n = len(values)
    reach = Z * n**0.5 / 2
    low, high = values[max(0, int(n / 2 - reach))], values[min(n - 1, int(n / 2 + reach))]
    return f"{number(statistics.median(values))}{unit} ({number(low)}..{number(high)})"


def mean(values, unit="", digits=3):
    """A mean with its interval."""
    values = list(values)
    middle = statistics.mean(values)
    half = Z * statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else math.nan
    return f"{number(middle, digits)}{unit} (±{number(half)})"


def column(runs, name):
    return [float(run[name]) for run in runs if run[name]]


def cases(path):
    """The runs of each scenario; of each with its method, where methods were swept."""
    scenarios = {}
    with open(path, newline="", encoding="utf-8") as table:
        for run in csv.DictReader(table):
            name = "`, `".join(run[part] for part in ("scenario", "method") if part in run)
            scenarios.setdefault(name, []).append(run)
    return scenarios


def show(head, rows):
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def errors(path):
    head = ["scenario", "mean error", "greatest error", "greatest of all runs", "depth (rms)"]
    head += ["roll", "pitch", "yaw"]
    rows = []
    for scenario, runs in cases(path).items():
        greatest = column(runs, "position_error_max_m")
        row = [f"`{scenario}`", median(column(runs, "position_error_mean_m"), " m"), median(greatest, " m")]
        row += [f"{number(max(greatest))} m", median(column(runs, "depth_error_rms_m"), " cm", 100)]
        row += [median(column(runs, f"{angle}_error_99_deg"), "", MRAD) for angle in ("roll", "pitch", "yaw")]
        rows.append(row)
    show(head, rows)


def percent(values):
    values = [100 * value for value in values]
    if not values:
        return ""
    half = Z * statistics.stdev(values) / len(values) ** 0.5
    return f"{statistics.mean(values):.1f} % (±{half:.1f})"


def consistency(path):
    head = ["scenario", "NEES", "within 95 %", "place within 3 sigma"]
    kinds = ("attitude", "pressure", "velocity", "arrival")
    head += [f"NIS {kind}" for kind in kinds]
    head += ["beyond", "not told"]
    rows = []
    for scenario, runs in cases(path).items():
        row = [f"`{scenario}`", mean(column(runs, "nees")), percent(column(runs, "nees_within_95"))]
        row.append(percent(column(runs, "position_within_3_sigma")))
        for kind in kinds:
            nis, within = column(runs, f"nis_{kind}"), column(runs, f"nis_{kind}_within_95")
            row.append(f"{number(statistics.mean(nis), 3)}, {100 * statistics.mean(within):.1f} %" if nis else "")
        row += [f"{number(statistics.mean(column(runs, name)), 2)} s" for name in ("beyond_s", "unnoticed_s")]
        rows.append(row)
    show(head, rows)


def claims(path):
    """In how many runs the bounds of the paper hold."""
    head = ["scenario", "gyro biases within 1 mrad/s", "accelerometer biases within 50 mm/s²"]
    head += ["99 % of roll and pitch within 20 mrad", "99 % of yaw within 50 mrad"]
    rows = []
    for scenario, runs in cases(path).items():

        def holds(*bounds):
            return wilson(sum(all(float(run[name]) < most for name, most in bounds) for run in runs), len(runs))

        row = [f"`{scenario}`", holds(("gyro_bias_error_max_deg_s", 1 / MRAD))]
        row.append(holds(("accelerometer_bias_error_max_m_s2", 0.05)))
        row.append(holds(("roll_error_99_deg", 20 / MRAD), ("pitch_error_99_deg", 20 / MRAD)))
        row.append(holds(("yaw_error_99_deg", 50 / MRAD)))
        rows.append(row)
    show(head, rows)


def biases(folder):
    """Errors of the biases at some times: medians of their sizes, the greatest of all runs, and how many were within three sigmas."""
    head = ["at", *(f"{sensor} {axis}" for sensor in ("gyroscope", "accelerometer") for axis in "xyz")]
    times = [30.0, 60.0, 100.0, 200.0]
    looks = {time: [] for time in times}
    for track in sorted(Path(folder).glob("*/export/track.csv")):
        with open(track, newline="", encoding="utf-8") as table:
            lines = csv.reader(table)
            names = [name.split(" (")[0] for name in next(lines)]
            for line in lines:
                if float(line[0]) in looks and line[names.index("navigation.nees")]:
                    looks[float(line[0])].append(dict(zip(names, line)))
    rows = []
    for time, runs in looks.items():
        row = [f"{time:.0f} s"]
        for sensor, scale, unit in (("gyro_bias", MRAD, "mrad/s"), ("accelerometer_bias", 1000, "mm/s²")):
            for axis in "xyz":
                off = [scale * abs(float(run[f"navigation.error.{sensor}.{axis}"])) for run in runs]
                known = [scale * float(run[f"navigation.sigma.{sensor}.{axis}"]) for run in runs]
                within = sum(x <= 3 * sigma for x, sigma in zip(off, known))
                row.append(f"{number(statistics.median(off))}, {number(max(off))} {unit}; {within} of {len(off)}")
        rows.append(row)
    show(head, rows)


def boundary(path):
    head = ["scenario", "closed", "no more than 4 m off", "mean error", "median", "greatest"]
    head += ["area within 5 %", "position: mean error", "greatest error", "way"]
    rows = []
    for scenario, runs in cases(path).items():
        found = [run for run in runs if run["error_m"]]
        off = column(found, "error_m")
        areas = [float(run["boundary_surface_m2"]) / float(run["boundary_true_surface_m2"]) - 1 for run in found]
        row = [f"`{scenario}`", wilson(len(found), len(runs)), wilson(sum(x <= 4 for x in off), len(runs))]
        row += [mean(off, " m"), median(off, " m"), f"{max(off):.2f} m"]
        row.append(wilson(sum(abs(area) <= 0.05 for area in areas), len(runs)))
        places = column(runs, "position_error_mean_m")
        row += [median(places, " m"), median(column(runs, "position_error_max_m"), " m")] if places else ["", ""]
        row.append(f"{statistics.median(column(runs, 'path_length_m')) / 1000:.1f} km")
        rows.append(row)
    show(head, rows)


def source(path):
    head = ["scenario", "declared", "within 30 m", "median distance", "97 % below", "median time", "position: mean error"]
    rows = []
    for scenario, runs in cases(path).items():
        off = sorted(column(runs, "error_m"))
        row = [f"`{scenario}`", wilson(len(off), len(runs)), wilson(sum(x <= 30 for x in off), len(runs))]
        row += [median(off, " m"), f"{off[min(len(off) - 1, int(0.97 * len(off)))]:.1f} m"]
        row.append(f"{statistics.median(column(runs, 'report_t_s')) / 60:.1f} min")
        places = column(runs, "position_error_mean_m")
        row.append(median(places, " m") if places else "")
        rows.append(row)
    show(head, rows)


def told(trace):
    """What the trace tells first of the navigation once the fault has begun, and after how long."""
    for line in trace.read_text(encoding="utf-8").splitlines():
        at, _, rest = line.strip().partition(" s  ")
        if "detected: navigation: " in rest and FAULT[0] <= float(at) < FAULT[1]:
            return f"{rest.split('detected: navigation: ')[1].strip()}, after {float(at) - FAULT[0]:.1f} s"
    return "nothing"


def faults(path, folder):
    head = ["fault", "told first", "greatest error", "greatest of all runs", "depth, greatest", "beyond", "not told"]
    rows = []
    for scenario, runs in cases(path).items():
        sensor, _, disorder = scenario.rpartition("_")
        greatest = column(runs, "position_error_max_m")
        row = [f"`{sensor}` {disorder}", told(Path(folder) / scenario / "trace.txt"), median(greatest, " m")]
        row += [f"{number(max(greatest))} m", median(column(runs, "depth_error_max_m"), " m")]
        row += [f"{number(statistics.mean(column(runs, name)), 2)} s" for name in ("beyond_s", "unnoticed_s")]
        rows.append(row)
    show(head, rows)


def main():
    tables = {table.__name__: table for table in (errors, consistency, claims, biases, boundary, source, faults)}
    if len(sys.argv) < 3 or sys.argv[1] not in tables:
        sys.exit(__doc__)
    tables[sys.argv[1]](*sys.argv[2:])


main()
