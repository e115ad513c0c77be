#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "fem/assembly_result.hpp"
#include "fem/function_space.hpp"
#include "mesh/submesh.hpp"
#include "wall/supports.hpp"
#include "wall/wall_deformation.hpp"
#include "wall/wall_input.hpp"

namespace fsi {

/// What a layer of the wall is, without its element loops.
struct LayerData {
  Material material;
  std::size_t elements = 0;  ///< of this process's part
  double volume = 0;         ///< of the whole layer at rest, mm^3
  std::vector<int> nodes;    ///< of the wall's part here, ascending
  double springs = 0;        ///< shear moduli of its Maxwell branches together, kPa

  /// Hoop modulus (materials/material.hpp) of a sudden load, kPa: branches, 2 G E each, count 4 G where the wall is held
  /// along its axis and nearly incompressible. \param of_structure  bulk modulus of layers without one, kPa
  double sudden_hoop_modulus(double of_structure) const { return hoop_modulus(material, of_structure) + 4 * springs; }
};

/// The wall sub-problem as everything above the element loops sees it, vectors with n components: residual and Jacobian
/// without boundary conditions but with the follower pressure on some of its facets.
template <int n>
class Wall {
 public:
  virtual ~Wall() = default;

  virtual const PartNodes& nodes() const = 0;
  virtual const FunctionSpace<n>& space() const = 0;
  virtual const WallConstants& constants() const = 0;
  /// \param speed  of pressure waves in the scene, mm/ms, for the stabilisation; 0, as at first: not known
  virtual void set_wave_speed(double speed) = 0;
  virtual const std::vector<LayerData>& layer_data() const = 0;
  virtual bool is_viscous() const = 0;  ///< whether a layer resists the rate of its strain, or has Maxwell branches
  /// Layout of the arrays with the strains that Maxwell branches keep.
  virtual const BranchPlaces& branch_places() const = 0;
  /// Such an array for branches that are fully relaxed at a displacement; empty without branches. \param wall  (d, .)
  virtual std::vector<double> relaxed_branches(const std::vector<double>& wall) const = 0;
  /// Writes such an array for a balance. \param branches  of branch_places().size() numbers
  virtual void settle_branches(const WallInput& in, std::vector<double>& branches) const = 0;
  const std::shared_ptr<const NodeGraph>& graph() const { return space().graph(); }
  int node_count() const { return nodes().node_count(); }

  /// Overwrites the residual, in the mixed layout, and the Jacobian if there is one.
  /// \param pressure  kPa on the pressurised facets
  /// \param solution  (d, .), mixed layout, mm: where these facets are; not read while find_unloaded_shape()
  /// \param jacobian  on the graph(), owned by the caller; null: no derivatives
  virtual AssemblyResult assemble(const WallInput& in, double pressure, const std::vector<double>& solution,
                                  std::vector<double>& residual, WallMatrix<n>* jacobian = nullptr) = 0;

  /// \param wall      (d, .) of a level
  /// \param velocity  of the level, vector layout; empty in statics
  /// \param balance   (., p) of the balance whose pressures are to count
  /// \param branches  of the level, what Maxwell branches keep
  virtual WallEnergy energy(const std::vector<double>& wall, const std::vector<double>& velocity,
                            const std::vector<double>& balance, const std::vector<double>& branches) const = 0;
  virtual WallWork work(const WallStep& step) const = 0;
  /// How far the layers are deformed, in the order of layer_data(): of all processes, which ask together.
  /// \param wall  (d, .) of a level; while find_unloaded_shape(), of the search
  virtual std::vector<LayerDeformation> deformation(const std::vector<double>& wall) const = 0;
  /// Work of the pressure on the pressurised facets, as they are in `now`, on the way from `old` to `now`; uJ, of this
  /// process's nodes. So are energy() and work(): of the elements and nodes that sums count here.
  virtual double pressure_work(double pressure, const std::vector<double>& old,
                               const std::vector<double>& now) const = 0;

  /// While it does, assemble() makes the equations of the unloaded shape (wall/unloaded_shape.hpp): d is the displacement
  /// from there to the mesh, under loads on the mesh as it is.
  virtual void find_unloaded_shape(bool find) = 0;
  /// From now on the wall is unloaded where the mesh less this displacement (vector layout, mm) is, and displacements
  /// count from the mesh.
  virtual void set_prestress(std::vector<double> displacement) = 0;
  virtual const std::vector<double>& prestress() const = 0;  ///< that displacement; empty: none
  /// (d, p) with displacements from the unloaded shape: what strains and stresses are made of, on unloaded_nodes().
  std::vector<double> from_unloaded(std::vector<double> wall) const {
    const std::vector<double>& first = prestress();
    for (std::size_t i = 0; i < first.size(); ++i)
      wall[MixedLayout<n>::vector(static_cast<int>(i) / n, static_cast<int>(i) % n)] += first[i];
    return wall;
  }
  /// Where the nodes are without load, mm. \param axes  of space, that the components of vectors lie along
  std::vector<Point> unloaded_nodes(const std::array<int, n>& axes) const {
    std::vector<Point> unloaded = nodes().nodes;
    const std::vector<double>& first = prestress();
    for (std::size_t i = 0; i < first.size(); ++i) unloaded[i / n][axes[i % n]] -= first[i];
    return unloaded;
  }

  /// What holds and loads the wall from outside, part of what assemble() makes from then on.
  void support_by(std::unique_ptr<const WallSupports<n>> supports) { supports_ = std::move(supports); }
  const WallSupports<n>* supports() const { return supports_.get(); }  ///< null: nothing

  virtual std::size_t element_count() const = 0;
  /// The elements as vertices, n + 1 numbers each.
  virtual std::vector<int> cell_vertices() const = 0;

 private:
  std::unique_ptr<const WallSupports<n>> supports_;
};

}  // namespace fsi
