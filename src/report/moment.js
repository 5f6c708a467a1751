// The moment that all parts of the page show: the slider, the address, the keys and playing change it, and the parts are told.
{
  const slider = document.getElementById("slider");
  const clock = document.getElementById("clock");
  const play = document.getElementById("play");
  const rate = document.getElementById("rate");
  const chain = document.getElementById("chain");
  const listeners = [];

  report.t = 0;
  report.playing = false;
  // Whether a run that goes on is shown at its newest moment, whatever that is.
  report.following = false;
  report.whenMoved = (listener) => listeners.push(listener);

  // The address is changed a little later: browsers refuse to have it changed many times a second.
  let addressTimer = null;
  function keepAddress() {
    addressTimer ??= setTimeout(() => {
      addressTimer = null;
      const hash = report.following ? "" : `#t=${Number(report.t.toFixed(1))}`;
      if (location.hash !== hash) history.replaceState(null, "", hash === "" ? location.pathname : hash);
    }, 250);
  }

  function show() {
    slider.value = report.t;
    const told = `${report.clock(report.t)} · ${report.t.toFixed(1)} s`;
    slider.setAttribute("aria-valuetext", told);
    clock.textContent = told;
    const names = report.active(report.t).map((id) => report.activities[id].name);
    chain.replaceChildren();
    names.forEach((name, i) => {
      const part = document.createElement(i + 1 === names.length ? "b" : "span");
      part.textContent = name;
      chain.append(i > 0 ? " › " : "", part);
    });
    if (names.length === 0) chain.textContent = "nothing is active";
    for (const listener of listeners) listener(report.t);
  }

  // Several changes before the next picture are one.
  let pending = false;
  report.go = function (t) {
    report.t = Math.min(Math.max(Number.isFinite(t) ? t : 0, 0), report.end);
    // Who goes to the end of a run that goes on stays there.
    report.following = report.isLive === true && report.t >= report.end;
    keepAddress();
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      show();
    });
  };

  // The switch after or before the moment.
  report.goToSwitch = function (step) {
    const at = report.lastBefore(report.switches, report.t, (line) => line.t);
    let next = at + step;
    // From within a switch's own moment the one before is meant.
    if (step < 0 && at >= 0 && report.switches[at].t < report.t - 0.05) next = at;
    while (step < 0 && next > 0 && report.switches[next].t > report.t - 0.05) next--;
    if (report.switches[next] !== undefined) report.go(report.switches[next].t);
    else report.go(step < 0 ? 0 : report.end);
  };

  function ofAddress() {
    const found = /^#t=([0-9]+(?:\.[0-9]+)?)$/.exec(location.hash);
    return found === null ? null : Number(found[1]);
  }

  let lastFrame = null;
  function frame(now) {
    if (!report.playing) return;
    if (lastFrame !== null) report.go(report.t + ((now - lastFrame) / 1000) * Number(rate.value));
    lastFrame = now;
    if (report.t >= report.end) report.play(false);
    else requestAnimationFrame(frame);
  }
  report.play = function (on) {
    report.playing = on;
    lastFrame = null;
    play.textContent = on ? "Pause" : "Play";
    play.setAttribute("aria-pressed", String(on));
    if (on) {
      if (report.t >= report.end) report.go(0);
      requestAnimationFrame(frame);
    }
  };

  const keys = {
    ArrowLeft: (event) => report.go(report.t - (event.shiftKey ? 10 : 1)),
    ArrowRight: (event) => report.go(report.t + (event.shiftKey ? 10 : 1)),
    p: () => report.goToSwitch(-1),
    n: () => report.goToSwitch(1),
    "+": () => report.zoomTime(0.5),
    "-": () => report.zoomTime(2),
    0: () => report.zoomTime(Infinity),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const on = event.target.tagName;
    // A list of choices has keys of its own, and a button is pressed by the space bar.
    if (on === "SELECT" || (event.key === " " && (on === "BUTTON" || event.target.type === "checkbox"))) return;
    if (event.key === " ") {
      event.preventDefault();
      report.play(!report.playing);
    } else if (Object.hasOwn(keys, event.key)) {
      event.preventDefault();
      keys[event.key](event);
    }
  });

  report.startMoment = function () {
    report.whenLoaded(() => (slider.max = report.end));
    // The whole run takes about a minute to be played.
    const speeds = [1, 5, 10, 30, 60, 120, 300, 600];
    const usual = speeds.find((speed) => report.end / speed <= 75) ?? 600;
    for (const speed of speeds) rate.add(new Option(`${speed}×`, speed, speed === usual, speed === usual));
    slider.addEventListener("input", () => report.go(Number(slider.value)));
    play.addEventListener("click", () => report.play(!report.playing));
    document.getElementById("before").addEventListener("click", () => report.goToSwitch(-1));
    document.getElementById("after").addEventListener("click", () => report.goToSwitch(1));
    addEventListener("hashchange", () => {
      const t = ofAddress();
      if (t !== null && Math.abs(t - report.t) > 0.05) report.go(t);
    });
    report.asked = ofAddress();
    report.t = Math.min(report.asked ?? 0, report.end);
    show();
  };
}
