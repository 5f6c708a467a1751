// A run that goes on: what is new is asked for once a second, and the newest moment is shown until the person chooses another.
{
  const ASK_MS = 1000;
  const ANSWER_MS = 5000;
  // After so many questions in vain the program is taken for gone; it is asked on, less often.
  const VAIN_MAX = 3;
  const header = document.querySelector("header");
  const state = document.createElement("p");
  state.id = "live";
  header.querySelector("h1").after(state);
  const newest = document.createElement("button");
  newest.type = "button";
  newest.id = "newest";
  newest.textContent = "newest";
  newest.title = "follow the run";
  document.getElementById("after").after(newest);

  // The server tells its pages apart by this: it waits for the last word to each.
  const page = crypto.getRandomValues(new Uint32Array(1))[0];
  let [cursor, run, hasEnded, isOther, vain, silentSince] = ["", null, false, false, 0, null];
  let known = null;
  let [world, isFirst] = [report.world, true];
  const nothing = () => ({
    series: new Map(), colours: [], activities: [], diagrams: [], happenings: [], reports: [], spans: { activity: [], level: [], from: [], ticks: [] },
  });

  // Numbers that are told as differences, from a slot on.
  function put(values, slot, list) {
    while (values.length < slot) values.push(null);
    let sum = 0;
    list.forEach((step, i) => {
      if (step !== null) sum += step;
      values[slot + i] = step === null ? null : sum;
    });
  }

  function merge(more) {
    if (more.anew || known === null) known = nothing();
    for (const { name, unit, decimals, values } of more.series) {
      if (!known.series.has(name)) known.series.set(name, { name, unit, decimals, values: [] });
      put(known.series.get(name).values, more.slot, values);
    }
    put(known.colours, more.slot, more.colours);
    known.activities.push(...more.activities);
    for (const part of ["activity", "level", "from"]) known.spans[part].push(...more.spans[part]);
    while (known.spans.ticks.length < known.spans.from.length) known.spans.ticks.push(null);
    for (const [place, ticks] of more.spans.closed) known.spans.ticks[place] = ticks;
    for (const line of more.happenings) known.happenings.push(line);
    known.diagrams = more.diagrams ?? known.diagrams;
    known.reports = more.reports ?? known.reports;
    world = more.world ?? world;
    report.load({
      ...known, head: more.head, world, detection: more.detection, every_s: more.every_s, happenings_left_out: more.happenings_left_out,
      series: Array.from(known.series.values()), plume: null, isWhole: true,
    });
  }

  // Texts that the server has made are escaped already.
  function tell(more) {
    document.title = header.querySelector("h1").textContent = more.title;
    header.querySelector("dl").innerHTML = more.head_html;
    if (more.reports_html !== null) document.getElementById("report-room").innerHTML = more.reports_html;
  }

  function say(more) {
    const told = (text, isWarning) => {
      state.textContent = text;
      state.className = isWarning ? "warning" : "";
      // Who listens to the page hears what is new, and not each second.
      state.setAttribute("aria-live", isWarning || hasEnded ? "polite" : "off");
      newest.disabled = report.following;
    };
    const now = report.clock(report.end);
    const lost = more.missed > 0 ? ` ${more.missed} ticks are not in this page: the host was too slow.` : "";
    if (isOther) told("Another run is at this address now: reload the page to see it.", true);
    else if (hasEnded) told(`The run has ended: ${more.head.outcome}, at ${now}. Nothing more comes; this page keeps what it has.${lost}`, false);
    else if (vain >= VAIN_MAX) told(`The program is gone: it has not answered since ${silentSince}, ${now} of the run. This page keeps what it has.`, true);
    else if (vain === 0) told(`The run goes on: ${now}${report.following ? "" : ", shown at another moment"}.${lost}`, false);
  }

  let last = { missed: 0 };
  function take(more) {
    if (run !== null && run !== more.run) {
      isOther = true;
      return;
    }
    const following = report.following || (isFirst && report.asked === null);
    [run, cursor, hasEnded, last] = [more.run, more.cursor, more.ended, more];
    merge(more);
    tell(more);
    if (following) report.go(report.end);
    else report.go(isFirst ? report.asked : report.t);
    isFirst = false;
    report.drawAll();
  }

  async function ask() {
    try {
      const signal = AbortSignal.timeout(ANSWER_MS);
      const answer = await fetch(`/data?page=${page}&since=${cursor}`, { cache: "no-store", signal });
      if (!answer.ok) throw new Error(`${answer.status}`);
      const more = await answer.json();
      vain = 0;
      take(more);
    } catch {
      vain += 1;
      if (vain === 1) silentSince = new Date().toLocaleTimeString();
    }
    say(last);
    if (!hasEnded && !isOther) setTimeout(ask, vain >= VAIN_MAX ? 3 * ASK_MS : ASK_MS);
  }

  report.isLive = true;
  report.startLive = function () {
    newest.addEventListener("click", () => report.go(report.end));
    report.whenMoved(() => say(last));
    ask();
  };
}
