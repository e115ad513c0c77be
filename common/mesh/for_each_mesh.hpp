#pragma once

/// The kinds of meshes (dimension, order) that the routines of this folder are compiled for: declared in headers and
/// instantiated once, in their own .cpp files, by INSTANTIATE(dimension, order).
#define FSI_FOR_EACH_MESH(INSTANTIATE) \
  INSTANTIATE(2, 1)                    \
  INSTANTIATE(2, 2)                    \
  INSTANTIATE(3, 1)                    \
  INSTANTIATE(3, 2)
