"use strict";
(function () {
  const place = document.getElementById("charts");
  const colours = ["#1b6ca8", "#c8553d", "#3a7d44", "#7a4f9e", "#8a6d1d", "#444444"];
  const short = (x, digits = 5) => {
    if (x === null) return "none";
    const size = Math.abs(x);
    return size !== 0 && (size >= 1e5 || size < 1e-3) ? Number(x.toPrecision(digits)).toExponential() : Number(x.toPrecision(digits)).toString();
  };
  const charts = JSON.parse(document.getElementById("curves").textContent).map((curve) => {
    const box = document.createElement("div");
    const title = box.appendChild(document.createElement("h3"));
    title.textContent = curve.title;
    const chart = box.appendChild(document.createElement("div"));
    chart.className = "chart";
    const legend = box.appendChild(document.createElement("div"));
    legend.className = "legend";
    place.appendChild(box);
    return new Dygraph(chart, curve.rows, {
      labels: curve.labels, labelsDiv: legend, legend: "always", xlabel: "t (s)", strokeWidth: 1.2,
      colors: colours.slice(0, curve.labels.length - 1), connectSeparatedPoints: true, drawPoints: curve.rows.length < 3,
      axes: { x: { valueFormatter: (t) => "t = " + short(t) + " s", axisLabelFormatter: (t) => short(t, 4) },
              y: { axisLabelWidth: 64, valueFormatter: (y) => short(y), axisLabelFormatter: (y) => short(y, 4) } },
    });
  });
  // They begin and end at the same times.
  if (charts.length > 1) Dygraph.synchronize(charts, { selection: false, range: false, zoom: true });
})();
