#pragma once

#include <string>

#include "case/case.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/prescribed_inflow.hpp"

namespace fsi {

/// The velocity of an opening whose flow is given.
template <int n>
struct MadeInflow {
  PrescribedInflow<n> inflow;
  std::string instead;  ///< what was taken in place of the profile asked for, and why; empty: nothing
};

/// Makes the nodal profile that the case asks for at an opening with a flow rate (fluid/inflow_profile.hpp).
/// \param part  the fluid
/// \throws InputError when the fluid sticks at every node of the opening
template <class Element>
MadeInflow<Element::components> make_inflow(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& part,
                                            InflowNodes where);

}  // namespace fsi
