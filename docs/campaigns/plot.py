"""Draws the pictures of docs/campaigns.md from two tables of `albacore campaign`.

    python docs/campaigns/plot.py trace_plume.csv cpt_2005.csv docs/campaigns

needs pandas and matplotlib.
"""

import pathlib
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "albacore", "svg.fonttype": "none", "font.size": 9})
import matplotlib.pyplot as plt
import pandas as pd

COLOURS = ["#0072b2", "#d55e00"]


def errors(tables, to):
    """Where the first report lies, seen from the source, with the flow going up the page; and how many are how near."""
    figure, (place, share) = plt.subplots(1, 2, figsize=(9, 4.2))
    for (name, table), colour in zip(tables.items(), COLOURS):
        place.plot(table.error_across_m, table.error_along_m, ".", color=colour, markersize=3, label=name)
        near = table.error_m.dropna().sort_values()
        share.step(near, [100 * (i + 1) / len(table) for i in range(len(near))], color=colour, where="post", label=name)
    place.plot(0, 0, "k+", markersize=12)
    place.set(xlabel="to the right of the flow (m)", ylabel="down-flow (m)", xlim=(-60, 60), ylim=(-20, 100), title="first report, from the source")
    place.set_aspect("equal")
    share.set(xlabel="error (m)", ylabel="of all runs (%)", xlim=(0, 60), ylim=(0, 100), title="runs at most so far off")
    share.grid(color="#e2e7ec")
    share.legend(frameon=False, loc="lower right")
    save(figure, to / "errors.svg")


def behaviors(tables, to):
    """What the strategies spend their time with."""
    names = ["find", "track_in", "track_out", "scan", "ride", "regain", "reacquire"]
    figure, axes = plt.subplots(figsize=(9, 1.9))
    for row, table in enumerate(tables.values()):
        left = 0
        for i, name in enumerate(names):
            if f"{name}_s" in table:
                mean = table[f"{name}_s"].mean() / 60
                axes.barh(row, mean, left=left, color=plt.cm.viridis(i / len(names)), label=name)
                left += mean
    axes.set(yticks=range(len(tables)), yticklabels=list(tables), xlabel="mean time in each behavior (min)")
    bars = dict(zip(reversed(axes.get_legend_handles_labels()[1]), reversed(axes.get_legend_handles_labels()[0])))
    labels = [name for name in names if name in bars]
    axes.legend([bars[name] for name in labels], labels, frameon=False, ncols=7, loc="upper center", bbox_to_anchor=(0.5, 1.3))
    save(figure, to / "behaviors.svg")


def save(figure, path):
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)


if __name__ == "__main__":
    *paths, to = map(pathlib.Path, sys.argv[1:])
    tables = {path.stem: pd.read_csv(path) for path in paths}
    errors(tables, to)
    behaviors(tables, to)
