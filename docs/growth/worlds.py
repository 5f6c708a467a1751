"""Cases of docs/growth.md: the world of a run, and the files of data that it reads."""

import math
import struct

from cases import case, mission, run, write

DUCK = """scenario {name} = duck_2003 with {{
{clauses}
}}
"""
LASTING = """scenario {name} = {base} with {{
    vehicle(kinematic(endurance: 1000 h), start: point(north: 0 m, east: 0 m), depth: 2 m)
    navigation()
}}
"""
SMELL = "    memory smelt: Int = 0\n    on chemical > 4 % { smelt = smelt + 1 }\n    on smelt > 100000000 { smelt = 0 }"
MOW = """behavior mow(box: Area) {
    loop {
        for row in box.rows(40 m) { follow row }
        wait for 1 s
    }
}
"""
ROWS = "    mow(op) for {hours} h"


def along(forward, right):
    """A place in the area of Duck, by its long side and across it."""
    turn = math.radians(320)
    north = forward * math.cos(turn) - right * math.sin(turn)
    east = forward * math.sin(turn) + right * math.cos(turn)
    return f"point(north: {north:.2f} m, east: {east:.2f} m)"


@case("world", [1, 2, 4, 8, 16])
def sources(folder, n):
    """sources of a plume, an hour of rows"""
    lines = [f'    source("s{i}", at: {along(480, (i + 0.5) / n * 300 - 150)}, height: 0.2 m, rate: 1 Hz)' for i in range(n)]
    lines.append('    source("dye", at: ' + along(480, -160) + ", rate: 1e-6 Hz)")
    text = MOW + mission(ROWS.format(hours=1), "many", inputs=", chemical", top=SMELL)
    write(folder, "grow.alb", text + DUCK.format(name="many", clauses="\n".join(lines)))
    return run()


def larger(folder, n, region):
    length, width = 1094 * math.sqrt(n), 367 * math.sqrt(n)
    clauses = [f'    source("dye", at: {along(length * 0.44, 0)}, height: 0.2 m, rate: 1 Hz)']
    if region:
        clauses.append(f"    region(rectangle(center: 36°10.804'N 75°44.458'W, along: 320 deg, length: {length:.0f} m, width: {width:.0f} m))")
    clauses.append("    vehicle(kinematic, start: point(north: 0 m, east: 0 m))")
    text = MOW + mission(ROWS.format(hours=1), "large", inputs=", chemical", side=(round(length), round(width)), top=SMELL)
    write(folder, "grow.alb", text + DUCK.format(name="large", clauses="\n".join(clauses)))
    return run()


@case("world", [1, 2, 4, 8, 16])
def box(folder, n):
    """times the plume's box and the area, an hour of rows"""
    return larger(folder, n, region=True)


@case("world", [1, 4, 16, 64])
def rows(folder, n):
    """times the area of a survey in rows, to its end, without a plume"""
    side = (round(1094 * math.sqrt(n)), round(367 * math.sqrt(n)))
    body = "    for row in op.rows(40 m) { follow row }"
    write(folder, "grow.alb", mission(body, "lasting", "1000 h", side=side) + LASTING.format(name="lasting", base="calm"))
    return run()


@case("world", [1, 2, 4, 8, 16, 24])
def hours(folder, n):
    """hours of a mission in the plume of Duck"""
    write(folder, "grow.alb", MOW + mission(ROWS.format(hours=n), "lasting", inputs=", chemical", top=SMELL) + LASTING.format(name="lasting", base="duck_2003"))
    return run()


@case("world", [1, 2, 4, 8, 16, 24])
def hours_kept(folder, n):
    """hours of a mission without a plume, with its run folder"""
    top = "    record position, heading, battery at 1 Hz"
    write(folder, "grow.alb", MOW + mission(ROWS.format(hours=n), "lasting", top=top) + LASTING.format(name="lasting", base="calm"))
    return ["run", "grow.alb", "--out", "out", "--replace"]



def depth_at(row, column):
    return -100 - (row * 7 + column * 13) % 83


def survey_csv(folder, n):
    side = round(math.sqrt(n))
    with open(folder / "bay.csv", "w", encoding="utf-8") as file:
        file.write(f"# north 0..{side - 1} n={side} east 0..{side - 1} n={side} metres\n")
        for row in range(side):
            file.write(",".join(str(depth_at(row, column)) for column in range(side)) + "\n")


