#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/split_blocks.hpp"
#include "algebra/vector_view.hpp"
#include "fem/nodal_layout.hpp"
#include "host/parallel_for.hpp"
#include "linear/velocity_pressure/interface_shape_derivatives.hpp"
#include "linear/velocity_pressure/velocity_pressure_blocks.hpp"
#include "linear/velocity_pressure/velocity_pressure_ghosts.hpp"

namespace fsi {

/// The Jacobian of velocities and pressures, F = [A G; B C], in single precision, A in 16 bits (SplitBlocks). Of the mesh
/// motion A has what InterfaceShapeDerivatives gives, the rest is left out. A third of the memory of the assembled matrices,
/// and arranged so that products and smoothers run over whole registers. Vectors hold `lanes` floats a velocity node (padded with
/// zero), then one a pressure. Where the scene is shared out among processes, rows are those of own unknowns, and vectors have
/// places for ghosts behind each.
template <int n>
class VelocityPressureMatrix : public VelocityPressureBlocks<n> {
 public:
  using VelocityPressureBlocks<n>::for_blocks_of;
  using VelocityPressureBlocks<n>::for_blocks_of_node;

  static constexpr int lanes = padded<n>;  ///< floats of a nodal vector
  using Nodal = Register<n>;               ///< one nodal vector in a register

  static Nodal load(const float* from) { return fsi::load<n>(from); }
  static void store(Nodal x, float* to) { fsi::store<n>(x, to); }

  VelocityPressureMatrix(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout)
      : VelocityPressureBlocks<n>(blocks, layout), layout_(layout), ghosts_(blocks, layout) {
    make_momentum_pattern();
    make_continuity_pattern();
    shape_derivatives_ = std::make_unique<InterfaceShapeDerivatives<n>>(blocks, layout);
    gradient_.resize(gradient_columns_.size() * lanes);
    divergence_.resize(continuity_velocities_.size() * lanes);
    compressibility_.resize(compressibility_columns_.size());
  }

  std::size_t velocity_size() const { return static_cast<std::size_t>(layout_.velocities) * lanes; }
  std::size_t size() const { return velocity_size() + layout_.pressures; }

  /// to = factor * from. \param from  in double precision, in the order of the layout \param to  of size(), padded
  void take(const std::vector<double>& from, double factor, VectorView<float> to) const {
    parallel_for(layout_.velocities, layout_.velocities > 2000, [&](int v) {
      for (int i = 0; i < lanes; ++i)
        to[static_cast<std::size_t>(v) * lanes + i] =
            i < n ? static_cast<float>(factor * from[VectorLayout<n>::vector(v, i)]) : 0.0f;
    });
    for (int p = 0; p < layout_.pressures; ++p)
      to[velocity_size() + p] = static_cast<float>(factor * from[layout_.velocity_size() + p]);
  }
  /// The reverse: to = factor * from, `to` resized to the size of the layout.
  void give(VectorView<const float> from, double factor, std::vector<double>& to) const {
    to.resize(layout_.size());
    parallel_for(layout_.velocities, layout_.velocities > 2000, [&](int v) {
      for (int k = 0; k < n; ++k)
        to[VectorLayout<n>::vector(v, k)] = factor * from[static_cast<std::size_t>(v) * lanes + k];
    });
    for (int p = 0; p < layout_.pressures; ++p) to[layout_.velocity_size() + p] = factor * from[velocity_size() + p];
  }

  /// Takes the present values of the block matrices.
  void fill() {
    fill_momentum();
    fill_continuity();
  }

