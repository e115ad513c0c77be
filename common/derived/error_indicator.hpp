#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "case/case.hpp"
#include "parallel/whole_order.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/build_scene.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Errors of a level's fields in the cells of a medium: a number per cell here.
struct CellErrors {
  std::vector<double> vectors;   ///< of the fluid's velocity, mm/ms, or of the wall's displacement, mm
  std::vector<double> pressure;  ///< kPa
};

/// The same for the gradients, in these units per mm.
struct CellGradientErrors {
  CellErrors errors;
  std::vector<double> measure;  ///< of the cells, mm^3; mm^2 in plane scenes, the ring's volume in bodies of revolution
};

/// An indicator of the error of discretisation in each cell of a medium [Zienkiewicz1987]: the recovered gradient G u_h
/// (derived/gradient_recovery.hpp), interpolated from the nodes by the element's shape functions, against that of the
/// finite-element function (docs/theory.md, section 11a.5),
///   delta = G u_h - grad u_h,     eta_K^2 = 1/|K| int_K |delta (x - x_K)|^2,
/// x_K being the mean of the cell's vertices: the change of the quantity's error across the cell, in the quantity's
/// unit, also in long and thin cells. Gradients are with respect to the mesh as it was read, since it is this mesh that
/// is to be refined. The indicator of a rotated body is the same.
///
/// Functions of fields are collective over the processes that share the medium.
template <int n>
class ErrorIndicator {
 public:
  virtual ~ErrorIndicator() = default;
  /// Number of the medium's cells here.
  virtual std::size_t cells() const = 0;
  /// Order of the cells in the whole medium; null: all are here.
  virtual const WholeOrder* order() const = 0;
  /// eta_K. \param field  (vectors, pressure) of the medium, mixed layout
  virtual CellErrors of_cells(const std::vector<double>& field) const = 0;
  /// Root mean square of delta in each cell, with u_r / r in bodies of revolution.
  virtual CellGradientErrors of_gradients(const std::vector<double>& field) const = 0;
};

/// Of the fluid's velocity and pressure; null where the scene has no fluid.
/// \param mesh   that the scene was built on
/// \param scene  must outlive what is made
/// \param whole  whole parts of a mesh that processes share; empty: the scene has them
template <class Element>
std::unique_ptr<ErrorIndicator<Element::components>> make_fluid_indicator(const MeshOf<Element>& mesh,
                                                                          const Scene<Element::components>& scene,
                                                                          const WholeParts<Element>& whole = {});

/// Of the wall's displacement and pressure, layer by layer, since gradients jump between layers; null without wall.
template <class Element>
std::unique_ptr<ErrorIndicator<Element::components>> make_wall_indicator(const Case& setup, const MeshOf<Element>& mesh,
                                                                         const Scene<Element::components>& scene,
                                                                         const WholeParts<Element>& whole = {});

}  // namespace fsi
