// Timelines: panels one beneath the other on one axis of time. What does not change with the moment is drawn on one canvas, the moment and
// the numbers at it on another above it.
{
  const still = document.getElementById("lines-still");
  const moving = document.getElementById("lines-moment");
  const stillPen = still.getContext("2d");
  const abovePen = moving.getContext("2d");
  const [LEFT, RIGHT, TOP, AXIS, GAP] = [58, 14, 17, 22, 8];
  const ROW = 17;
  // What is shown of the time, s.
  const shown = { from: 0, to: report.end };
  const has = (name) => report.series.has(name);

  const SHADES = {
    blue: ["#0072b2", "#5cb6ea"], orange: ["#c45100", "#ff9d57"], green: ["#00805f", "#45d3a6"], pink: ["#a8447f", "#ec9fcd"],
    grey: ["#6b6b6b", "#a8a8a8"], brown: ["#8a6d1f", "#e2c064"],
  };
  const shade = (name) => SHADES[name][report.isDark() ? 1 : 0];

  // The panels: each is there when one of its lines is. `dash` lines are what was asked for or is true.
  const line = (name, label, colour, more) => ({ name, label, colour, ...more });
  const PANELS = [
    { title: "chemical", unit: "%", height: 78, from: 0, least: 5, lines: [line("chemical", "greatest of a second", "brown", { least: "chemical_least" })], isMarked: true },
    {
      title: "depth, and bottom", unit: "m", height: 104, down: true, from: 0, floors: ["true_bottom", "bottom"],
      lines: [
        line("depth", "depth", "blue"), line("asked_depth", "asked", "orange", { dash: [5, 3] }), line("bottom", "depth + altitude", "brown"),
        line("true_depth", "true", "grey", { dash: [2, 2] }),
      ],
    },
    {
      title: "altitude", unit: "m", height: 64, from: 0, when: "asked_altitude",
      lines: [line("altitude", "altitude", "brown"), line("asked_altitude", "asked", "orange", { dash: [5, 3] })],
    },
    {
      title: "heading", unit: "deg", height: 84, range: [0, 360], ticks: [0, 90, 180, 270, 360],
      lines: [line("heading", "heading", "blue"), line("asked_heading", "asked", "orange", { dash: [5, 3] })],
    },
    {
      title: "speed", unit: "m/s", height: 74, from: 0,
      lines: [
        line("speed", "over ground", "blue"), line("asked_speed", "asked, through water", "orange", { dash: [5, 3] }),
        line("true_water_speed", "true, through water", "grey", { dash: [2, 2] }),
      ],
    },
    { title: "flow", unit: "m/s", height: 66, lines: [line("flow_north", "north", "blue"), line("flow_east", "east", "orange")], also: ["flow_speed", "flow_toward"] },
    { title: "flow below", unit: "m/s", height: 66, lines: [line("flow_below_north", "north", "blue"), line("flow_below_east", "east", "orange")], also: ["flow_below_speed", "flow_below_toward"] },
    { title: "error of the position", unit: "m", height: 58, from: 0, lines: [line("position_error", "believed from true", "pink")] },
    { title: "temperature", unit: "°C", height: 58, lines: [line("temperature", "temperature", "orange")] },
    { title: "salinity", unit: "", height: 58, lines: [line("salinity", "salinity", "green")] },
    { title: "battery", unit: "%", height: 52, from: 0, to: 100, lines: [line("battery", "battery", "green")] },
  ];
  // What was asked for and has no panel yet gets one of its own.
  function ownPanels() {
    const drawn = new Set(PANELS.flatMap((panel) => panel.lines.map(({ name }) => name)));
    const others = Array.from(report.series.values()).filter(({ name }) => name.startsWith("asked_") && !drawn.has(name));
    return others.map(({ name, unit }) => ({ title: name.slice(6), unit, height: 64, lines: [line(name, "asked", "orange", { dash: [5, 3] })] }));
  }
  const isShown = (panel) => has(panel.when ?? panel.lines[0].name) || (panel.when === undefined && panel.lines.some(({ name }) => has(name)));
  const gantt = { title: "active", height: ROW };
  let panels = [];
  let width = 1;
  const x = (t) => LEFT + ((t - shown.from) / (shown.to - shown.from)) * (width - LEFT - RIGHT);
  const timeAt = (px) => shown.from + ((px - LEFT) / (width - LEFT - RIGHT)) * (shown.to - shown.from);

  // Where each panel is, and how high all are.
  function laidOut() {
    let y = TOP;
    gantt.y = y;
    y += gantt.height + GAP;
    for (const panel of panels) {
      y += TOP;
      panel.y = y;
      y += panel.height + GAP;
    }
    return y + AXIS;
  }
  let height = 1;

  function rangeOf(panel) {
    if (panel.range !== undefined) return panel.range;
    let [least, most] = [panel.from ?? Infinity, panel.to ?? -Infinity];
    for (const { name } of panel.lines) {
      for (const value of report.series.get(name).values) {
        if (value < least) least = value;
        if (value > most) most = value;
      }
    }
    // Noise alone does not fill a panel.
    if (panel.least !== undefined) most = Math.max(most, panel.least);
    if (panel.mark !== undefined && panel.mark !== null) most = Math.max(most, panel.mark * 1.5);
    if (!(most > least)) [least, most] = Number.isFinite(least) ? [least, least + 1] : [0, 1];
    const room = 0.06 * (most - least);
    return [panel.from === undefined ? least - room : least, panel.to === undefined ? most + room : most];
  }
  // The panels of what there is, and of a run that goes on the time up to now, if all of it was shown before.
  let endBefore = report.end;
  report.whenLoaded(() => {
    const part = (panel) => ({
      ...panel, lines: panel.lines.filter(({ name }) => has(name)), floor: panel.floors?.find(has), mark: panel.isMarked ? report.detection : undefined,
    });
    panels = [...PANELS, ...ownPanels()].filter(isShown).map(part);
    for (const panel of panels) panel.shownRange = rangeOf(panel);
    gantt.height = ROW * Math.max(1, report.levels.length);
    height = laidOut();
    still.style.height = moving.style.height = `${height}px`;
    if (shown.from === 0 && shown.to === endBefore) shown.to = report.end;
    endBefore = report.end;
  });
  const yOf = (panel, value) => {
    const [least, most] = panel.shownRange;
    const share = (value - least) / (most - least);
    return panel.y + (panel.down ? share : 1 - share) * panel.height;
  };

  function steps(least, most, count) {
    const ten = 10 ** Math.floor(Math.log10((most - least) / count));
    const step = ten * ([1, 2, 5, 10].find((of) => (most - least) / (of * ten) <= count) ?? 10);
    const out = [];
    for (let at = Math.ceil(least / step - 1e-9) * step; at <= most + 1e-9; at += step) out.push(Number(at.toFixed(9)));
    return out;
  }

  const TIME_STEPS = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 36000];
  function timeSteps() {
    const step = TIME_STEPS.find((of) => (shown.to - shown.from) / of <= width / 90) ?? 86400;
    const out = [];
    for (let t = Math.ceil(shown.from / step) * step; t <= shown.to; t += step) out.push(t);
    return out;
  }

  // A line with at most a least and a greatest number for each column of pixels; a heading does not run across the whole panel at north.
  function drawLine(panel, { name, colour, dash, least }) {
    const { values } = report.series.get(name);
    const lows = least !== undefined && has(least) ? report.series.get(least).values : values;
    const [first, last] = [Math.max(0, Math.floor(shown.from / report.every) - 1), Math.min(values.length - 1, Math.ceil(shown.to / report.every) + 1)];
    const isHeading = panel.unit === "deg";
    stillPen.strokeStyle = shade(colour);
    stillPen.lineWidth = 1.3;
    stillPen.setLineDash(dash ?? []);
    stillPen.beginPath();
    let before = null;
    for (let i = first; i <= last;) {
      const column = Math.floor(x(i * report.every));
      let [low, high, end, at] = [Infinity, -Infinity, NaN, i];
      const begin = values[i];
      for (; i <= last && (Math.floor(x(i * report.every)) === column || at === i); i++) {
        if (Number.isNaN(values[i])) continue;
        low = Math.min(low, lows[i], values[i]);
        high = Math.max(high, values[i]);
        end = values[i];
        at = i;
      }
      if (Number.isNaN(end)) continue;
      const here = x(at * report.every);
      const isFar = before === null || (at - before.i) * report.every > Math.max(20, report.series.get(name).old);
      const turns = isHeading && before !== null && Math.abs((Number.isNaN(begin) ? end : begin) - before.end) > 180;
      if (isFar || turns) stillPen.moveTo(here, yOf(panel, Number.isNaN(begin) ? end : begin));
      else stillPen.lineTo(here, yOf(panel, Number.isNaN(begin) ? end : begin));
      if (high > low && !(isHeading && high - low > 180)) {
        stillPen.lineTo(here, yOf(panel, low));
        stillPen.lineTo(here, yOf(panel, high));
      }
      if (isHeading && high - low > 180) stillPen.moveTo(here, yOf(panel, end));
      else stillPen.lineTo(here, yOf(panel, end));
      before = { i: at, end };
    }
    stillPen.stroke();
    stillPen.setLineDash([]);
  }

  // All below the bottom.
  function drawFloor(panel) {
    if (panel.floor === undefined || !has(panel.floor)) return;
    const { values } = report.series.get(panel.floor);
    const base = panel.y + panel.height;
    stillPen.fillStyle = report.isDark() ? "rgba(226,192,100,0.16)" : "rgba(138,109,31,0.15)";
    stillPen.beginPath();
    let open = null;
    for (let i = 0; i < values.length; i++) {
      const at = x(i * report.every);
      if (Number.isNaN(values[i]) || at < LEFT - 40 || at > width + 40) continue;
      if (open === null) stillPen.moveTo(at, base);
      stillPen.lineTo(at, Math.min(base, yOf(panel, values[i])));
      open = at;
    }
    if (open !== null) stillPen.lineTo(open, base);
    stillPen.fill();
  }

  function drawPanel(panel) {
    stillPen.strokeStyle = report.ink("rule");
    stillPen.fillStyle = report.ink("soft");
    stillPen.lineWidth = 1;
    stillPen.textAlign = "right";
    stillPen.textBaseline = "middle";
    const ticks = panel.ticks ?? steps(...panel.shownRange, panel.height < 70 ? 3 : 4);
    for (const tick of ticks) {
      const y = Math.round(yOf(panel, tick)) + 0.5;
      stillPen.beginPath();
      stillPen.moveTo(LEFT, y);
      stillPen.lineTo(width - RIGHT, y);
      stillPen.stroke();
      stillPen.fillText(`${tick}${panel.unit === "deg" ? "°" : ""}`, LEFT - 6, Math.min(Math.max(y, panel.y + 4), panel.y + panel.height - 4));
    }
    stillPen.save();
    stillPen.beginPath();
    stillPen.rect(LEFT, panel.y - 1, width - LEFT - RIGHT, panel.height + 2);
    stillPen.clip();
    drawFloor(panel);
    if (panel.mark !== undefined && panel.mark !== null) {
      stillPen.strokeStyle = report.ink("warn");
      stillPen.setLineDash([2, 3]);
      stillPen.beginPath();
      stillPen.moveTo(LEFT, yOf(panel, panel.mark));
      stillPen.lineTo(width - RIGHT, yOf(panel, panel.mark));
      stillPen.stroke();
      stillPen.setLineDash([]);
    }
    for (const one of [...panel.lines].reverse()) drawLine(panel, one);
    stillPen.restore();
  }

  function drawGantt() {
    stillPen.save();
    stillPen.beginPath();
    stillPen.rect(LEFT, gantt.y - 1, width - LEFT - RIGHT, gantt.height + 2);
    stillPen.clip();
    stillPen.textBaseline = "middle";
    stillPen.textAlign = "left";
    report.levels.forEach((spans, level) => {
      const y = gantt.y + level * ROW;
      let drawnTo = -Infinity;
      for (const span of spans) {
        if (span.to < shown.from || span.from > shown.to) continue;
        const [from, to] = [Math.max(x(span.from), LEFT - 2), Math.min(x(span.to), width)];
        // What is narrower than a pixel is drawn once a pixel.
        if (to < drawnTo + 0.6) continue;
        drawnTo = to;
        const colour = report.colourOf(span.activity);
        stillPen.fillStyle = colour;
        stillPen.globalAlpha = report.shownBehaviors.includes(span.activity) ? 0.9 : 0.55;
        stillPen.fillRect(from, y, Math.max(0.8, to - from - (to - from > 4 ? 0.8 : 0)), ROW - 2);
        stillPen.globalAlpha = 1;
        const { name } = report.activities[span.activity];
        if (to - from > stillPen.measureText(name).width + 8) {
          stillPen.fillStyle = bright(colour) ? "#111" : "#fff";
          stillPen.fillText(name, from + 4, y + ROW / 2 - 0.5);
        }
      }
    });
    stillPen.restore();
    stillPen.fillStyle = report.ink("soft");
    stillPen.textAlign = "right";
    stillPen.fillText("active", LEFT - 6, gantt.y + ROW / 2);
  }
  function bright(colour) {
    const [r, g, b] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
    return 0.3 * r + 0.59 * g + 0.11 * b > 128;
  }

  // Switches, reports and what went wrong, as marks above all.
  const MARKS = { report: "moment", abort: "warn", timeout: "warn", stale: "warn", switch: "accent" };
  function drawMarks() {
    for (const one of report.happenings) {
      const name = MARKS[one.verb];
      if (name === undefined || one.t < shown.from || one.t > shown.to) continue;
      stillPen.fillStyle = report.ink(name);
      const at = x(one.t);
      stillPen.beginPath();
      stillPen.moveTo(at - 3.5, 4);
      stillPen.lineTo(at + 3.5, 4);
      stillPen.lineTo(at, 12);
      stillPen.fill();
    }
  }

  function drawStill() {
    [width] = report.sized(still, stillPen, height);
    stillPen.clearRect(0, 0, width, height);
    stillPen.font = "11px Helvetica, Arial, sans-serif";
    stillPen.strokeStyle = report.ink("rule");
    stillPen.fillStyle = report.ink("soft");
    stillPen.textAlign = "center";
    stillPen.textBaseline = "top";
    for (const panel of panels) {
      stillPen.fillStyle = report.ink("panel");
      stillPen.fillRect(LEFT, panel.y, width - LEFT - RIGHT, panel.height);
    }
    stillPen.fillStyle = report.ink("soft");
    for (const t of timeSteps()) {
      stillPen.strokeStyle = report.ink("rule");
      stillPen.globalAlpha = 0.7;
      stillPen.beginPath();
      stillPen.moveTo(x(t), TOP);
      stillPen.lineTo(x(t), height - AXIS + 2);
      stillPen.stroke();
      stillPen.globalAlpha = 1;
      stillPen.fillText(report.clock(t), Math.min(Math.max(x(t), LEFT + 12), width - 24), height - AXIS + 5);
    }
    for (const panel of panels) drawPanel(panel);
    drawGantt();
    drawMarks();
  }

  // The moment, and above each panel what its lines are and their numbers there.
  function drawMoment(t) {
    // On paper there is one canvas: printers do not see through the other.
    const movingPen = report.printing ? stillPen : abovePen;
    if (!report.printing) {
      report.sized(moving, movingPen, height);
      movingPen.clearRect(0, 0, width, height);
    }
    movingPen.font = "12px Helvetica, Arial, sans-serif";
    movingPen.textBaseline = "alphabetic";
    movingPen.textAlign = "left";
    for (const panel of panels) {
      let at = LEFT;
      const put = (text, colour, bold) => {
        movingPen.font = `${bold ? "bold " : ""}12px Helvetica, Arial, sans-serif`;
        movingPen.fillStyle = colour;
        movingPen.fillText(text, at, panel.y - 5);
        at += movingPen.measureText(text).width + 12;
      };
      put(panel.unit === "" || panel.unit === "deg" ? panel.title : `${panel.title}, ${panel.unit}`, report.ink("ink"), true);
      for (const one of panel.lines) {
        const dashes = one.dash === undefined ? "—" : "- -";
        put(`${dashes} ${one.label} ${report.told(one.name, report.value(one.name, t))}`, shade(one.colour), false);
      }
      if (panel.also !== undefined) {
        put(`${report.told(panel.also[0], report.value(panel.also[0], t))} toward ${report.told(panel.also[1], report.value(panel.also[1], t))}`, report.ink("soft"), false);
      }
    }
    if (t < shown.from || t > shown.to) return;
    movingPen.strokeStyle = report.ink("moment");
    movingPen.lineWidth = 1.5;
    movingPen.beginPath();
    movingPen.moveTo(x(t), 2);
    movingPen.lineTo(x(t), height - AXIS + 3);
    movingPen.stroke();
  }

  report.drawTimelines = function () {
    drawStill();
    drawMoment(report.t);
  };

  // Zooms about the moment, or about a time; what is shown stays within the run.
  report.zoomTime = function (factor, about) {
    const middle = about ?? report.t;
    const length = Math.min(report.end, Math.max(5, (shown.to - shown.from) * factor));
    const share = about === undefined ? 0.5 : (middle - shown.from) / (shown.to - shown.from);
    shown.from = Math.min(Math.max(0, middle - share * length), report.end - length);
    shown.to = shown.from + length;
    report.drawTimelines();
  };

  report.startTimelines = function () {
    let held = false;
    const go = (event) => report.go(timeAt(event.clientX - moving.getBoundingClientRect().left));
    moving.addEventListener("pointerdown", (event) => {
      held = true;
      moving.setPointerCapture(event.pointerId);
      go(event);
    });
    moving.addEventListener("pointermove", (event) => held && go(event));
    moving.addEventListener("pointerup", () => (held = false));
    moving.addEventListener("pointercancel", () => (held = false));
    // The wheel alone scrolls the page.
    moving.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.shiftKey) return;
      event.preventDefault();
      const turned = event.deltaY === 0 ? event.deltaX : event.deltaY;
      report.zoomTime(Math.exp(turned * 0.002), timeAt(event.clientX - moving.getBoundingClientRect().left));
    }, { passive: false });
    document.getElementById("closer").addEventListener("click", () => report.zoomTime(0.5));
    document.getElementById("wider").addEventListener("click", () => report.zoomTime(2));
    document.getElementById("whole").addEventListener("click", () => report.zoomTime(Infinity));
    report.whenResized(still, report.drawTimelines);
    report.whenMoved((t) => {
      // While it plays, the part that is shown goes along.
      if (t < shown.from || t > shown.to) {
        const length = shown.to - shown.from;
        shown.from = Math.min(Math.max(0, t - 0.1 * length), report.end - length);
        shown.to = shown.from + length;
        drawStill();
      }
      drawMoment(t);
    });
  };
}
