"""Cases of docs/growth.md: what a script is made of, and how it is checked, laid out, tested and run."""

import math

from cases import case, mission, run, write
from worlds import LASTING

# A behavior, a function, a strategy and a record: 20 lines of a script.
SOUND = """/// Legs to one side, longer and longer.
record Sighting_{0} {{ at: Point, strength: Number }}
const most_{0}: Angle = 30 deg
fn lean_{0}(side: Sign, share: Number) -> Angle {{
    let turned = side * share * most_{0}
    clamp(turned, -most_{0}, most_{0})
}}
behavior fan_{0}(legs: Int = 3 in 1..10) -> Sighting_{0} {{
    for n in 1..legs {{
        steer north + lean_{0}(+1, n / 10) for n * 20 s
    }}
    finish Sighting_{0}(at: position, strength: 0.5)
}}
strategy search_{0}(patience: Duration = 10 min) {{
    behavior out {{ fan_{0}(legs: 4) }}
    behavior home_{0} {{ goto point(north: 0 m, east: 0 m) }}
    start out
    out -> home_{0} on done or after patience
    home_{0} -> finish on done
}}
"""
LINES = [100, 1_000, 10_000, 100_000]


def sound(n):
    parts = range(max(1, n // 21))
    calls = "\n".join(f"    search_{i}()" for i in parts)
    return "".join(SOUND.format(i) for i in parts) + mission(calls)


@case("scripts", LINES)
def check(folder, n):
    """lines of a script: check"""
    write(folder, "grow.alb", sound(n))
    return ["check", "grow.alb"]


@case("scripts", LINES)
def fmt(folder, n):
    """lines of a script: fmt"""
    write(folder, "grow.alb", sound(n))
    return ["fmt", "grow.alb"]


@case("scripts", LINES)
def fmt_flat(folder, n):
    """lines of a script whose margins are gone: fmt --check, then fmt"""
    write(folder, "grow.alb", "\n".join(line.strip() if line.startswith("  ") else line for line in sound(n).split("\n")))
    return ["fmt", "grow.alb"]


@case("scripts", LINES[:3])
def doc(folder, n):
    """lines of a script: doc"""
    write(folder, "grow.alb", sound(n))
    return ["doc", "grow.alb", "--out", "out"]


@case("scripts", LINES)
def run_lines(folder, n):
    """lines of a script: a run of a second"""
    write(folder, "grow.alb", sound(n).replace("wait", "") + mission("    wait for 1 s", name="short"))
    return run("--mission", "short")


@case("scripts", [4, 16, 64, 250])
def modules(folder, n):
    """modules that a script imports, each of 210 lines: check"""
    for i in range(n):
        write(folder, f"part{i}.alb", "".join(SOUND.format(j) for j in range(10)))
    uses = "use " + ", ".join(f"part{i}" for i in range(n)) + "\n"
    write(folder, "grow.alb", uses + mission("\n".join(f"    part{i}.search_3()" for i in range(n))))
    return ["check", "grow.alb"]


@case("scripts", [4, 16, 64, 250])
def chain(folder, n):
    """modules that import one another in a row: check"""
    for i in range(n):
        use = f"use part{i + 1}\n" if i < n - 1 else ""
        more = f"fn next() -> Number {{ part{i + 1}.here() }}\n" if i < n - 1 else ""
        write(folder, f"part{i}.alb", use + "fn here() -> Number { 0.5 }\n" + more)
    write(folder, "grow.alb", "use part0\n" + mission("    let x = part0.next()\n    steer north + x * 1 deg for 1 s"))
    return ["check", "grow.alb"]


def repeated(n, line):
    return "\n".join(f"    {line.format(i, i + 1)}" for i in range(n))


@case("scripts", [100, 1_000, 10_000, 50_000])
def statements(folder, n):
    """statements of one behavior: check"""
    write(folder, "grow.alb", "behavior long() {\n" + repeated(n, "steer north + {0} * 1 mrad for 1 s") + "\n}\n" + mission("    long()"))
    return ["check", "grow.alb"]


@case("scripts", [100, 1_000, 4_000, 16_000])
def texts(folder, n):
    """behaviors, each with a text and a report: check"""
    one = 'behavior b{0}() {{\n    log "at {0}"\n    wait for 1 s\n    report "r{0}": position\n}}\n'
    write(folder, "grow.alb", "".join(one.format(i) for i in range(n)) + mission(repeated(n, "b{0}()")))
    return ["check", "grow.alb"]


@case("scripts", [100, 1_000, 4_000, 10_000])
def tables(folder, n):
    """strategies, each with a behavior and two rules: run"""
    one = """strategy s{0}() {{
    behavior a{0} {{ wait for 1 s }}
    start a{0}
    a{0} -> abort "no {0}" on after 3 s
    a{0} -> finish on done
}}
"""
    write(folder, "grow.alb", "".join(one.format(i) for i in range(n)) + mission(repeated(n, "s{0}()")))
    return run()


@case("scripts", [100, 1_000, 10_000])
def names(folder, n):
    """names that follow from one another in one body: check"""
    body = "    let a0 = depth\n" + repeated(n, "let a{1} = a{0} + 1 mm")
    write(folder, "grow.alb", mission(body + f"\n    keep depth a{n} for 1 s", inputs=", depth"))
    return ["check", "grow.alb"]


@case("scripts", [100, 1_000, 10_000])
def memories(folder, n):
    """memories, each with a reaction: check"""
    top = "\n".join(f"    memory m{i}: Int = 0\n    on becomes m{i} > 3 {{ m{i} = m{i} + 1 }}" for i in range(n))
    write(folder, "grow.alb", mission("    wait for 1 s", top=top))
    return ["check", "grow.alb"]


@case("scripts", [100, 1_000, 3_000])
def memories_run(folder, n):
    """the same: ten minutes of a run"""
    top = "\n".join(f"    memory m{i}: Int = 0\n    on becomes m{i} > 3 {{ m{i} = m{i} + 1 }}" for i in range(n))
    write(folder, "grow.alb", mission("    wait for 10 min", top=top))
    return run()


def table(n, exits, apart=7):
    behaviors = "\n".join(f"    behavior b{i} {{ steer {i % 360} deg for {1 + i % 7} s }}" for i in range(n))
    rules = "\n".join(
        f"    b{i} -> b{(i * apart + j + 1) % n} on " + ("done" if j == 0 else f"after {100 + j} s and depth > {j} m") for i in range(n) for j in range(exits)
    )
    return f"strategy all() {{\n{behaviors}\n    start b0\n{rules}\n}}\n" + mission("    all() for 1 min", inputs=", depth")


@case("scripts", [16, 64, 256, 1_024, 4_096])
def behaviors(folder, n):
    """behaviors of one strategy, a rule each: check"""
    write(folder, "grow.alb", table(n, 1, apart=1))
    return ["check", "grow.alb"]


@case("scripts", [16, 64, 256, 1_024, 4_096])
def graph(folder, n):
    """the same: graph"""
    write(folder, "grow.alb", table(n, 1, apart=1))
    return ["graph", "grow.alb", "all"]


@case("scripts", [4, 16, 64, 250])
def rules(folder, n):
    """rules of each of 16 behaviors: check"""
    write(folder, "grow.alb", table(16, n))
    return ["check", "grow.alb"]


@case("scripts", [4, 16, 64, 250])
def rules_run(folder, n):
    """the same: a run of a minute, a hundred times"""
    write(folder, "grow.alb", table(16, n).replace("for 1 min", "for 100 min"))
    return run()


@case("scripts", [4, 16, 64, 256, 1_024])
def any_rules(folder, n):
    """behaviors that `any` leaves, to each: check"""
    some = min(n, 250)
    behaviors = "\n".join(f"    behavior b{i} {{ steer {i % 360} deg for 5 s }}" for i in range(n))
    rules = "\n".join(f"    any -> b{i} on becomes depth > {i + 1} m" for i in range(min(some, 65000 // n)))
    ends = "\n".join(f"    b{i} -> b{(i + 1) % n} on done" for i in range(n))
    write(folder, "grow.alb", f"strategy all() {{\n{behaviors}\n    start b0\n{rules}\n{ends}\n}}\n" + mission("    all() for 1 min", inputs=", depth"))
    return ["check", "grow.alb"]


@case("scripts", [1, 4, 16, 60])
def nesting(folder, n):
    """levels of `if` in one another, in 200 behaviors: check"""
    one = "".join("if depth > 1 m { " for _ in range(n)) + "wait for 1 s" + " }" * n
    write(folder, "grow.alb", "".join(f"behavior b{i} {{ {one} }}\n" for i in range(200)) + mission(repeated(200, "b{0}()"), inputs=", depth"))
    return ["check", "grow.alb"]


@case("scripts", [10, 100, 1_000, 5_000])
def missions(folder, n):
    """missions of one script, all calling one strategy: check"""
    text = table(16, 4).split("mission")[0] + "".join(mission("    all() for 1 min", inputs=", depth", name=f"m{i}") for i in range(n))
    write(folder, "grow.alb", text)
    return ["check", "grow.alb"]


@case("scripts", [10, 100, 1_000, 10_000])
def tests(folder, n):
    """tests of a file: test"""
    one = 'test "t{0}" {{\n    run grow in calm seeds 1..1\n    expect time < 1 min\n}}\n'
    write(folder, "grow.alb", mission("    wait for 1 s") + "".join(one.format(i) for i in range(n)))
    return ["test", "grow.alb"]


@case("scripts", [10, 100, 1_000])
def test_rows(folder, n):
    """rows of a test: test"""
    text = mission("    wait for pause").replace("mission grow", "mission grow(pause: Duration = 1 s in 1 s..1 h)")
    rows = "".join(f"    with pause: {1 + i % 10} s\n" for i in range(n))
    write(folder, "grow.alb", text + f'test "t" {{\n    run grow in calm seeds 1..1\n{rows}    expect time < 1 min\n}}\n')
    return ["test", "grow.alb"]


@case("scripts", [1, 4, 16, 64])
def expectations(folder, n):
    """expectations of a run of an hour, each on every tick: test"""
    lines = "".join(f"    expect always truth.depth < {i + 10} m\n" for i in range(n))
    write(folder, "grow.alb", mission("    wait for 1 h") + f'test "t" {{\n    run grow in calm seeds 1..1\n{lines}}}\n')
    return ["test", "grow.alb"]


@case("scripts", [10, 100, 1_000, 10_000])
def switches(folder, n):
    """switches in the trace that a test keeps: test --accept"""
    strategy = "strategy all() {\n    behavior a { wait for 0.5 s }\n    behavior b { wait for 0.5 s }\n    start a\n    a -> b on done\n    b -> a on done\n}\n"
    test = 'test "t" {\n    run grow in lasting seeds 1..1\n    expect completed\n    snapshot switches of seed 1\n}\n'
    write(folder, "grow.alb", strategy + mission(f"    all() for {n * 0.5} s", "lasting") + LASTING.format(name="lasting", base="calm") + test)
    return ["test", "grow.alb", "--accept"]


@case("scripts", [4, 16, 64, 256, 1_024])
def corners(folder, n):
    """corners of an area: check"""
    write(folder, "grow.alb", cornered(n, "    wait for 1 s"))
    return ["check", "grow.alb"]


def cornered(n, body, with_="depth 2 m, speed 2 m/s"):
    """A star: every other corner is a dent."""
    def corner(i):
        turn, far = 2 * math.pi * i / n, 500 if i % 2 else 450
        return f"point(north: {far * math.cos(turn):.2f} m, east: {far * math.sin(turn):.2f} m)"

    text = mission(body, with_=with_)
    begin, end = text.index("    area op"), text.index("    limits")
    return text[:begin] + "    area op = polygon([\n" + ",\n".join(corner(i) for i in range(n)) + "\n    ])\n" + text[end:]


@case("scripts", [4, 16, 64, 256, 1_024])
def corners_cage(folder, n):
    """the same: ten minutes in its cage"""
    write(folder, "grow.alb", "use safety\n" + cornered(n, "    steer north for 10 min", "safety.cage(op), depth 2 m, speed 2 m/s"))
    return run()


@case("scripts", [4, 16, 64, 256])
def corners_rows(folder, n):
    """the same: 100 rows in it, once"""
    write(folder, "grow.alb", cornered(n, "    let x = 1\n    for row in op.rows(10 m) { log \"{row.length + x * 1 m}\" }\n    wait for 1 s"))
    return run()


@case("scripts", [10, 100, 1_000])
def waypoints(folder, n):
    """points that a mission goes to, one after another: run"""
    write(folder, "grow.alb", mission(repeated(n, "goto op.center + {0} * 1 m toward {0} * 30 deg for 5 s")))
    return run()


# Lists


def listed(n, kind, each, before=""):
    """A list of capacity n, which is full after n ticks, and what is done with it on each tick after those, for an hour."""
    top = f"""    memory kept: [Length; {n}]{kind}
    memory sum: Length = 0 m
    on every one_tick {{ kept.insert(sum) }}
    on elapsed > 105 s {{ {each} }}
    on sum > 1e9 m {{ sum = kept.first else 0 m }}"""
    return before + mission("    wait for 1 h", top=top, inputs=", elapsed")


CAPACITIES = [16, 32, 64, 128, 256, 512, 1_024]


@case("lists", CAPACITIES)
def push(folder, n):
    """elements of a full list, one inserted in each tick, for an hour"""
    write(folder, "grow.alb", listed(n, "", "sum = kept.first else 0 m"))
    return run()


@case("lists", CAPACITIES)
def ordered(folder, n):
    """elements of an ordered list, one inserted in each tick, for an hour"""
    write(folder, "grow.alb", listed(n, " by most it", "sum = sum + 1 m"))
    return run()


@case("lists", CAPACITIES)
def walk(folder, n):
    """elements of a list, walked in each tick of an hour"""
    write(folder, "grow.alb", listed(n, "", "for x in kept { sum = x }"))
    return run()


@case("lists", CAPACITIES)
def function(folder, n):
    """elements of a list that a function takes in each tick of an hour"""
    before = "fn total(values: [Length; n]) -> Length {\n    var sum = 0 m\n    for x in values { sum = sum + x }\n    sum\n}\n"
    write(folder, "grow.alb", listed(n, "", "sum = total(kept)", before))
    return run()


@case("lists", [16, 64, 256, 1_024, 4_096])
def cells(folder, n):
    """cells of a map, walked in each tick of an hour"""
    top = f"    memory smelt: Map[Ratio; {n}] = map(over: op, each: 0)\n    memory sum: Ratio = 0\n    on elapsed > 1 s {{ sum = 0; for x in smelt {{ sum = sum + x }}; smelt[position] = sum }}"
    write(folder, "grow.alb", mission("    wait for 1 h", top=top, inputs=", elapsed"))
    return run()
