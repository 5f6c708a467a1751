// All parts begin, in the order in which they need one another.
{
  document.documentElement.classList.add("js");
  const drawAll = () => {
    report.map.draw();
    report.drawTimelines();
    report.drawLegend();
  };
  report.drawAll = drawAll;
  report.startLists();
  report.map.start();
  report.startTimelines();
  report.startMoment();
  // A run that goes on.
  report.startLive?.();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
  // On paper colours are those of the light, and lines as fine as the printer's.
  addEventListener("beforeprint", () => {
    report.printing = true;
    drawAll();
  });
  addEventListener("afterprint", () => {
    report.printing = false;
    drawAll();
  });
}
