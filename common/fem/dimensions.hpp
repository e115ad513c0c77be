#pragma once

/// Code that depends on the number of components of vector fields only, and not on the element, is compiled for two
/// (plane and axisymmetric scenes) and three: declared in headers and instantiated once, in its own .cpp file.
#define FSI_FOR_EACH_DIMENSION(INSTANTIATE) \
  INSTANTIATE(2)                            \
  INSTANTIATE(3)
