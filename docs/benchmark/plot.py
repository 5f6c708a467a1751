"""The picture of docs/benchmark.md, from the table of the benchmark.

    python docs/benchmark/plot.py benchmark.csv docs/benchmark
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "albacore"
import matplotlib.pyplot as plt
import pandas

COLOURS = ["#0072b2", "#d55e00", "#e69f00"]


def main(table, to):
    """Shares within 30 m and times of the first report, by world and strategy."""
    half = next(name for name in table if name.startswith("cpt_2005.half"))
    table["strategy"] = [
        "trace_plume" if mission == "duck_single" else f"cpt_2005, bowties of {size:.0f} m"
        for mission, size in zip(table.mission, table[half])
    ]
    worlds = list(table.scenario.drop_duplicates())
    strategies = list(table.strategy.drop_duplicates())
    figure, (share, time) = plt.subplots(1, 2, figsize=(10, 5.5), sharey=True)
    for row, strategy in enumerate(strategies):
        runs = table[table.strategy == strategy].groupby("scenario")
        near = [100 * (runs.get_group(world).error_m < 30).mean() for world in worlds]
        late = [runs.get_group(world).report_t_s.median() / 60 for world in worlds]
        places = [place + 0.26 * (row - 1) for place in range(len(worlds))]
        share.barh(places, near, height=0.24, color=COLOURS[row], label=strategy)
        time.barh(places, late, height=0.24, color=COLOURS[row])
    share.set(yticks=range(len(worlds)), yticklabels=worlds, xlim=(0, 100), xlabel="runs within 30 m of the source (%)")
    time.set(xlabel="median first report (min)")
    share.invert_yaxis()
    for axes in (share, time):
        axes.grid(axis="x", color="#e2e7ec")
        axes.set_axisbelow(True)
    figure.legend(loc="upper center", ncols=3, frameon=False)
    figure.savefig(to / "worlds.svg", bbox_inches="tight", metadata={"Date": None})


if __name__ == "__main__":
    main(pandas.read_csv(sys.argv[1]), Path(sys.argv[2]))
