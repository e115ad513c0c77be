// vessel_mesh bent|bifurcation FILE [ORDER]: meshes that a user would make with gmsh's solid modeller, for the tests.
//
// bent: a quarter of a torus, axis of radius 5 mm from (0, 0, 0) along z to (5, 0, 5) along x; lumen of radius 1 mm, wall
// of two layers, `inside` and `outside`, 0.3 mm each. bifurcation: a trunk of radius 1 mm from (0, 0, 0) along z, two
// branches of radius 0.7 mm from (0, 0, 3.5) to (+-2.5, 0, 6); wall `vessel` of 0.5 mm; the branches' ends are `outlet`,
// and one by one `left` (x < 0) and `right`.

#include <gmsh.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace occ = gmsh::model::occ;

constexpr double pi = 3.14159265358979323846;

void group(int dimension, const std::vector<int>& entities, const char* name) {
  if (entities.empty()) throw std::runtime_error(std::string("nothing is ") + name);
  gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, entities), name);
}

struct Plane {
  double origin[3], normal[3];
};

/// Faces of volumes that lie in a plane, and nowhere else than within `reach` of its origin.
std::vector<int> faces_in(const Plane& plane, const std::vector<int>& volumes, double reach = 3) {
  std::vector<int> found;
  for (const int volume : volumes) {
    gmsh::vectorpair faces;
    gmsh::model::getBoundary({{3, volume}}, faces, false, false);
    for (const auto& [dimension, face] : faces) {
      std::vector<double> low, high, normals;
      gmsh::model::getParametrizationBounds(2, face, low, high);
      const std::vector<double> middle{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
      std::string type;
      gmsh::model::getType(2, face, type);
      double x, y, z;
      occ::getCenterOfMass(2, face, x, y, z);
      gmsh::model::getNormal(face, middle, normals);
      const double at[3] = {x, y, z};
      double off = 0, along = 0, away = 0;
      for (int i = 0; i < 3; ++i) {
        off += (at[i] - plane.origin[i]) * plane.normal[i];
        along += normals[i] * plane.normal[i];
        away += (at[i] - plane.origin[i]) * (at[i] - plane.origin[i]);
      }
      if (type == "Plane" && std::abs(off) < 1e-6 && std::abs(std::abs(along) - 1) < 1e-6 && away < reach * reach)
        found.push_back(face);
    }
  }
  return found;
}

std::vector<int> joined(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void bent() {
  constexpr double radii[3] = {1, 1.3, 1.6}, bend = 5;
  gmsh::vectorpair disks, pieces;
  for (const double radius : radii) disks.emplace_back(2, occ::addDisk(0, 0, 0, radius, radius));
  std::vector<gmsh::vectorpair> origin;
  occ::fragment({disks[0]}, {disks[1], disks[2]}, pieces, origin);
  gmsh::vectorpair swept;
  occ::revolve(pieces, bend, 0, 0, 0, 1, 0, pi / 2, swept);
  occ::synchronize();
  std::map<double, int> by_size;
  for (const auto& [dimension, entity] : swept) {
    double mass = 0;
    if (dimension == 3) occ::getMass(3, entity, mass);
    if (dimension == 3) by_size[mass] = entity;
  }
  std::vector<int> volumes;  // by size: inside, outside, fluid
  for (const auto& [mass, entity] : by_size) volumes.push_back(entity);
  const int inside = volumes.at(0), outside = volumes.at(1), fluid = volumes.at(2);
  group(3, {fluid}, "fluid");
  group(3, {inside}, "inside");
  group(3, {outside}, "outside");
  const Plane start{{0, 0, 0}, {0, 0, 1}}, end{{bend, 0, bend}, {1, 0, 0}};
  group(2, faces_in(start, {fluid}), "inlet");
  group(2, faces_in(end, {fluid}), "outlet");
  group(2, joined(faces_in(start, {inside, outside}), faces_in(end, {inside, outside})), "wall_ends");
}

void bifurcation() {
  constexpr double trunk = 3.5, branch = 2.5;
  const auto vessel = [](double grown) {
    gmsh::vectorpair whole, parts{{3, occ::addSphere(0, 0, trunk, 1 + grown)}};
    for (const double side : {-1.0, 1.0})
      parts.emplace_back(3, occ::addCylinder(0, 0, trunk, side * branch, 0, branch, 0.7 + grown));
    std::vector<gmsh::vectorpair> origin;
    occ::fuse({{3, occ::addCylinder(0, 0, 0, 0, 0, trunk, 1 + grown)}}, parts, whole, origin);
    return whole;
  };
  const auto outer = vessel(0.5), lumen = vessel(0);
  gmsh::vectorpair pieces;
  std::vector<gmsh::vectorpair> origin;
  occ::fragment(outer, lumen, pieces, origin);
  occ::synchronize();
  const int fluid = origin.back().at(0).second;
  std::vector<int> wall;
  for (const auto& [dimension, entity] : origin.front())
    if (entity != fluid) wall.push_back(entity);
  group(3, {fluid}, "fluid");
  group(3, wall, "vessel");
  const double slope = std::sqrt(0.5);
  const Plane start{{0, 0, 0}, {0, 0, 1}};
  const Plane left{{-branch, 0, trunk + branch}, {-slope, 0, slope}},
      right{{branch, 0, trunk + branch}, {slope, 0, slope}};
  group(2, faces_in(start, {fluid}), "inlet");
  group(2, joined(faces_in(left, {fluid}), faces_in(right, {fluid})), "outlet");
  group(2, faces_in(left, {fluid}), "left");
  group(2, faces_in(right, {fluid}), "right");
  group(2, joined(faces_in(start, wall), joined(faces_in(left, wall), faces_in(right, wall))), "wall_ends");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 1;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  int code = 0;
  try {
    const std::string kind = argv[1];
    kind == "bent" ? bent() : bifurcation();
    gmsh::option::setNumber("Mesh.MeshSizeMin", 0.6);
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.6);
    gmsh::model::mesh::generate(3);
    if (argc > 3) gmsh::model::mesh::setOrder(std::stoi(argv[3]));
    gmsh::write(argv[2]);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "vessel_mesh: %s\n", failure.what());
    code = 2;
  }
  gmsh::finalize();
  return code;
}
