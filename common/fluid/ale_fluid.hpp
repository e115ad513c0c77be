#pragma once

#include <optional>
#include <type_traits>

#include "fem/contributions.hpp"
#include "materials/viscosity_law.hpp"
#include "math/kinematics.hpp"

namespace fsi {

/// What the weak form takes for the viscosity: a number of its own, so that it costs nothing at a point,
struct ConstantViscosity {
  template <class T>
  using Value = Pack;
  template <class T>
  struct AtPoint {
    static constexpr bool shear_dependent = false;
  };
};
/// or that of a law, found at each point with its derivatives.
struct ShearDependentViscosity {
  template <class T>
  using Value = T;
  template <class T>
  struct AtPoint {
    static constexpr bool shear_dependent = true;
    T viscosity;  ///< kPa ms
  };
};

/// Incompressible Navier-Stokes equations in arbitrary Lagrangian-Eulerian form, pulled back to the reference domain,
/// with equal-order SUPG and PSPG stabilisation (docs/theory.md, section 3). With F = I + grad d_m, J = det F, w the
/// mesh velocity and c = u - w the residual is, for test functions v and q,
///   (rho J (du/dt + grad u F^-1 c), v) + (J sigma F^-T, grad v) - (J F^-T : grad u, q)
///   + sum over elements (J tau r, grad v F^-1 c) - (J tau r / rho, F^-T grad q),
///   sigma = mu (grad u F^-1 + (grad u F^-1)^T) - p I,   r = rho (du/dt + grad u F^-1 c) + F^-T grad p,
///   tau = ((2/dt)^2 + c . G c + 36 nu^2 G : G)^(-1/2),  G = F^-T (dxi/dX)^T (dxi/dX) F^-1,
/// optionally + (rho J tau_C F^-T : grad u, F^-T : grad v), tau_C = 1 / (tau tr G).
/// Everything is differentiated through, tau included. Elements without a metric (Taylor-Hood) get the first line alone.
///
/// tau vanishes with the step, and the PSPG term no longer stabilises the pressure. Where pressure travels at a finite
/// speed c_w a further term stabilises it at any step. It takes the part of the pressure gradient that its projection
/// does not represent, so that it hardly acts on smooth pressures:
///   - sum over elements (J tau_p / rho (F^-T grad p - pi), F^-T grad q),
///   tau_p = ((2/T)^2 + 36 nu^2 G_0 : G_0)^(-1/2) - ((2/dt)^2 + 36 nu^2 G_0 : G_0)^(-1/2),   T = max(dt, h / c_w).
/// pi is the pressure gradient of the step's reference level, projected on continuous functions
/// (pressure_projection.hpp), G_0 = (dxi/dX)^T (dxi/dX), h^2 = 3 / tr G_0.
///
/// Where the viscosity follows a law it is that of the point everywhere, mu(g) with g^2 = 2 D : D, D the symmetric part
/// of grad u F^-1, and is differentiated like the rest: ShearDependentFluid, below.
struct AleFluid {
  double density;    ///< mg/mm^3
  double viscosity;  ///< kPa ms; where there is a law, one that stands for it (docs/theory.md, section 3.9)
  bool grad_div = false;
  double step = 0;        ///< dt in tau, ms: that of the step in progress, set where the form is assembled
  double wave_speed = 0;  ///< c_w, mm/ms; 0: without the projected term
  std::optional<ViscosityLaw> law = {};  ///< of the viscosity, where it is no constant

  static constexpr double inverse_estimate = 36.0;  ///< C_I

  /// What depends on gradients alone. M: scalar of the domain's motion, T: of everything else.
  template <class M, class T, class Viscosity>
  struct Galerkin : Viscosity::template AtPoint<T> {
    static constexpr bool stabilised = false;
    Mat3<M> inverse_gradient;   ///< F^-1
    Mat3<M> cofactor_gradient;  ///< J F^-T
    M volume_ratio;             ///< J
    Mat3<T> velocity_gradient;  ///< grad u F^-1
    T divergence;               ///< its trace
  };
  /// The same with what stabilisation needs.
  template <class M, class T, class Viscosity>
  struct Stabilised : Galerkin<M, T, Viscosity> {
    using Number = typename Viscosity::template Value<T>;
    static constexpr bool stabilised = true;
    Sym3<M> metric;                           ///< G
    Product<M, Number> viscous_rate_squared;  ///< (2/dt)^2 + 36 nu^2 G : G
    Vec3<T> pressure_gradient;                ///< F^-T grad p
    Number projected_tau;                     ///< tau_p, ms
  };
  template <class Metric, class M, class T, class Viscosity>
  using PreparedAs =
      std::conditional_t<std::is_same_v<Metric, Unstabilised>, Galerkin<M, T, Viscosity>, Stabilised<M, T, Viscosity>>;
  template <class Metric, class M, class T>
  using Prepared = PreparedAs<Metric, M, T, ConstantViscosity>;

