#include "case/case_hash.hpp"

#include <fmt/format.h>

#include "base/hash.hpp"

namespace fsi {

namespace {

/// Collects `key = value` lines.
class Dump {
 public:
  void section(const std::string& name) { prefix_ = name + "."; }
  template <class Value>
  void add(const char* key, const Value& value) {
    text_ += fmt::format("{}{} = {}\n", prefix_, key, value);
  }
  void add_table(const std::string& name, const PressureTable& table) {
    section(name);
    for (const auto& [time, pressure] : table.points) {
      add("time", time);
      add("pressure", pressure);
    }
  }
  void add_point(const char* key, const Point& point) {
    for (const double coordinate : point) add(key, coordinate);
  }
  const std::string& text() const { return text_; }

 private:
  std::string prefix_, text_;
};

}  // namespace

std::string canonical_dump(const Case& scene) {
  Dump dump;
  dump.add("element", scene.element);
  if (scene.fluid) {
    dump.section("fluid");
    dump.add("density", scene.fluid->density);
    dump.add("viscosity", scene.fluid->viscosity);
    dump.add("grad_div", scene.fluid->grad_div);
  }
  if (scene.structure) {
    dump.section("structure");
    dump.add("density", scene.structure->density);
    dump.add("bulk_modulus", scene.structure->bulk_modulus);
    dump.add("stabilisation", scene.structure->stabilisation);
    dump.add_point("axis_origin", scene.structure->axis_origin);
    dump.add_point("axis_direction", scene.structure->axis_direction);
    for (const auto& [name, material] : scene.structure->layers) {
      dump.section("structure.layers." + name);
      dump.add("material", material.material);
      dump.add("c10", material.c10);
      dump.add("c01", material.c01);
      dump.add("k1", material.k1);
      dump.add("k2", material.k2);
      dump.add("alpha", material.alpha);
      dump.add("fibre_scale", material.fibre_scale);
    }
  }
  if (scene.inlet) dump.add_table("inlet", *scene.inlet);
  if (scene.load) dump.add_table("load", *scene.load);
  if (scene.time) {
    dump.section("time");
    dump.add("step", scene.time->step);
    dump.add("newmark_beta", scene.time->newmark_beta);
    dump.add("newmark_gamma", scene.time->newmark_gamma);
  }
  if (scene.static_load) {
    dump.section("static");
    dump.add("load_steps", scene.static_load->load_steps);
  }
  return dump.text();
}

std::string hash_of_case(const Case& scene) {
  Fnv1a hash;
  hash.add(canonical_dump(scene));
  return hash.hex();
}

}  // namespace fsi
