#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "fem/element_packs.hpp"
#include "fluid/backflow.hpp"
#include "fluid/fluid.hpp"
#include "fluid/pressure_projection.hpp"

namespace fsi {

/// The fluid discretised by an element, on its part of the mesh.
template <class Element>
class FluidProblem : public Fluid<Element::components> {
 public:
  static constexpr int dim = Element::dim, n = Element::components;
  using Part = Submesh<Element::dim, Element::order>;

  /// \param open      surfaces in the part's node numbers
  /// \param mirrored  components that vanish in a mirror: normal to planes of symmetry, radial on an axis
  FluidProblem(Part part, const AleFluid& form, std::vector<OpenBoundary<n>> open,
               VanishingComponents<n> mirrored = {});

  const Part& part() const { return part_; }
  const ElementPacks<Element>& packs() const { return packs_; }

  const PartNodes& nodes() const override { return part_; }
  const FunctionSpace<n>& space() const override { return space_; }
  const AleFluid& form() const override { return form_; }
  void set_wave_speed(double speed) override { form_.wave_speed = speed; }
  void stabilise_backflow(std::size_t open, double coefficient) override;
  bool stabilises_backflow() const override { return !backflow_.empty() || !moving_backflow_.empty(); }
  const std::vector<OpenBoundary<n>>& open_boundaries() const override { return open_; }

  AssemblyResult assemble(const FluidInput& in, const std::vector<double>& pressures, std::vector<double>& residual,
                          FluidJacobian<n>* jacobian = nullptr) override;
  double kinetic_energy(const std::vector<double>& mesh, const std::vector<double>& flow) const override;
  FluidWork work(const FluidStep& step) const override;
  FluidInput projected(const FluidInput& in) override;
  double power_at(const std::vector<int>& nodes, const FluidInput& in, const std::vector<double>& pressures) override;

  std::size_t element_count() const override { return part_.cells.size(); }
  double volume() const override { return volume_; }
  std::vector<int> cell_vertices() const override;

 private:
  /// Adds what the openings do to a residual and, if asked, its derivatives.
  void add_openings(const FluidInput& in, const std::vector<double>& pressures, std::vector<double>& residual,
                    FluidJacobian<n>* jacobian);

  Part part_;
  AleFluid form_;
  FunctionSpace<n> space_;
  ElementPacks<Element> packs_;
  std::optional<ElementPacks<Element>> packs_at_;  ///< the elements at the nodes of power_at()
  double volume_ = 0;                              ///< of all processes' shares
  VanishingComponents<n> mirrored_;
  PressureProjection<Element> projection_;
  std::vector<double> rows_;  ///< storage of power_at()
  std::vector<OpenBoundary<n>> open_;
  std::map<std::size_t, BackflowFacets<Element>> backflow_;  ///< by place among the open boundaries that stay
  std::map<std::size_t, double> moving_backflow_;            ///< beta, by place among those that move
};

}  // namespace fsi
