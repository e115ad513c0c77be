#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// [output.lines.NAME]: straight from one point to another, or a tube's centre line from one opening to another.
struct LineRequest {
  Point from{0, 0, 0}, to{0, 0, 0};     ///< mm, where `centerline` is empty
  int points = 181;                     ///< evenly spaced, ends included
  std::vector<std::string> centerline;  ///< empty, or the names of two surfaces

  bool is_centre_line() const { return !centerline.empty(); }
};

/// [output.planes.NAME]
struct PlaneRequest {
  Point origin{0, 0, 0};  ///< mm
  Point normal{0, 0, 1};  ///< need not be normalised; flow along it is positive
};

/// What a case samples at each step, by name (docs/guide/cases.md#samples).
struct SampleRequests {
  std::map<std::string, Point> points;  ///< mm
  std::map<std::string, LineRequest> lines;
  std::map<std::string, PlaneRequest> planes;
};

}  // namespace fsi
