"""Draws the maps of one run, `albacore run MISSION.alb --seed N --json > run.json`: the regions that hold 50 and 95 %, the mean and the source.

    python plot.py run.json FOLDER

Needs matplotlib."""

import json
import math
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "albacore"
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection


def cells_of(grid, holds):
    """The corners of the fewest cells that hold a share."""
    along, side = math.radians(grid["along_deg"]), grid["cell_m"]
    ahead, right = (math.sin(along), math.cos(along)), (math.cos(along), -math.sin(along))
    held, found = 0.0, []
    for index in sorted(range(len(grid["cells"])), key=lambda i: -grid["cells"][i]):
        if held >= holds:
            break
        held += grid["cells"][index]
        row, column = divmod(index, grid["columns"])
        found.append([
            tuple(
                grid["corner"][name] + side * ((column + i) * ahead[axis] + (row + j) * right[axis])
                for axis, name in enumerate(("east_m", "north_m"))
            )
            for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))
        ])
    return found


def main():
    reports = json.load(open(sys.argv[1], encoding="utf-8"))["reports"]
    sources = [report for report in reports if report["name"] == "source"]
    maps = [report for report in reports if report["name"] == "map"]
    figure, axes = plt.subplots(1, len(maps), figsize=(3.1 * len(maps), 3.4), layout="constrained")
    for axis, source, grid in zip(axes, sources, maps, strict=True):
        for holds, shade in ((0.95, "#9ecae1"), (0.5, "#08519c")):
            axis.add_collection(PolyCollection(cells_of(grid["value"], holds), facecolor=shade, edgecolor="none"))
        axis.plot(source["east_m"], source["north_m"], "o", color="white", markeredgecolor="black", markersize=5)
        axis.plot(source["true_east_m"], source["true_north_m"], "x", color="red", markersize=8)
        axis.autoscale()
        axis.margins(0.15)
        axis.set_aspect("equal", "datalim")
        axis.set_title(f"{source['t_s'] / 60:.0f} min", fontsize=10)
        axis.tick_params(labelsize=7)
    axes[0].set_ylabel("north, m")
    figure.supxlabel("east, m", fontsize=9)
    figure.savefig(f"{sys.argv[2]}/maps.svg", metadata={"Date": None})


main()
