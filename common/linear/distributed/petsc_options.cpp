#include "linear/distributed/petsc_options.hpp"

#include <cctype>
#include <sstream>
#include <stdexcept>

#include "base/error.hpp"
#ifdef FSI_WITH_MPI
#include "linear/distributed/petsc_call.hpp"
#endif

namespace fsi {

namespace {

struct {
  std::string options, case_file;
#ifdef FSI_WITH_MPI
  std::string taken;  ///< what PETSc has
#endif
} given;

bool begins_with(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

std::vector<std::string> names_in(const std::string& options) {
  std::vector<std::string> names;
  std::istringstream words(options);
  for (std::string word; words >> word;)
    if (word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]))) names.push_back(word);
  return names;
}

}  // namespace

void set_petsc_options(const std::string& options, const std::string& case_file) {
  given.options = options;
  given.case_file = case_file;
}

const std::string& case_of_petsc_options() {
  return given.case_file;
}

bool has_petsc_options() {
  return !given.options.empty();
}

bool has_petsc_options(const std::string& prefix) {
  for (const auto& name : names_in(given.options))
    if (begins_with(name, "-" + prefix)) return true;
  return false;
}

const char* prefix_of(PetscPart part) {
  switch (part) {
    case PetscPart::wall:
      return "fsi_wall_";
    case PetscPart::mesh:
      return "fsi_mesh_";
    case PetscPart::direct:
      return "fsi_direct_";
    default:
      return "fsi_";
  }
}

#ifdef FSI_WITH_MPI

void take_petsc_options() {
  if (given.taken == given.options) return;
  for (const auto& name : names_in(given.taken)) petsc_check(PetscOptionsClearValue(nullptr, name.c_str()));
  given.taken = given.options;
  petsc_check(PetscOptionsInsertString(nullptr, given.options.c_str()));
}

void refuse_unread_petsc_options(PetscPart part) {
  for (const auto& name : names_in(given.options)) {
    PetscPart of = PetscPart::flow;
    for (const PetscPart other : {PetscPart::wall, PetscPart::mesh, PetscPart::direct})
      if (begins_with(name, std::string("-") + prefix_of(other))) of = other;
    if (of != part) continue;
    PetscBool used = PETSC_FALSE;
    petsc_check(PetscOptionsUsed(nullptr, name.c_str() + 1, &used));
    if (!used)
      throw InputError(given.case_file, "petsc.options", "\"" + name + "\" is no option of the solver as it is set up",
                       "see docs/guide/solvers.md; what PETSc knows is listed by -fsi_ksp_view and in its manual");
  }
}

void blame_petsc_options(const std::string& failure) {
  if (!has_petsc_options()) throw PetscFailure(failure);
  throw InputError(given.case_file, "petsc.options", failure, "correct \"" + given.options + "\"");
}

#endif

}  // namespace fsi
