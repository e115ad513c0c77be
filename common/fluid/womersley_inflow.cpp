#include "fluid/womersley_inflow.hpp"

#include <cmath>
#include <utility>

#include "fem/elements.hpp"
#include "fluid/opening_profile.hpp"
#include "fluid/opening_shape.hpp"
#include "fluid/scaled_profile.hpp"
#include "math/bessel.hpp"
#include "mesh/boundary.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

using Complex = std::complex<double>;

constexpr int most_modes = 64;
constexpr double left_over = 5e-3;  ///< of the rate's root mean square, that the modes may leave

/// The profile over a circle, but for a factor, at the distance s of the centre. \param l  sqrt(-i w / nu), Im l > 0
Complex over_circle(Complex l, double radius, double s) {
  if (std::abs(l) * radius < 1) {  // (J_0(l R) - J_0(l s)) / (-l^2/4), free of cancellation
    const Complex x = -0.25 * l * l;
    Complex sum = 0, factor = 1;
    double far = 1, near = 1;
    for (int k = 1; k <= 16; ++k) {
      far *= radius * radius;
      near *= s * s;
      sum += factor * (far - near);
      factor *= x / ((k + 1.0) * (k + 1.0));
    }
    return sum;
  }
  const Complex ratio = ScaledBessel(l * s).j0 / ScaledBessel(l * radius).j0;
  return 1.0 - ratio * std::exp(-l.imag() * (radius - s));
}

/// The profile over a segment, but for a factor, at the distance s of its middle. \param l  sqrt(i w / nu), Re l > 0
Complex over_segment(Complex l, double half_width, double s) {
  if (std::abs(l) * half_width < 1) {  // (cosh(l h) - cosh(l s)) / (l^2/2)
    Complex sum = 0, factor = 1;
    double far = 1, near = 1;
    for (int k = 1; k <= 16; ++k) {
      far *= half_width * half_width;
      near *= s * s;
      sum += factor * (far - near);
      factor *= l * l / ((2 * k + 1.0) * (2 * k + 2.0));
    }
    return sum;
  }
  return 1.0 -
         std::exp(l * (s - half_width)) * (1.0 + std::exp(-2.0 * l * s)) / (1.0 + std::exp(-2.0 * l * half_width));
}

/// The profile of one mode, per node of the opening, but for a factor. \param i_w_nu  i k w / nu, 1/mm^2
template <class Element>
std::vector<Complex> profile(const InflowOpening<Element>& opening, const std::vector<int>& nodes,
                             const OpeningShape& shape, Complex i_w_nu) {
  std::vector<Complex> w;
  if (!shape.walled) {
    w.assign(nodes.size(), 1.0);
  } else if (shape.kind == OpeningShape::Kind::other) {
    w = developed_flow(opening, nodes, i_w_nu);
  } else {
    for (const int a : nodes) {
      const double s = distance(opening.nodes[a], shape.centre);
      if (opening.sticking[a])
        w.emplace_back(0.0);
      else if (shape.kind == OpeningShape::Kind::circle)
        w.push_back(over_circle(Complex(0, 1) * std::sqrt(i_w_nu), shape.radius, s));
      else
        w.push_back(over_segment(std::sqrt(i_w_nu), shape.radius, s));
    }
  }
  return w;
}

}  // namespace

template <class Element>
WomersleyInflow womersley_inflow(const InflowOpening<Element>& opening, const PeriodicFlow& flow, double density,
                                 double viscosity) {
  constexpr int n = Element::components;
  const OpeningShape shape = shape_of(opening);
  const auto nodes = facet_nodes(opening.facets);
  WomersleyInflow::Modes modes;
  std::string instead;
  if (!shape.walled)
    instead = says_no_rim(opening);
  else if (shape.kind == OpeningShape::Kind::other)
    instead = says_own_shape(opening);
  for (const int a : nodes) modes.entries.push_back(VectorLayout<n>::vector(a));
  for (int k = 0; k < n; ++k) modes.direction.push_back(shape.inward[Element::axis[k]]);

  const double w = 2 * std::acos(-1.0) / flow.period, square = flow.mean_square();
  double left = square;
  for (int k = 0; k <= most_modes; ++k) {
    const Complex q = flow.coefficient(k);
    modes.coefficients.push_back(q);
    left -= (k == 0 ? 1.0 : 0.5) * std::norm(q);
    if (left <= left_over * left_over * square) break;
  }
  for (std::size_t k = 0; k < modes.coefficients.size(); ++k) {
    modes.profiles.push_back(
        profile(opening, nodes, shape, Complex(0, static_cast<double>(k) * w * density / viscosity)));
    scale_to_unit_flow(opening, nodes, shape.inward, modes.profiles.back());
  }
  return {flow, std::move(modes), std::move(instead)};
}

void WomersleyInflow::set(double time, double flow_rate, std::vector<double>& velocity) const {
  const auto& [entries, direction, profiles, coefficients] = modes_;
  const double w = 2 * std::acos(-1.0) / flow_.period;
  std::vector<Complex> rates;
  double left = flow_rate;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    // The phase of whole periods is taken off first: it would cost digits.
    rates.push_back(coefficients[k] * std::polar(1.0, static_cast<double>(k) * w * std::fmod(time, flow_.period)));
    left -= rates.back().real();
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    double along = left * profiles.back()[i].real();
    for (std::size_t k = 0; k < rates.size(); ++k)
      along += rates[k].real() * profiles[k][i].real() - rates[k].imag() * profiles[k][i].imag();
    for (std::size_t c = 0; c < direction.size(); ++c) velocity[entries[i] + c] = along * direction[c];
  }
}

void WomersleyInflow::keep(const std::function<std::ptrdiff_t(std::size_t entry)>& entry_there) {
  Modes kept;
  kept.direction = modes_.direction;
  kept.coefficients = modes_.coefficients;
  kept.profiles.resize(modes_.profiles.size());
  for (std::size_t i = 0; i < modes_.entries.size(); ++i) {
    const std::ptrdiff_t entry = entry_there(modes_.entries[i]);
    if (entry < 0) continue;
    kept.entries.push_back(static_cast<std::size_t>(entry));
    for (std::size_t k = 0; k < kept.profiles.size(); ++k) kept.profiles[k].push_back(modes_.profiles[k][i]);
  }
  modes_ = std::move(kept);
}

#define FSI_INSTANTIATE(Element)                                                                                 \
  template WomersleyInflow womersley_inflow<Element>(const InflowOpening<Element>&, const PeriodicFlow&, double, \
                                                     double);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
