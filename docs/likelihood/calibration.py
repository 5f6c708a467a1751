"""How often the regions of a map of likelihood hold the source: runs a mission that reports `source` and `map` (stdlib/likelihood.alb) seed by
seed, and prints a line for each of its reports. Needs nothing but Python.

    python calibration.py ALBACORE MISSION.alb FIRST LAST [ROWS.csv] [arguments of `albacore run`]
"""

import csv
import json
import math
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor


def above(grid, north, east):
    """The share of the cells that are more probable than that of a place; 1 of a place outside of the map."""
    along = math.radians(grid["along_deg"])
    north -= grid["corner"]["north_m"]
    east -= grid["corner"]["east_m"]
    column = math.floor((north * math.cos(along) + east * math.sin(along)) / grid["cell_m"])
    row = math.floor((east * math.cos(along) - north * math.sin(along)) / grid["cell_m"])
    if not (0 <= column < grid["columns"] and 0 <= row < grid["rows"]):
        return 1.0
    here = grid["cells"][row * grid["columns"] + column]
    return sum(share for share in grid["cells"] if share > here)


def run(albacore, mission, seed, rest):
    told = subprocess.run(
        [albacore, "run", mission, "--seed", str(seed), "--json", "--no-out", *rest],
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False,
    )
    reports = json.loads(told.stdout)["reports"]
    sources = [report for report in reports if report["name"] == "source"]
    maps = [report for report in reports if report["name"] == "map"]
    return [
        {
            "seed": seed,
            "report": number,
            "t_s": source["t_s"],
            "above": above(grid["value"], source["true_north_m"], source["true_east_m"]),
            "region_50_m2": source["labelled"]["region_50"]["value"],
            "region_95_m2": source["labelled"]["region_95"]["value"],
            "error_m": source["error_m"],
        }
        for number, (source, grid) in enumerate(zip(sources, maps, strict=True), start=1)
    ]


def share(held, of, z=1.96):
    """A share in percent, with Wilson's 95 % interval."""
    p = held / of
    middle = (p + z * z / (2 * of)) / (1 + z * z / of)
    half = z * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of)) / (1 + z * z / of)
    return f"{100 * p:.1f} ({100 * (middle - half):.1f} to {100 * (middle + half):.1f})"


def main():
    albacore, mission, first, last, *rest = sys.argv[1:]
    table = rest.pop(0) if rest and rest[0].endswith(".csv") else None
    rows = []
    with ThreadPoolExecutor(2) as pool:
        for of_seed in pool.map(lambda seed: run(albacore, mission, seed, rest), range(int(first), int(last) + 1)):
            rows += of_seed
            if table:
                with open(table, "w", newline="", encoding="utf-8") as file:
                    writer = csv.DictWriter(file, rows[0])
                    writer.writeheader()
                    writer.writerows(rows)
    print("time | runs | in the 50 % region, % | in the 95 % region, % | regions, median, m2 | error, median / p90, m")
    for number in sorted({row["report"] for row in rows}):
        those = [row for row in rows if row["report"] == number]
        errors = sorted(row["error_m"] for row in those)
        middle = {key: statistics.median(row[key] for row in those) for key in ("t_s", "region_50_m2", "region_95_m2")}
        print(
            f"{middle['t_s']:.0f} s", len(those),
            *(share(sum(row["above"] < level for row in those), len(those)) for level in (0.5, 0.95)),
            f"{middle['region_50_m2']:.0f} / {middle['region_95_m2']:.0f}",
            f"{statistics.median(errors):.1f} / {errors[math.ceil(0.9 * len(errors)) - 1]:.1f}",
            sep=" | ",
        )


main()
