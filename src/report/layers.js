// What is drawn on the map, from below: bottom, grid, plume, true outlines, areas and track; what lies on them is in the next part.
{
  const { map } = report;
  const { pen, view } = map;

  // Okabe and Ito's colours, less yellow, plus wine and grey, as in the picture of a run; lighter in the dark.
  const LIGHT = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#882255", "#6b6b6b"];
  const DARK = ["#4aa8e0", "#ff8a3c", "#2fd0a0", "#e79cc8", "#f2b632", "#8fd0f7", "#d0668f", "#a8a8a8"];
  report.whenLoaded(() => {
    report.shownBehaviors = Array.from(new Set(report.colours)).filter((id) => !Number.isNaN(id));
  });
  report.colourOf = function (activity) {
    const palette = report.isDark() ? DARK : LIGHT;
    const at = report.shownBehaviors.indexOf(activity);
    return at < 0 ? (report.isDark() ? "#6d7780" : "#9aa3ab") : palette[at % palette.length];
  };

  // Numbers as colours: five stops, from near the paper's own brightness to far from it, so that high numbers stand out, in grey too.
  const ON_LIGHT = [[172, 186, 200], [104, 158, 206], [104, 100, 190], [146, 40, 130], [88, 0, 38]];
  const ON_DARK = [[84, 92, 110], [70, 110, 160], [40, 160, 150], [110, 215, 110], [253, 231, 37]];
  const STEPS = 32;
  report.scaleColour = function (share) {
    const stops = report.isDark() ? ON_DARK : ON_LIGHT;
    const at = Math.min(Math.max(share, 0), 0.9999) * (stops.length - 1);
    const [a, b] = [stops[Math.floor(at)], stops[Math.floor(at) + 1]];
    const part = at - Math.floor(at);
    return `rgb(${a.map((x, i) => Math.round(x + part * (b[i] - x))).join(",")})`;
  };

  // By what the track is coloured, and the range of that.
  map.colour = "behavior";
  map.range = [0, 1];
  map.colourBy = function (name) {
    map.colour = name;
    const series = report.series.get(name);
    if (series === undefined) return;
    const values = Array.from(series.values).filter((x) => !Number.isNaN(x)).sort((a, b) => a - b);
    const at = (share) => values[Math.round(share * (values.length - 1))];
    // A few wild readings do not decide what all others look like; of a plume every one counts.
    map.range = series.unit === "deg" ? [0, 360] : name === "chemical" ? [0, Math.max(at(1), 1)] : [at(0.005), at(0.995)];
    if (map.range[0] === map.range[1]) map.range = [map.range[0] - 0.5, map.range[1] + 0.5];
  };
  map.colourAt = function (i) {
    if (map.colour === "behavior") return report.colourOf(report.behaviorAt(i));
    const series = report.series.get(map.colour);
    const x = i < series.values.length ? series.values[i] : NaN;
    if (Number.isNaN(x)) return report.isDark() ? "#59636b" : "#b4bbc1";
    if (series.unit === "deg") return `hsl(${Math.round(x / 10) * 10} 75% ${report.isDark() ? 62 : 42}%)`;
    const share = (x - map.range[0]) / (map.range[1] - map.range[0]);
    return report.scaleColour(Math.round(share * STEPS) / STEPS);
  };

  map.shown = { plume: true, "true outline": true, bottom: true, truth: true, detections: true, reports: true, grid: true };

  report.depthAt = function (north, east) {
    const { bottom, world } = report;
    if (bottom === null) return null;
    const { extent } = world;
    const n = Math.floor(((north - extent.south) / (extent.north - extent.south)) * bottom.cells);
    const e = Math.floor(((east - extent.west) / (extent.east - extent.west)) * bottom.cells);
    if (n < 0 || e < 0 || n >= bottom.cells || e >= bottom.cells) return null;
    const depth = bottom.depths[n * bottom.cells + e];
    return Number.isNaN(depth) ? null : depth;
  };

  // The bottom is drawn once, small, and stretched.
  let [bottomImage, imageOf] = [null, null];
  report.whenLoaded(() => {
    if (map.colour !== "behavior") map.colourBy(map.colour);
    if (report.bottom === imageOf) return;
    [bottomImage, imageOf] = [null, report.bottom];
    const depths = Array.from(report.bottom?.depths ?? []).filter((depth) => !Number.isNaN(depth));
    map.bottomRange = [Math.max(0, depths.reduce((a, b) => Math.min(a, b), Infinity)), depths.reduce((a, b) => Math.max(a, b), 0)];
  });
  function bottomPicture() {
    const { cells, depths } = report.bottom;
    const [least, most] = map.bottomRange;
    const picture = document.createElement("canvas");
    picture.width = picture.height = cells;
    const inner = picture.getContext("2d");
    const pixels = inner.createImageData(cells, cells);
    for (let i = 0; i < cells * cells; i++) {
      const depth = depths[i];
      const share = (depth - least) / Math.max(0.1, most - least);
      // Land is sand, water is bluer the deeper it is.
      const colour = depth <= 0 ? [222, 203, 160, 170] : [40, 100, 160, 8 + 92 * share];
      const row = cells - 1 - Math.floor(i / cells);
      pixels.data.set(Number.isNaN(depth) ? [0, 0, 0, 0] : colour, 4 * (row * cells + (i % cells)));
    }
    inner.putImageData(pixels, 0, 0);
    return picture;
  }

  function drawBottom() {
    bottomImage ??= bottomPicture();
    const { south, west, north, east } = report.world.extent;
    pen.save();
    // Within the operating area: beyond it nobody asks.
    const area = report.world.areas[0];
    if (area !== undefined) {
      pen.beginPath();
      for (const [x, y] of pixels(area.at)) pen.lineTo(x, y);
      pen.clip();
    }
    pen.imageSmoothingEnabled = true;
    pen.drawImage(bottomImage, map.x(west), map.y(north), (east - west) * view.scale, (north - south) * view.scale);
    pen.restore();
  }

  // 1, 2 or 5 times a power of ten, so many metres at most.
  function roundDown(most) {
    const ten = 10 ** Math.floor(Math.log10(most));
    return ten * ([5, 2, 1].find((step) => step * ten <= most) ?? 1);
  }

  function drawGrid() {
    const step = roundDown(130 / view.scale);
    pen.strokeStyle = report.ink("rule");
    pen.fillStyle = report.ink("soft");
    pen.lineWidth = 1;
    pen.font = "11px Helvetica, Arial, sans-serif";
    pen.textAlign = "left";
    pen.textBaseline = "alphabetic";
    for (let east = Math.ceil(map.east(0) / step) * step; east <= map.east(view.width); east += step) {
      stroke([[map.x(east), 0], [map.x(east), view.height]]);
      if (map.x(east) + 44 < view.width) pen.fillText(`${Math.round(east * 10) / 10} E`, map.x(east) + 3, view.height - 4);
    }
    for (let north = Math.ceil(map.north(view.height) / step) * step; north <= map.north(0); north += step) {
      stroke([[0, map.y(north)], [view.width, map.y(north)]]);
      pen.fillText(`${Math.round(north * 10) / 10} N`, 4, map.y(north) - 3);
    }
  }

  function stroke(points, closed) {
    pen.beginPath();
    points.forEach(([x, y], i) => (i === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
    if (closed) pen.closePath();
    pen.stroke();
  }

  const pixels = (at) => Array.from({ length: at.length / 2 }, (_, i) => [map.x(at[2 * i + 1]), map.y(at[2 * i])]);

  // Text that can be read on anything.
  function label(text, x, y, colour, align) {
    pen.font = "12px Helvetica, Arial, sans-serif";
    pen.textAlign = align ?? "left";
    pen.textBaseline = "middle";
    pen.lineWidth = 3.5;
    pen.lineJoin = "round";
    pen.strokeStyle = report.ink("paper");
    pen.strokeText(text, x, y);
    pen.fillStyle = colour;
    pen.fillText(text, x, y);
  }

  function outline(named, colour, dash, width, fill) {
    const points = pixels(named.at);
    if (points.length === 0) return;
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dash);
    stroke(points, true);
    pen.setLineDash([]);
    if (fill) {
      pen.fillStyle = fill;
      pen.fill();
    }
  }

  map.outlineColour = { reported: "#7b1fa2", get true() { return report.isDark() ? "#ebc85a" : "#8a6d1f"; } };

  // What fades is fainter, but for its name.
  function drawTrueOutlines(t) {
    const colour = map.outlineColour.true;
    for (const one of report.trueOutlines(t)) {
      pen.globalAlpha = Math.max(one.left, 0.3);
      outline(one, colour, [], 1.5, report.isDark() ? "rgba(235,200,90,0.12)" : "rgba(176,141,47,0.14)");
      pen.globalAlpha = 1;
      nameAtBottom(one, colour);
    }
  }

  // The name of what is true stands at its southernmost corner, clear of the name of what was reported of it; what is off the map has none.
  function nameAtBottom(named, colour) {
    const onMap = pixels(named.at).filter(([x, y]) => x > 0 && y > 0 && x < view.width && y < view.height);
    if (onMap.length === 0) return;
    const [x, y] = onMap.reduce((a, b) => (b[1] > a[1] ? b : a));
    label(named.name, Math.min(Math.max(x, 4), view.width - 60), Math.min(y + 9, view.height - 9), colour);
  }

  // Other names stand at the northernmost corner, inside the map.
  function nameAtTop(named, colour) {
    const top = pixels(named.at).reduce((a, b) => (b[1] < a[1] ? b : a), [0, Infinity]);
    label(named.name, Math.min(Math.max(top[0], 4), view.width - 60), Math.max(top[1] - 9, 9), colour);
  }

  function drawAreas() {
    const { areas, outlines, no_go } = report.world;
    areas.forEach((area, i) => outline(area, report.ink(i === 0 ? "ink" : "soft"), i === 0 ? [7, 4] : [3, 3], i === 0 ? 1.6 : 1.1));
    for (const zone of no_go) outline(zone, "#c62828", [], 1.4, "rgba(198,40,40,0.13)");
    const reported = map.shown.reports ? outlines : [];
    for (const area of reported) outline(area, map.outlineColour.reported, [2, 2], 1.6);
    for (const area of areas.slice(1)) nameAtTop(area, report.ink("soft"));
    for (const zone of no_go) nameAtTop(zone, "#c62828");
    for (const area of reported) nameAtTop(area, map.outlineColour.reported);
  }

  // A filament is a Gaussian: a soft disc, drawn once and stretched.
  const discs = new Map();
  function disc(rgb) {
    if (!discs.has(rgb)) {
      const picture = document.createElement("canvas");
      picture.width = picture.height = 64;
      const inner = picture.getContext("2d");
      const soft = inner.createRadialGradient(32, 32, 0, 32, 32, 32);
      for (let i = 0; i <= 8; i++) soft.addColorStop(i / 8, `rgba(${rgb},${Math.exp(-2.2 * (i / 8) ** 2) * (1 - i / 8)})`);
      inner.fillStyle = soft;
      inner.fillRect(0, 0, 64, 64);
      discs.set(rgb, picture);
    }
    return discs.get(rgb);
  }

  function drawPlume(t) {
    const plume = report.plumeAt(t);
    if (plume === null) return;
    const picture = disc(report.isDark() ? "235,200,90" : "176,141,47");
    pen.globalAlpha = 0.6;
    for (let i = 0; i < plume.north.length; i++) {
      const radius = Math.max(4.5, 2 * plume.radius[i] * view.scale);
      const [x, y] = [map.x(plume.east[i]), map.y(plume.north[i])];
      if (x > -radius && y > -radius && x < view.width + radius && y < view.height + radius) {
        pen.drawImage(picture, x - radius, y - radius, 2 * radius, 2 * radius);
      }
    }
    pen.globalAlpha = 1;
  }

  // A way in stretches of one colour. Where positions are missing for long there is a gap.
  const GAP_SLOTS = 30;
  function drawWay(north, east, from, to, colourAt) {
    let colour = null;
    let last = null;
    pen.lineJoin = "round";
    for (let i = Math.max(0, from); i <= Math.min(to, north.length - 1); i++) {
      if (Number.isNaN(north[i]) || Number.isNaN(east[i])) continue;
      const [x, y] = [map.x(east[i]), map.y(north[i])];
      const now = colourAt(i);
      if (last === null || now !== colour || i - last.i > GAP_SLOTS) {
        if (last !== null) pen.stroke();
        pen.beginPath();
        pen.strokeStyle = colour = now;
        if (last !== null && i - last.i <= GAP_SLOTS) {
          pen.moveTo(last.x, last.y);
          pen.lineTo(x, y);
        } else {
          pen.moveTo(x, y);
        }
      } else {
        pen.lineTo(x, y);
      }
      last = { i, x, y };
    }
    if (last !== null) pen.stroke();
  }

  function drawTrack(t) {
    const [north, east] = [report.series.get("north"), report.series.get("east")];
    const [trueNorth, trueEast] = [report.series.get("true_north"), report.series.get("true_east")];
    const now = Math.round(t / report.every);
    if (map.shown.truth && trueNorth !== undefined) {
      pen.lineWidth = 1.2;
      pen.setLineDash([4, 3]);
      const soft = report.ink("soft");
      drawWay(trueNorth.values, trueEast.values, 0, now, () => soft);
      pen.setLineDash([]);
    }
    if (north === undefined) return;
    pen.lineWidth = 1.4;
    pen.globalAlpha = 0.32;
    drawWay(north.values, east.values, now, Infinity, map.colourAt);
    pen.globalAlpha = 1;
    pen.lineWidth = 2.2;
    drawWay(north.values, east.values, 0, now, map.colourAt);
  }

  // What the marks need of these.
  Object.assign(map, { stroke, pixels, label, roundDown });

  map.layers = function () {
    const { t } = report;
    pen.fillStyle = report.ink("paper");
    pen.fillRect(0, 0, view.width, view.height);
    if (map.shown.bottom && report.bottom !== null) drawBottom();
    if (map.shown.grid) drawGrid();
    if (map.shown.plume) drawPlume(t);
    if (map.shown["true outline"]) drawTrueOutlines(t);
    drawAreas();
    drawTrack(t);
    map.marks(t);
  };
}
