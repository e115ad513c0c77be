#include "fem/elements.hpp"
#include "wall/layer_loops_of.hpp"

namespace fsi {

#define FSI_INSTANTIATE(Element) template struct LayerLoops<Element, DispersedArtery>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