  /// mu at a point, kPa ms.
  template <class K>
  auto viscosity_at(const K& k) const {
    if constexpr (K::shear_dependent)
      return k.viscosity;
    else
      return Pack(viscosity);
  }
  /// 36 nu^2 at a point.
  template <class K>
  auto viscous_factor(const K& k) const {
    if constexpr (K::shear_dependent) {
      return Pack(inverse_estimate / (density * density)) * (k.viscosity * k.viscosity);
    } else {
      const double nu = viscosity / density;
      return Pack(inverse_estimate * nu * nu);
    }
  }

  /// tau_p in ms. \param metric  G_0, 1/mm^2
  Pack projected_tau(const Sym3<Pack>& metric) const {
    return projected_tau(metric, viscous_factor(ConstantViscosity::AtPoint<Pack>{}));
  }
  /// \param factor  36 nu^2
  template <class Number>
  Number projected_tau(const Sym3<Pack>& metric, const Number& factor) const {
    const Number viscous = factor * contract(metric, metric);
    const Pack of_wave = Pack(4.0 / 3.0 * wave_speed * wave_speed) * trace(metric);  // (2 c_w / h)^2
    const Pack of_step = Pack(4.0 / (step * step));
    return Pack(1.0) / sqrt(select(of_step > of_wave, of_wave, of_step) + viscous) -
           Pack(1.0) / sqrt(of_step + viscous);
  }

  /// \param grad_d, grad_u, grad_p  reference gradients of mesh displacement, velocity and pressure
  /// \param reference_metric        (dxi/dX)^T (dxi/dX), a Sym3<Pack>, or Unstabilised
  template <class M, class U, class Metric>
  auto prepare(const Mat3<M>& grad_d, const Mat3<U>& grad_u, const Vec3<U>& grad_p,
               const Metric& reference_metric) const {
    return prepare_as<ConstantViscosity>(grad_d, grad_u, grad_p, reference_metric);
  }
  template <class Viscosity, class M, class U, class Metric>
  auto prepare_as(const Mat3<M>& grad_d, const Mat3<U>& grad_u, const Vec3<U>& grad_p,
                  const Metric& reference_metric) const {
    PreparedAs<Metric, M, Product<M, U>, Viscosity> k;
    const auto f = deformation(grad_d);
    k.volume_ratio = f.volume_ratio;
    k.cofactor_gradient = f.cofactor_gradient;
    const M inverse_ratio = Pack(1.0) / f.volume_ratio;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) k.inverse_gradient(i, j) = inverse_ratio * f.cofactor_gradient(j, i);
    k.velocity_gradient = grad_u * k.inverse_gradient;
    if constexpr (decltype(k)::shear_dependent) k.viscosity = local_viscosity(*law, k.velocity_gradient);
    if constexpr (decltype(k)::stabilised) {
      k.metric = congruence(reference_metric, k.inverse_gradient);
      k.viscous_rate_squared = Pack(4.0 / (step * step)) + viscous_factor(k) * contract(k.metric, k.metric);
    }
    k.divergence = trace(k.velocity_gradient);
    if constexpr (decltype(k)::stabilised) {
      k.pressure_gradient = transposed_times(k.inverse_gradient, grad_p);
      k.projected_tau =
          wave_speed > 0 ? projected_tau(reference_metric, viscous_factor(k)) : typename decltype(k)::Number(0.0);
    }
    return k;
  }

  /// The momentum equation at a point.
  template <class T>
  struct Momentum {
    Vec3<T> inertia;          ///< rho (du/dt + grad u F^-1 c)
    Vec3<T> strong_residual;  ///< r, where there is stabilisation
    T tau;                    ///< ms, likewise
  };
  /// The scalar of inertia, and that of the stress, at a point. \tparam R, C, P  of du/dt, of c and of p
  template <class K, class R, class C>
  using Inertial = Sum<R, Product<decltype(K::divergence), C>>;
  template <class K, class R, class C, class P>
  using Stressed = std::conditional_t<K::stabilised, Sum<Inertial<K, R, C>, P>, Sum<decltype(K::divergence), P>>;

