#pragma once

namespace fsi {

/// A quadrature rule on a simplex with `Vertices` vertices: barycentric coordinates of its points and weights that add
/// up to one. All points lie inside the simplex and all weights are positive.
template <int Vertices, int Points>
struct SimplexRule {
  static constexpr int points = Points;
  double point[Points][Vertices];
  double weight[Points];
};

namespace detail {

/// Appends the points (1 - (Vertices - 1) a, a, a, ...) with the first coordinate in each place in turn.
/// \returns the number of points that there are then
template <int Vertices, int Points>
constexpr int add_vertex_orbit(SimplexRule<Vertices, Points>& rule, int from, double a, double weight) {
  for (int v = 0; v < Vertices; ++v, ++from) {
    for (int i = 0; i < Vertices; ++i) rule.point[from][i] = i == v ? 1 - (Vertices - 1) * a : a;
    rule.weight[from] = weight;
  }
  return from;
}

}  // namespace detail

// --- lines: Gauss-Legendre -------------------------------------------------------------------------------------------

/// Exact for degree 3.
constexpr SimplexRule<2, 2> line_rule_3() {
  constexpr double near = 0.78867513459481288225, far = 0.21132486540518711775;
  return {{{near, far}, {far, near}}, {0.5, 0.5}};
}
/// Exact for degree 5.
constexpr SimplexRule<2, 3> line_rule_5() {
  constexpr double offset = 0.38729833462074168852;  // sqrt(0.15)
  return {{{0.5 + offset, 0.5 - offset}, {0.5, 0.5}, {0.5 - offset, 0.5 + offset}}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};
}
/// Exact for degree 7.
constexpr SimplexRule<2, 4> line_rule_7() {
  constexpr double inner = 0.5 * 0.33998104358485626480, outer = 0.5 * 0.86113631159405257522;
  constexpr double inner_weight = 0.5 * 0.65214515486254614263, outer_weight = 0.5 * 0.34785484513745385737;
  return {
      {{0.5 + outer, 0.5 - outer}, {0.5 + inner, 0.5 - inner}, {0.5 - inner, 0.5 + inner}, {0.5 - outer, 0.5 + outer}},
      {outer_weight, inner_weight, inner_weight, outer_weight}};
}

// --- triangles -------------------------------------------------------------------------------------------------------

/// Exact for degree 2.
constexpr SimplexRule<3, 3> triangle_rule_2() {
  SimplexRule<3, 3> rule{};
  detail::add_vertex_orbit(rule, 0, 1.0 / 6, 1.0 / 3);
  return rule;
}
/// Exact for degree 4 [Dunavant1985].
constexpr SimplexRule<3, 6> triangle_rule_4() {
  SimplexRule<3, 6> rule{};
  const int next = detail::add_vertex_orbit(rule, 0, 0.44594849091596488632, 0.22338158967801146570);
  detail::add_vertex_orbit(rule, next, 0.091576213509770743460, 0.10995174365532186764);
  return rule;
}
/// Exact for degree 5 (Radon).
constexpr SimplexRule<3, 7> triangle_rule_5() {
  SimplexRule<3, 7> rule{{{1.0 / 3, 1.0 / 3, 1.0 / 3}}, {0.225}};
  const int next = detail::add_vertex_orbit(rule, 1, 0.10128650732345633880, 0.12593918054482715260);
  detail::add_vertex_orbit(rule, next, 0.47014206410511508977, 0.13239415278850618074);
  return rule;
}
/// Exact for degree 6 [Dunavant1985].
constexpr SimplexRule<3, 12> triangle_rule_6() {
  SimplexRule<3, 12> rule{};
  int next = detail::add_vertex_orbit(rule, 0, 0.24928674517091042129, 0.11678627572637936603);
  next = detail::add_vertex_orbit(rule, next, 0.063089014491502227610, 0.050844906370206816921);
  constexpr double a = 0.053145049844816947353, b = 0.31035245103378440542, c = 1 - a - b;
  constexpr double orbit[6][3] = {{a, b, c}, {b, c, a}, {c, a, b}, {b, a, c}, {a, c, b}, {c, b, a}};
  for (const auto& point : orbit) {
    for (int i = 0; i < 3; ++i) rule.point[next][i] = point[i];
    rule.weight[next++] = 0.082851075618373575194;
  }
  return rule;
}

// --- tetrahedra ------------------------------------------------------------------------------------------------------

/// Exact for degree 5 (Walkington).
constexpr SimplexRule<4, 14> tetrahedron_rule_5() {
  SimplexRule<4, 14> rule{};
  int next = detail::add_vertex_orbit(rule, 0, 0.31088591926330060980, 0.11268792571801585080);
  next = detail::add_vertex_orbit(rule, next, 0.092735250310891226402, 0.073493043116361949544);
  constexpr double far = 0.045503704125649649492;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) rule.point[next][k] = k == i || k == j ? 0.5 - far : far;
      rule.weight[next++] = 0.042546020777081466438;
    }
  return rule;
}

}  // namespace fsi
