"""Opens every export with readers that others wrote, and holds what they read against the CSV.

    python -m venv readers && readers/bin/pip install pandas xarray scipy netCDF4 compliance-checker mcap jsonschema lxml fastkml gpxpy geopandas
    readers/bin/python tests/export/readers.py target/release/albacore

A run in simulation, one over a link, one whose journal is cut short and a campaign are made in a folder that is removed at the end.
Then the examples of docs/python.md are executed. It prints a line for each reader, and ends with 1 where one disagrees. A reader that is
not installed is told, and no disagreement.
"""

import contextlib
import importlib
import io
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy
import pandas

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORMATS = ["--csv", "--geojson", "--kml", "--gpx", "--netcdf", "--mcap", "--alog"]
KML, GX, GPX = "{http://www.opengis.net/kml/2.2}", "{http://www.google.com/kml/ext/2.2}", "{http://www.topografix.com/GPX/1/1}"


def near(what, found, expected, within=1e-6):
    found, expected = numpy.asarray(found, float), numpy.asarray(expected, float)
    assert found.shape == expected.shape, f"{what}: {found.shape} values, and {expected.shape} in the table"
    assert (numpy.isnan(found) == numpy.isnan(expected)).all(), f"{what}: other values are absent"
    off = numpy.abs(found - expected) / numpy.maximum(1, numpy.abs(expected))
    assert not (off > within).any(), f"{what}: off by {numpy.nanmax(off)}"


def variable(head):
    return re.sub(r"[^A-Za-z0-9]", "_", re.sub(r" \(.*\)$", "", head))


def numbers(table):
    """The columns of numbers, by the names that programs have for them."""
    columns = {variable(head): head for head in table.columns}
    texts = {"behavior", "control", "reported", "vehicle_mode", "utc"}
    return {name: table[head].astype(float).values for name, head in columns.items() if name not in texts}


class Run:
    """What is exported of a run, and the table of it."""

    def __init__(self, folder):
        self.folder = folder
        self.table = pandas.read_csv(folder / "track.csv", low_memory=False)
        seconds = self.table["time (s)"].values
        whole = numpy.isclose(seconds % 1, 0, atol=0.01) | numpy.isclose(seconds % 1, 1, atol=0.01)
        whole[-1] = True
        known = self.table["latitude (deg)"].notna().values
        self.mapped = self.table[whole & known]
        self.reports = self.table["reported"].dropna()

    def path(self, ending):
        return self.folder / f"track.{ending}"

    def is_simulated(self):
        return "truth.north (m)" in self.table.columns


def by_pandas(run):
    assert run.table["time (s)"].is_monotonic_increasing
    return f"{len(run.table)} rows, {len(run.table.columns)} columns"


def by_xarray(run):
    import xarray

    with xarray.open_dataset(run.path("nc"), engine="scipy") as data:
        seconds = (data.time.values - data.time.values[0]) / numpy.timedelta64(1, "ns") / 1e9
        near("time", seconds, run.table["time (s)"] - run.table["time (s)"][0])
        for name, column in numbers(run.table).items():
            if name != "time":
                near(name, data[name].values, column)
        behaviors = [text.decode() for text in data.behavior.values]
        assert behaviors == run.table["behavior"].fillna("").tolist(), "other behaviors"
        held = run.table["latitude (deg)"].ffill()
        near("lat", data.lat.values, held, 1e-7)
        assert set(data.depth.coords) == {"time", "lat", "lon", "z"}, data.depth.coords
        return f"{len(data.data_vars)} variables, from {str(data.time.values[0])[:19]} on"


def by_scipy(run):
    from scipy.io import netcdf_file

    with netcdf_file(run.path("nc"), mmap=False) as data:
        depth = data.variables["depth"].data.astype(float)
        depth[depth > 9e36] = numpy.nan
        near("depth", depth, run.table["depth (m)"])
        return f"{data.version_byte=}, {data.featureType.decode()}"


def by_netcdf4(run):
    import netCDF4

    with netCDF4.Dataset(run.path("nc")) as data:
        assert data.data_model == "NETCDF3_CLASSIC" and data["trajectory"].cf_role == "trajectory_id"
        near("heading", data["heading"][:].filled(numpy.nan), run.table["heading (deg)"])
        return f"{data.data_model}, {data.Conventions}"


def by_compliance_checker(run):
    from compliance_checker.runner import CheckSuite, ComplianceChecker

    CheckSuite.load_all_available_checkers()
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        passed, errors = ComplianceChecker.run_checker(str(run.path("nc")), ["cf:1.8"], 0, "strict", output_format="text")
    assert passed and not errors, said.getvalue()
    return "cf:1.8, strict: " + ("no error" if passed else "errors")


