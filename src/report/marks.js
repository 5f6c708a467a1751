// What lies on the map: detections, sources, reports, the vehicle, north, flow and scale.
{
  const { map } = report;
  const { pen, view, stroke, pixels, label, roundDown } = map;

  function drawDetections(t) {
    const [chemical, north, east] = ["chemical", "north", "east"].map((name) => report.series.get(name));
    if (chemical === undefined || north === undefined || report.detection === null) return;
    pen.strokeStyle = report.isDark() ? "#ffffff" : "#111111";
    pen.lineWidth = 1;
    pen.globalAlpha = 0.75;
    pen.beginPath();
    const end = Math.min(Math.round(t / report.every), chemical.values.length - 1, north.values.length - 1);
    // Of detections beside one another one is enough: the track is to be seen beneath them.
    const taken = new Set();
    for (let i = 0; i <= end; i++) {
      if (!(chemical.values[i] >= report.detection) || Number.isNaN(north.values[i])) continue;
      const [x, y] = [map.x(east.values[i]), map.y(north.values[i])];
      const cell = Math.round(x / 7) * 100000 + Math.round(y / 7);
      if (taken.has(cell)) continue;
      taken.add(cell);
      pen.moveTo(x - 2.5, y - 2.5);
      pen.lineTo(x + 2.5, y + 2.5);
      pen.moveTo(x - 2.5, y + 2.5);
      pen.lineTo(x + 2.5, y - 2.5);
    }
    pen.stroke();
    pen.globalAlpha = 1;
  }

  function star(x, y, radius, fill) {
    pen.beginPath();
    for (let i = 0; i < 10; i++) {
      const [r, angle] = [i % 2 === 0 ? radius : radius * 0.45, (i * Math.PI) / 5];
      pen.lineTo(x + r * Math.sin(angle), y - r * Math.cos(angle));
    }
    pen.closePath();
    pen.fillStyle = fill;
    pen.fill();
    pen.strokeStyle = report.ink("paper");
    pen.lineWidth = 1;
    pen.stroke();
  }

  function drawFound(t) {
    for (const source of report.world.sources) {
      const points = pixels(source.at);
      pen.strokeStyle = "#c62828";
      pen.lineWidth = 3;
      if (points.length > 1) stroke(points);
      star(points[0][0], points[0][1], 9, "#d32f2f");
    }
    if (report.world.deepest !== null) star(map.x(report.world.deepest[1]), map.y(report.world.deepest[0]), 9, "#d32f2f");
    if (report.world.start !== null) {
      const [x, y] = [map.x(report.world.start[1]), map.y(report.world.start[0])];
      pen.strokeStyle = report.ink("ink");
      pen.lineWidth = 2;
      pen.strokeRect(x - 5, y - 5, 10, 10);
    }
    if (!map.shown.reports) return;
    const named = [];
    // Many rings hide one another and the track.
    const radius = report.reports.length > 25 ? 4 : 8;
    for (const one of report.reports) {
      if (one.north === null) continue;
      const [x, y] = [map.x(one.east), map.y(one.north)];
      // What is still to come has a ring and no name.
      const isTold = one.t <= t;
      pen.globalAlpha = isTold ? 1 : 0.35;
      pen.strokeStyle = pen.fillStyle = "#c2185b";
      pen.lineWidth = radius > 4 ? 2.4 : 1.3;
      pen.beginPath();
      pen.arc(x, y, radius, 0, 2 * Math.PI);
      pen.stroke();
      pen.beginPath();
      pen.arc(x, y, radius > 4 ? 2.2 : 1, 0, 2 * Math.PI);
      pen.fill();
      if (isTold) named.push({ text: `${one.name}, ${report.clock(one.t)}`, x, y });
      pen.globalAlpha = 1;
    }
    placeLabels(named);
  }

  // Names beside their places, each where no other is; the latest come first, and what finds no room has none.
  const NAMES_MAX = 60;
  function placeLabels(named) {
    const taken = [];
    pen.font = "12px Helvetica, Arial, sans-serif";
    for (const { text, x, y } of [...named].reverse().slice(0, NAMES_MAX)) {
      const wide = pen.measureText(text).width;
      const left = x + 13 + wide > view.width ? x - 13 - wide : x + 13;
      const isFree = (at) => taken.every((one) => left > one.left + one.wide || one.left > left + wide || Math.abs(one.at - at) > 14);
      const at = [-11, 13, -26, 28, -41, 43].map((dy) => y + dy).find(isFree);
      if (at === undefined) continue;
      taken.push({ left, wide, at });
      label(text, left, at, report.ink("moment"));
    }
  }

  function drawVehicle(t) {
    const at = (north, east, colour, size, hollow) => {
      const [n, e] = [report.value(north, t), report.value(east, t)];
      if (Number.isNaN(n) || Number.isNaN(e)) return;
      const heading = report.value("heading", t);
      pen.save();
      pen.translate(map.x(e), map.y(n));
      pen.rotate(((Number.isNaN(heading) ? 0 : heading) * Math.PI) / 180);
      pen.beginPath();
      pen.moveTo(0, -size);
      pen.lineTo(size * 0.62, size * 0.8);
      pen.lineTo(0, size * 0.4);
      pen.lineTo(-size * 0.62, size * 0.8);
      pen.closePath();
      pen.fillStyle = hollow ? "transparent" : colour;
      pen.fill();
      pen.strokeStyle = hollow ? colour : report.ink("paper");
      pen.lineWidth = 1.6;
      pen.stroke();
      pen.restore();
    };
    if (map.shown.truth) at("true_north", "true_east", report.ink("soft"), 11, true);
    at("north", "east", report.ink("moment"), 13, false);
  }

  // North, the scale, and where the flow goes at the moment.
  function drawRose(t) {
    const ink = report.ink("ink");
    const [x, y] = [view.width - 26, 40];
    pen.fillStyle = pen.strokeStyle = ink;
    pen.lineWidth = 1.2;
    pen.beginPath();
    pen.moveTo(x, y - 26);
    pen.lineTo(x + 8, y + 10);
    pen.lineTo(x, y + 4);
    pen.lineTo(x - 8, y + 10);
    pen.closePath();
    pen.stroke();
    pen.fill();
    label("N", x, y + 20, ink, "center");
    const [speed, toward] = [report.value("flow_speed", t), report.value("flow_toward", t)];
    if (speed > 0.005) {
      pen.save();
      pen.translate(x - 52, y - 6);
      pen.rotate((toward * Math.PI) / 180);
      pen.strokeStyle = pen.fillStyle = report.isDark() ? "#7cc4ff" : "#2a6f97";
      pen.lineWidth = 2.6;
      stroke([[0, 16], [0, -10]]);
      pen.beginPath();
      pen.moveTo(0, -18);
      pen.lineTo(6, -6);
      pen.lineTo(-6, -6);
      pen.fill();
      pen.restore();
      label(`flow ${(speed * 100).toFixed(0)} cm/s`, x - 52, y + 20, report.isDark() ? "#7cc4ff" : "#2a6f97", "center");
    }
    const length = roundDown(150 / view.scale);
    const [right, base] = [view.width - 16, view.height - 24];
    const left = right - length * view.scale;
    pen.strokeStyle = ink;
    pen.lineWidth = 2;
    stroke([[left, base - 6], [left, base], [right, base], [right, base - 6]]);
    label(length >= 1000 ? `${length / 1000} km` : `${length} m`, (left + right) / 2, base - 9, ink, "center");
  }

  map.marks = function (t) {
    // Coloured by what is detected, the track tells it already.
    if (map.shown.detections && map.colour !== "chemical") drawDetections(t);
    drawFound(t);
    drawVehicle(t);
    drawRose(t);
  };
}
