#include "openings/openings.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
Openings<n>::Openings(const std::vector<OpenBoundary<n>>& surfaces, const std::vector<Behind>& behind,
                      std::shared_ptr<const Network> network)
    : count_(surfaces.size()) {
  assert(behind.size() == count_);
  for (std::size_t i = 0; i < count_; ++i)
    if (behind[i].law) {
      answering_.push_back({i, &surfaces[i], behind[i].law, size_});
      size_ += behind[i].law->start().size();
    }
  std::vector<typename JoinedOpenings<n>::Opening> joined;
  for (std::size_t i = 0; i < count_; ++i)
    if (behind[i].joined) joined.push_back({i, &surfaces[i]});
  if (network) {
    assert(joined.size() == network->openings());
    joined_ = JoinedOpenings<n>(std::move(joined), std::move(network), size_);
    size_ += joined_.network().size();
  }
  for (std::size_t i = 0; i < count_; ++i)
    if (behind[i].flow_given) {
      driven_.push_back({i, &surfaces[i], size_});
      size_ += 2;
    }
}

template <int n>
std::vector<double> Openings<n>::start(double pressure) const {
  std::vector<double> kept(size_, 0.0);
  for (const Answering& opening : answering_) {
    const std::vector<double> own = opening.law->start();
    std::copy(own.begin(), own.end(), kept.begin() + static_cast<std::ptrdiff_t>(opening.place));
  }
  if (!joined_.empty()) {
    const std::vector<double> own = joined_.network().start();
    std::copy(own.begin(), own.end(), kept.begin() + static_cast<std::ptrdiff_t>(joined_.place()));
  }
  for (const Driven& opening : driven_) kept[opening.place] = pressure;
  return kept;
}

template <int n>
std::vector<double> Openings<n>::start_rates(const std::vector<double>& kept, const std::vector<double>& mesh,
                                             const std::vector<double>& flow) const {
  std::vector<double> rates(size_, 0.0);
  for (const Answering& opening : answering_) {
    const std::vector<double> own =
        opening.law->rates(kept.data() + opening.place, opening.surface->outflow(mesh, flow));
    std::copy(own.begin(), own.end(), rates.begin() + static_cast<std::ptrdiff_t>(opening.place));
  }
  joined_.start_rates(kept, mesh, flow, rates);
  return rates;
}

template <int n>
std::vector<double> Openings<n>::pressures(const std::vector<double>& applied, const FluidInput& in, double time,
                                           const std::vector<double>& reference,
                                           const std::vector<double>& kept) const {
  assert(applied.size() <= count_);
  std::vector<double> pressures = applied;
  if (!answering_.empty() || !driven_.empty() || !joined_.empty()) pressures.resize(count_, 0.0);
  for (const Answering& opening : answering_)
    pressures[opening.number] +=
        opening.law->pressure(in.fluid_factor, reference.data() + opening.place, opening.surface->relative_outflow(in));
  joined_.add_pressures(in, time, reference, pressures);
  for (const Driven& opening : driven_) pressures[opening.number] = kept[opening.place];
  return pressures;
}

template <int n>
void Openings<n>::settle(const FluidInput& in, double time, const std::vector<double>& reference,
                         std::vector<double>& kept) const {
  for (const Answering& opening : answering_) {
    const std::vector<double> own =
        opening.law->kept(in.fluid_factor, reference.data() + opening.place, opening.surface->relative_outflow(in));
    std::copy(own.begin(), own.end(), kept.begin() + static_cast<std::ptrdiff_t>(opening.place));
  }
  joined_.settle(in, time, reference, kept);
  for (const Driven& opening : driven_) kept[opening.place + 1] = opening.surface->relative_outflow(in);
}

#define FSI_INSTANTIATE(n) template class Openings<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
