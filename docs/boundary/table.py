"""Prints the table of docs/boundary.md from tables of campaigns: python3 docs/boundary/table.py TABLE.csv ..."""

import csv
import statistics
import sys

Z = 1.96


def wilson(hits, n):
    """The 95 % interval of a share, in percent."""
    share, square = hits / n, Z * Z
    centre = (share + square / (2 * n)) / (1 + square / n)
    half = Z / (1 + square / n) * (share * (1 - share) / n + square / (4 * n * n)) ** 0.5
    return 100 * max(0, centre - half), 100 * min(1, centre + half)


def median_interval(values):
    """The 95 % interval of a median, by the order of the values."""
    values, n = sorted(values), len(values)
    reach = Z * n**0.5 / 2
    return values[max(0, int(n / 2 - reach))], values[min(n - 1, int(n / 2 + reach))]


def row(name, runs):
    found = [run for run in runs if run["error_m"]]
    errors = sorted(float(run["error_m"]) for run in found)
    areas = [float(run["boundary_surface_m2"]) / float(run["boundary_true_surface_m2"]) - 1 for run in found]
    n = len(runs)
    low, high = wilson(len(found), n)
    cells = [*name, f"{len(found)} of {n} ({low:.0f}..{high:.0f} %)"]
    if errors:
        least, most = median_interval(errors)
        cells += [
            f"{statistics.mean(errors):.2f} m",
            f"{statistics.median(errors):.2f} m ({least:.2f}..{most:.2f})",
            f"{errors[min(len(errors) - 1, int(0.97 * len(errors)))]:.2f} m",
            f"{sum(abs(area) <= 0.05 for area in areas)} of {n}",
        ]
    else:
        cells += ["", "", "", f"0 of {n}"]
    length = statistics.median(float(run["path_length_m"]) for run in runs)
    return "| " + " | ".join([*cells, f"{length / 1000:.1f} km"]) + " |"


def main():
    print("| scenario | method | closed | mean error | median | 97 % below | area within 5 % | way |")
    print("|---|---|---|---|---|---|---|---|")
    for path in sys.argv[1:]:
        cases = {}
        with open(path, newline="", encoding="utf-8") as table:
            for run in csv.DictReader(table):
                cases.setdefault((run["scenario"], run["method"]), []).append(run)
        for (scenario, method), runs in cases.items():
            print(row((f"`{scenario}`", f"`{method}`"), runs))


main()