  /// y = F x, both of size(). Ghosts in x must have the owners' values; those of y are left as they are.
  void multiply(VectorView<const float> x, VectorView<float> y) const {
    const float* pressure = x.data() + velocity_size();
    parallel_for(layout_.own_velocities, layout_.own_velocities > 500, [&](int v) {
      store(momentum_.row_product(v, x.data()) + gradient_product(v, pressure),
            y.data() + static_cast<std::size_t>(v) * lanes);
    });
    multiply_continuity(x, y);
  }
  /// The pressures' rows of y = F x.
  void multiply_continuity(VectorView<const float> x, VectorView<float> y) const {
    const float* pressure = x.data() + velocity_size();
    float* rows = y.data() + velocity_size();
    parallel_for(layout_.own_pressures, layout_.own_pressures > 500, [&](int p) {
      float sum = divergence_product(p, x.data());
      for (int at = compressibility_offsets_[p]; at < compressibility_offsets_[p + 1]; ++at)
        sum += compressibility_[at] * pressure[compressibility_columns_[at]];
      rows[p] = sum;
    });
  }
  /// B x of a pressure, of the velocities alone.
  float divergence_product(int p, const float* x) const {
    Nodal sums{};
    for (int at = continuity_offsets_[p]; at < continuity_offsets_[p + 1]; ++at)
      sums += load(divergence_.data() + static_cast<std::size_t>(at) * lanes) *
              load(x + static_cast<std::size_t>(continuity_velocities_[at]) * lanes);
    float sum = 0;
    for (int i = 0; i < n; ++i) sum += sums[i];
    return sum;
  }

  /// G p of a velocity node.
  Nodal gradient_product(int v, const float* pressure) const {
    Nodal even{}, odd{};
    int at = gradient_offsets_[v];
    const int end = gradient_offsets_[v + 1];
    const float* g = gradient_.data() + static_cast<std::size_t>(at) * lanes;
    for (; at + 1 < end; at += 2, g += 2 * lanes) {
      even += load(g) * pressure[gradient_columns_[at]];
      odd += load(g + lanes) * pressure[gradient_columns_[at + 1]];
    }
    if (at < end) even += load(g) * pressure[gradient_columns_[at]];
    return even + odd;
  }

  /// An estimate of the norm of F x's error by the rounding of A's numbers (SplitBlocks::rounding_squared), over all
  /// processes. By all of them together. \param x  velocities first
  double rounding(const std::vector<float>& x) const {
    double sum = 0;
    for (int v = 0; v < layout_.own_velocities; ++v)
      sum += momentum_.rounding_squared(v, load(x.data() + static_cast<std::size_t>(v) * lanes));
    return std::sqrt(processes().sum(sum));
  }
  /// The shape derivatives that F has.
  const InterfaceShapeDerivatives<n>& shape_derivatives() const { return *shape_derivatives_; }

  const Communicator& processes() const { return *ghosts_.velocities.processes; }
  const VelocityPressureGhosts<n>& ghosts() const { return ghosts_; }
  /// Gives ghosts the owners' values. \param velocities  `lanes` floats each, as a vector here begins
  void update_velocities(float* velocities) const { ghosts_.velocities.exchange.update(velocities, lanes); }
  void update_pressures(float* pressures) const { ghosts_.pressures.exchange.update(pressures, 1); }

  /// A by velocity nodes; rows of ghosts are zero.
  const SplitBlocks<n>& momentum() const { return momentum_; }
  /// G: pressures of each velocity node, one entry per assembled block.
  const std::vector<int>& gradient_offsets() const { return gradient_offsets_; }
  const std::vector<int>& gradient_columns() const { return gradient_columns_; }
  const float* gradient(int at) const { return gradient_.data() + static_cast<std::size_t>(at) * lanes; }

  std::size_t bytes() const {
    return momentum_.bytes() + sizeof(float) * (gradient_.size() + divergence_.size() + compressibility_.size()) +
           sizeof(int) * (gradient_columns_.size() + continuity_velocities_.size() + compressibility_columns_.size());
  }

