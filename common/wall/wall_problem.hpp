#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "wall/fibre_directions.hpp"
#include "wall/wall.hpp"

namespace fsi {

/// The wall discretised by an element, on its part of the mesh.
template <class Element>
class WallProblem : public Wall<Element::components> {
 public:
  static constexpr int dim = Element::dim, n = Element::components;
  using Part = Submesh<Element::dim, Element::order>;
  using Facets = std::vector<typename Part::Facet>;

  /// To be called by all processes that share the wall.
  /// \param layers       region of the mesh and material of each layer
  /// \param axis         of the fibres' cylindrical frame
  /// \param pressurised  facets in the part's node numbers, normals outward from the wall; may be empty
  /// \param frame        of the fibres in place of the cylindrical one; empty: that
  WallProblem(Part part, const WallConstants& constants, const std::vector<std::pair<int, Material>>& layers,
              const CylinderAxis& axis, Facets pressurised = {}, const FrameFields& frame = {});

  const Part& part() const { return part_; }
  const std::vector<WallLayer<Element>>& layers() const { return layers_; }
  const std::vector<int>& cells_of_layer(std::size_t layer) const { return layer_cells_.at(layer); }
  /// \param viscosity  eta of a layer, kPa ms; 0, as at first: elastic
  void set_viscosity(std::size_t layer, double viscosity);
  /// \param branches    of each layer; none, as at first
  /// \param whole_cell  per cell of the part its number in the whole wall; empty: the part is whole
  void set_branches(const std::vector<std::vector<MaxwellBranch>>& branches,
                    const std::vector<std::int64_t>& whole_cell = {});

  /// The law of a layer at a place: of a cell of the part, at a quadrature point x with this weight, mm and mm^3.
  using LawAt = std::function<LawHere(int cell, const Point& x, double weight)>;
  /// Lets the constants of a layer vary: `at` is called once for each quadrature point of its cells, on the mesh. To be
  /// called before any prestress. With fibres at different angles the layer's material must have been made with one
  /// between 0 and 90 degrees.
  /// \param form_varies  whether a parameter varies that decides the law's form (decides_form())
  void vary(std::size_t layer, bool form_varies, const LawAt& at);
  /// What stands for such a layer where one number must (LayerData): the material at its mean constants.
  void set_mean(std::size_t layer, const Material& material, double viscosity);

  const PartNodes& nodes() const override { return part_; }
  const FunctionSpace<n>& space() const override { return space_; }
  const WallConstants& constants() const override { return constants_; }
  void set_wave_speed(double speed) override { constants_.wave_speed = speed; }
  const std::vector<LayerData>& layer_data() const override { return layer_data_; }
  bool is_viscous() const override;
  const BranchPlaces& branch_places() const override { return places_; }
  std::vector<double> relaxed_branches(const std::vector<double>& wall) const override;
  void settle_branches(const WallInput& in, std::vector<double>& branches) const override;

  AssemblyResult assemble(const WallInput& in, double pressure, const std::vector<double>& solution,
                          std::vector<double>& residual, WallMatrix<n>* jacobian = nullptr) override;
  WallEnergy energy(const std::vector<double>& wall, const std::vector<double>& velocity,
                    const std::vector<double>& balance, const std::vector<double>& branches) const override;
  WallWork work(const WallStep& step) const override;
  std::vector<LayerDeformation> deformation(const std::vector<double>& wall) const override;
  double pressure_work(double pressure, const std::vector<double>& old, const std::vector<double>& now) const override;
  void find_unloaded_shape(bool find) override { finds_unloaded_shape_ = find; }
  void set_prestress(std::vector<double> displacement) override;
  const std::vector<double>& prestress() const override { return prestress_; }

  std::size_t element_count() const override { return part_.cells.size(); }
  std::vector<int> cell_vertices() const override;

 private:
  /// \param at  as in vary()
  void set_constants(std::size_t layer, const VaryingLaw& law, const LawAt& at);
  WallInput prestressed(WallInput in) const;
  AssemblyResult assemble_unloaded_shape(WallInput in, double pressure, std::vector<double>& residual,
                                         WallMatrix<n>* jacobian);

  Part part_;
  WallConstants constants_;
  Facets pressurised_;
  FunctionSpace<n> space_;
  std::vector<WallLayer<Element>> layers_;
  BranchPlaces places_;
  std::vector<LayerData> layer_data_;
  std::vector<std::vector<int>> layer_cells_;  ///< of the part
  bool finds_unloaded_shape_ = false;
  std::vector<double> prestress_;  ///< displacement from the unloaded shape, vector layout, mm; empty: none
};

}  // namespace fsi
