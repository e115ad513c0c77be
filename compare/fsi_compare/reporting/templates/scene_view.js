// Draws the parts of the shown runs beside each other by three.js, with one camera for all: parallel projection, so that lengths can
// be compared. Turns about the middle (drag), shifts (right button, or Shift), zooms (wheel), finds the point that is clicked.
var vesselView = (function () {
  "use strict";

  var GREY = [0.8, 0.8, 0.8], FAR = 1e30, GLASS = 0.22;
  var COARSE = 0.5; // pixels of the canvas for one of the page while it moves, where the processor draws
  var REST = 150; // ms without movement, after which it is drawn finely
  // Light is found at the vertices, and only what is cut open may leave out pixels: both spare a processor that draws most of its work.
  var VERTEX = [
    "attribute float value; uniform float lit; varying float shown; varying float light;",
    "#ifdef CUT", "attribute vec3 reference; varying vec3 original;", "#endif",
    "void main() {",
    "  shown = value;",
    "  light = lit > 0.5 ? 0.58 + 0.42 * abs(normalize(normalMatrix * normal).z) : 1.0;",
    "#ifdef CUT", "  original = reference;", "#endif",
    "  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);",
    "}"].join("\n");
  var FRAGMENT = [
    "uniform sampler2D colours; uniform float low, high, known, opacity; uniform vec3 grey; varying float shown; varying float light;",
    "#ifdef CUT", "uniform vec4 plane; varying vec3 original;", "#endif",
    "void main() {",
    "#ifdef CUT", "  if (dot(plane.xyz, original) > plane.w) discard;", "#endif",
    "  float place = clamp((shown - low) / (high - low), 0.0, 1.0);",
    "  vec3 colour = known > 0.5 && abs(shown) < 1e29",
    "    ? texture2D(colours, vec2((place * 255.0 + 0.5) / 256.0, 0.5)).rgb : grey;",
    "  gl_FragColor = vec4(colour * light, opacity);",
    "}"].join("\n");

  function View(canvas, box, smooth) {
    this.canvas = canvas;
    this.smooth = smooth;
    this.renderer = new THREE.WebGLRenderer({ canvas: canvas, antialias: smooth });
    this.renderer.setScissorTest(true);
    this.renderer.autoClear = false;
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -10, 10);
    this.low = new THREE.Vector3().fromArray(box.low);
    this.high = new THREE.Vector3().fromArray(box.high);
    this.size = this.high.distanceTo(this.low);
    this.target = this.low.clone().add(this.high).multiplyScalar(0.5);
    this.zoom = 1;
    this.panes = []; // [{scene, left, top, width, height}], of the canvas, in pixels of the page
    this.marker = new THREE.Mesh(new THREE.SphereBufferGeometry(0.008 * this.size, 12, 8),
      new THREE.MeshBasicMaterial({ color: 0xd81b60, depthTest: false }));
    this.marker.renderOrder = 9;
    this.listen();
  }

  // A drawing of a part: {mesh, part, made}.
  View.prototype.drawing = function (part, made, reference) {
    var geometry = new THREE.BufferGeometry(), n = made.source.length;
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * n), 3));
    geometry.setAttribute("reference", new THREE.BufferAttribute(reference, 3));
    geometry.setAttribute("value", new THREE.BufferAttribute(new Float32Array(n), 1));
    geometry.setIndex(new THREE.BufferAttribute(made.index, 1));
    var flat = part.spec.group === "section" || part.spec.group === "cut";
    var material = new THREE.ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, side: THREE.DoubleSide,
      uniforms: {
        colours: { value: null }, low: { value: 0 }, high: { value: 1 }, known: { value: 0 }, opacity: { value: 1 },
        lit: { value: flat || made.shift ? 0 : 1 }, grey: { value: new THREE.Vector3().fromArray(GREY) },
        plane: { value: new THREE.Vector4() }, cutting: { value: 0 }
      }
    });
    var mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    if (flat && !made.turn) mesh.renderOrder = -1;
    return { mesh: mesh, part: part, made: made };
  };

  View.prototype.moved = function (drawing, at, factor) {
    var geometry = drawing.mesh.geometry;
    vesselGeometry.move(drawing.part, drawing.made, at, factor, geometry.attributes.position.array);
    geometry.attributes.position.needsUpdate = true;
    if (drawing.mesh.material.uniforms.lit.value) geometry.computeVertexNormals();
    else if (!geometry.attributes.normal) geometry.setAttribute("normal", geometry.attributes.reference);
    geometry.boundingSphere = null;
  };

  // `value(node)`: null for a part without the quantity; `scale`: {low, high, texture}.
  View.prototype.coloured = function (drawing, value, scale) {
    var uniforms = drawing.mesh.material.uniforms, attribute = drawing.mesh.geometry.attributes.value;
    uniforms.known.value = value ? 1 : 0;
    var glass = !value && drawing.part.spec.group === "wall";
    uniforms.opacity.value = glass ? GLASS : 1;
    drawing.mesh.material.transparent = glass;
    drawing.mesh.material.depthWrite = !glass;
    if (!value) return;
    uniforms.colours.value = scale.texture;
    uniforms.low.value = scale.low;
    uniforms.high.value = scale.high;
    var source = drawing.made.source, n = drawing.part.nodes.length, of = new Float32Array(n);
    for (var node = 0; node < n; ++node) of[node] = value(node);
    for (var v = 0; v < source.length; ++v) attribute.array[v] = isNaN(of[source[v]]) ? FAR : of[source[v]];
    attribute.needsUpdate = true;
  };

  View.prototype.cut = function (drawing, plane) {
    var uniforms = drawing.mesh.material.uniforms, group = drawing.part.spec.group;
    var cutting = plane && group !== "cut" ? 1 : 0, material = drawing.mesh.material;
    if (cutting !== uniforms.cutting.value) {
      material.defines = cutting ? { CUT: 1 } : {};
      material.needsUpdate = true;
    }
    uniforms.cutting.value = cutting;
    if (plane) uniforms.plane.value.fromArray(plane);
  };

  View.prototype.look = function (towards, up, target) {
    this.towards = new THREE.Vector3().fromArray(towards).normalize();
    this.up = new THREE.Vector3().fromArray(up);
    this.target = target ? new THREE.Vector3().fromArray(target) : this.low.clone().add(this.high).multiplyScalar(0.5);
    this.zoom = 1;
    this.place();
    this.fit();
  };

  // How much is seen across: all corners of the box, unless the reader has zoomed.
  View.prototype.fit = function () {
    var right = new THREE.Vector3().crossVectors(this.up, this.towards).normalize();
    var above = new THREE.Vector3().crossVectors(this.towards, right), wide = 0, high = 0;
    for (var corner = 0; corner < 8; ++corner) {
      var at = new THREE.Vector3(corner & 1 ? this.low.x : this.high.x, corner & 2 ? this.low.y : this.high.y,
        corner & 4 ? this.low.z : this.high.z).sub(this.target);
      wide = Math.max(wide, Math.abs(at.dot(right)));
      high = Math.max(high, Math.abs(at.dot(above)));
    }
    this.half = [1.08 * wide, 1.08 * high];
    this.render();
  };

  View.prototype.place = function () {
    this.camera.up.copy(this.up);
    this.camera.position.copy(this.target).addScaledVector(this.towards, this.size);
    this.camera.near = -4 * this.size;
    this.camera.far = 6 * this.size;
    this.camera.lookAt(this.target);
    this.camera.updateMatrixWorld(true);
  };

  View.prototype.shape = function (pane) {
    var ratio = pane.width / pane.height, high = Math.max(this.half[1], this.half[0] / ratio) / this.zoom;
    this.camera.top = high;
    this.camera.bottom = -high;
    this.camera.left = -high * ratio;
    this.camera.right = high * ratio;
    this.camera.updateProjectionMatrix();
    return 2 * high / pane.height; // mm of a pixel
  };

  // Of a picture that moves: coarsely where the processor draws, and finely when it rests.
  View.prototype.renderMoving = function () {
    var self = this;
    clearTimeout(this.resting);
    if (!this.smooth) {
      this.coarse = true;
      this.resting = setTimeout(function () { self.coarse = false; self.render(); }, REST);
    }
    this.render();
  };

  View.prototype.render = function () {
    var self = this;
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(function () { self.waiting = false; self.draw(); });
  };

  View.prototype.draw = function () {
    var width = this.canvas.clientWidth, height = this.canvas.clientHeight, self = this;
    if (!width || !this.half) return;
    var ratio = this.coarse ? COARSE : this.smooth ? Math.min(window.devicePixelRatio || 1, 2) : 1;
    if (this.drawnAt !== [width, height, ratio].join()) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
      this.drawnAt = [width, height, ratio].join();
    }
    this.renderer.setClearColor(0xffffff, 1);
    this.renderer.setScissor(0, 0, width, height);
    this.renderer.clear();
    this.panes.forEach(function (pane) {
      self.shape(pane);
      var bottom = height - pane.top - pane.height;
      self.renderer.setViewport(pane.left, bottom, pane.width, pane.height);
      self.renderer.setScissor(pane.left, bottom, pane.width, pane.height);
      self.renderer.render(pane.scene, self.camera);
    });
    if (this.drawn) this.drawn();
  };

  View.prototype.paneAt = function (x, y) {
    return this.panes.filter(function (pane) {
      return x >= pane.left && x < pane.left + pane.width && y >= pane.top && y < pane.top + pane.height;
    })[0];
  };

  // {drawing, vertex, pane} under a place of the canvas, cut surfaces left out; null: nothing there.
  View.prototype.found = function (x, y) {
    var pane = this.paneAt(x, y);
    if (!pane) return null;
    this.shape(pane);
    var ray = new THREE.Raycaster();
    ray.setFromCamera({ x: 2 * (x - pane.left) / pane.width - 1, y: 1 - 2 * (y - pane.top) / pane.height }, this.camera);
    var hits = [];
    pane.drawings.forEach(function (drawing) {
      if (!drawing.mesh.visible || drawing.mesh.material.transparent) return;
      ray.intersectObject(drawing.mesh).forEach(function (hit) { hits.push({ hit: hit, drawing: drawing }); });
    });
    hits.sort(function (a, b) { return a.hit.distance - b.hit.distance; });
    for (var i = 0; i < hits.length; ++i) {
      var face = hits[i].hit.face, geometry = hits[i].drawing.mesh.geometry, uniforms = hits[i].drawing.mesh.material.uniforms;
      var nearest = [face.a, face.b, face.c].map(function (v) {
        return { v: v, far: new THREE.Vector3().fromBufferAttribute(geometry.attributes.position, v).distanceTo(hits[i].hit.point) };
      }).sort(function (a, b) { return a.far - b.far; })[0].v;
      var original = new THREE.Vector3().fromBufferAttribute(geometry.attributes.reference, nearest), p = uniforms.plane.value;
      if (uniforms.cutting.value && original.x * p.x + original.y * p.y + original.z * p.z > p.w) continue;
      return { drawing: hits[i].drawing, vertex: nearest, pane: pane };
    }
    return null;
  };

  View.prototype.turn = function (dx, dy) {
    var eye = this.towards, right = new THREE.Vector3().crossVectors(this.up, eye).normalize();
    var up = new THREE.Vector3().crossVectors(eye, right);
    var turn = new THREE.Quaternion().setFromAxisAngle(up, -dx)
      .multiply(new THREE.Quaternion().setFromAxisAngle(right, -dy));
    this.towards = eye.clone().applyQuaternion(turn).normalize();
    this.up = up.applyQuaternion(turn);
    this.place();
    this.renderMoving();
  };

  View.prototype.shift = function (dx, dy) {
    if (!this.panes.length) return;
    var mm = this.shape(this.panes[0]), right = new THREE.Vector3().crossVectors(this.up, this.towards).normalize();
    this.target.addScaledVector(right, -mm * dx).addScaledVector(new THREE.Vector3().crossVectors(this.towards, right), mm * dy);
    this.place();
    this.renderMoving();
  };

  View.prototype.closer = function (factor) {
    this.zoom = Math.min(200, Math.max(0.2, this.zoom * factor));
    this.renderMoving();
  };

  View.prototype.listen = function () {
    var self = this, canvas = this.canvas, last = null, went = 0;
    canvas.addEventListener("pointerdown", function (event) {
      last = [event.clientX, event.clientY];
      went = 0;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", function (event) {
      if (!last) return;
      var dx = event.clientX - last[0], dy = event.clientY - last[1];
      went += Math.abs(dx) + Math.abs(dy);
      last = [event.clientX, event.clientY];
      if (event.buttons & 6 || event.shiftKey) self.shift(dx, dy);
      else self.turn(0.008 * dx, 0.008 * dy);
    });
    canvas.addEventListener("pointerup", function (event) {
      var box = canvas.getBoundingClientRect();
      if (last && went < 4 && event.button === 0 && self.picked)
        self.picked(self.found(event.clientX - box.left, event.clientY - box.top));
      last = null;
    });
    canvas.addEventListener("pointercancel", function () { last = null; });
    canvas.addEventListener("contextmenu", function (event) { event.preventDefault(); });
    canvas.addEventListener("wheel", function (event) {
      event.preventDefault();
      self.closer(Math.exp(-0.0015 * event.deltaY));
    }, { passive: false });
    canvas.addEventListener("keydown", function (event) {
      var turns = { ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, -0.15], ArrowDown: [0, 0.15] }[event.key];
      if (turns) self.turn(turns[0], turns[1]);
      else if (event.key === "+") self.closer(1.2);
      else if (event.key === "-") self.closer(1 / 1.2);
      else return;
      event.preventDefault();
    });
  };

  // A table of 256 colours as a texture.
  function texture(bytes) {
    var made = new THREE.DataTexture(bytes, 256, 1, THREE.RGBFormat);
    made.magFilter = made.minFilter = THREE.LinearFilter;
    made.unpackAlignment = 1;
    made.needsUpdate = true;
    return made;
  }

  return { View: View, texture: texture };
})();
