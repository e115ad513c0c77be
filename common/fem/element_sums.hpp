#pragma once

#include <array>
#include <vector>

#include "fem/element_packs.hpp"

/// Stands behind the parameters of a function that sums over a pack: its calls are inlined, so that fields stay in
/// registers from the nodes to the integrals.
#define FSI_WITH_ALL_CALLS_INLINE __attribute__((flatten))

namespace fsi {

/// Integrals of `Count` quantities over one pack, a lane per element: prepare(point geometry) evaluates what depends on
/// gradients alone, once where gradients are constant; densities(prepared, point geometry, point) returns
/// the quantities per reference volume.
template <class Element, std::size_t Count, class Prepare, class Densities>
inline std::array<Pack, Count> pack_integrals(const typename Element::Geometry& geometry, Prepare prepare,
                                              Densities densities) {
  std::array<Pack, Count> total;
  total.fill(Pack(0.0));
  const auto add = [&](const std::array<Pack, Count>& density, Pack weight) {
    for (std::size_t i = 0; i < Count; ++i) total[i] += weight * density[i];
  };
  if constexpr (Element::constant_gradients) {
    const auto prepared = prepare(Element::at(geometry, 0));
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      add(densities(prepared, g, q), g.weight);
    }
  } else {
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      add(densities(prepare(g), g, q), g.weight);
    }
  }
  return total;
}

/// Sums of `Count` quantities over the elements that this process counts. integrals(pack, thread, index in that
/// thread's packs) returns those of one pack, a lane per element. Every pack is evaluated once and the packs are added
/// up in their order, so that the sums do not depend on the number of threads.
template <std::size_t Count, class Element, class Integrals>
std::array<double, Count> sum_over_elements(const ElementPacks<Element>& packs, Integrals integrals) {
  std::vector<std::array<double, Count>> of_pack(packs.pack_count());
  for_each_thread(packs, serial_sum_elements, [&](int t, const auto& mine) {
    for (std::size_t index = 0; index < mine.size(); ++index) {
      const auto& pack = mine[index];
      if (!pack.counted_here()) continue;
      const std::array<Pack, Count> lanes = integrals(pack, t, index);
      for (std::size_t i = 0; i < Count; ++i) {
        double sum = 0;
        for (int lane = 0; lane < pack.filled; ++lane)
          if (pack.counted[lane]) sum += lanes[i][lane];
        of_pack[static_cast<std::size_t>(pack.number)][i] = sum;
      }
    }
  });
  std::array<double, Count> total{};
  for (const auto& sums : of_pack)
    for (std::size_t i = 0; i < Count; ++i) total[i] += sums[i];
  return total;
}

}  // namespace fsi
