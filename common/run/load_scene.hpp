#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "derived/derived_quantities.hpp"
#include "io/checkpoint.hpp"
#include "io/fields_writer.hpp"
#include "mesh/wall_faces.hpp"
#include "observers/grid_share.hpp"
#include "observers/observation.hpp"
#include "run/plausibility.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// What a run says of its mesh.
struct MeshFacts {
  std::string name;  ///< its file, or "level coarse"
  std::string hash;  ///< tells whether a checkpoint belongs to it
  std::size_t nodes = 0, cells = 0;
  const char* cell = "";              ///< "tetrahedra", "triangles"
  std::vector<std::string> surfaces;  ///< names of its groups of facets that are not empty
  std::vector<ThicknessRange> wall;   ///< thickness of the wall's layers and of all of it; empty: the scene has none
};

/// A case on its mesh. Only what stands here knows the element; it is chosen once, by the case.
template <int n>
struct LoadedScene {
  MeshFacts mesh;
  std::unique_ptr<Scene<n>> scene;
  DerivedNumbers numbers;  ///< that tell whether units are right; their warnings are among the scene's notices
  ObservationPoints points;
  DerivedQuantities<n> derived;         ///< refers to the scene
  std::vector<FieldGrid> grids;         ///< of fluid and wall here, where they are, without fields
  std::vector<GridShare> grid_shares;   ///< of each, where processes share the scene out
  std::optional<Checkpoint> prestress;  ///< what a run keeps of its wall's, where it has one
};

/// What is called while a scene is loaded, and what is left out. An empty function is not called.
struct LoadingScene {
  std::function<void(std::size_t cells)> mesh_known;             ///< before the scene is built
  std::function<void(const std::string& warning)> mesh_strange;  ///< before anything is computed on it
  std::function<void(const std::string& text)> prestress_goes_on;
  bool find_prestress = true;  ///< false: where it would have to be found, the wall stays without
};

/// Reads or makes the mesh of a case, checks it and builds the scene on it. To be called by all processes: each gets
/// its share of the scene, and the whole mesh is freed.
/// \tparam n  2 for plane and axisymmetric scenes, 3 otherwise: components_of(setup)
/// \throws InputError where case, mesh and files do not go together; ConvergenceError where a prestress is not found
template <int n>
LoadedScene<n> load_scene(const Case& setup, const LoadingScene& loading = {});
template <>
LoadedScene<2> load_scene(const Case& setup, const LoadingScene& loading);
template <>
LoadedScene<3> load_scene(const Case& setup, const LoadingScene& loading);

/// Components of the vectors of a case.
inline int components_of(const Case& setup) {
  return setup.geometry == Geometry::three_dimensional ? 3 : 2;
}

}  // namespace fsi
