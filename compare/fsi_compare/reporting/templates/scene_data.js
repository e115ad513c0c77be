// Reads what scene_packing.py has packed: 16-bit numbers of many times, stored as changes from one time to the next, their
// bytes apart, deflated, in base64. Everything is unpacked when it is first shown.
var vesselData = (function () {
  "use strict";

  var NONE = 65535;

  function plain(text) {
    var binary = atob(text), bytes = new Uint8Array(binary.length);
    for (var i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
  }

  function inflated(text) {
    var stream = new Blob([plain(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Response(stream).arrayBuffer().then(function (buffer) { return new Uint8Array(buffer); });
  }

  // {values: Float32Array (rows * width), width, step}
  function numbers(packed) {
    return inflated(packed.data).then(function (bytes) {
      var count = bytes.length / 2, width = packed.rows ? count / packed.rows : 0, values = new Float32Array(count);
      var row = new Uint16Array(width);
      for (var i = 0; i < count; ++i) {
        var column = i % width, n = row[column] += bytes[i] + 256 * bytes[count + i];
        n &= 65535;
        values[i] = n === NONE ? NaN : packed.low + packed.step * n;
      }
      return { values: values, width: width, step: packed.step };
    });
  }

  function counts(packed) {
    return inflated(packed.data).then(function (bytes) {
      var n = packed.count, found = new Uint32Array(n), last = 0;
      for (var i = 0; i < n; ++i) {
        last = (last + (bytes[i] | bytes[n + i] << 8 | bytes[2 * n + i] << 16 | bytes[3 * n + i] << 24)) | 0;
        found[i] = last;
      }
      return found;
    });
  }

  function text(packed) {
    return inflated(packed).then(function (bytes) { return new TextDecoder().decode(bytes); });
  }

  // [i, weight]: a time lies between levels i and i + 1.
  function place(times, t) {
    var last = times.length - 1, i = 0;
    if (last < 1 || t <= times[0]) return [0, 0];
    if (t >= times[last]) return [last - 1, 1];
    while (times[i + 1] < t) ++i;
    var weight = (t - times[i]) / (times[i + 1] - times[i]);
    return weight > 1 - 1e-6 ? [i + 1 > last - 1 ? last - 1 : i + 1, i + 1 > last - 1 ? 1 : 0] : [i, weight < 1e-6 ? 0 : weight];
  }

  // The fields of one part of a run. `base`: the same part of the first run, where this one holds differences from it.
  function Part(spec, times, base) {
    this.spec = spec;
    this.times = times;
    this.base = base;
    this.loaded = {};
  }

  Part.prototype.has = function (field) { return field in this.spec.fields; };

  Part.prototype.mesh = function () {
    var self = this, spec = this.spec;
    this.meshLoaded = this.meshLoaded || Promise.all([numbers(spec.points), counts(spec.cells), counts(spec.nodes)]).then(
      function (found) {
        self.points = found[0].values;
        self.cells = found[1];
        self.nodes = found[2];
      });
    return this.meshLoaded;
  };

  Part.prototype.load = function (field) {
    var self = this;
    if (!this.has(field) || this.loaded[field]) return Promise.resolve();
    var all = [numbers(this.spec.fields[field])];
    if (this.base) all.push(this.base.load(field));
    return Promise.all(all).then(function (found) { self.loaded[field] = found[0]; });
  };

  Part.prototype.components = function (field) { return this.loaded[field].width / this.nodes.length; };

  // One component of a field at a node and a time; of the difference from the first run with `apart`.
  Part.prototype.component = function (field, node, k, components, at, apart) {
    var data = this.loaded[field], i = at[0] * data.width + node * components + k, value = data.values[i];
    if (at[1]) value = (1 - at[1]) * value + at[1] * data.values[i + data.width];
    return this.base && !apart ? value + this.base.component(field, node, k, components, at) : value;
  };

  // A quantity {field, part} at a node: magnitude of a vector where no part is named.
  Part.prototype.value = function (quantity, node, at) {
    var components = this.components(quantity.field);
    if (quantity.part >= 0 && components > 1) return this.component(quantity.field, node, quantity.part, components, at);
    if (components === 1) return this.component(quantity.field, node, 0, 1, at);
    var sum = 0;
    for (var k = 0; k < components; ++k) {
      var c = this.component(quantity.field, node, k, components, at);
      sum += c * c;
    }
    return Math.sqrt(sum);
  };

  // Of this run less the first one. Magnitudes by (|b| - |a|) = (b - a).(b + a) / (|b| + |a|), which loses no digits.
  Part.prototype.difference = function (quantity, node, at) {
    var components = this.components(quantity.field), field = quantity.field;
    if (quantity.part >= 0 && components > 1) return this.component(field, node, quantity.part, components, at, true);
    if (components === 1) return this.component(field, node, 0, 1, at, true);
    var product = 0, own = 0, first = 0;
    for (var k = 0; k < components; ++k) {
      var d = this.component(field, node, k, components, at, true), a = this.base.component(field, node, k, components, at);
      product += d * (d + 2 * a);
      own += (a + d) * (a + d);
      first += a * a;
    }
    return own + first > 0 ? product / (Math.sqrt(own) + Math.sqrt(first)) : 0;
  };

  return { Part: Part, place: place, plain: plain, text: text };
})();
