#include <fmt/format.h>
#include <cctype>
#include <sstream>

#include "case/case_keys.hpp"
#include "case/key_values.hpp"

namespace fsi {

namespace {

bool begins_with(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

/// Refuses options without our prefix, which could reach other objects of PETSc. Whether one with it exists,
/// PETSc itself checks once there is a solver.
void check_petsc(const CaseEntry& entry, PetscData& petsc) {
  std::istringstream words(petsc.options);
  bool first = true;
  for (std::string word; words >> word; first = false) {
    const bool option = word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
    if (option ? !begins_with(word, "-fsi_") : first)
      entry.refuse(fmt::format("options has \"{}\"", word),
                   "give options that begin with -fsi_, each with its value behind it (docs/guide/solvers.md)");
    for (const char* owned : {"-fsi_ksp_rtol", "-fsi_ksp_atol", "-fsi_ksp_max_it", "-fsi_mesh_ksp_rtol",
                              "-fsi_mesh_ksp_atol", "-fsi_mesh_ksp_max_it"})
      if (word == owned)
        entry.refuse(fmt::format("options has \"{}\", which each solve sets by what it is for", word),
                     "give linear.tolerance, or leave it out");
  }
}

}  // namespace

CaseKey<Case> petsc_section() {
  using P = PetscData;
  const std::vector<CaseKey<P>> keys = {
      leaf("options", false, "options of PETSc, all with the prefix -fsi_, as on its command line",
           any_text(at(&P::options))),
  };
  return section<P, Case>(
      "petsc", false, "for the linear solver petsc, and for whatever is solved by several processes", keys,
      [](Case& scene) -> P& { return scene.petsc; }, [](const Case& scene) { return &scene.petsc; }, KeyRole::running,
      check_petsc);
}

}  // namespace fsi
