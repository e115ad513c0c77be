#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "math/tensor.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/build_scene.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// The force of the fluid on a surface; in plane scenes per mm of thickness.
struct SurfaceForce {
  double area = 0;          ///< mm^2, in the current configuration
  Vec3<double> force{};     ///< mN = kPa mm^2, along the axes of space
  Vec3<double> pressure{};  ///< mN, the part of the pressure: integral of p n, n outward from the fluid
};

/// Forces of the fluid on named surfaces at a balance, from the discrete equations: minus the sum of the residual's
/// momentum rows over the surface's nodes, the force that holds the velocity there, not an integral of differentiated
/// velocities. So forces balance pressures, flows of momentum and inertia to the tolerance of the solver
/// [Gresho1987, John2001] (docs/theory.md, section 11a.4). On openings with free velocities, which nothing holds, they
/// are integrals of p n - mu (grad u + grad u^T) n with recovered gradients.
template <int n>
class SurfaceForces {
 public:
  virtual ~SurfaceForces() = default;
  /// Names of the surfaces, in the order of at().
  virtual const std::vector<std::string>& names() const = 0;
  /// Collective over the processes that share the fluid; all get the same.
  virtual std::vector<SurfaceForce> at(const Balance& balance) const = 0;
};

/// Of output.surfaces and output.forces; null when the case names none.
/// \param mesh   that the scene was built on
/// \param scene  must outlive this
/// \param whole  whole parts of a mesh that processes share; empty: the scene has them
/// \throws InputError naming the key for a surface that does not bound the fluid, for a set that joins openings with
/// free velocities to other surfaces, and in a scene without fluid
template <class Element>
std::unique_ptr<SurfaceForces<Element::components>> make_surface_forces(const Case& setup, const MeshOf<Element>& mesh,
                                                                        const Scene<Element::components>& scene,
                                                                        const WholeParts<Element>& whole = {});

}  // namespace fsi
