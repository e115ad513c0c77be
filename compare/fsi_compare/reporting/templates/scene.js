// The vessel in space: controls, legend, what is read. Data by scene.py: {runs: [{name, times, apart, parts}], quantities, views,
// box, plane, flat, turned, angles, maps, clock: "t = {} ms"}. Where the library or WebGL is missing the stills of the page
// stay, with a line that says why.
(function () {
  "use strict";

  var PER_KPA = { kPa: 1, Pa: 1000, mmHg: 7.50062 }, GAP = 8;
  var shown = vesselCurve.shown;

  function element(parent, name, attributes, text) {
    var made = document.createElement(name);
    Object.keys(attributes || {}).forEach(function (key) { made.setAttribute(key, attributes[key]); });
    if (text !== undefined) made.textContent = text;
    if (parent) parent.appendChild(made);
    return made;
  }

  // `smooth`: edges are smoothed, for which the processor would take too long.
  function Scene(root, data, smooth) {
    this.root = root;
    this.data = data;
    this.state = { time: 0, quantity: data.first, show: data.runs.length > 1 ? "all" : "0", factor: 1, unit: "", cut: false, swept: false,
      on: {}, pick: null };
    this.runs = data.runs.map(function (run, r) {
      return { name: run.name, times: run.times, apart: run.apart, parts: run.parts.map(function (spec, p) {
        return new vesselData.Part(spec, run.times, run.apart ? { index: p } : null);
      }) };
    });
    var runs = this.runs;
    runs.forEach(function (run) {
      run.parts.forEach(function (part) { if (part.base) part.base = runs[0].parts[part.base.index]; });
    });
    this.times = Array.from(new Set([].concat.apply([], data.runs.map(function (run) { return run.times; })))).sort(function (a, b) {
      return a - b;
    });
    this.textures = {};
    this.state.time = this.nearest(data.start);
    this.controls();
    this.view = new vesselView.View(this.canvas, data.box, smooth);
    var self = this;
    this.view.picked = function (found) { self.pick(found); };
    this.view.drawn = function () { self.frames = (self.frames || 0) + 1; };
    Object.keys(data.maps).forEach(function (name) { self.textures[name] = vesselView.texture(vesselData.plain(data.maps[name])); });
    this.ownUnit();
    this.look(data.views[0]);
    this.rebuild();
    new ResizeObserver(function () { self.arrange(); }).observe(this.canvas);
  }

  // The number of the time that is nearest to one in ms.
  Scene.prototype.nearest = function (time) {
    var times = this.times;
    return times.reduce(function (best, t, i) { return Math.abs(t - time) < Math.abs(times[best] - time) ? i : best; }, 0);
  };

  Scene.prototype.quantity = function () {
    var key = this.state.quantity;
    return this.data.quantities.filter(function (q) { return q.key === key; })[0];
  };

  Scene.prototype.select = function (parent, label, options, value, chosen) {
    var holder = element(parent, "label", {}, label + " "), list = element(holder, "select");
    options.forEach(function (o) { element(list, "option", { value: o[0] }, o[1]); });
    list.value = value;
    list.addEventListener("change", function () { chosen(list.value); });
    return list;
  };

  Scene.prototype.controls = function () {
    var self = this, data = this.data, state = this.state;
    var top = element(this.root, "div", { class: "row" });
    this.fieldList = this.select(top, "Field", data.quantities.map(function (q) { return [q.key, q.words]; }), state.quantity, function (key) {
      state.quantity = key;
      state.on = {};
      self.ownUnit();
      self.rebuild();
    });
    this.unitList = this.select(top, "Unit", [["kPa", "kPa"], ["Pa", "Pa"], ["mmHg", "mmHg"]], "kPa", function (unit) {
      state.unit = unit;
      self.update();
    });
    var shows = data.runs.map(function (run, r) { return [String(r), run.name]; });
    if (data.runs.length > 1) shows.unshift(["all", "all beside each other"]);
    data.runs.forEach(function (run, r) {
      if (run.apart) shows.push(["apart" + r, "difference: " + run.name + " less " + data.runs[0].name]);
    });
    this.runList = this.select(top, "Run", shows, state.show, function (show) { state.show = show; self.rebuild(); });
    this.runList.parentNode.hidden = shows.length < 2;
    this.viewList = this.select(top, "View", data.views.map(function (v, i) { return [i, i ? "from " + v.name : v.name]; }), 0, function (i) {
      self.look(data.views[i]);
    });
    var moves = data.quantities.some(function (q) { return q.field === "displacement"; });
    var factor = element(element(top, "label", {}, "Displacement × "), "input", { type: "number", min: 0, step: "any", value: 1, class: "factor" });
    factor.parentNode.hidden = !moves;
    factor.addEventListener("input", function () {
      var value = Number(factor.value);
      if (isFinite(value) && value >= 0) { state.factor = value; self.update(); }
    });
    this.groups = element(this.root, "div", { class: "row groups" });
    this.stage = element(this.root, "div", { class: "stage" });
    this.canvas = element(this.stage, "canvas", { tabindex: 0, role: "img", "aria-label":
      "The vessel. Drag or arrow keys turn it, the wheel, plus and minus zoom, a click reads a value." });
    this.names = element(this.stage, "div", { class: "names" });
    this.legend = element(this.root, "div", { class: "legend" });
    var time = element(this.root, "div", { class: "row" });
    this.playButton = element(time, "button", { type: "button" }, "Play");
    this.playButton.addEventListener("click", function () { self.play(!self.playing); });
    this.slider = element(time, "input", { type: "range", min: 0, max: this.times.length - 1, step: 1, "aria-label": "time" });
    this.slider.value = state.time;
    this.clock = element(time, "output");
    this.slider.addEventListener("input", function () { state.time = Number(self.slider.value); self.update(); });
    this.readout = element(this.root, "p", { class: "readout" }, "Click a point of the surface to read its value.");
    this.curve = element(this.root, "div", { class: "curve" });
  };

  // Small stresses in Pa, unless the reader has chosen.
  Scene.prototype.ownUnit = function () {
    if (!this.state.unit) this.unitList.value = Math.max(Math.abs(this.quantity().low), this.quantity().high) < 0.5 ? "Pa" : "kPa";
  };

  // Which groups are shown: what the reader chose, else those that have the field.
  Scene.prototype.visible = function (part) {
    var group = part.spec.group, chosen = this.state.on[group];
    if (group === "cut") return this.state.cut;
    if (part.spec.name === "inner" && this.twice()) return false;
    if (chosen !== undefined) return chosen;
    return this.data.flat && group !== "wall" || this.colours(part) || group === "openings";
  };

  // Whether lumen and inner side of the wall, which are one surface, would be drawn with the same values.
  Scene.prototype.twice = function () {
    return this.state.on.lumen !== false && this.quantity().media.length > 1;
  };

  Scene.prototype.colours = function (part) {
    var q = this.quantity();
    return q.media.indexOf(part.spec.medium) >= 0 && part.has(q.field);
  };

  Scene.prototype.groupBoxes = function () {
    var self = this, state = this.state, seen = {}, angles = this.state.swept;
    this.groups.textContent = "";
    function box(text, checked, chosen) {
      var label = element(self.groups, "label"), input = element(label, "input", { type: "checkbox" });
      input.checked = checked;
      label.appendChild(document.createTextNode(" " + text));
      input.addEventListener("change", function () { chosen(input.checked); });
    }
    if (this.data.turned) box("swept around the axis", state.swept, function (on) {
      state.swept = on;
      self.look(self.data.views[on ? 1 : 0]);
      self.rebuild();
    });
    this.runs[0].parts.forEach(function (part) {
      var group = part.spec.group;
      if (seen[group] || group === "cut" || self.data.flat && !angles && group !== "lumen") return;
      seen[group] = true;
      box(group, self.visible(part), function (on) { state.on[group] = on; self.rebuild(); });
    });
    if (this.data.plane) box("cut open", state.cut, function (on) { state.cut = on; self.rebuild(); });
  };

  // Which runs in which pane: [{run, apart}].
  Scene.prototype.panes = function () {
    var show = this.state.show;
    if (show === "all") return this.runs.map(function (run) { return { run: run, apart: false }; });
    if (show.indexOf("apart") === 0) return [{ run: this.runs[Number(show.slice(5))], apart: true }];
    return [{ run: this.runs[Number(show)], apart: false }];
  };

  // Everything anew: after another choice of field, run or surfaces. Its promise is kept when all is on the screen.
  Scene.prototype.rebuild = function () {
    var self = this, q = this.quantity(), panes = this.panes(), waits = [], size = this.view.size;
    this.building = (this.building || 0) + 1;
    var turn = this.building;
    this.groupBoxes();
    panes.forEach(function (pane) {
      pane.parts = pane.run.parts.filter(function (part) { return self.visible(part); });
      pane.parts.forEach(function (part) {
        waits.push(part.mesh().then(function () {
          return Promise.all([part.load("displacement"), self.colours(part) ? part.load(q.field) : null, part.base ? part.base.mesh() : null]);
        }));
      });
    });
    this.ready = Promise.all(waits).then(function () {
      if (turn !== self.building) return;
      self.free();
      self.view.panes = panes.map(function (pane) {
        var scene = new THREE.Scene(), drawings = [];
        pane.parts.forEach(function (part) {
          var made = vesselGeometry.shape(part, self.state.swept ? self.data.angles : null, size, self.data.turned ? 2 : 1);
          if (!made) return;
          var reference = new Float32Array(3 * made.source.length);
          vesselGeometry.move(part, made, [0, 0], 0, reference);
          var drawing = self.view.drawing(part, made, reference);
          drawings.push(drawing);
          scene.add(drawing.mesh);
        });
        return { scene: scene, drawings: drawings, run: pane.run, apart: pane.apart };
      });
      self.arrange();
      self.update();
    });
    return this.ready;
  };

  Scene.prototype.free = function () {
    this.view.panes.forEach(function (pane) {
      pane.drawings.forEach(function (drawing) { drawing.mesh.geometry.dispose(); drawing.mesh.material.dispose(); });
    });
  };

  // Panes beside each other, at most three in a row.
  Scene.prototype.arrange = function () {
    var panes = this.view.panes, columns = Math.min(panes.length, 3) || 1, rows = Math.ceil(panes.length / columns) || 1;
    var width = (this.canvas.clientWidth - GAP * (columns - 1)) / columns, names = this.names;
    var height = (this.canvas.clientHeight - GAP * (rows - 1)) / rows;
    names.textContent = "";
    panes.forEach(function (pane, i) {
      pane.left = (i % columns) * (width + GAP);
      pane.top = Math.floor(i / columns) * (height + GAP);
      pane.width = width;
      pane.height = height;
      var text = pane.apart ? pane.run.name + " less the first run" : pane.run.name;
      element(names, "span", { style: "left:" + pane.left + "px;top:" + pane.top + "px" }, text);
    });
    this.view.render();
  };

  Scene.prototype.scale = function () {
    var q = this.quantity(), show = this.state.show;
    var of = show.indexOf("apart") === 0 ? q.apart[Number(show.slice(5)) - 1] : q;
    return { low: of.low, high: of.high, least: of.least, largest: of.largest, map: of.map, texture: this.textures[of.map] };
  };

  // After another time, factor or unit.
  Scene.prototype.update = function () {
    var self = this, q = this.quantity(), t = this.times[this.state.time], scale = this.scale(), plane = this.cutPlane();
    this.unitList.parentNode.hidden = q.unit !== "kPa";
    this.view.panes.forEach(function (pane) {
      var at = vesselData.place(pane.run.times, t);
      pane.drawings.forEach(function (drawing) {
        var part = drawing.part;
        self.view.moved(drawing, at, self.state.factor);
        self.view.coloured(drawing, self.colours(part) && part.loaded[q.field] ? function (node) {
          return pane.apart ? part.difference(q, node, at) : part.value(q, node, at);
        } : null, scale);
        self.view.cut(drawing, plane);
      });
    });
    this.slider.value = this.state.time;
    this.clock.textContent = this.data.clock.replace("{}", shown(t));
    this.slider.setAttribute("aria-valuetext", this.clock.textContent.replace("t = ", ""));
    this.showLegend(scale);
    this.read();
    if (this.playing) this.view.renderMoving();
    else this.view.render();
  };

  // What is on the eye's side of it is left out.
  Scene.prototype.cutPlane = function () {
    var plane = this.data.plane;
    if (!plane || !this.state.cut) return null;
    var n = plane.normal, o = plane.origin, side = this.cutSide || 1;
    return [side * n[0], side * n[1], side * n[2], side * (n[0] * o[0] + n[1] * o[1] + n[2] * o[2])];
  };

  Scene.prototype.perOwn = function () {
    var q = this.quantity();
    return q.unit === "kPa" ? PER_KPA[this.unitList.value] : 1;
  };

  Scene.prototype.unit = function () { return this.quantity().unit === "kPa" ? this.unitList.value : this.quantity().unit; };

  Scene.prototype.showLegend = function (scale) {
    var q = this.quantity(), per = this.perOwn(), unit = this.unit(), bytes = vesselData.plain(this.data.maps[scale.map]), stops = [];
    for (var i = 0; i < 256; i += 15) stops.push("rgb(" + bytes[3 * i] + "," + bytes[3 * i + 1] + "," + bytes[3 * i + 2] + ")");
    this.legend.textContent = "";
    element(this.legend, "strong", {}, q.words + (unit ? " in " + unit : "") + (this.state.show.indexOf("apart") === 0 ? ", difference" : ""));
    var bar = element(this.legend, "div", { class: "bar", style: "background:linear-gradient(to right," + stops.join(",") + ")" });
    vesselCurve.ticks(per * scale.low, per * scale.high).forEach(function (tick) {
      var place = 100 * (tick / per - scale.low) / (scale.high - scale.low);
      element(bar, "span", { class: "tick", style: "left:" + place.toFixed(3) + "%" }, shown(tick));
    });
    element(bar, "span", { class: "unit" }, unit);
    element(this.legend, "small", {}, "One scale for all times and runs. Colours end at the " + this.data.percentile +
      "th percentile of the nodes; " + shown(per * scale.least) + " to " + shown(per * scale.largest) + " occur.");
  };

  Scene.prototype.look = function (view) {
    this.view.look(view.towards, view.up, view.target);
    var n = this.data.plane && this.data.plane.normal, side = n && n[0] * view.towards[0] + n[1] * view.towards[1] + n[2] * view.towards[2];
    this.cutSide = side < 0 ? -1 : 1;
    if (this.data.plane && this.state.cut) this.update();
  };

  Scene.prototype.pick = function (found) {
    if (this.view.marker.parent) this.view.marker.parent.remove(this.view.marker);
    this.state.pick = found && { part: found.drawing.part.spec.name, run: this.runs.indexOf(found.pane.run),
      node: found.drawing.made.source[found.vertex], vertex: found.vertex };
    this.read();
    this.view.render();
  };

  // Value and curve of the picked point; the mark that stands there.
  Scene.prototype.read = function () {
    var pick = this.state.pick, self = this, q = this.quantity(), per = this.perOwn(), unit = this.unit();
    this.curve.textContent = "";
    if (!pick) {
      this.readout.textContent = "Click a point of the surface to read its value.";
      return;
    }
    var curves = [], words = [], t = this.times[this.state.time], where = "";
    this.view.panes.forEach(function (pane) {
      pane.drawings.forEach(function (drawing) {
        var part = drawing.part, at = vesselData.place(pane.run.times, t), r = self.runs.indexOf(pane.run);
        if (part.spec.name !== pick.part || pick.node >= part.nodes.length) return;
        if (r === pick.run || !where) {
          var p = [0, 1, 2].map(function (k) { return shown(part.points[3 * pick.node + k]); });
          where = part.spec.name + ", " + (part.spec.between ? "near " : "") + "node " + part.nodes[pick.node] + " of the " +
            part.spec.medium + " at (" + p.join(", ") + ") mm: ";
          self.mark(pane, drawing, pick.vertex);
        }
        if (!self.colours(part) || !part.loaded[q.field]) return;
        var value = function (level) { return per * (pane.apart ? part.difference(q, pick.node, level) : part.value(q, pick.node, level)); };
        words.push((self.view.panes.length > 1 ? pane.run.name + " " : "") + shown(value(at)) + (unit ? " " + unit : ""));
        curves.push({ run: r, name: pane.run.name, times: pane.run.times, values: pane.run.times.map(function (time) {
          return value(vesselData.place(pane.run.times, time));
        }) });
      });
    });
    this.readout.textContent = where ? where + (words.length ? q.words + " " + words.join(", ") : "it has no " + q.words) :
      "Click a point of the surface to read its value.";
    if (curves.length) vesselCurve.draw(this.curve, curves, t, q.words + (unit ? " in " + unit : ""));
  };

  Scene.prototype.mark = function (pane, drawing, vertex) {
    if (vertex >= drawing.made.source.length) return;
    this.view.marker.position.fromBufferAttribute(drawing.mesh.geometry.attributes.position, vertex);
    this.view.marker.scale.setScalar(1 / Math.sqrt(this.view.zoom));
    pane.scene.add(this.view.marker);
  };

  // Where a node of a shown part is on the canvas: [x, y] in pixels of the page. For scripts.
  Scene.prototype.screen = function (paneNumber, name, node) {
    var pane = this.view.panes[paneNumber], drawing = pane.drawings.filter(function (d) { return d.part.spec.name === name; })[0];
    this.view.shape(pane);
    var p = new THREE.Vector3().fromBufferAttribute(drawing.mesh.geometry.attributes.position, drawing.made.source.indexOf(node))
      .project(this.view.camera);
    return [pane.left + (p.x + 1) / 2 * pane.width, pane.top + (1 - p.y) / 2 * pane.height];
  };

  // Turns to a place of the vessel: a field at a time, the point marked. {quantity, time, run, part, point}
  Scene.prototype.turnTo = function (place) {
    var self = this, run = this.runs[place.run];
    this.play(false);
    this.state.quantity = this.fieldList.value = place.quantity;
    this.state.show = this.runList.value = String(place.run);
    this.state.on = {};
    this.state.time = this.nearest(place.time);
    this.state.cut = place.part.indexOf(" cut") > 0;
    this.ownUnit();
    return this.rebuild().then(function () {
      var pane = self.view.panes[0], drawing = pane.drawings.filter(function (d) { return d.part.spec.name === place.part; })[0];
      if (!drawing || !run) return;
      var p = drawing.part.points, best = 0, far = Infinity;
      for (var i = 0; i < drawing.part.nodes.length; ++i) {
        var d = Math.hypot(p[3 * i] - place.point[0], p[3 * i + 1] - place.point[1], p[3 * i + 2] - place.point[2]);
        if (d < far) { far = d; best = i; }
      }
      var vertex = drawing.made.source.indexOf(best);
      if (!self.data.flat && drawing.part.spec.group !== "cut") {
        var normal = drawing.mesh.geometry.attributes.normal, n = [normal.getX(vertex), normal.getY(vertex), normal.getZ(vertex)];
        var up = Math.abs(n[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0];
        self.view.look(n, up);
      } else self.look(self.data.views[0]);
      self.pick({ drawing: drawing, vertex: vertex, pane: pane });
      self.root.scrollIntoView({ block: "nearest" });
    });
  };

  Scene.prototype.play = function (on) {
    var self = this;
    this.playing = on;
    this.playButton.textContent = on ? "Stop" : "Play";
    clearTimeout(this.timer);
    if (!on) return;
    (function next() {
      if (!self.playing) return;
      self.state.time = (self.state.time + 1) % self.times.length;
      self.update();
      self.timer = setTimeout(next, Math.max(50, Math.min(200, 8000 / self.times.length)));
    })();
  };

  // Of what draws; null without WebGL.
  function drawerName() {
    var context = document.createElement("canvas").getContext("webgl");
    if (!context) return null;
    var about = context.getExtension("WEBGL_debug_renderer_info"), lose = context.getExtension("WEBGL_lose_context");
    var name = about ? String(context.getParameter(about.UNMASKED_RENDERER_WEBGL)) : "";
    if (lose) lose.loseContext();
    return name;
  }

  function begin(root) {
    var problem = element(root, "p", { class: "note" });
    function without(why) {
      problem.textContent = why + " The pictures below are of the same.";
      root.classList.add("still");
    }
    var data = JSON.parse(root.querySelector("script[type='application/json']").textContent);
    var library = document.getElementById("vessel-library");
    if (!library) return without("The library that draws in space was not installed when this page was made (Debian package libjs-three).");
    if (typeof DecompressionStream === "undefined") return without("This browser is too old to unpack the scene.");
    var drawer = drawerName();
    if (drawer === null) return without("This browser does not draw in space (it lacks WebGL).");
    vesselData.text(library.textContent.trim()).then(function (program) {
      if (!window.THREE) element(document.head, "script", {}, program);
      root.vessel = new Scene(root, data, !/swiftshader|llvmpipe|software/i.test(drawer));
      Array.from(document.querySelectorAll("[data-look]")).forEach(function (button) {
        button.addEventListener("click", function () { root.vessel.turnTo(JSON.parse(button.dataset.look)); });
        button.disabled = false;
      });
      return root.vessel.ready;
    }).then(function () {
      document.body.classList.add("turns");
      performance.mark("vessel");
      root.dataset.ready = "yes";
    });
  }

  Array.from(document.querySelectorAll(".vessel")).forEach(begin);
})();