  /// \param k           Galerkin or Stabilised
  /// \param rate        du/dt at the point, mm/ms^2
  /// \param convection  c = u - w, mm/ms
  template <class K, class R, class C>
  Momentum<Inertial<K, R, C>> momentum(const K& k, const Vec3<R>& rate, const Vec3<C>& convection) const {
    Momentum<Inertial<K, R, C>> m;
    m.inertia = Pack(density) * (rate + k.velocity_gradient * convection);
    if constexpr (K::stabilised) {
      m.strong_residual = m.inertia + k.pressure_gradient;
      m.tau = Pack(1.0) / sqrt(k.viscous_rate_squared + dot(convection, k.metric * convection));
    }
    return m;
  }

  /// \param pressure            kPa
  /// \param projected_gradient  pi, kPa/mm
  template <class K, class R, class C, class P>
  auto integrand(const K& k, const Vec3<R>& rate, const Vec3<C>& convection, const P& pressure,
                 const Vec3<Pack>& projected_gradient = zero_vector()) const {
    using T = Stressed<K, R, C, P>;
    const auto& c = convection;
    const auto m = momentum(k, rate, c);

    // Stress, streamline and (optional) divergence stabilisation share the test gradient: one current tensor, pulled
    // back.
    Mat3<T> stress;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const auto viscous = viscosity_at(k) * (k.velocity_gradient(i, j) + k.velocity_gradient(j, i));
        if constexpr (K::stabilised) {
          stress(i, j) = viscous + (m.tau * m.strong_residual[i]) * c[j];
        } else {
          stress(i, j) = viscous;
        }
      }
    T isotropic = -pressure + T(0.0);
    if constexpr (K::stabilised)
      if (grad_div) isotropic += Pack(density) * k.divergence / (m.tau * trace(k.metric));
    for (int i = 0; i < 3; ++i) stress(i, i) += isotropic;

    using M = std::decay_t<decltype(k.volume_ratio)>;
    Integrand<Product<M, Inertial<K, R, C>>, Product<T, M>, Product<M, decltype(K::divergence)>> f;
    f.source = k.volume_ratio * m.inertia;
    f.flux = stress * k.cofactor_gradient;
    f.scalar_source = -(k.volume_ratio * k.divergence);
    if constexpr (K::stabilised) {
      Vec3<T> scaled = (m.tau * Pack(-1.0 / density)) * m.strong_residual;
      if (wave_speed > 0)
        scaled = scaled - (Pack(1.0 / density) * k.projected_tau) * (k.pressure_gradient - projected_gradient);
      f.scalar_flux = transposed_times(k.cofactor_gradient, scaled);  // J F^-1 r
    }
    return f;
  }

  /// Powers per reference volume, kPa/ms: what the integrand's terms but inertia become with v = u and q = -p. The
  /// pressure drops out.
  struct Power {
    Pack viscous;  ///< J mu (grad u F^-1 + (grad u F^-1)^T) : grad u F^-1
    /// J tau r . (grad u F^-1 c + F^-T grad p / rho) + J tau_p / rho (F^-T grad p - pi) . F^-T grad p, optionally
    /// + rho J tau_C (div u)^2
    Pack stabilisation;
  };
  template <class K>
  Power power(const K& k, const Vec3<Pack>& rate, const Vec3<Pack>& convection,
              const Vec3<Pack>& projected_gradient = zero_vector()) const {
    const Momentum<Pack> m = momentum(k, rate, convection);
    const auto& l = k.velocity_gradient;
    Pack shear(0.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) shear += (l(i, j) + l(j, i)) * l(i, j);
    Power power;
    power.viscous = viscosity_at(k) * k.volume_ratio * shear;
    power.stabilisation = Pack(0.0);
    if constexpr (K::stabilised) {
      power.stabilisation = m.tau * dot(m.strong_residual, l * convection + Pack(1.0 / density) * k.pressure_gradient);
      if (wave_speed > 0)
        power.stabilisation +=
            Pack(1.0 / density) * k.projected_tau * dot(k.pressure_gradient - projected_gradient, k.pressure_gradient);
      if (grad_div) power.stabilisation += Pack(density) * k.divergence * k.divergence / (m.tau * trace(k.metric));
      power.stabilisation *= k.volume_ratio;
    }
    return power;
  }

 private:
  static Vec3<Pack> zero_vector() { return {{Pack(0.0), Pack(0.0), Pack(0.0)}}; }
};

/// The same fluid where its viscosity follows a law. \pre law
struct ShearDependentFluid : AleFluid {
  template <class Metric, class M, class T>
  using Prepared = PreparedAs<Metric, M, T, ShearDependentViscosity>;

  template <class M, class U, class Metric>
  auto prepare(const Mat3<M>& grad_d, const Mat3<U>& grad_u, const Vec3<U>& grad_p,
               const Metric& reference_metric) const {
    return prepare_as<ShearDependentViscosity>(grad_d, grad_u, grad_p, reference_metric);
  }
};

}  // namespace fsi
