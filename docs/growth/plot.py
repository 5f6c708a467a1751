"""Draws the picture of docs/growth.md from what measure.py wrote, and prints the table with the exponents.

    python docs/growth/plot.py docs/growth/measured.csv docs/growth

needs matplotlib.
"""

import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "albacore", "svg.fonttype": "none", "font.size": 7})
import matplotlib.pyplot as plt

PANELS = {
    "world": "a run, by its world",
    "files": "files of data",
    "scripts": "scripts",
    "lists": "lists and maps, an hour",
    "reports": "reports",
    "campaigns": "campaigns",
    "prompt": "the prompt",
}


def slope(sizes, costs):
    """The exponent: of a straight line through the upper half of the sizes, by least squares of the logarithms."""
    points = [(math.log(s), math.log(c)) for s, c in zip(sizes, costs)]
    upper = points[min(len(points) // 2, len(points) - 2) :]
    mean_x, mean_y = (sum(values) / len(upper) for values in zip(*upper))
    return sum((x - mean_x) * (y - mean_y) for x, y in upper) / sum((x - mean_x) ** 2 for x, _ in upper)


def draw(cases, to):
    figure, axes = plt.subplots(2, 4, figsize=(13, 8.2))
    for axis, (group, title) in zip(axes.flat, PANELS.items()):
        own = {name: case for name, case in cases.items() if case["group"] == group}
        for i, (name, case) in enumerate(own.items()):
            style = {"color": plt.cm.tab20(i % 20), "linestyle": "-" if i < 20 else "--", "marker": "."}
            label = f"{name.replace('_', ' ')}  {case['slope']:.2f}"
            axis.loglog(case["sizes"], case["costs"], markersize=3, linewidth=0.9, label=label, **style)
        guide(axis, len(own))
        axis.set(title=title, xlabel="size", ylabel="CPU time (s)")
        axis.grid(color="#e2e7ec", linewidth=0.5)
        axis.legend(frameon=False, fontsize=5.2, loc="upper left", ncols=2 if len(own) > 12 else 1, handlelength=1.2, columnspacing=0.8)
    for axis in axes.flat[len(PANELS) :]:
        axis.set_axis_off()
        axis.text(0, 0.9, "dashed: as the size (1)\ndotted: as its square (2)\n\nbehind each name its exponent", va="top", fontsize=8)
    figure.tight_layout()
    figure.savefig(to / "growth.svg", bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)


def guide(axis, names):
    """What grows as its size, and as the square of that, from the middle of the panel; room above for the legend."""
    (left, right), (low, high) = axis.get_xlim(), axis.get_ylim()
    middle = math.sqrt(left * right)
    for power, style in [(1, "--"), (2, ":")]:
        ends = [math.sqrt(low * high) * (x / middle) ** power for x in (left, right)]
        axis.plot([left, right], ends, style, color="#9aa5b1", linewidth=0.8, zorder=0)
    axis.set(xlim=(left, right), ylim=(low, high * (high / low) ** (0.9 if names > 12 else 0.45)))


def shown(size):
    return f"{size:,}"


def tables(cases):
    print("| case | sizes | CPU time, s | memory, MB | exponent |\n|---|---|---|---|---|")
    for group in PANELS:
        for name, case in cases.items():
            if case["group"] == group:
                sizes, costs = case["sizes"], case["costs"]
                memory = case["memory"][-1] / 1024
                row = [f"`{name}`: {case['what']}", f"{shown(sizes[0])} to {shown(sizes[-1])}", f"{costs[0]:.3f} to {costs[-1]:.3f}"]
                print("| " + " | ".join([*row, f"{memory:.0f}", f"{case['slope']:.2f}"]) + " |")


if __name__ == "__main__":
    table, to = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    cases = {}
    for row in csv.DictReader(table.open(encoding="utf-8")):
        case = cases.setdefault(row["case"], {"group": row["group"], "what": row["what"], "sizes": [], "costs": [], "memory": []})
        case["sizes"].append(int(row["size"]))
        case["costs"].append(max(float(row["cpu_s"]), 0.001))
        case["memory"].append(int(row["memory_kib"]))
    for case in cases.values():
        case["slope"] = slope(case["sizes"], case["costs"])
    draw(cases, to)
    tables(cases)
