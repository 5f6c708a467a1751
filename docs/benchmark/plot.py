"""A picture of docs/benchmark.md, from a table of the benchmark or of its peers.

    python docs/benchmark/plot.py benchmark.csv docs/benchmark/worlds.svg
    python docs/benchmark/plot.py peers.csv docs/benchmark/peers.svg
"""

import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "albacore"
import matplotlib.pyplot as plt
import pandas

COLOURS = ["#0072b2", "#d55e00", "#e69f00", "#009e73", "#cc79a7"]


def name(run):
    """The strategy of a run."""
    if run.mission == "duck_single":
        return "trace_plume"
    if run.mission == "duck_single_2005":
        half = next(column for column in run.index if column.startswith("cpt_2005.half"))
        return f"cpt_2005, bowties of {run[half]:.0f} m"
    return run.mission.removesuffix("_single")


def main(table, picture):
    """Shares within 30 m and times of the first report, by world and strategy."""
    table["strategy"] = table.apply(name, axis=1)
    worlds = list(table.scenario.drop_duplicates())
    strategies = list(table.strategy.drop_duplicates())
    figure, (share, time) = plt.subplots(1, 2, figsize=(10, 5.5), sharey=True)
    many = len(strategies)
    for row, strategy in enumerate(strategies):
        runs = table[table.strategy == strategy].groupby("scenario")
        near = [100 * (runs.get_group(world).error_m < 30).mean() for world in worlds]
        late = [runs.get_group(world).report_t_s.median() / 60 for world in worlds]
        places = [place + 0.78 / many * (row - (many - 1) / 2) for place in range(len(worlds))]
        share.barh(places, near, height=0.72 / many, color=COLOURS[row], label=strategy)
        time.barh(places, late, height=0.72 / many, color=COLOURS[row])
    share.set(yticks=range(len(worlds)), yticklabels=worlds, xlim=(0, 100), xlabel="runs within 30 m of the source (%)")
    time.set(xlabel="median first report (min)")
    share.invert_yaxis()
    for axes in (share, time):
        axes.grid(axis="x", color="#e2e7ec")
        axes.set_axisbelow(True)
    figure.legend(loc="upper center", ncols=many, frameon=False)
    figure.savefig(picture, bbox_inches="tight", metadata={"Date": None})


if __name__ == "__main__":
    main(pandas.read_csv(sys.argv[1]), sys.argv[2])