def survey_netcdf(folder, n):
    """NetCDF classic: y and x in metres, z in whole metres."""
    side = round(math.sqrt(n))

    def text(word):
        return struct.pack(">i", len(word)) + word.encode() + b"\0" * (-len(word) % 4)

    def variable(name, dims, kind, size, begin):
        units = struct.pack(">ii", 12, 1) + text("units") + struct.pack(">i", 2) + text("m")
        ids = struct.pack(f">i{len(dims)}i", len(dims), *dims)
        return text(name) + ids + units + struct.pack(">iii", kind, size, begin)

    def head(at):
        dims = struct.pack(">ii", 10, 2) + text("y") + struct.pack(">i", side) + text("x") + struct.pack(">i", side)
        ends = [at, at + 8 * side, at + 16 * side]
        parts = variable("y", [0], 6, 8 * side, ends[0]) + variable("x", [1], 6, 8 * side, ends[1])
        parts += variable("z", [0, 1], 4, 4 * side * side, ends[2])
        return b"CDF\1" + struct.pack(">i", 0) + dims + struct.pack(">ii", 0, 0) + struct.pack(">ii", 11, 3) + parts

    with open(folder / "bay.nc", "wb") as file:
        file.write(head(len(head(0))))
        axis = struct.pack(f">{side}d", *range(side))
        file.write(axis + axis)
        for row in range(side):
            file.write(struct.pack(f">{side}i", *(depth_at(row, column) for column in range(side))))


def surveyed(folder, file, body, inputs=""):
    clauses = f'scenario bay {{\n    bottom_grid("{file}", at: point(north: 0 m, east: 0 m))\n    vehicle(kinematic, start: point(north: 0 m, east: 0 m))\n}}\n'
    write(folder, "grow.alb", mission(body, "bay", side=(12, 12), inputs=inputs) + clauses)


SURVEYS = [1_000, 10_000, 100_000, 1_000_000, 4_000_000]


@case("files", SURVEYS)
def survey(folder, n):
    """cells of a survey in CSV: check"""
    survey_csv(folder, n)
    surveyed(folder, "bay.csv", "    wait for 1 s")
    return ["check", "grow.alb"]


@case("files", SURVEYS)
def survey_nc(folder, n):
    """cells of a survey in NetCDF: check"""
    survey_netcdf(folder, n)
    surveyed(folder, "bay.nc", "    wait for 1 s")
    return ["check", "grow.alb"]


@case("files", SURVEYS)
def survey_run(folder, n):
    """the same: a run of a second, with its picture"""
    survey_netcdf(folder, n)
    surveyed(folder, "bay.nc", "    wait for 1 s")
    return ["run", "grow.alb", "--out", "out", "--replace"]


@case("files", SURVEYS)
def survey_seeds(folder, n):
    """the same: ten seeds of a campaign"""
    survey_netcdf(folder, n)
    surveyed(folder, "bay.nc", "    wait for 1 s")
    return ["campaign", "grow.alb", "--seeds", "1..10", "--threads", "1", "--out", "grow.csv"]


@case("files", [1_000, 10_000, 100_000, 1_000_000])
def played(folder, n):
    """rows of a recording that is played: a run of a second"""
    rows = "".join(f"{i * 0.1:.1f},{10 + i % 50 / 10}\n" for i in range(n))
    write(folder, "dive.csv", "time (s),temperature (degC)\n" + rows)
    scenario = 'scenario again = calm with {\n    played("temperature", file: "dive.csv")\n}\n'
    write(folder, "grow.alb", mission("    wait for 1 s", "again") + scenario)
    return run()


@case("files", [10, 100, 1_000, 10_000])
def chart(folder, n):
    """polygons in a GeoJSON, of which one is read: check"""
    box = "[[[-75.75,36.17],[-75.73,36.17],[-75.73,36.19],[-75.75,36.19],[-75.75,36.17]]]"
    one = '{{"type":"Feature","properties":{{"name":"a{0}"}},"geometry":{{"type":"Polygon","coordinates":{1}}}}}'
    features = ",".join(one.format(i, box) for i in range(n))
    write(folder, "bay.geojson", '{"type":"FeatureCollection","features":[' + features + "]}")
    text = mission("    wait for 1 s").replace("area op = ", f'area op = area_file("bay.geojson", named: "a{n - 1}") //')
    write(folder, "grow.alb", text)
    return ["check", "grow.alb"]


def things(n, line):
    """Ten minutes in a world in which so many things are."""
    clauses = "\n".join("    " + line(i) for i in range(n))
    return mission("    steer north for 10 min", "full") + f"scenario full = calm with {{\n{clauses}\n}}\n"


@case("world", [16, 64, 256, 1_024])
def no_go(folder, n):
    """areas of no_go, ten minutes"""
    outline = "rectangle(center: {}, along: 0 deg, length: 20 m, width: 20 m)"
    write(folder, "grow.alb", things(n, lambda i: f'no_go("z{i}", {outline.format(along(i - 500, 90))})'))
    return run()


@case("world", [16, 64, 256, 1_024])
def pits(folder, n):
    """pits of the bottom, ten minutes"""
    write(folder, "grow.alb", things(n, lambda i: f'pit("p{i}", at: {along(i - 500, 90)}, depth: 1 cm, radius: 10 m)'))
    return run()


@case("world", [16, 64, 256, 1_024])
def faults(folder, n):
    """faults, one after another, ten minutes"""
    write(folder, "grow.alb", things(n, lambda i: f"fault(flow, off, from: {i}.0 s, to: {i}.5 s)"))
    return run()
