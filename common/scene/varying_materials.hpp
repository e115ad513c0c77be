#pragma once

#include "case/case.hpp"
#include "scene/scene.hpp"
#include "wall/wall_problem.hpp"

namespace fsi {

/// Lets the constants of the wall's layers vary as the case says (docs/theory.md, section 4.8): each is looked up at the
/// quadrature points of the mesh, in its file and in regions with a transition. What stands for a layer where one number
/// must is the material at the means over its volume. Tells the scene the ranges, and the means in elements.
/// \throws InputError at all processes for a hole in a file's field, values that make no material, and a region in which
///         there is nothing of its layers
template <class Element>
void vary_materials(const Case& setup, WallProblem<Element>& wall, Scene<Element::components>& scene);

}  // namespace fsi