def by_mcap(run):
    from mcap.reader import make_reader

    schemas, states, fixes, logs, reports = {}, [], [], 0, 0
    with open(run.path("mcap"), "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        for schema, channel, message in reader.iter_messages():
            value = json.loads(message.data)
            schemas.setdefault(schema.name, (json.loads(schema.data), []))[1].append(value)
            states += [value] if channel.topic == "/state" else []
            fixes += [value] if channel.topic == "/position" else []
            logs += channel.topic == "/log"
            reports += channel.topic == "/reports"
        about = {record.name: record.metadata for record in reader.iter_metadata()}
    for name, column in numbers(run.table).items():
        key = "time_s" if name == "time" else name
        near(name, [state.get(key, math.nan) for state in states], column)
    held = run.table["longitude (deg)"].ffill().dropna()
    near("longitude", [fix["longitude"] for fix in fixes], held, 1e-7)
    assert summary.statistics.message_count == sum(len(values) for _, values in schemas.values())
    assert logs > 0 and reports >= len(run.reports) and about["run"]["mission"]
    checked = ""
    with contextlib.suppress(ImportError):
        import jsonschema

        for schema, values in schemas.values():
            validator = jsonschema.Draft7Validator(schema)
            assert all(validator.is_valid(value) for value in values[:: max(1, len(values) // 500)]), schema["title"]
        checked = ", valid by their schemas"
    return f"{summary.statistics.message_count} messages of {sorted(schemas)}{checked}"


def by_json(run):
    with open(run.path("geojson"), encoding="utf-8") as file:
        features = json.load(file, parse_constant=lambda name: sys.exit(f"{name} is no JSON"))["features"]
    track = next(feature for feature in features if feature["properties"]["name"] == "track")
    near("longitude", [point[0] for point in track["geometry"]["coordinates"]], run.mapped["longitude (deg)"], 1e-9)
    near("depth", [-point[2] for point in track["geometry"]["coordinates"]], run.table["depth (m)"].ffill()[run.mapped.index])
    return f"{len(features)} features"


def by_geopandas(run):
    import geopandas

    frame = geopandas.read_file(run.path("geojson"))
    track = frame[frame["name"] == "track"].geometry.iloc[0]
    near("latitude", [point[1] for point in track.coords], run.mapped["latitude (deg)"], 1e-9)
    area = frame[frame["kind"] == "area"].geometry.iloc[0]
    assert area.is_valid and area.exterior.is_ccw, "the area does not go round against the clock"
    inside = frame[frame["kind"] == "report"].geometry.within(area.buffer(1e-3))
    assert inside.all(), "reports far outside the area"
    return f"CRS {frame.crs.to_string()}, area of {frame[frame['kind'] == 'area'].to_crs(frame.estimate_utm_crs()).area.iloc[0]:.0f} m2"


def by_gdal_kml(run):
    import pyogrio

    layers = pyogrio.list_layers(run.path("kml"))
    kinds = set()
    for name, _ in layers:
        kinds |= set(pyogrio.read_dataframe(run.path("kml"), layer=name).geometry.geom_type)
    assert "Polygon" in kinds and kinds & {"LineString", "MultiLineString"}, kinds
    return f"{len(layers)} layers, {sorted(kinds)}"


def by_gdal_gpx(run):
    import pyogrio

    points = pyogrio.read_dataframe(run.path("gpx"), layer="track_points")
    first = points[points["track_fid"] == 0]
    near("latitude", first.geometry.y, run.mapped["latitude (deg)"], 1e-9)
    routes = pyogrio.read_dataframe(run.path("gpx"), layer="routes")
    return f"{len(points)} track points, {len(routes)} route, {len(pyogrio.read_dataframe(run.path('gpx'), layer='waypoints'))} waypoints"


def by_lxml(run):
    from lxml import etree

    tree = etree.parse(str(run.path("kml")))
    track = tree.find(f".//{GX}Track")
    coords = [coord.text.split() for coord in track.findall(f"{GX}coord")]
    whens = [when.text for when in track.findall(f"{KML}when")]
    near("longitude", [coord[0] for coord in coords], run.mapped["longitude (deg)"], 1e-9)
    assert len(whens) == len(coords) and whens == sorted(whens)
    gpx = etree.parse(str(run.path("gpx")))
    order = [child.tag.removeprefix(GPX) for child in gpx.getroot()]
    wanted = ["metadata", "wpt", "rte", "trk"]
    assert order == sorted(order, key=wanted.index), order
    return f"{len(coords)} coordinates from {whens[0]} to {whens[-1]}"


def by_fastkml(run):
    from fastkml import kml
    from fastkml.utils import find_all

    document = kml.KML.parse(run.path("kml"))
    marks = list(find_all(document, of_type=kml.Placemark))
    assert len(marks) >= 2 and any(mark.geometry is not None and mark.geometry.geom_type == "Polygon" for mark in marks)
    return f"{len(marks)} placemarks"


def by_gpxpy(run):
    import gpxpy

    with open(run.path("gpx"), encoding="utf-8") as file:
        gpx = gpxpy.parse(file)
    points = gpx.tracks[0].segments[0].points
    near("latitude", [point.latitude for point in points], run.mapped["latitude (deg)"], 1e-9)
    seconds = [(point.time - points[0].time).total_seconds() for point in points]
    times = run.mapped["time (s)"]
    near("time", seconds, times - times.iloc[0], 1e-6)
    return f"{len(points)} points, {gpx.tracks[0].length_3d():.0f} m long, {len(gpx.waypoints)} waypoints"


def by_lines(run):
    """The log of MOOS by its columns: no reader of it is to be had as a package."""
    log = [line.split(None, 3) for line in open(run.path("alog"), encoding="utf-8") if not line.startswith("%%")]
    for name, head in [("NAV_X", "east (m)"), ("NAV_LAT", "latitude (deg)"), ("DESIRED_HEADING", "commanded.heading (deg)")]:
        told = [(float(time), float(value)) for time, of, _, value in log if of == name]
        column = run.table[["time (s)", head]].dropna()
        near(f"time of {name}", [time for time, _ in told], column["time (s)"])
        near(name, [value for _, value in told], column[head])
    assert len([1 for _, name, _, _ in log if name == "REPORT"]) >= len(run.reports)
    return f"{len(log)} lines, {len({name for _, name, _, _ in log})} variables"


READERS = {
    "track.csv by pandas": ("pandas", by_pandas),
    "track.nc by xarray": ("xarray", by_xarray),
    "track.nc by scipy": ("scipy", by_scipy),
    "track.nc by netCDF4": ("netCDF4", by_netcdf4),
    "track.nc by compliance-checker": ("compliance_checker", by_compliance_checker),
    "track.mcap by mcap": ("mcap", by_mcap),
    "track.geojson by json": ("json", by_json),
    "track.geojson by geopandas": ("geopandas", by_geopandas),
    "track.kml by GDAL": ("pyogrio", by_gdal_kml),
    "track.gpx by GDAL": ("pyogrio", by_gdal_gpx),
    "track.kml, track.gpx by lxml": ("lxml", by_lxml),
    "track.kml by fastkml": ("fastkml", by_fastkml),
    "track.gpx by gpxpy": ("gpxpy", by_gpxpy),
    "track.alog by its lines": ("re", by_lines),
}


def over_a_link(albacore, folder):
    """The run of a mission on a vehicle at the end of a pseudo terminal."""
    served = [albacore, "vehicle", str(ROOT / "missions/box.alb#tidal_stream"), "--link", "pty:?dialect=recon", "--rate", "50"]
    with open(folder / "vehicle.txt", "w+") as said:
        vehicle = subprocess.Popen(served, stdout=said, stderr=said)
        try:
            for _ in range(100):
                found = re.search(r"serial:(\S+)\?", (folder / "vehicle.txt").read_text())
                if found:
                    break
                time.sleep(0.1)
            link = f"serial:{found[1]}?dialect=recon"
            mission = ROOT / "missions/box.alb"
            command = [albacore, "run", mission, "--link", link, "--rate", "50", "--out", folder / "link"]
            subprocess.run(command, check=True, capture_output=True, timeout=120)
        finally:
            vehicle.terminate()
            vehicle.wait(10)


def runs(albacore, folder):
    """Runs of every kind, each with the name of its exports."""
    call = lambda *words: subprocess.run([albacore, *words], cwd=folder, check=True, capture_output=True, text=True)
    call("run", ROOT / "missions/duck_single.alb", "--out", "run")
    over_a_link(albacore, folder)
    journal = (folder / "run/journal").read_bytes()
    (folder / "cut").mkdir()
    (folder / "cut/journal").write_bytes(journal[: len(journal) // 2])
    for run in ["run", "link", "cut"]:
        said = call("export", run, *FORMATS).stderr
        assert ("cut short at byte" in said) == (run == "cut"), said
    call("campaign", ROOT / "missions/duck_single.alb", "--seeds", "1..20", "--out", "table.csv")
    return {name: Run(folder / name / "export") for name in ["run", "link", "cut"]}


def examples(folder):
    """Executes the examples of docs/python.md, in the folder of the runs."""
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)
    os.chdir(folder)
    for number, block in enumerate(blocks, 1):
        lines = [line for line in block.splitlines() if line.strip()]
        assert len(lines) <= 10, f"example {number} has {len(lines)} lines"
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(block, f"docs/python.md, example {number}", "exec"), {})
        print(f"docs/python.md, example {number}: {len(lines)} lines\n" + re.sub("(?m)^", "    ", printed.getvalue().rstrip()))


def main():
    albacore, failed = pathlib.Path(sys.argv[1]).resolve(), 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for kind, run in runs(albacore, folder).items():
            for name, (module, read) in READERS.items():
                try:
                    importlib.import_module(module)
                except ImportError:
                    print(f"{kind:<5} {name:<32} not installed")
                    continue
                try:
                    print(f"{kind:<5} {name:<32} {read(run)}")
                except Exception as error:
                    failed += 1
                    print(f"{kind:<5} {name:<32} FAILED: {type(error).__name__}: {error}")
        examples(folder)
        os.chdir(ROOT)
    print(f"{failed} failed")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
