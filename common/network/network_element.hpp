#pragma once

#include <optional>
#include <string>

namespace fsi {

/// When the equations of a network hold, and how rates are made there.
struct NetworkMoment {
  /// 1/k, ms, of what elements keep: dy/dt = (y - r) / lag with r known, at a balance of a time scheme (docs/theory.md,
  /// section 8.4). 0: y is known and r itself, at a finished level.
  double lag = 0;
  double time = 0;  ///< ms
};

/// A lumped element between two nodes of a network (docs/theory.md, section 3.10): an equation between the drop of the
/// pressure from its first end to its second, and the flow that way. It may keep a number y of its own, a volume or a
/// flow, which time schemes march like any other quantity. Units: kPa, mm^3/ms, ms, mm^3.
class NetworkElement {
 public:
  /// f(drop, flow) = 0, with the derivatives of f.
  struct Equation {
    double value, by_drop, by_flow;
  };
  enum class Keeps { nothing, volume, flow };

  virtual ~NetworkElement() = default;

  /// \param reference  r of what it keeps; not read where that is nothing
  virtual Equation equation(const NetworkMoment& at, double reference, double drop, double flow) const = 0;
  virtual Keeps keeps() const { return Keeps::nothing; }
  /// y at the start.
  virtual double start() const { return 0; }
  /// y at a balance with this drop and flow.
  virtual double kept(const NetworkMoment& /*at*/, double reference, double /*drop*/, double /*flow*/) const {
    return reference;
  }
  /// dy/dt there.
  virtual double rate(double /*drop*/, double /*flow*/) const { return 0; }

  /// A parameter that does not go with the others.
  struct Contradiction {
    std::string parameter, problem, remedy;
  };
  virtual std::optional<Contradiction> contradiction() const { return std::nullopt; }

  /// Whether f is not affine, since the element opens and closes by the drop.
  virtual bool switches() const { return false; }
  /// kPa ms/mm^3: weight of f, a flow, against pressures, of an element that switches.
  virtual double resistance_of_residual() const { return 1; }
  /// ms, with which it repeats itself; 0: it does not.
  virtual double period() const { return 0; }
  /// In words. \param volume  the unit of volume, with which units are made: of a plane scene an area
  virtual std::string description(const std::string& volume) const = 0;
};

}  // namespace fsi
