// Moves the reader of a report through time. Plain JavaScript on inline SVG; nothing is loaded. What it shows stands beside it
// as JSON, made by player.py:
//   {times: [ms], clock: "t = {} ms", runs: [{name, color, dash, width}],
//    panels: [{title, kind: "line" | "series", x, y, xUnit, yUnit, curves: [{run, times?, x, values}]}]}
// Values are packed: {low, step, data: base64 of 16-bit numbers}, value = low + step * number, 65535: none. x and times are
// {low, step, count} when they are equally spaced, else {numbers}.
// A "line" has values at (time, x) and moves; a "series" has values at x = time, and a mark at the present time.
(function () {
  "use strict";

  var WIDTH = 560, HEIGHT = 300, LEFT = 66, RIGHT = 14, TOP = 12, BOTTOM = 44;
  var NONE = 65535;

  function unpacked(packed) {
    if (packed.numbers) return Float64Array.from(packed.numbers);
    if (packed.count) return Float64Array.from({ length: packed.count }, function (_, i) { return packed.low + packed.step * i; });
    var bytes = atob(packed.data), numbers = new Float64Array(bytes.length / 2);
    for (var i = 0; i < numbers.length; ++i) {
      var n = bytes.charCodeAt(2 * i) + 256 * bytes.charCodeAt(2 * i + 1);
      numbers[i] = n === NONE ? NaN : packed.low + packed.step * n;
    }
    return numbers;
  }

  // [i, weight]: x lies between numbers i and i + 1 of an increasing array; null outside of it.
  function place(numbers, x) {
    var last = numbers.length - 1, tolerance = 1e-4 * Math.abs(numbers[last] - numbers[0]) + 1e-12;
    if (last < 0 || x < numbers[0] - tolerance || x > numbers[last] + tolerance) return null;
    if (x <= numbers[0] || last === 0) return [0, 0];
    if (x >= numbers[last]) return [last - 1, 1];
    var low = 0, high = last;
    while (high - low > 1) {
      var middle = (low + high) >> 1;
      if (numbers[middle] <= x) low = middle; else high = middle;
    }
    return [low, (x - numbers[low]) / (numbers[low + 1] - numbers[low])];
  }

  function between(numbers, at, offset) {
    var a = numbers[offset + at[0]];
    return at[1] === 0 ? a : (1 - at[1]) * a + at[1] * numbers[offset + at[0] + 1];
  }

  function shown(value) {
    return value === 0 ? "0" : String(Number(value.toPrecision(4)));
  }

  // Without the digits that packing has lost.
  function read(value, step) {
    var unit = step > 0 ? Math.pow(10, Math.ceil(Math.log(step) / Math.LN10)) : 0;
    return shown(unit > 0 ? Math.round(value / unit) * unit : value);
  }

  function ticks(low, high, most) {
    var raw = (high - low) / most, power = Math.pow(10, Math.floor(Math.log(raw) / Math.LN10 + 1e-9));
    var step = [1, 2, 5, 10].map(function (n) { return n * power; }).filter(function (n) { return n >= raw * 0.999; })[0];
    var found = [];
    for (var i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) found.push(i * step);
    return found;
  }

  function element(name, attributes, text) {
    var made = document.createElement(name);
    Object.keys(attributes || {}).forEach(function (key) { made.setAttribute(key, attributes[key]); });
    if (text !== undefined) made.textContent = text;
    return made;
  }

  // Elements of pictures take their namespace from one that was parsed, so that the page names no address.
  var namespace = (function () {
    var holder = document.createElement("div");
    holder.innerHTML = "<svg></svg>";
    return holder.firstChild.namespaceURI;
  })();

  function drawn(parent, name, attributes, text) {
    var made = document.createElementNS(namespace, name);
    Object.keys(attributes || {}).forEach(function (key) { made.setAttribute(key, attributes[key]); });
    if (text !== undefined) made.textContent = text;
    if (parent) parent.appendChild(made);
    return made;
  }

  function lineStyle(run) {
    return { stroke: run.color, "stroke-width": run.width, "stroke-dasharray": run.dash, fill: "none" };
  }

  // One diagram. `state`: {time, on: [bool]} of the whole player.
  function Panel(spec, data, state) {
    var self = this;
    this.spec = spec;
    this.data = data;
    this.state = state;
    this.pointer = null; // x under the pointer
    this.view = null; // [x0, x1, y0, y1] when zoomed
    this.curves = spec.curves.map(function (curve) {
      return {
        run: curve.run,
        times: curve.times ? unpacked(curve.times) : null,
        x: unpacked(curve.x),
        values: unpacked(curve.values),
        step: curve.values.step
      };
    });
    this.whole = this.ofAll = this.limits(this.curves, function (curve) { return curve.values; });
    this.figure = element("figure", { class: "panel" });
    this.figure.appendChild(element("figcaption", {}, spec.title));
    var name = spec.title + ": " + spec.y + " over " + spec.x;
    this.svg = drawn(this.figure, "svg", {
      viewBox: "0 0 " + WIDTH + " " + HEIGHT, tabindex: 0, role: "img",
      "aria-label": name + ". Arrow keys read values, plus and minus zoom, 0 shows all."
    });
    this.axes = drawn(this.svg, "g", { class: "axes" });
    var wide = WIDTH - LEFT - RIGHT, high = HEIGHT - TOP - BOTTOM;
    var inside = drawn(this.svg, "svg", { // it cuts off what is outside
      x: LEFT, y: TOP, width: wide, height: high, viewBox: [LEFT, TOP, wide, high].join(" ")
    });
    this.now = drawn(inside, "line", { class: "now" });
    this.paths = this.curves.map(function (curve) {
      var attributes = lineStyle(data.runs[curve.run]);
      attributes.class = "curve";
      attributes["data-run"] = curve.run;
      return drawn(inside, "path", attributes);
    });
    this.cursor = drawn(inside, "line", { class: "cursor" });
    this.dots = this.curves.map(function (curve) {
      return drawn(inside, "circle", { r: 3.5, fill: data.runs[curve.run].color, class: "dot" });
    });
    this.box = drawn(this.svg, "rect", { class: "box" });
    this.readout = element("p", { class: "readout" });
    this.figure.appendChild(this.readout);
    this.reset = element("button", { type: "button", class: "reset", hidden: "" }, "show all");
    this.reset.addEventListener("click", function () { self.zoom(null); });
    this.figure.appendChild(this.reset);
    this.listen();
  }

  // [x0, x1, y0, y1] about curves with these values.
  Panel.prototype.limits = function (curves, valuesOf) {
    var low = Infinity, high = -Infinity, first = Infinity, last = -Infinity;
    curves.forEach(function (curve) {
      (valuesOf(curve) || []).forEach(function (v) { if (v < low) low = v; if (v > high) high = v; });
      curve.x.forEach(function (x) { if (x < first) first = x; if (x > last) last = x; });
    });
    if (!(low <= high)) { low = 0; high = 1; }
    if (low > 0 && low < 0.3 * high) low = 0;
    if (low === high) { low -= 1; high += 1; }
    if (!(first < last)) { first -= 0.5; last = first + 1; }
    var margin = 0.04 * (high - low);
    return [first, last, low === 0 ? 0 : low - margin, high + margin];
  };

  Panel.prototype.view4 = function () { return this.view || this.whole; };
  Panel.prototype.toX = function (x) {
    var v = this.view4();
    return LEFT + (WIDTH - LEFT - RIGHT) * (x - v[0]) / (v[1] - v[0]);
  };
  Panel.prototype.toY = function (y) {
    var v = this.view4();
    return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (y - v[2]) / (v[3] - v[2]);
  };
  Panel.prototype.fromX = function (px) {
    var v = this.view4();
    return v[0] + (v[1] - v[0]) * (px - LEFT) / (WIDTH - LEFT - RIGHT);
  };
  Panel.prototype.fromY = function (py) {
    var v = this.view4();
    return v[2] + (v[3] - v[2]) * (HEIGHT - BOTTOM - py) / (HEIGHT - TOP - BOTTOM);
  };

  // Values of a curve at the present time: an array beside curve.x, or null where the run has no level.
  Panel.prototype.present = function (curve) {
    if (!curve.times) return curve.values;
    var at = place(curve.times, this.state.time), n = curve.x.length;
    if (!at) return null;
    if (at[1] === 0) return curve.values.subarray(at[0] * n, at[0] * n + n);
    var a = curve.values.subarray(at[0] * n, at[0] * n + n), b = curve.values.subarray((at[0] + 1) * n, (at[0] + 2) * n);
    return a.map(function (value, i) { return (1 - at[1]) * value + at[1] * b[i]; });
  };

  Panel.prototype.valueAt = function (curve, x) {
    var values = this.present(curve), at = values && place(curve.x, x);
    return at ? between(values, at, 0) : NaN;
  };

  Panel.prototype.drawAxes = function () {
    var self = this, v = this.view4(), spec = this.spec, bottom = HEIGHT - BOTTOM;
    this.axes.textContent = "";
    ticks(v[0], v[1], 7).forEach(function (x) {
      drawn(self.axes, "line", { class: "grid", x1: self.toX(x), x2: self.toX(x), y1: TOP, y2: bottom });
      drawn(self.axes, "text", { x: self.toX(x), y: bottom + 16, "text-anchor": "middle" }, shown(x));
    });
    ticks(v[2], v[3], 5).forEach(function (y) {
      drawn(self.axes, "line", { class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: self.toY(y), y2: self.toY(y) });
      drawn(self.axes, "text", { x: LEFT - 6, y: self.toY(y) + 4, "text-anchor": "end" }, shown(y));
    });
    drawn(self.axes, "path", { class: "frame", d: "M" + LEFT + " " + TOP + "V" + bottom + "H" + (WIDTH - RIGHT) });
    drawn(self.axes, "text", { class: "label", x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 8, "text-anchor": "middle" },
      spec.x + " in " + spec.xUnit);
    var middle = (TOP + bottom) / 2;
    drawn(self.axes, "text", {
      class: "label", x: 14, y: middle, "text-anchor": "middle", transform: "rotate(-90 14 " + middle + ")"
    }, spec.y + " in " + spec.yUnit);
  };

  Panel.prototype.draw = function () {
    var self = this, state = this.state, spec = this.spec, words = [];
    this.whole = this.ofAll;
    if (state.fit && spec.kind === "line") {
      var on = this.curves.filter(function (curve) { return state.on[curve.run]; });
      var fitted = this.limits(on, function (curve) { return self.present(curve); });
      if (on.length) this.whole = [this.ofAll[0], this.ofAll[1], fitted[2], fitted[3]];
    }
    var x = this.pointer !== null ? this.pointer : spec.kind === "series" ? state.time : null;
    this.drawAxes();
    this.curves.forEach(function (curve, i) {
      var on = state.on[curve.run], values = on ? self.present(curve) : null, d = "", pen = false;
      for (var k = 0; values && k < curve.x.length; ++k) {
        if (isNaN(values[k])) { pen = false; continue; }
        d += (pen ? "L" : "M") + self.toX(curve.x[k]).toFixed(1) + " " + self.toY(values[k]).toFixed(1);
        pen = true;
      }
      self.paths[i].setAttribute("d", d);
      self.paths[i].setAttribute("visibility", on ? "visible" : "hidden");
      var value = on && x !== null ? self.valueAt(curve, x) : NaN;
      self.dots[i].setAttribute("visibility", isNaN(value) ? "hidden" : "visible");
      if (!isNaN(value)) {
        self.dots[i].setAttribute("cx", self.toX(x));
        self.dots[i].setAttribute("cy", self.toY(value));
      }
      if (!on) return;
      var name = self.data.runs[curve.run].name + " ";
      if (x !== null) words.push(name + (isNaN(value) ? "none" : read(value, curve.step) + " " + spec.yUnit));
      else words.push(name + self.largest(curve, values));
    });
    this.upright(this.cursor, this.pointer);
    this.upright(this.now, spec.kind === "series" ? state.time : null);
    this.readout.textContent = (x !== null ? spec.x + " " + shown(x) + " " + spec.xUnit + ": " : "largest: ") +
      words.join("; ");
    this.reset.hidden = this.view === null;
  };

  Panel.prototype.largest = function (curve, values) {
    var best = -1;
    for (var k = 0; values && k < values.length; ++k)
      if (!isNaN(values[k]) && (best < 0 || values[k] > values[best])) best = k;
    if (best < 0) return "none";
    return read(values[best], curve.step) + " " + this.spec.yUnit + " at " + shown(curve.x[best]) + " " + this.spec.xUnit;
  };

  Panel.prototype.upright = function (line, x) {
    line.setAttribute("visibility", x === null ? "hidden" : "visible");
    if (x === null) return;
    line.setAttribute("x1", this.toX(x));
    line.setAttribute("x2", this.toX(x));
    line.setAttribute("y1", TOP);
    line.setAttribute("y2", HEIGHT - BOTTOM);
  };

  Panel.prototype.zoom = function (view) {
    this.view = view;
    this.draw();
  };

  // About the pointer, or the middle.
  Panel.prototype.scale = function (factor) {
    var v = this.view4(), x = this.pointer !== null ? this.pointer : (v[0] + v[1]) / 2, y = (v[2] + v[3]) / 2;
    var w = this.whole, next = [x + factor * (v[0] - x), x + factor * (v[1] - x), y + factor * (v[2] - y), y + factor * (v[3] - y)];
    this.zoom(next[1] - next[0] >= w[1] - w[0] ? null : next);
  };

  Panel.prototype.listen = function () {
    var self = this, svg = this.svg, from = null;

    function at(event) { // in the units of the picture
      var box = svg.getBoundingClientRect();
      return [(event.clientX - box.left) * WIDTH / box.width, (event.clientY - box.top) * HEIGHT / box.height];
    }
    function follow(px) {
      var v = self.view4();
      self.pointer = Math.min(v[1], Math.max(v[0], self.fromX(px)));
      self.draw();
    }
    function select(to) {
      var wide = Math.abs(to[0] - from[0]), high = Math.abs(to[1] - from[1]);
      self.box.setAttribute("x", Math.min(from[0], to[0]));
      self.box.setAttribute("y", Math.min(from[1], to[1]));
      self.box.setAttribute("width", wide);
      self.box.setAttribute("height", high);
      return wide > 8 && high > 8;
    }
    svg.addEventListener("pointerdown", function (event) {
      from = at(event);
      if (svg.setPointerCapture) try { svg.setPointerCapture(event.pointerId); } catch (ignored) { /* it has left */ }
    });
    svg.addEventListener("pointermove", function (event) {
      var to = at(event);
      if (from) select(to);
      follow(to[0]);
    });
    svg.addEventListener("pointerup", function (event) {
      var to = at(event);
      if (from && select(to)) {
        var x = [self.fromX(from[0]), self.fromX(to[0])], y = [self.fromY(from[1]), self.fromY(to[1])], w = self.view4();
        self.zoom([Math.max(w[0], Math.min(x[0], x[1])), Math.min(w[1], Math.max(x[0], x[1])),
          Math.max(w[2], Math.min(y[0], y[1])), Math.min(w[3], Math.max(y[0], y[1]))]);
      }
      from = null;
      self.box.setAttribute("width", 0);
    });
    svg.addEventListener("pointerleave", function () {
      if (from) return;
      self.pointer = null;
      self.draw();
    });
    svg.addEventListener("pointercancel", function () { from = null; self.box.setAttribute("width", 0); });
    svg.addEventListener("dblclick", function () { self.zoom(null); });
    svg.addEventListener("blur", function () { self.pointer = null; self.draw(); });
    svg.addEventListener("keydown", function (event) {
      var v = self.view4(), step = (v[1] - v[0]) / 100;
      if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
        var x = self.pointer !== null ? self.pointer : (v[0] + v[1]) / 2;
        self.pointer = Math.min(v[1], Math.max(v[0], x + (event.key === "ArrowLeft" ? -step : step)));
        self.draw();
      } else if (event.key === "+" || event.key === "=") self.scale(0.5);
      else if (event.key === "-") self.scale(2);
      else if (event.key === "0") self.zoom(null);
      else if (event.key === "Escape") { self.pointer = null; self.draw(); }
      else return;
      event.preventDefault();
    });
  };

  function start(root) {
    var data = JSON.parse(root.querySelector("script").textContent);
    var state = { time: data.times[0], fit: false, on: data.runs.map(function () { return true; }) };
    var controls = element("div", { class: "controls" }), panels = element("div", { class: "panels" });
    var play = element("button", { type: "button" }, "play"), timer = null;
    var label = element("label", {}, "time "), output = element("output");
    var slider = element("input", { type: "range", min: 0, max: data.times.length - 1, step: 1, value: 0 });
    label.appendChild(slider);
    controls.appendChild(play);
    controls.appendChild(label);
    controls.appendChild(output);

    var made = data.panels.map(function (spec) { return new Panel(spec, data, state); });
    function show() {
      state.time = data.times[Number(slider.value)];
      output.textContent = data.clock.replace("{}", shown(state.time));
      slider.setAttribute("aria-valuetext", output.textContent.replace("t = ", ""));
      made.forEach(function (panel) { panel.draw(); });
    }
    function stop() {
      if (timer !== null) clearInterval(timer);
      timer = null;
      play.textContent = "play";
    }
    slider.addEventListener("input", function () { stop(); show(); });
    play.addEventListener("click", function () {
      if (timer !== null) return stop();
      if (Number(slider.value) >= data.times.length - 1) slider.value = 0;
      play.textContent = "stop";
      timer = setInterval(function () {
        if (Number(slider.value) >= data.times.length - 1) return stop();
        slider.value = Number(slider.value) + 1;
        show();
      }, Math.max(40, Math.min(400, 8000 / data.times.length)));
    });

    var choice = element("fieldset", { class: "runs" });
    choice.appendChild(element("legend", {}, "runs"));
    data.runs.forEach(function (run, i) {
      var each = element("label"), box = element("input", { type: "checkbox" });
      box.checked = true;
      box.addEventListener("change", function () {
        state.on[i] = box.checked;
        show();
      });
      each.appendChild(box);
      var attributes = lineStyle(run);
      attributes.d = "M2 6H46";
      drawn(drawn(each, "svg", { viewBox: "0 0 48 12", class: "sample", "aria-hidden": "true" }), "path", attributes);
      each.appendChild(document.createTextNode(run.name));
      choice.appendChild(each);
    });
    var fit = element("label"), box = element("input", { type: "checkbox", class: "fit" });
    box.addEventListener("change", function () {
      state.fit = box.checked;
      show();
    });
    fit.appendChild(box);
    fit.appendChild(document.createTextNode(" scale to the time shown"));
    choice.appendChild(fit);
    made.forEach(function (panel) { panels.appendChild(panel.figure); });
    root.appendChild(controls);
    root.appendChild(choice);
    root.appendChild(panels);
    root.hidden = false;
    show();
  }

  Array.prototype.forEach.call(document.querySelectorAll(".player"), start);
})();
