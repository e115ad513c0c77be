#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "fluid/womersley_inflow.hpp"
#include "mesh/mesh_share.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/prescribed_inflow.hpp"

namespace fsi {

/// The velocity of an opening whose flow is given: a nodal profile of unit flow or one that changes in time.
struct Inflow {
  std::size_t opening;                         ///< its number
  std::vector<int> nodes;                      ///< whose velocity is prescribed
  std::vector<double> profile;                 ///< vector layout, 1/mm^2; empty: the other one holds
  std::shared_ptr<WomersleyInflow> womersley;  ///< null: the other one holds
  std::string instead;   ///< what was taken in place of the profile asked for, and why; empty: nothing
  std::string remark{};  ///< what it is made of; empty: nothing to say
};

/// Makes the profile that the case asks for at an opening with a flow rate (fluid/inflow_profile.hpp).
/// \param part  the whole fluid
/// \param where  nodes of the opening, and where the fluid sticks
/// \throws InputError when the fluid sticks at every node of the opening, its mean normal is zero, or it is no
///         rectangle for a biparabolic profile
template <class Element>
Inflow make_inflow(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& part, InflowNodes where);

/// Restricts an inflow of the whole fluid to the nodes that this process holds.
template <int n>
void restrict_to(const PartRestriction& here, Inflow& inflow);

/// The boundary condition of an inflow. \param nodes  how many the fluid has here
template <int n>
PrescribedInflow<n> prescribed(Inflow inflow, int nodes);

}  // namespace fsi
