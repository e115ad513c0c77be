#include "wall/maxwell_layers.hpp"

#include <cassert>

#include "fem/element_sums.hpp"
#include "fem/elements.hpp"
#include "fem/interpolation.hpp"
#include "wall/maxwell_form.hpp"
#include "wall/wall_assembly.hpp"

namespace fsi {

namespace {

template <class Element>
using PackOf = typename ElementPacks<Element>::ElementPack;

/// Where the strain of a branch at a point of a cell begins.
template <class Element>
std::size_t place_of(const BranchPlaces& places, const PackOf<Element>& pack, int lane, int point, std::size_t branch) {
  const auto cell = static_cast<std::size_t>(places.place_of_cell[pack.cell[lane]]);
  return cell * places.entries + (static_cast<std::size_t>(point) * places.branches + branch) * 6;
}

template <class Element>
Sym3<Pack> strain_at(const double* strains, const BranchPlaces& places, const PackOf<Element>& pack, int point,
                     std::size_t branch) {
  Sym3<Pack> a;
  for (int lane = 0; lane < pack_width; ++lane) {
    const double* from = strains + place_of<Element>(places, pack, lane, point, branch);
    for (int k = 0; k < 6; ++k) a.c[k].set(lane, from[k]);
  }
  return a;
}

/// Displacement from the unloaded shape.
template <class Element>
NodalVector<Element> displacement_of(const double* wall, const double* prestress, const PackOf<Element>& pack) {
  NodalVector<Element> d{};
  gather<MixedLayout<Element::components>>(d, pack, wall);
  if (prestress) detail::add_prestress<Element>(d, pack, prestress);
  return d;
}

template <class Element, bool Derivatives>
void maxwell_packs(const MaxwellForm& form, const BranchPlaces& places, const std::vector<PackOf<Element>>& packs,
                   const WallInput& in, double* residual, double* blocks) {
  constexpr int n = Element::components;
  constexpr int seeds = Derivatives ? n + 1 : 0;  // displacement, pressure
  using T = Seeded<seeds>;
  Sym3<Pack> history[Element::points];
  ElementRows<Element, T> rows;
  for (const auto& pack : packs) {
    const NodalVector<Element> d = displacement_of<Element>(in.wall, in.prestress, pack);
    for (int q = 0; q < Element::points; ++q) {
      history[q] = Sym3<Pack>{};
      for (int k = 0; k < 6; ++k) history[q].c[k] = Pack(0.0);
      for (std::size_t i = 0; i < form.count(); ++i)
        history[q] = history[q] + Pack(form.weight(i)) * strain_at<Element>(in.branch_reference, places, pack, q, i);
    }
    for (int b = 0; b < (Derivatives ? Element::nodes : 1); ++b) {
      integrate(
          rows, pack.geometry,
          [&](const auto& g) { return form.prepare(seed_gradient<Element, seeds, 0>(gradient_of(d, g), g, b)); },
          [&](const auto& k, const auto&, int q) { return form.integrand(k, history[q]); });
      if (b == 0) scatter_residual<Element>(rows, pack, residual);
      if constexpr (Derivatives) scatter_blocks<Element, seeds, 0, n + 1>(rows, pack, b, blocks);
    }
  }
}

}  // namespace

template <class Element>
void MaxwellLayers<Element>::add(const Layers& layers, const BranchPlaces& places, const WallInput& in,
                                 std::vector<double>& residual, WallMatrix<n>* jacobian) {
  if (in.velocity_rate == 0) return;
  for (const auto& layer : layers) {
    if (layer.branches.empty() || layer.packs.element_count() == 0) continue;
    assert(in.branch_reference);
    const MaxwellForm form(layer.branches, in.velocity_rate);
    for_each_thread(layer.packs, jacobian ? serial_jacobian_elements : serial_residual_elements,
                    [&](int, const auto& mine) {
                      if (jacobian)
                        maxwell_packs<Element, true>(form, places, mine, in, residual.data(), jacobian->values.data());
                      else
                        maxwell_packs<Element, false>(form, places, mine, in, residual.data(), nullptr);
                    });
  }
}

template <class Element>
void MaxwellLayers<Element>::settle(const Layers& layers, const BranchPlaces& places, const WallInput& in,
                                    double* strains) {
  for (const auto& layer : layers) {
    if (layer.branches.empty()) continue;
    for_each_thread(layer.packs, serial_residual_elements, [&](int, const auto& mine) {
      for (const auto& pack : mine) {
        if (!pack.counted_here()) continue;  // of the threads that hold it, one writes
        const NodalVector<Element> d = displacement_of<Element>(in.wall, in.prestress, pack);
        for (int q = 0; q < Element::points; ++q) {
          const Sym3<Pack> e = green_lagrange(gradient_of(d, Element::at(pack.geometry, q)));
          for (std::size_t i = 0; i < layer.branches.size(); ++i) {
            const double lag = in.velocity_rate * layer.branches[i].time;
            for (int lane = 0; lane < pack.filled; ++lane) {
              const std::size_t first = place_of<Element>(places, pack, lane, q, i);
              for (std::size_t k = 0; k < 6; ++k) {
                const double at = e.c[k][lane];
                strains[first + k] = lag == 0 ? at : (at + lag * in.branch_reference[first + k]) / (1 + lag);
              }
            }
          }
        }
      }
    });
  }
}

template <class Element>
double MaxwellLayers<Element>::stored(const Layers& layers, const BranchPlaces& places, const WallInput& level,
                                      const double* strains) {
  double sum = 0;
  for (const auto& layer : layers) {
    if (layer.branches.empty()) continue;
    sum += sum_over_elements<1>(layer.packs, [&](const auto& pack, int, std::size_t) {
      const NodalVector<Element> d = displacement_of<Element>(level.wall, level.prestress, pack);
      return pack_integrals<Element, 1>(
          pack.geometry, [&](const auto& g) { return green_lagrange(gradient_of(d, g)); },
          [&](const Sym3<Pack>& e, const auto&, int q) {
            Pack energy(0.0);
            for (std::size_t i = 0; i < layer.branches.size(); ++i) {
              const Sym3<Pack> spring = e - strain_at<Element>(strains, places, pack, q, i);
              energy += Pack(layer.branches[i].shear) * contract(spring, spring);
            }
            return std::array<Pack, 1>{energy};
          });
    })[0];
  }
  return sum;
}

template <class Element>
MaxwellWork MaxwellLayers<Element>::work(const Layers& layers, const BranchPlaces& places, const WallStep& step) {
  MaxwellWork work;
  if (step.balance.velocity_rate == 0) return work;
  const Pack weight(step.weight), duration(step.duration);
  for (const auto& layer : layers) {
    if (layer.branches.empty()) continue;
    const auto sums = sum_over_elements<2>(layer.packs, [&](const auto& pack, int, std::size_t) {
      const double* prestress = step.balance.prestress;
      const NodalVector<Element> d = displacement_of<Element>(step.balance.wall, prestress, pack),
                                 start = displacement_of<Element>(step.start, prestress, pack),
                                 end = displacement_of<Element>(step.end, prestress, pack);
      NodalVector<Element> moved = displacement_of<Element>(step.reference, prestress, pack);
      for (int a = 0; a < Element::nodes; ++a)
        for (int k = 0; k < n; ++k) moved.at[a][k] = Pack(step.duration * step.rate) * (d.at[a][k] - moved.at[a][k]);
      struct Strains {
        Sym3<Pack> now, start, end;  ///< E
        Sym3<Pack> change;           ///< W dE/dt
      };
      return pack_integrals<Element, 2>(
          pack.geometry,
          [&](const auto& g) {
            const Mat3<Pack> h = gradient_of(d, g), v = gradient_of(moved, g);
            Strains e{
                green_lagrange(h), green_lagrange(gradient_of(start, g)), green_lagrange(gradient_of(end, g)), {}};
            for (int i = 0; i < 3; ++i)
              for (int j = i; j < 3; ++j) {
                Pack sum = v(i, j) + v(j, i);
                for (int k = 0; k < 3; ++k) sum += h(k, i) * v(k, j) + h(k, j) * v(k, i);
                e.change(i, j) = Pack(0.5) * sum;
              }
            return e;
          },
          [&](const Strains& e, const auto&, int q) {
            Pack dissipated(0.0), beyond(0.0);
            for (std::size_t i = 0; i < layer.branches.size(); ++i) {
              const auto& [shear, time] = layer.branches[i];
              const auto spring = [&](const Sym3<Pack>& strain, const double* kept) {
                return strain - strain_at<Element>(kept, places, pack, q, i);
              };
              const Sym3<Pack> here = spring(e.now, step.branches), first = spring(e.start, step.branches_start),
                               last = spring(e.end, step.branches_end);
              const Pack taken = duration * Pack(2 * shear / time) * contract(here, here);
              dissipated += taken;
              beyond += Pack(2 * shear) * contract(here, e.change) - taken -
                        weight * Pack(shear) * contract(last - first, last + first);
            }
            return std::array<Pack, 2>{dissipated, beyond};
          });
    });
    work.dissipated += sums[0];
    work.beyond += sums[1];
  }
  return work;
}

#define FSI_INSTANTIATE(Element) template struct MaxwellLayers<Element>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
