#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "partitioned/accelerators/low_rank_map.hpp"
#include "partitioned/interface_space.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// What passes tell of an affine map r(x) = r_0 + S x of the interface whose slope S stays while r_0 changes: pairs
/// with S w_j = v_j, the v_j orthonormal, as in conjugate residual methods that recycle [Parks2006]. They are exact for
/// as long as S stays, so that what they span of a residual takes no further pass. The rest, u, is taken as a
/// fixed-point iteration would, but for a map L of low rank that knows S as it was before:
///   x <- x - W V^T r + (1 + L) u,   u = r - V V^T r.
/// A pair made of a small residual holds its rounding, and would leave a part of every residual that comes. Where the
/// pairs had all of a residual and yet leave something, they change by what is the least, of rank one, that explains
/// it:
///   W <- W + (dx - W V^T dr) (V^T dr)^T / |V^T dr|^2        (the second method of [Broyden1965]).
/// When S becomes another, pairs no longer hold and become part of L, which from then on maps v_j to -(w_j + v_j):
///   L <- L - (W + V + L V) V^T      (the multi-vector method, iqn_imvj.hpp).
class AffineMap {
 public:
  /// \param most    pairs kept, the latest, and rank of L, at most
  /// \param filter  what a change of the residual has beside the pairs at hand, relative to it, below which it is no
  ///                further one
  AffineMap(int most, double filter, const InterfaceSpace& space = {})
      : most_(static_cast<std::size_t>(most)), filter_(filter), space_(space), before_(space) {}

  /// The change of x that is to make r vanish. Collective, as are the other functions but columns() and clear().
  std::vector<double> correction(const std::vector<double>& r);
  /// Learns from the pass after the last correction().
  /// \param r         residual of that pass
  /// \param accuracy  relative error of the residual's change; 0: exact
  void learn(const std::vector<double>& r, double accuracy);
  /// From here on S is another, similar slope: pairs become part of L.
  void renew();
  /// From here on S has nothing in common with the last: forgets pairs and L.
  void clear();
  /// What corrections are made of: pairs and rank of L.
  int columns() const { return static_cast<int>(pairs_ + before_.rank()); }

  void keep(RestartArchive& archive, const std::string& name);

 private:
  using Columns = std::vector<double>;  ///< of as many numbers as an interface vector, one behind the other

  std::vector<double> products(const std::vector<double>& r) const;
  void add(const Columns& columns, const std::vector<double>& weights, std::vector<double>& to) const;
  std::vector<double> column(const Columns& columns, std::size_t j) const;
  /// Applies the rank-one update of W, so that the pairs explain the residual r after the last correction.
  void mend_pairs(const std::vector<double>& r);

  std::size_t most_;
  double filter_;
  InterfaceSpace space_;
  std::size_t size_ = 0, pairs_ = 0, next_ = 0;  ///< of a vector; at hand; the place of the next
  Columns w_, v_;
  LowRankMap before_;                           ///< L
  std::vector<double> corrected_, correction_;  ///< of the last correction r and the change of x,
  std::vector<double> unexplained_, step_;      ///< u and (1 + L) u
};

}  // namespace fsi