 private:
  void make_momentum_pattern() {
    gradient_offsets_ = {0};
    std::vector<std::vector<int>> rows(layout_.velocities);
    for (int v = 0; v < layout_.velocities; ++v) {
      auto& row = rows[v];
      if (v < layout_.own_velocities)
        for_blocks_of(v, [&](const double*, int u, int p, double) {
          if (u >= 0) row.push_back(u);
          if (p >= 0) gradient_columns_.push_back(p);
        });
      else
        row.push_back(v);
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
      gradient_offsets_.push_back(static_cast<int>(gradient_columns_.size()));
    }
    momentum_ = SplitBlocks<n>(rows);
  }

  void make_continuity_pattern() {
    continuity_offsets_ = {0};
    compressibility_offsets_ = {0};
    for (int p = 0; p < layout_.pressures; ++p) {
      if (p < layout_.own_pressures)
        for_blocks_of_node(layout_.wall_pressure[p], layout_.node_of_pressure[p],
                           [&](const double*, int v, int q, double) {
                             continuity_velocities_.push_back(std::max(v, 0));  // without one zeros are stored
                             if (q >= 0) compressibility_columns_.push_back(q);
                           });
      continuity_offsets_.push_back(static_cast<int>(continuity_velocities_.size()));
      compressibility_offsets_.push_back(static_cast<int>(compressibility_columns_.size()));
    }
  }

  void fill_momentum() {
    constexpr int stride = SplitBlocks<n>::stride;
    parallel_for(layout_.own_velocities, layout_.own_velocities > 500, [&](int v) {
      std::vector<float> row(static_cast<std::size_t>(momentum_.count(v)) * stride, 0.0f);
      const auto block_of = [&](int u) {
        return row.data() + static_cast<std::size_t>(momentum_.place(v, u)) * stride;
      };
      int gradient_at = gradient_offsets_[v];
      for_blocks_of(v, [&](const double* block, int u, int p, double factor) {
        if (p >= 0) {
          float* g = gradient_.data() + static_cast<std::size_t>(gradient_at++) * lanes;
          for (int i = 0; i < n; ++i) g[i] = static_cast<float>(block[MixedLayout<n>::in_block(i, n)]);
        }
        if (u < 0) return;
        float* a = block_of(u);
        for (int i = 0; i < n; ++i)
          for (int k = 0; k < n; ++k)
            a[k * lanes + i] += static_cast<float>(factor * block[MixedLayout<n>::in_block(i, k)]);
      });
      shape_derivatives_->for_row(
          v, [&](int u, int i, int k, double value) { block_of(u)[k * lanes + i] += static_cast<float>(value); });
      momentum_.set_row(v, row.data());
    });
  }

  void fill_continuity() {
#pragma omp parallel for schedule(static) if (layout_.own_pressures > 500)
    for (int p = 0; p < layout_.own_pressures; ++p) {
      int at = continuity_offsets_[p], compressibility_at = compressibility_offsets_[p];
      for_blocks_of_node(
          layout_.wall_pressure[p], layout_.node_of_pressure[p], [&](const double* block, int v, int q, double factor) {
            float* b = divergence_.data() + static_cast<std::size_t>(at++) * lanes;
            for (int k = 0; k < n; ++k)
              b[k] = v < 0 ? 0.0f : static_cast<float>(factor * block[MixedLayout<n>::in_block(n, k)]);
            if (q >= 0)
              compressibility_[compressibility_at++] = static_cast<float>(block[MixedLayout<n>::in_block(n, n)]);
          });
    }
  }

  const VelocityPressureLayout<n>& layout_;
  VelocityPressureGhosts<n> ghosts_;
  SplitBlocks<n> momentum_;  ///< A
  std::unique_ptr<const InterfaceShapeDerivatives<n>> shape_derivatives_;
  std::vector<int> gradient_offsets_, gradient_columns_;
  std::vector<float> gradient_;  ///< `lanes` numbers a block
  std::vector<int> continuity_offsets_, continuity_velocities_;
  std::vector<float> divergence_;  ///< B, `lanes` numbers a block
  std::vector<int> compressibility_offsets_, compressibility_columns_;
  std::vector<float> compressibility_;  ///< C
};

}  // namespace fsi
