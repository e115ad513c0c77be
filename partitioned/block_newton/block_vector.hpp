#pragma once

#include <cstddef>
#include <vector>

#include "algebra/vector_view.hpp"

namespace fsi {

/// The three parts of a block vector: one for each medium, and the datum of the interface, n numbers per node of the scene's
/// interface along the axes of space.
template <class T>
struct BlockView {
  VectorView<T> fluid, wall, datum;
};

/// Where fluid, wall and datum stand in a vector that holds all three, one behind the other. An iteration over both media
/// works on whole vectors, each medium on its part of them: nothing is copied between the two.
struct BlockLayout {
  std::size_t fluid = 0, wall = 0, datum = 0;  ///< numbers of each

  std::size_t size() const { return fluid + wall + datum; }
  /// \param whole  of size()
  BlockView<float> view(std::vector<float>& whole) const { return parts(whole.data()); }
  BlockView<const float> view(const std::vector<float>& whole) const { return parts(whole.data()); }

 private:
  template <class T>
  BlockView<T> parts(T* whole) const {
    return {{whole, fluid}, {whole + fluid, wall}, {whole + fluid + wall, datum}};
  }
};

}  // namespace fsi
