// The curve over time of a picked point, a line for each run that is shown, with a mark at the present time.
var vesselCurve = (function () {
  "use strict";

  var WIDTH = 460, HEIGHT = 190, LEFT = 70, RIGHT = 12, TOP = 12, BOTTOM = 36;
  var STYLES = [["#000000", ""], ["#e8871e", "7 4"], ["#2c6fbb", "9 3 2 3"], ["#b02a5b", "2 3"], ["#5fa55a", "10 3"], ["#6a4c93", "5 1 1 1"]];

  var namespace = (function () {
    var holder = document.createElement("div");
    holder.innerHTML = "<svg></svg>";
    return holder.firstChild.namespaceURI;
  })();

  function add(parent, name, attributes, text) {
    var made = document.createElementNS(namespace, name);
    Object.keys(attributes).forEach(function (key) { made.setAttribute(key, attributes[key]); });
    if (text !== undefined) made.textContent = text;
    parent.appendChild(made);
    return made;
  }

  // Multiples of 1, 2 or 5 times a power of ten; pictures have the same (drawing/colours.py).
  function ticks(low, high) {
    var raw = (high - low) / 4, power = Math.pow(10, Math.floor(Math.log(raw) / Math.LN10 + 1e-9)), found = [];
    var step = [1, 2, 5, 10].map(function (n) { return n * power; }).filter(function (n) { return n >= raw * 0.999; })[0];
    for (var i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) found.push(i * step);
    return found;
  }

  function shown(value) { return value === 0 ? "0" : String(Number(value.toPrecision(4))); }

  // `curves`: [{run, name, times, values}]; `now`: ms; `label`: name and unit.
  function draw(holder, curves, now, label) {
    holder.textContent = "";
    var all = [].concat.apply([], curves.map(function (c) { return c.values; })).filter(isFinite);
    if (!all.length || curves[0].times.length < 2) return;
    var svg = add(holder, "svg", { viewBox: [0, 0, WIDTH, HEIGHT].join(" "), role: "img", "aria-label": label + " over time" });
    var first = Math.min.apply(null, curves.map(function (c) { return c.times[0]; }));
    var last = Math.max.apply(null, curves.map(function (c) { return c.times[c.times.length - 1]; }));
    var low = Math.min.apply(null, all), high = Math.max.apply(null, all);
    if (high === low) { high += Math.abs(high) || 1; low -= Math.abs(low) || 1; }
    function x(t) { return LEFT + (t - first) / (last - first) * (WIDTH - LEFT - RIGHT); }
    function y(v) { return HEIGHT - BOTTOM - (v - low) / (high - low) * (HEIGHT - TOP - BOTTOM); }
    ticks(low, high).forEach(function (v) {
      add(svg, "line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y(v), y2: y(v), class: "grid" });
      add(svg, "text", { x: LEFT - 6, y: y(v) + 4, "text-anchor": "end" }, shown(v));
    });
    ticks(first, last).forEach(function (t) {
      add(svg, "text", { x: x(t), y: HEIGHT - BOTTOM + 16, "text-anchor": "middle" }, shown(t));
    });
    add(svg, "text", { x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 4, "text-anchor": "middle" }, "time in ms");
    curves.forEach(function (curve) {
      var style = STYLES[curve.run % STYLES.length], path = "";
      curve.values.forEach(function (v, i) {
        if (isFinite(v)) path += (path ? "L" : "M") + x(curve.times[i]).toFixed(1) + " " + y(v).toFixed(1);
      });
      add(svg, "path", { d: path, fill: "none", stroke: style[0], "stroke-dasharray": style[1], "stroke-width": 1.6 });
    });
    add(svg, "line", { x1: x(now), x2: x(now), y1: TOP, y2: HEIGHT - BOTTOM, class: "now" });
  }

  return { draw: draw, shown: shown, ticks: ticks };
})();
