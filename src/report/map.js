// The map: where it is looked at, how places become pixels, and what the pointer does. What is drawn on it is in the next part.
{
  const canvas = document.getElementById("map");
  const hover = document.getElementById("hover");
  const pen = canvas.getContext("2d");
  // Pixels a metre, and the place in the middle.
  const view = { scale: 1, north: 0, east: 0, width: 1, height: 1 };
  const map = { canvas, pen, view };
  report.map = map;

  map.x = (east) => view.width / 2 + (east - view.east) * view.scale;
  map.y = (north) => view.height / 2 - (north - view.north) * view.scale;
  map.east = (x) => view.east + (x - view.width / 2) / view.scale;
  map.north = (y) => view.north - (y - view.height / 2) / view.scale;

  // Canvases take their colours from the style sheet, so that they are right in the dark and on paper.
  const PAPER = {
    paper: "#ffffff", panel: "#f6f7f8", ink: "#1a1a1a", soft: "#444444", rule: "#bbbbbb", accent: "#14527a", warn: "#8a3b00", moment: "#c2185b",
  };
  report.ink = function (name) {
    // Before it prints, a page still has the colours of the screen.
    if (report.printing) return PAPER[name];
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  };
  report.isDark = () => !report.printing && matchMedia("(prefers-color-scheme: dark)").matches;

  // A canvas as large as it is shown, with all the pixels of the screen, and more on paper.
  report.sized = function (canvas, pen, height) {
    const width = Math.max(1, canvas.clientWidth);
    const tall = Math.max(1, height ?? canvas.clientHeight);
    const dense = report.printing ? 3 : Math.max(1, devicePixelRatio || 1);
    if (canvas.width !== Math.round(width * dense) || canvas.height !== Math.round(tall * dense)) {
      canvas.width = Math.round(width * dense);
      canvas.height = Math.round(tall * dense);
    }
    pen.setTransform(dense, 0, 0, dense, 0, 0);
    return [width, tall];
  };

  // Drawn in the next frame: what changes sizes while they are looked at is told as an error.
  report.whenResized = function (canvas, draw) {
    new ResizeObserver(() => requestAnimationFrame(() => draw())).observe(canvas);
  };

  map.fit = function () {
    const { south, west, north, east } = report.world.extent;
    view.north = (north + south) / 2;
    view.east = (west + east) / 2;
    const [width, height] = [canvas.clientWidth || 1, canvas.clientHeight || 1];
    view.scale = 0.94 * Math.min(width / (east - west), height / (north - south));
    map.fitted = true;
  };

  map.draw = function () {
    [view.width, view.height] = report.sized(canvas, pen);
    if (map.fitted) map.fit();
    map.layers();
  };

  function zoom(factor, x, y) {
    const [north, east] = [map.north(y), map.east(x)];
    const least = 0.2 / Math.max(1, report.world.extent.north - report.world.extent.south) * view.height;
    view.scale = Math.min(Math.max(view.scale * factor, least), 200);
    view.north += north - map.north(y);
    view.east += east - map.east(x);
    map.fitted = false;
    map.draw();
  }

  // The time at which the track is nearest to a pixel, if it is near.
  const NEAR_PX = 12;
  function timeNear(x, y) {
    const [north, east] = [report.series.get("north"), report.series.get("east")];
    if (north === undefined || east === undefined) return null;
    let [best, at] = [NEAR_PX ** 2, null];
    for (let i = 0; i < north.values.length; i++) {
      const distance = (map.x(east.values[i]) - x) ** 2 + (map.y(north.values[i]) - y) ** 2;
      // Where the way crosses itself the pass that is nearer in time is meant.
      const isNearer = at !== null && distance < best + 4 && Math.abs(i * report.every - report.t) < Math.abs(at - report.t);
      if (distance < best || isNearer) [best, at] = [Math.min(best, distance), i * report.every];
    }
    return at;
  }

  function tell(x, y) {
    const [north, east] = [map.north(y), map.east(x)];
    const lines = [`north ${north.toFixed(1)} m, east ${east.toFixed(1)} m`];
    const globe = report.globe(north, east);
    if (globe !== "") lines.push(globe);
    const depth = report.depthAt(north, east);
    if (depth !== null) lines.push(`bottom ${depth.toFixed(1)} m`);
    const t = timeNear(x, y);
    canvas.style.cursor = t === null ? "crosshair" : "pointer";
    if (t !== null) {
      const behavior = report.behaviorAt(Math.round(t / report.every));
      const name = Number.isNaN(behavior) ? "" : `, ${report.activities[behavior].name}`;
      lines.push(`track at ${report.clock(t)} (${t} s)${name}`);
    }
    hover.textContent = lines.join("\n");
    hover.hidden = false;
    const [wide, tall] = [hover.offsetWidth, hover.offsetHeight];
    hover.style.left = `${x + 16 + wide > view.width ? x - wide - 10 : x + 16}px`;
    hover.style.top = `${y + 16 + tall > view.height ? y - tall - 10 : y + 16}px`;
  }

  map.start = function () {
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left - 1, event.clientY - box.top - 1];
    };
    let held = null;
    canvas.addEventListener("pointerdown", (event) => {
      held = { at: place(event), moved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const [x, y] = place(event);
      if (held !== null) {
        const [dx, dy] = [x - held.at[0], y - held.at[1]];
        if (held.moved || Math.hypot(dx, dy) > 3) {
          view.east -= dx / view.scale;
          view.north += dy / view.scale;
          held = { at: [x, y], moved: true };
          map.fitted = false;
          map.draw();
        }
      }
      tell(x, y);
    });
    canvas.addEventListener("pointerup", (event) => {
      const t = held !== null && !held.moved ? timeNear(...place(event)) : null;
      if (t !== null) report.go(t);
      held = null;
    });
    canvas.addEventListener("pointerleave", () => (hover.hidden = true));
    canvas.addEventListener("keydown", (event) => {
      const factor = { "+": 1.5, "-": 1 / 1.5 }[event.key];
      if (event.key === "0") all();
      else if (factor !== undefined) zoom(factor, view.width / 2, view.height / 2);
      else return;
      event.stopPropagation();
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      zoom(Math.exp(-event.deltaY * 0.0015), ...place(event));
    }, { passive: false });
    const all = () => {
      map.fit();
      map.draw();
    };
    canvas.addEventListener("dblclick", all);
    document.getElementById("fit").addEventListener("click", all);
    map.fit();
    report.whenResized(canvas, map.draw);
    report.whenMoved(map.draw);
  };
}
