"""Cases of docs/growth.md: reports, campaigns and their tables, the prompt."""

from cases import case, mission, run, write
from scripts import table
from worlds import LASTING

SHORT = mission("    wait for 1 s")


@case("reports", [1_000, 10_000, 100_000, 400_000])
def reports(folder, n):
    """reports of a run, one in each tick, with its run folder"""
    body = f"    wait for {n / 10} s"
    text = mission(body, "lasting", top='    on depth >= 0 m { report "here": position, deep: depth }', inputs=", depth")
    write(folder, "grow.alb", text + LASTING.format(name="lasting", base="calm"))
    return ["run", "grow.alb", "--out", "out", "--replace"]


@case("reports", [1_000, 10_000, 100_000, 400_000])
def reports_json(folder, n):
    """the same: run --json without a folder"""
    reports(folder, n)
    return run("--json")


@case("reports", [10, 100, 1_000, 5_000])
def report_names(folder, n):
    """names of reports, of ten seeds: campaign"""
    body = "\n".join(f'    report "r{i}": position, deep: depth' for i in range(n)) + "\n    wait for 1 s"
    write(folder, "grow.alb", mission(body, inputs=", depth"))
    return ["campaign", "grow.alb", "--seeds", "1..10", "--threads", "1", "--out", "grow.csv"]


@case("reports", [10, 100, 1_000])
def report_columns(folder, n):
    """reports of one name, with columns of their own, of ten seeds: campaign --reports"""
    body = f'    for i in 1..{n} {{\n        report "r": position, deep: depth\n        wait for 1 s\n    }}'
    write(folder, "grow.alb", mission(body, inputs=", depth"))
    return ["campaign", "grow.alb", "--seeds", "1..10", "--threads", "1", "--reports", str(n), "--out", "grow.csv"]


SEEDS = [1_000, 10_000, 100_000, 1_000_000]


@case("campaigns", [10, 100, *SEEDS])
def seeds(folder, n):
    """seeds of a mission of a second"""
    write(folder, "grow.alb", SHORT)
    return ["campaign", "grow.alb", "--seeds", f"1..{n}", "--threads", "1", "--out", "grow.csv"]


def shard(i, n):
    return ["campaign", "grow.alb", "--seeds", f"1..{n}", "--threads", "1", "--shard", f"{i}/8", "--out", f"part-{i}.csv"]


@case("campaigns", SEEDS, prepare=lambda n: [shard(i, n) for i in range(1, 9)])
def merge(folder, n):
    """rows of eight tables: campaign merge"""
    write(folder, "grow.alb", SHORT)
    return ["campaign", "merge", *(f"part-{i}.csv" for i in range(1, 9)), "--out", "grow.csv"]


@case("campaigns", SEEDS, prepare=lambda n: [seeds_of("a.csv", n)])
def compare(folder, n):
    """rows of a table that is compared with itself: campaign compare"""
    write(folder, "grow.alb", SHORT)
    return ["campaign", "compare", "a.csv", "a.csv"]


def seeds_of(table, n):
    return ["campaign", "grow.alb", "--seeds", f"1..{n}", "--threads", "1", "--out", table]


@case("campaigns", SEEDS, prepare=lambda n: [seeds_of("a.csv", n)])
def resume(folder, n):
    """rows of a table that is gone on with by a seed: campaign --resume"""
    write(folder, "grow.alb", SHORT)
    return [*seeds_of("a.csv", n), "--resume"]


@case("campaigns", [1, 10, 100, 1_000])
def sweep(folder, n):
    """cases of a sweep, two seeds of each"""
    text = mission("    wait for pause").replace("mission grow", "mission grow(pause: Duration = 1 s in 1 s..1 h)")
    write(folder, "grow.alb", text)
    values = ",".join(f"{1 + i / 1000}s" for i in range(n))
    return ["campaign", "grow.alb", "--sweep", f"pause={values}", "--seeds", "1..2", "--threads", "1", "--out", "grow.csv"]


@case("campaigns", [1, 4, 16, 64, 256], prepare=lambda n: [shard_of(i, n) for i in range(1, n + 1)])
def parts(folder, n):
    """tables of 10 rows each: campaign merge"""
    write(folder, "grow.alb", SHORT)
    return ["campaign", "merge", *(f"part-{i}.csv" for i in range(1, n + 1)), "--out", "grow.csv"]


def shard_of(i, n):
    return ["campaign", "grow.alb", "--seeds", f"1..{10 * n}", "--threads", "1", "--shard", f"{i}/{n}", "--out", f"part-{i}.csv"]


@case("campaigns", [10, 100, 1_000, 4_000])
def columns(folder, n):
    """behaviors, each with two columns, of a hundred seeds"""
    write(folder, "grow.alb", table(n, 1, apart=1).replace("for 1 min", "for 10 s"))
    return ["campaign", "grow.alb", "--seeds", "1..100", "--threads", "1", "--out", "grow.csv"]


@case("prompt", [10, 100, 1_000, 3_000])
def prompt(folder, n):
    """lines at the prompt, a second each: repl"""
    write(folder, "stdin", "steer north at depth 2 m, speed 1 m/s for 1 s\n" * n)
    return ["repl"]


@case("prompt", [10, 100, 1_000])
def declared(folder, n):
    """lines at the prompt that declare something: repl"""
    write(folder, "stdin", "".join(f"let a{i} = {i} m\n" for i in range(n)))
    return ["repl"]


@case("prompt", [1, 3, 10])
def back(folder, n):
    """hours at the prompt, from which twenty lines go back: repl"""
    write(folder, "stdin", f"steer north at depth 2 m, speed 1 m/s for {n} h\n" + "back 10 s\n" * 20)
    return ["repl"]
