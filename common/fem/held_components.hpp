#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fem/nodal_frames.hpp"

namespace fsi {

/// Conditions on single components that hold a vector's part along some directions at zero.
template <int n>
struct HeldComponents {
  std::array<bool, n> held{};
  bool turned = false;  ///< the components are those along `axes`
  NodalAxes<n> axes{};
};

namespace detail {

template <int n>
double dot(const Direction<n>& a, const Direction<n>& b) {
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += a[k] * b[k];
  return sum;
}

/// The axis that a direction is along, exactly; -1: none.
template <int n>
int axis_along(const Direction<n>& v) {
  const auto zeros = std::count(v.begin(), v.end(), 0.0);
  return zeros == n - 1
             ? static_cast<int>(std::find_if(v.begin(), v.end(), [](double x) { return x != 0; }) - v.begin())
             : -1;
}

/// Turns the axis nearest to a unit vector into it or its opposite, by the smallest rotation: axes across both stay.
/// \returns that axis
template <int n>
int turn_nearest_axis(Direction<n> v, NodalAxes<n>& axes) {
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const int k = static_cast<int>(std::max_element(v.begin(), v.end(), larger) - v.begin());
  if (v[k] < 0)
    for (double& x : v) x = -x;
  for (int j = 0; j < n; ++j) {
    axes[j] = {};
    axes[j][j] = 1;
    for (int i = 0; i < n && j != k; ++i) axes[j][i] -= v[j] / (1 + v[k]) * (v[i] + (i == k ? 1 : 0));
  }
  axes[k] = v;
  return k;
}

}  // namespace detail

/// Conditions that a vector has no component along any of the directions: along axes of space where these do, else in a
/// frame (docs/theory.md, section 2.4).
/// \param directions  unit vectors; those within 1e-4 of the others' span count as lying in it
template <int n>
HeldComponents<n> hold(const std::vector<Direction<n>>& directions) {
  constexpr double parallel = 1e-4;
  std::vector<Direction<n>> basis;
  bool along_axes = true;
  for (const auto& direction : directions) {
    auto v = direction;
    for (const auto& known : basis) {
      const double along = detail::dot<n>(v, known);
      for (int k = 0; k < n; ++k) v[k] -= along * known[k];
    }
    const double length = std::sqrt(detail::dot<n>(v, v));
    if (length < parallel) continue;
    for (double& x : v) x /= length;
    basis.push_back(v);
    along_axes = along_axes && detail::axis_along<n>(direction) >= 0;
  }
  HeldComponents<n> result;
  if (along_axes) {
    for (const auto& v : basis) result.held[detail::axis_along<n>(v)] = true;
    return result;
  }
  if (basis.size() == n) {
    result.held.fill(true);
    return result;
  }
  if (basis.size() == 1) {
    result.turned = true;
    result.held[detail::turn_nearest_axis<n>(basis[0], result.axes)] = true;
    return result;
  }
  if constexpr (n == 3) {  // two directions: what is across both remains free
    const auto &u = basis[0], &v = basis[1];
    Direction<n> across{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    for (double& x : across)
      if (std::abs(x) < 1e-10) x = 0;
    int free = detail::axis_along<n>(across);
    if (free < 0) {
      result.turned = true;
      free = detail::turn_nearest_axis<n>(across, result.axes);
    }
    result.held.fill(true);
    result.held[free] = false;
  }
  return result;
}

}  // namespace fsi
