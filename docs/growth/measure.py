"""Measures how the cost of Albacore grows with the work, for docs/growth.md.

    python docs/growth/measure.py target/release/albacore docs/growth/measured.csv [CASE…]

runs each case in each of its sizes, several times, and writes the median of the CPU time (user and system), and the largest
memory. Other work on the machine lengthens the time by the wall, and hardly that of the processor. Only the standard library is needed.
With names of cases only those are measured anew, and take the place of their rows in the table.
"""

import csv
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

import scripts  # noqa: F401, which names its cases
import tables  # noqa: F401
import worlds  # noqa: F401
from cases import CASES


def cost(program, arguments, folder, stdin=os.devnull):
    """CPU seconds and KiB of one process, start and exit included, as a small process of its own sees them: a child's peak of memory is
    never less than what its parent held."""
    with open(folder / stdin) as given, open(folder / "errors", "w") as errors:
        launched = [sys.executable, "-S", "-E", "-c", LAUNCH, program, *arguments]
        told = subprocess.run(launched, cwd=folder, stdin=given, stdout=subprocess.PIPE, stderr=errors, text=True, check=True).stdout
    code, seconds, memory = told.split()
    if code != "0":
        sys.exit(f"{arguments} ended with {code}:\n" + (folder / "errors").read_text()[:600])
    return float(seconds), int(memory)


LAUNCH = """
import os, sys
to = os.open(os.devnull, os.O_WRONLY)
child = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ, file_actions=[(os.POSIX_SPAWN_DUP2, to, 1)])
_, status, usage = os.wait4(child, 0)
print(os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, usage.ru_maxrss)
"""


def measure(program, name):
    group, what, sizes, runs, make, prepare = CASES[name]
    for size in sizes:
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            arguments = make(folder, size)
            stdin = "stdin" if (folder / "stdin").exists() else os.devnull
            for before in prepare(size) if prepare else []:
                cost(program, before, folder)
            there, costs = set(folder.iterdir()), []
            for _ in range(runs):
                for made in set(folder.iterdir()) - there:
                    shutil.rmtree(made) if made.is_dir() else made.unlink()
                costs.append(cost(program, arguments, folder, stdin))
                if sum(seconds for seconds, _ in costs) > 4:
                    break
        seconds = statistics.median(c[0] for c in costs)
        memory = max(c[1] for c in costs)
        print(f"{name:20} {size:>8}  {seconds:9.3f} s  {memory / 1024:8.1f} MB", flush=True)
        yield [group, name, what, size, f"{seconds:.4f}", memory, len(costs), "albacore " + " ".join(arguments)]


if __name__ == "__main__":
    program, table, *names = sys.argv[1:]
    program, table = pathlib.Path(program).resolve(), pathlib.Path(table)
    kept = list(csv.reader(table.open(encoding="utf-8")))[1:] if names and table.exists() else []
    measured = {name: list(measure(program, name)) for name in names or CASES}
    rows = {name: [row for row in kept if row[1] == name] for name in CASES} | measured
    with table.open("w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["group", "case", "what", "size", "cpu_s", "memory_kib", "runs", "command"])
        out.writerows(row for name in CASES for row in rows[name])
