#!/usr/bin/env python3
"""Opens reports of runs in a real browser, uses them as a person would, and keeps pictures of them.

It needs Python's playwright and a Chromium, whose path is --browser; it is no part of `cargo test`:

    cargo build --release
    pip install playwright
    python3 tests/report/screenshots.py --browser /usr/bin/chromium --out target/report-pictures

Each run is made anew. The script ends with 1 when a page logs an error, asks for anything over a network, or does not do what it should.
"""

import argparse
import json
import pathlib
import re
import socket
import subprocess
import sys
import time

from playwright.sync_api import sync_playwright

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
# A page is open when it has drawn its first picture; so long it may take, ms.
OPEN_MAX_MS = 1000
BYTES_MAX = 10_000_000

RUNS = {
    "single": ["missions/duck_single.alb"],
    "failed": ["missions/duck_single.alb", "--fault", "fault(position, off, from: 600 s, to: 900 s)"],
    "four_sources": ["missions/duck_regions.alb", "--in", "four_sources", "--set", "thorough=true", "--set", "patience=1h"],
    "survey": ["missions/deepest_point.alb"],
    "layers": ["missions/duck_layers.alb"],
}


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as port:
        port.bind(("127.0.0.1", 0))
        return port.getsockname()[1]


def make_runs(binary, folder):
    """Runs all missions, the last of them on a link, and makes their reports."""
    for name, words in RUNS.items():
        subprocess.run([binary, "run", *words, "--out", folder / name, "--replace"], cwd=REPOSITORY, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    url = f"udp:127.0.0.1:{free_port()}?dialect=recon"
    serving = subprocess.Popen([binary, "vehicle", "missions/box.alb#tidal_stream", "--link", url, "--rate", "40"], cwd=REPOSITORY,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        time.sleep(0.5)
        subprocess.run([binary, "run", "missions/box.alb", "--link", url, "--rate", "40", "--out", folder / "link", "--replace"],
                       cwd=REPOSITORY, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
    finally:
        serving.terminate()
        serving.wait()
    # A run whose journal was cut short.
    cut = folder / "cut"
    cut.mkdir(exist_ok=True)
    journal = (folder / "single" / "journal").read_bytes()
    (cut / "journal").write_bytes(journal[: len(journal) // 2])
    for name in [*RUNS, "link", "cut"]:
        subprocess.run([binary, "report", folder / name], check=True, stderr=subprocess.DEVNULL)


class Page:
    """A page under test, with all that it says and asks for."""

    def __init__(self, browser, path, **settings):
        self.faults = []
        self.name = path.parent.name
        self.context = browser.new_context(viewport={"width": 1280, "height": 800}, **settings)
        self.page = self.context.new_page()
        self.page.on("console", lambda message: self.fault(message.text) if message.type in ("error", "warning") else None)
        self.page.on("pageerror", lambda error: self.fault(f"{error}"))
        self.page.on("request", lambda request: None if request.url.startswith(("file:", "data:")) else self.fault(f"asks for {request.url}"))
        self.url = path.resolve().as_uri()

    def fault(self, text):
        self.faults.append(f"{self.name}: {text}")

    def check(self, holds, what):
        if not holds:
            self.fault(what)

    def open(self, hash=""):
        self.page.goto("about:blank")
        self.page.goto(self.url + hash)
        # Two frames later all is drawn.
        self.page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def now(self):
        return self.page.evaluate("report.t")

    def shot(self, folder, name, whole=False):
        self.page.screenshot(path=folder / f"{self.name}-{name}.png", full_page=whole)


def opening(page):
    """How long a page takes to be drawn, ms, from the moment that it is asked for."""
    page.open()
    return page.page.evaluate("performance.now()")


def try_page(page, folder):
    took = opening(page)
    page.check(took < OPEN_MAX_MS, f"opens in {took:.0f} ms")
    page.check(page.page.evaluate("report.map.canvas.width > 300 && document.getElementById('map').clientHeight > 300"), "the map has no room")
    end = page.page.evaluate("report.end")
    page.shot(folder, "begin")
    # The address holds the moment.
    middle = round(end / 2, 1)
    page.open(f"#t={middle}")
    page.check(abs(page.now() - middle) < 0.06, f"the address says {middle}, the page shows {page.now()}")
    page.shot(folder, "middle")
    page.page.evaluate("location.hash = '#t=12.5'")
    page.page.wait_for_timeout(100)
    page.check(abs(page.now() - 12.5) < 0.06, "a changed address is not followed")
    # The slider, and the address with it.
    page.page.evaluate("""(t) => {
        const slider = document.getElementById("slider");
        slider.value = t;
        slider.dispatchEvent(new Event("input"));
    }""", end / 3)
    page.page.wait_for_timeout(500)
    found = re.search(r"#t=([0-9.]+)$", page.page.evaluate("location.href"))
    page.check(found is not None and abs(float(found.group(1)) - end / 3) < 0.2, "the slider does not change the address")
    # Keys.
    before = page.now()
    page.page.keyboard.press("ArrowRight")
    page.page.wait_for_timeout(60)
    page.check(abs(page.now() - before - 1) < 0.01, "the right arrow is no step of a second")
    if page.page.evaluate("report.switches.some((one) => one.t > report.t + 0.1)"):
        page.page.keyboard.press("n")
        page.page.wait_for_timeout(60)
        page.check(page.page.evaluate("report.switches.some((one) => Math.abs(one.t - report.t) < 0.01)"), "n leads to no switch")
        before = page.now()
    page.page.keyboard.press("Space")
    page.page.wait_for_timeout(700)
    page.check(page.page.evaluate("report.playing") and page.now() > before + 1.5, "space does not play")
    page.page.keyboard.press("Space")
    page.check(not page.page.evaluate("report.playing"), "space does not pause")
    page.page.click("#play")
    page.page.wait_for_timeout(300)
    page.check(page.page.evaluate("report.playing"), "the button does not play")
    page.page.click("#play")
    # A line of the list moves the time and says why.
    switches = page.page.locator("#lines button", has=page.page.locator(".v-switch"))
    if switches.count() > 0:
        row = switches.first
        t = float(row.locator(".t").inner_text())
        row.click()
        page.page.wait_for_timeout(100)
        page.check(abs(page.now() - t) < 0.06, "a line does not move the time")
        page.check(re.search(r"rule at .+:\d+", page.page.inner_text("#why")) is not None, "a line does not say why")
        active = page.page.locator("g[data-behavior].active").count()
        page.check(active > 0 or page.page.locator("#diagrams figure").count() == 0, "no box is highlighted")
    # The pointer on the map and on the timelines.
    box = page.page.locator("#map").bounding_box()
    page.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.check("north" in page.page.inner_text("#hover"), "the map does not tell a place")
    page.page.evaluate("document.getElementById('lines-moment').scrollIntoView({ block: 'end' })")
    box = page.page.locator("#lines-moment").bounding_box()
    page.page.mouse.click(box["x"] + 58 + (box["width"] - 72) * 0.75, box["y"] + box["height"] - 60)
    page.page.wait_for_timeout(100)
    page.check(abs(page.now() - 0.75 * end) < end / 100, f"the timelines lead to {page.now()} and not to {0.75 * end}")
    page.page.evaluate("scrollTo(0, 0)")
    page.shot(folder, "whole", whole=True)
    colours = page.page.locator("#colour option").all_inner_texts()
    for colour in colours:
        page.page.select_option("#colour", label=colour)
    if "chemical" in colours:
        page.page.select_option("#colour", label="chemical")
    page.page.evaluate("scrollTo(0, 0); report.zoomTime(0.2)")
    page.shot(folder, "colour")
    return {"opens_ms": round(took), "end_s": end, "lines": page.page.evaluate("report.happenings.length")}


def try_live(browser, binary, folder):
    """The page of a run that goes on follows it, stays where a person goes, and says what has become of the run."""
    faults = []
    for name, signal, word in [("live-ended", "terminate", "has ended"), ("live-gone", "kill", "is gone")]:
        run = subprocess.Popen([binary, "run", "missions/duck_single.alb", "--live", "--rate", "30", "--no-out"], cwd=REPOSITORY,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            url = re.search(r"http://\S+", run.stderr.readline()).group(0)
            page = browser.new_context(viewport={"width": 1280, "height": 800}).new_page()
            page.on("pageerror", lambda error, name=name: faults.append(f"{name}: {error}"))
            page.goto(url)

            def eventually(what, name=name, page=page):
                # The page's own policy lets nobody evaluate a text in it again and again.
                for _ in range(300):
                    if page.evaluate(what):
                        return
                    time.sleep(0.1)
                faults.append(f"{name}: in vain: {what}")

            eventually("report.end > 90 && report.t === report.end")
            page.screenshot(path=folder / f"{name}-following.png", full_page=True)
            page.evaluate("""() => {
                const slider = document.getElementById("slider");
                slider.value = 30;
                slider.dispatchEvent(new Event("input"));
            }""")
            end = page.evaluate("report.end")
            eventually(f"report.end > {end + 30}")
            if page.evaluate("report.t") != 30:
                faults.append(f"{name}: the page does not stay at the moment that was chosen")
            page.click("#newest")
            eventually("report.t === report.end")
            getattr(run, signal)()
            eventually(f"document.getElementById('live').textContent.includes('{word}')")
            page.screenshot(path=folder / f"{name}.png", full_page=True)
            page.context.close()
        finally:
            run.kill()
            run.wait()
    return faults


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--binary", type=pathlib.Path, default=REPOSITORY / "target" / "release" / "albacore")
    words.add_argument("--browser", help="the path of a Chromium; else the one of playwright")
    words.add_argument("--out", type=pathlib.Path, default=REPOSITORY / "target" / "report-pictures")
    words.add_argument("--keep-runs", action="store_true", help="take the runs that are there already")
    given = words.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    runs = (given.out / "runs").resolve()
    runs.mkdir(exist_ok=True)
    if not given.keep_runs:
        make_runs(given.binary.resolve(), runs)
    faults, told = [], {}
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=given.browser, args=["--no-sandbox"])
        for name in [*RUNS, "link", "cut"]:
            path = runs / name / "report.html"
            page = Page(browser, path)
            told[name] = try_page(page, given.out) | {"bytes": path.stat().st_size}
            page.check(path.stat().st_size <= BYTES_MAX, "it is too large")
            page.context.close()
            faults += page.faults
        # In the dark, without scripts, and on paper.
        dark = Page(browser, runs / "single" / "report.html", color_scheme="dark")
        dark.open("#t=900")
        dark.shot(given.out, "dark", whole=True)
        paper = Page(browser, runs / "single" / "report.html", color_scheme="dark")
        paper.open("#t=900")
        paper.page.emulate_media(media="print")
        paper.page.evaluate("dispatchEvent(new Event('beforeprint'))")
        paper.page.pdf(path=given.out / "single-paper.pdf", format="A4", print_background=True)
        plain = Page(browser, runs / "single" / "report.html", java_script_enabled=False)
        plain.page.goto(plain.url)
        plain.check(plain.page.locator("noscript svg").count() + plain.page.locator("figure svg").count() > 0, "no picture without scripts")
        plain.shot(given.out, "plain", whole=True)
        for page in (dark, paper, plain):
            faults += page.faults
        faults += try_live(browser, given.binary.resolve(), given.out)
        browser.close()
    print(json.dumps(told, indent=1))
    for fault in faults:
        print(f"FAULT {fault}")
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
