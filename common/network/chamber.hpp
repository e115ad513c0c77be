#pragma once

#include <cmath>

#include "math/pi.hpp"
#include "network/elastance.hpp"

namespace fsi {

/// A chamber of the heart: E(t) = E_min + (E_max - E_min) e(t), with the activation of ventricles in
/// [Korakianitis2006], t being the time since the beginning of its contraction in a period,
///   e = (1 - cos(pi t / T_1)) / 2 up to T_1,   (1 + cos(pi (t - T_1) / (T_2 - T_1))) / 2 up to T_2,   0 after.
class Chamber : public TimeVaryingElastance {
 public:
  double minimum = 1;    ///< E_min, kPa/mm^3
  double maximum = 1;    ///< E_max, kPa/mm^3
  double beat = 800;     ///< ms
  double peak = 300;     ///< T_1, ms
  double relaxed = 450;  ///< T_2, ms
  double delay = 0;      ///< ms, of the first begin

  static constexpr const char* name = "chamber";
  static std::vector<ParameterOf<Chamber>> parameters() {
    using E = Chamber;
    std::vector<ParameterOf<E>> all{
        {&E::minimum, "minimum", "elastance of the relaxed chamber", quantity::elastance(), positive},
        {&E::maximum, "maximum", "elastance at the peak of the contraction", quantity::elastance(), positive},
        {&E::beat, "period", "of the beat", quantity::time(), positive},
        {&E::peak, "peak", "from the begin of the contraction to its peak", quantity::time(), positive},
        {&E::relaxed, "relaxed", "from the begin of the contraction to the end of the relaxation", quantity::time(),
         positive},
        {&E::delay, "delay", "of the first begin", quantity::time(), not_negative, false}};
    for (auto& parameter : volumes<E>()) all.push_back(parameter);
    return all;
  }

  double elastance(double time) const override { return minimum + (maximum - minimum) * activation(time); }
  double activation(double time) const {
    const double beats = (time - delay) / beat, t = (beats - std::floor(beats)) * beat;
    if (t < peak) return 0.5 * (1 - std::cos(pi * t / peak));
    if (t < relaxed) return 0.5 * (1 + std::cos(pi * (t - peak) / (relaxed - peak)));
    return 0;
  }
  double period() const override { return beat; }
  std::optional<Contradiction> contradiction() const override {
    if (maximum < minimum)
      return Contradiction{"maximum", fmt::format("{:g} is below minimum, {:g}", maximum, minimum),
                           "give a larger one"};
    if (!(relaxed > peak))
      return Contradiction{"relaxed", fmt::format("{:g} ms are not behind peak, {:g} ms", relaxed, peak),
                           "give a later time"};
    if (relaxed > beat)
      return Contradiction{"relaxed", fmt::format("{:g} ms are behind the period, {:g} ms", relaxed, beat),
                           "give an earlier time, or a longer period"};
    return std::nullopt;
  }
  std::string description(const std::string& volume) const override {
    return fmt::format("elastance {:g} to {:g} kPa/{} every {:g} ms, from {:g} {}", minimum, maximum, volume, beat,
                       initial_volume, volume);
  }
};

}  // namespace fsi
