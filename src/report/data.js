"use strict";
// The parts of the page share this one object: each file adds what it offers to the others.
const report = {};

// What goes wrong is said: a browser may be too old for this page.
addEventListener("error", (event) => {
  if (event.error === null) return;
  const said = document.createElement("p");
  said.className = "warning";
  said.textContent = `This page cannot be drawn by this browser (${event.message}). With scripts off it shows a picture and a list.`;
  document.querySelector("header").append(said);
});

// What the page is about: the embedded data, unpacked, and what is asked of it at a moment.
{
  // Whole numbers that are told as differences, or as they are; what is missing is no number.
  function unpacked(list, scale, isWhole) {
    const out = new Float64Array(list.length);
    let sum = 0;
    for (let i = 0; i < list.length; i++) {
      if (list[i] === null) {
        out[i] = NaN;
      } else {
        sum = isWhole ? list[i] : sum + list[i];
        out[i] = sum / scale;
      }
    }
    return out;
  }

  // What follows from series that are there, such as the bottom from depth and altitude.
  function derive(name, unit, decimals, from, of) {
    const parts = from.map((part) => report.series.get(part));
    if (parts.some((part) => part === undefined) || report.series.has(name)) return;
    const length = Math.max(...parts.map((part) => part.values.length));
    const values = new Float64Array(length);
    for (let i = 0; i < length; i++) {
      values[i] = of(...parts.map((part) => (i < part.values.length ? part.values[i] : NaN)));
    }
    report.series.set(name, { name, unit, decimals, values });
  }
  const turned = (radians) => ((radians * 180) / Math.PI + 360) % 360;

  const slot = (t) => Math.round(t / report.every);
  // A number of a series stands for so long, s, until the next: for some seconds, and of an instrument that is slow longer.
  const OLD_S = 5;

  let [frames, frameEvery, ready, outlines] = [[], 1, new Map(), []];
  // What is told with its reason when nothing is chosen: the last of these.
  const TOLD = new Set(["switch", "resume", "abort", "timeout", "stale", "hold"]);

  function loadSeries(raw) {
    report.series = new Map();
    for (const one of raw.series) {
      const values = unpacked(one.values, 10 ** one.decimals, raw.isWhole);
      report.series.set(one.name, { name: one.name, unit: one.unit, decimals: one.decimals, values });
    }
    derive("bottom", "m", 1, ["depth", "altitude"], (depth, altitude) => depth + altitude);
    for (const flow of ["flow", "flow_below"]) {
      derive(`${flow}_speed`, "m/s", 3, [`${flow}_north`, `${flow}_east`], (n, e) => Math.hypot(n, e));
      derive(`${flow}_toward`, "deg", 0, [`${flow}_north`, `${flow}_east`], (n, e) => turned(Math.atan2(e, n)));
    }
    const apart = ["north", "east", "true_north", "true_east"];
    derive("position_error", "m", 1, apart, (n, e, tn, te) => Math.hypot(n - tn, e - te));
    for (const series of report.series.values()) {
      const gaps = [];
      let before = null;
      series.values.forEach((x, i) => {
        if (Number.isNaN(x)) return;
        if (before !== null) gaps.push(i - before);
        before = i;
      });
      gaps.sort((a, b) => a - b);
      series.old = Math.max(OLD_S, 2.5 * (gaps[gaps.length >> 1] ?? 1) * report.every);
    }
  }

  // When each activity was active, by level. Stretches of a level do not overlap, so that a moment is found by halving.
  function loadSpans(raw) {
    report.levels = [];
    const { activity, level, from, ticks } = raw.spans;
    let tick = 0;
    for (let i = 0; i < activity.length; i++) {
      tick = raw.isWhole ? from[i] : tick + from[i];
      // What has not ended lasts as long as the run has lasted.
      const to = ticks[i] === null ? raw.head.ticks : tick + ticks[i];
      (report.levels[level[i]] ??= []).push({ activity: activity[i], from: tick / 10, to: to / 10 });
    }
    for (let i = 0; i < report.levels.length; i++) report.levels[i] ??= [];
  }

  // Parts of the page that look at the data once are told when it is other.
  const loaders = [];
  report.whenLoaded = function (loader) {
    loaders.push(loader);
    loader();
  };

  report.load = function (raw) {
    report.head = raw.head;
    report.reports = raw.reports;
    report.diagrams = raw.diagrams;
    report.activities = raw.activities;
    report.detection = raw.detection === null ? null : raw.detection * 100;
    report.every = raw.every_s;
    report.leftOut = raw.happenings_left_out;
    // A run that is over at once has an axis all the same.
    report.end = Math.max(raw.head.time_s, 1);
    loadSeries(raw);
    loadSpans(raw);
    report.colours = unpacked(raw.colours, 1, raw.isWhole);
    if (report.happenings?.length !== raw.happenings.length) {
      report.happenings = raw.happenings.map((line, index) => ({ ...line, t: line.tick / 10, index }));
      report.switches = report.happenings.filter((line) => line.verb === "switch" || line.verb === "resume");
      report.decisions = report.happenings.filter((line) => TOLD.has(line.verb));
    }
    frames = raw.plume === null ? [] : raw.plume.frames;
    frameEvery = raw.plume === null ? 1 : raw.plume.every_s;
    ready = new Map();
    report.hasPlume = frames.some((frame) => frame[0].length > 0);
    if (report.world !== raw.world) {
      const { bottom } = raw.world;
      report.world = raw.world;
      report.bottom = bottom === null ? null : { cells: bottom.cells, depths: unpacked(bottom.depths, 10) };
      outlines = raw.world.true_outlines.map((one) => ({
        name: one.name, halfLife: one.half_life_s, at: one.at.map((list) => unpacked(list, 10)), moves: one.moves.map((list) => unpacked(list, 1e6)),
      }));
    }
    for (const loader of loaders) loader();
  };

  // The number of a series at a moment: the last one, if it still stands.
  report.value = function (name, t) {
    const series = report.series.get(name);
    if (series === undefined) return NaN;
    const at = Math.min(slot(t), series.values.length - 1);
    const back = Math.max(1, Math.ceil(series.old / report.every));
    for (let i = at; i >= 0 && i >= slot(t) - back; i--) {
      if (!Number.isNaN(series.values[i])) return series.values[i];
    }
    return NaN;
  };

  // A number as it is shown, with its unit.
  report.told = function (name, x) {
    const series = report.series.get(name);
    if (series === undefined || Number.isNaN(x)) return "–";
    const digits = series.unit === "deg" ? 0 : Math.min(series.decimals, 2);
    const unit = series.unit === "deg" ? "°" : series.unit === "" ? "" : ` ${series.unit}`;
    return x.toFixed(digits) + unit;
  };

  // The last place in a sorted list whose time is not after a moment; -1 for none.
  report.lastBefore = function (list, t, time) {
    let low = 0;
    let high = list.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (time(list[middle]) <= t + 1e-9) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  };

  // What is active at a moment, from outside in.
  report.active = function (t) {
    const chain = [];
    for (const spans of report.levels) {
      const span = spans[report.lastBefore(spans, t, (one) => one.from)];
      // What ends at the end of the run is shown there.
      if (span === undefined || !(t < span.to || (span.to >= report.end && t >= report.end))) break;
      chain.push(span.activity);
    }
    return chain;
  };

  report.behaviorAt = (at) => (at < report.colours.length ? report.colours[at] : NaN);

  // The plume at the moment before; its lists are unpacked when they are wanted.
  report.plumeAt = function (t) {
    if (!report.hasPlume) return null;
    const at = Math.max(0, Math.min(frames.length - 1, Math.round(t / frameEvery)));
    if (!ready.has(at)) {
      const [north, east, radius] = frames[at];
      ready.set(at, { north: unpacked(north, 1), east: unpacked(east, 1), radius: unpacked(radius, 10) });
    }
    return ready.get(at);
  };

  // The true outlines at a moment: north and east of their corners by turns, and what share of the chemical is left.
  report.trueOutlines = function (t) {
    return outlines.map(({ name, halfLife, at: [north, east], moves }) => {
      const left = halfLife === null ? 1 : 2 ** (-t / halfLife);
      const at = Array.from(north).flatMap((x, i) => [x + t * moves[0][i], east[i] + t * moves[1][i]]);
      return { name: halfLife === null ? name : `${name}, ${Math.round(100 * left)} % left`, left, at };
    });
  };

  // Latitude and longitude of a place: a parabola each way through nine known points, which is right to centimetres.
  function parabola(share, a, b, c) {
    return a * 2 * (share - 0.5) * (share - 1) + b * 4 * share * (1 - share) + c * 2 * share * (share - 0.5);
  }
  report.globe = function (north, east) {
    const points = report.world.globe;
    if (points === null) return "";
    const { south, west, north: top, east: right } = report.world.extent;
    const [n, e] = [(north - south) / (top - south), (east - west) / (right - west)];
    const part = (of) => {
      const row = (i) => parabola(e, points[i][of], points[i + 1][of], points[i + 2][of]);
      return parabola(n, row(0), row(3), row(6));
    };
    const written = (degrees, signs) => {
      const thousandths = Math.round(Math.abs(degrees) * 60000);
      const minutes = ((thousandths % 60000) / 1000).toFixed(3);
      return `${Math.floor(thousandths / 60000)}°${minutes}'${degrees < 0 ? signs[1] : signs[0]}`;
    };
    return `${written(part(0), "NS")} ${written(part(1), "EW")}`;
  };

  report.clock = function (t) {
    const whole = Math.floor(t + 1e-6);
    const two = (x) => String(x).padStart(2, "0");
    const hours = Math.floor(whole / 3600);
    return `${hours > 0 ? `${hours}:` : ""}${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  };

  report.load(JSON.parse(document.getElementById("data").textContent));
}
