#pragma once

#include <string>

#include "case/case.hpp"
#include "mesh/mesh_share.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/prescribed_inflow.hpp"

namespace fsi {

/// The velocity of an opening whose flow is given.
template <int n>
struct MadeInflow {
  PrescribedInflow<n> inflow;
  std::string instead;   ///< what was taken in place of the profile asked for, and why; empty: nothing
  std::string remark{};  ///< what it is made of; empty: nothing to say
};

/// Makes the nodal profile that the case asks for at an opening with a flow rate (fluid/inflow_profile.hpp).
/// \param part  the whole fluid
/// \param here  the nodes of it that the inflow is made for; null: all
/// \throws InputError when the fluid sticks at every node of the opening
template <class Element>
MadeInflow<Element::components> make_inflow(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& part,
                                            InflowNodes where, const PartRestriction* here = nullptr);

}  // namespace fsi
