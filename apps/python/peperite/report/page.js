"use strict";
(function () {
  const place = document.getElementById("charts");
  const colours = ["#1b6ca8", "#c8553d", "#3a7d44", "#7a4f9e", "#8a6d1d", "#444444"];
  const short = (x, digits = 5) => {
    if (x === null) return "none";
    const size = Math.abs(x);
    return size !== 0 && (size >= 1e5 || size < 1e-3) ? Number(x.toPrecision(digits)).toExponential() : Number(x.toPrecision(digits)).toString();
  };
  // So many that ticks differ: a range of 0.1 about 1250 wants six.
  const digits = ([low, high]) => {
    const size = Math.max(Math.abs(low), Math.abs(high)), range = high - low;
    return Math.min(15, Math.max(3, range > 0 ? Math.ceil(Math.log10(size / range)) + 3 : 3));
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
      colors: colours.slice(0, curve.labels.length - 1), drawPoints: curve.rows.length < 3,
      axes: { x: { valueFormatter: (t) => "t = " + short(t) + " s", axisLabelFormatter: (t, _, __, chart) => short(t, digits(chart.xAxisRange())) },
              y: { axisLabelWidth: 80, valueFormatter: (y) => short(y), axisLabelFormatter: (y, _, __, chart) => short(y, digits(chart.yAxisRange())) } },
    });
  });
  // They begin and end at the same times.
  if (charts.length > 1) Dygraph.synchronize(charts, { selection: false, range: false, zoom: true });
})();
