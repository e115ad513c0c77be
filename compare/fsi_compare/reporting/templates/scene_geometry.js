// Triangles of a part as they are drawn. Triangles in space come as they are. Edges of a two-dimensional mesh become a thin ribbon
// in the plane, or the surface that they sweep around the axis; the section itself stands at both ends of the sweep.
var vesselGeometry = (function () {
  "use strict";

  var RIBBON = 0.006; // of the scene's size

  function copies(part, cells, angles, corners) {
    var n = part.nodes.length, source = [], turn = [], index = [];
    angles.forEach(function (angle, i) {
      for (var node = 0; node < n; ++node) { source.push(node); turn.push(angle); }
      if (corners === 3) for (var c = 0; c < cells.length; ++c) index.push(cells[c] + i * n);
      else if (i) for (var e = 0; e < cells.length; e += 2) {
        var a = cells[e] + (i - 1) * n, b = cells[e + 1] + (i - 1) * n;
        index.push(a, b, b + n, a, b + n, a + n);
      }
    });
    return { source: Uint32Array.from(source), turn: Float32Array.from(turn), index: Uint32Array.from(index) };
  }

  function ribbon(part, size, flat) {
    var n = part.nodes.length, cells = part.cells, across = new Float32Array(3 * n), p = part.points, index = [], source = [];
    for (var e = 0; e < cells.length; e += 2) {
      var a = cells[e], b = cells[e + 1], dx = p[3 * b] - p[3 * a], dy = p[3 * b + flat] - p[3 * a + flat];
      var length = Math.hypot(dx, dy) || 1;
      [a, b].forEach(function (node) { across[3 * node] += dy / length; across[3 * node + flat] -= dx / length; });
      index.push(a, b, b + n, a, b + n, a + n);
    }
    var shift = new Float32Array(6 * n);
    for (var node = 0; node < 2 * n; ++node) {
      var of = node % n, norm = Math.hypot(across[3 * of], across[3 * of + 1], across[3 * of + 2]) || 1;
      source.push(of);
      for (var k = 0; k < 3; ++k) shift[3 * node + k] = (node < n ? -0.5 : 0.5) * RIBBON * size * across[3 * of + k] / norm;
    }
    return { source: Uint32Array.from(source), turn: null, shift: shift, index: Uint32Array.from(index) };
  }

  // `angles`: of the sweep, null where the scene stays in its plane, which x and coordinate `flat` span. null: nothing is drawn.
  function shape(part, angles, size, flat) {
    var corners = part.spec.corners, group = part.spec.group;
    if (corners === 2) {
      if (!angles) return part.spec.name === "lumen" ? ribbon(part, size, flat) : null;
      return copies(part, part.cells, angles, 2);
    }
    if (angles) return copies(part, part.cells, [angles[0], angles[angles.length - 1]], 3);
    return { source: Uint32Array.from(part.nodes, function (_, i) { return i; }), turn: null, index: part.cells };
  }

  // Positions of the vertices, with `factor` times the displacement at a time, into `to`.
  function move(part, made, at, factor, to) {
    var moves = factor !== 0 && part.loaded.displacement, p = part.points;
    for (var v = 0; v < made.source.length; ++v) {
      var node = made.source[v], x = p[3 * node], y = p[3 * node + 1], z = p[3 * node + 2];
      if (moves) {
        x += factor * part.component("displacement", node, 0, 3, at);
        y += factor * part.component("displacement", node, 1, 3, at);
        z += factor * part.component("displacement", node, 2, 3, at);
      }
      if (made.turn) {
        var c = Math.cos(made.turn[v]), s = Math.sin(made.turn[v]), r = x;
        x = c * r - s * y;
        y = s * r + c * y;
      }
      to[3 * v] = x + (made.shift ? made.shift[3 * v] : 0);
      to[3 * v + 1] = y + (made.shift ? made.shift[3 * v + 1] : 0);
      to[3 * v + 2] = z + (made.shift ? made.shift[3 * v + 2] : 0);
    }
  }

  return { shape: shape, move: move };
})();
