// The lines of the trace, why a rule fired, the diagrams, and the choices above the map.
{
  const lines = document.getElementById("lines");
  const why = document.getElementById("why");

  // What is listed, by verb, and whether that is so from the start.
  const KINDS = [
    ["switches", ["switch", "resume", "suspend"], true],
    ["holds", ["stale", "fresh", "hold", "wait", "link", "control"], true],
    ["ends", ["abort", "timeout", "end", "rules"], true],
    ["limits", ["limit"], true],
    ["reports", ["report", "ask", "answer"], true],
    ["messages", ["log", "vehicle"], true],
    ["all else", [], false],
  ];
  const KNOWN = new Set(KINDS.flatMap(([, verbs]) => verbs));
  const kindOf = (verb) => (KNOWN.has(verb) ? KINDS.findIndex(([, verbs]) => verbs.includes(verb)) : KINDS.length - 1);
  const chosen = KINDS.map(([, , isOn]) => isOn);
  // More rows make a page slow that nobody reads to its end.
  const ROWS_MAX = 4000;

  let rows = [];
  let marked = null;

  function element(name, className, text) {
    const made = document.createElement(name);
    if (className !== "") made.className = className;
    if (text !== undefined) made.textContent = text;
    return made;
  }

  function list() {
    const all = report.happenings.filter((one) => chosen[kindOf(one.verb)]);
    // Of a run that goes on the newest are wanted.
    rows = (report.isLive ? all.slice(-ROWS_MAX) : all.slice(0, ROWS_MAX)).map((one) => {
      const row = element("button", "");
      row.type = "button";
      row.tabIndex = -1;
      row.title = one.text;
      // The columns of the trace: what, where, by which rule, and why. Here the first is enough.
      const what = one.verb === "switch" ? one.text.split(/\s{2,}/)[0] : one.text.replace(/\s{2,}/g, "  ");
      row.append(element("span", "t", one.t.toFixed(1)), element("span", `v v-${one.verb}`, one.verb), element("span", "what", what));
      row.addEventListener("click", () => {
        report.go(one.t);
        explain(one);
      });
      return { one, row };
    });
    const before = lines.scrollTop;
    lines.replaceChildren(...rows.map(({ row }) => row));
    lines.scrollTop = before;
    const beyond = all.length - rows.length;
    if (all.length === 0) lines.append(element("p", "", "Nothing of this happened."));
    if (beyond > 0) lines.append(element("p", "", `${beyond} ${report.isLive ? "earlier" : "more"} lines: choose fewer kinds above to see them.`));
    if (report.leftOut > 0) lines.append(element("p", "", `${report.leftOut} lines were left out of this page: they are in the trace.`));
    marked = null;
    mark(report.t);
  }

  // The line of the moment, and those after it paler.
  function mark(t) {
    const at = report.lastBefore(rows, t, ({ one }) => one.t);
    if (marked !== at) {
      if (marked !== null) rows[marked]?.row.classList.remove("now");
      rows.forEach(({ row }, i) => row.classList.toggle("later", i > at));
      marked = at;
    }
    const now = rows[at]?.row;
    if (now === undefined) {
      lines.scrollTop = 0;
      return;
    }
    now.classList.add("now");
    const [top, bottom] = [now.offsetTop - lines.offsetTop, now.offsetTop - lines.offsetTop + now.offsetHeight];
    if (top < lines.scrollTop + 20 || bottom > lines.scrollTop + lines.clientHeight - 20) lines.scrollTop = top - lines.clientHeight / 2;
  }

  // So many conditions and terms are shown without being asked for.
  const OPEN_LINES = 14;
  let explained;
  function explain(one) {
    if (one === explained) return;
    explained = one;
    if (one === undefined) {
      why.replaceChildren(element("p", "hint", "Choose a line, or move the moment: here stands what was decided last, and why."));
      return;
    }
    const head = element("p", "");
    const parts = one.text.split(/\s{2,}/);
    head.append(element("b", "", `${one.verb}: ${parts[0]}`), ` at ${report.clock(one.t)} (${one.t.toFixed(1)} s)`);
    const made = [head];
    if (one.why !== undefined) {
      const rule = element("p", "code", one.why.rule);
      const place = element("p", "hint", one.why.place === "" ? "" : `rule at ${one.why.place}`);
      made.push(rule, place);
      if (one.why.values.length > 0) {
        const table = element("table", "code");
        for (const [name, value] of one.why.values) {
          const row = element("tr", "");
          row.append(element("td", "", name), element("td", "", value));
          table.append(row);
        }
        made.push(table);
      }
      if (one.why.tried !== undefined) {
        const tried = element("details", "");
        tried.append(element("summary", "hint", "tried in this tick, in this order"), element("p", "code", one.why.tried.join("\n")));
        tried.open = one.why.tried.length <= OPEN_LINES;
        made.push(tried);
      }
      const position = parts.find((part) => part.startsWith("at ("));
      if (position !== undefined) made.push(element("p", "hint", `vehicle ${position}`));
    } else if (parts.length > 1) {
      made.push(element("p", "code", parts.slice(1).join("\n")));
    }
    why.replaceChildren(...made);
  }

  // The diagrams are our own pictures: their texts are escaped already.
  const drawn = [];
  function drawDiagrams() {
    const room = document.getElementById("diagrams");
    room.replaceChildren();
    drawn.length = 0;
    for (const diagram of report.diagrams) {
      const figure = element("figure", "");
      if (diagram.svg === null) {
        figure.append(element("p", "", `The diagram of ${report.activities[diagram.activity].name} is too large to be drawn.`));
      } else {
        figure.innerHTML = diagram.svg;
      }
      room.append(figure);
      const boxes = Array.from(figure.querySelectorAll("g[data-behavior]"));
      const links = Array.from(figure.querySelectorAll("g[data-from]"));
      drawn.push({ diagram, boxes, links });
    }
    document.getElementById("diagram-part").hidden = report.diagrams.length === 0;
  }

  function markDiagrams(t) {
    const active = report.active(t);
    for (const { diagram, boxes, links } of drawn) {
      const isActive = active.includes(diagram.activity);
      boxes.forEach((box) => {
        const behavior = diagram.behaviors[Number(box.dataset.behavior)];
        box.classList.toggle("active", isActive && behavior !== null && active.includes(behavior));
      });
      // The rule that fired last in this table, while it is active.
      let edge = null;
      if (isActive) {
        for (let i = report.lastBefore(report.switches, t, (one) => one.t); i >= 0 && edge === null; i--) {
          const taken = report.switches[i].why?.edge;
          if (taken !== undefined && taken[0] === diagram.activity) edge = taken;
        }
      }
      links.forEach((link) => {
        const isTaken = edge !== null && Number(link.dataset.from) === edge[1] && Number(link.dataset.to) === edge[2];
        link.classList.toggle("taken", isTaken);
      });
    }
  }

  function choice(text, isOn, change) {
    const label = element("label", "");
    const box = element("input", "");
    box.type = "checkbox";
    box.checked = isOn;
    box.addEventListener("change", () => change(box.checked));
    label.append(box, ` ${text}`);
    return label;
  }

  function legend() {
    const room = document.getElementById("legend");
    room.replaceChildren();
    const { map } = report;
    if (map.colour === "behavior") {
      for (const id of report.shownBehaviors) {
        const entry = element("span", "");
        const line = element("i", "");
        line.style.background = report.colourOf(id);
        entry.append(line, report.activities[id].name);
        room.append(entry);
      }
    } else {
      const bar = element("canvas", "");
      [bar.width, bar.height] = [180, 1];
      const pen = bar.getContext("2d");
      const isHeading = report.series.get(map.colour).unit === "deg";
      for (let i = 0; i < 180; i++) {
        pen.fillStyle = isHeading ? `hsl(${2 * i} 75% ${report.isDark() ? 62 : 42}%)` : report.scaleColour(i / 180);
        pen.fillRect(i, 0, 1, 1);
      }
      const entry = element("span", "");
      const [least, most] = map.range.map((x) => report.told(map.colour, x).replace(/\.0+(?= |°|$)/, ""));
      entry.append(`${map.colour.replaceAll("_", " ")} ${least}`, bar, most);
      room.append(entry);
    }
    const { sources, deepest, start, outlines, true_outlines } = report.world;
    const marks = [
      ["var(--moment)", "◎", "report", report.reports.some((one) => one.north !== null)],
      [map.outlineColour.reported, "⬠", "reported area", outlines.length > 0],
      [map.outlineColour.true, "⬠", "true outline", true_outlines.length > 0],
      ["#d32f2f", "★", sources.length > 0 ? "true source" : "truly deepest", sources.length > 0 || deepest !== null],
      ["var(--ink)", "□", "start", start !== null],
      ["var(--ink)", "×", "detection", report.detection !== null && report.series.has("chemical") && map.colour !== "chemical"],
      ["var(--soft)", "┄", "true track", report.series.has("true_north")],
    ];
    for (const [colour, sign, text, isThere] of marks) {
      if (!isThere) continue;
      const entry = element("span", "");
      const mark = element("b", "", sign);
      mark.style.color = colour;
      entry.append(mark, text);
      room.append(entry);
    }
    if (report.bottom !== null) room.append(element("span", "", `bottom ${map.bottomRange.map((x) => x.toFixed(1)).join(" to ")} m: bluer is deeper`));
  }
  report.drawLegend = legend;

  // What may be chosen above map and list: made anew only when there is something else to choose.
  const colour = document.getElementById("colour");
  const NO_COLOURS = new Set(["north", "east", "true_north", "true_east", "chemical_least"]);
  let offered = "";
  function offer() {
    const { map } = report;
    const colours = ["behavior", ...Array.from(report.series.keys()).filter((one) => !NO_COLOURS.has(one))];
    const { outlines, true_outlines } = report.world;
    const isThere = { plume: report.hasPlume, "true outline": true_outlines.length > 0, bottom: report.bottom !== null, truth: report.series.has("true_north"), detections: report.detection !== null && report.series.has("chemical"), reports: outlines.length > 0 || report.reports.some((one) => one.north !== null), grid: true };
    const layers = Object.keys(map.shown).filter((name) => isThere[name]);
    const verbs = new Set(report.happenings.map((one) => kindOf(one.verb)));
    const kinds = KINDS.map((_, kind) => kind).filter((kind) => verbs.has(kind));
    const now = JSON.stringify([colours, layers, kinds]);
    if (now === offered) return;
    offered = now;
    colour.replaceChildren(...colours.map((name) => new Option(name.replaceAll("_", " "), name, false, name === map.colour)));
    const layer = (name) => choice(name, map.shown[name], (isOn) => {
      map.shown[name] = isOn;
      map.draw();
    });
    document.getElementById("layers").replaceChildren(...layers.map(layer));
    const filter = (kind) => choice(KINDS[kind][0], chosen[kind], (isOn) => {
      chosen[kind] = isOn;
      list();
    });
    document.getElementById("filters").replaceChildren(...kinds.map(filter));
  }

  report.startLists = function () {
    const { map } = report;
    colour.addEventListener("change", () => {
      map.colourBy(colour.value);
      map.draw();
      legend();
    });
    document.getElementById("report-part").addEventListener("click", (event) => {
      const row = event.target.closest("tr[data-t]");
      if (row !== null) report.go(Number(row.dataset.t));
    });
    lines.addEventListener("keydown", (event) => {
      const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
      const next = rows[(marked ?? -1) + step];
      if (next === undefined) return;
      event.preventDefault();
      // Of lines of one moment the next one is the first of a later moment: the list follows the moment.
      const later = step > 0 ? next : (rows.find(({ one }) => one.t === next.one.t) ?? next);
      report.go(later.one.t);
      explain(later.one);
    });
    let [diagramsOf, linesOf] = [null, null];
    report.whenLoaded(() => {
      offer();
      if (diagramsOf !== report.diagrams) drawDiagrams();
      if (linesOf !== report.happenings) list();
      [diagramsOf, linesOf] = [report.diagrams, report.happenings];
      legend();
    });
    report.whenMoved((t) => {
      markDiagrams(t);
      const isNow = explained !== undefined && Math.abs(explained.t - t) < 0.05;
      if (!isNow) explain(report.decisions[report.lastBefore(report.decisions, t, (one) => one.t)]);
      // Last: the room that is left for the list depends on the reason above it.
      mark(t);
    });
    explained = null;
    explain(undefined);
  };
}
