#include "mesher/geo_script.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <vector>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "mesh_io/gmsh_session.hpp"
#include "mesh_io/temporary_mesh.hpp"

namespace fsi {

namespace {

constexpr std::uint64_t largest_script = 16 << 20;

std::string text_of(const std::filesystem::path& script) {
  constexpr const char* remedy = "give a gmsh script, .geo";
  require_regular_file(script, {"no such file", remedy, remedy, largest_script});
  std::ifstream stream(script, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(script.string(), "", "cannot be read", "check its permissions");
  return text;
}

/// gmsh takes any name without a word, so a misspelt one would change nothing.
void require_constants(const std::filesystem::path& script, const std::map<std::string, double>& numbers) {
  const std::string text = text_of(script);
  for (const auto& [name, value] : numbers) {
    if (!std::regex_match(name, std::regex("[A-Za-z_][A-Za-z0-9_]*")))
      throw InputError("--set", name, "is no name of a constant", "write --set name=number");
    if (!std::regex_search(text, std::regex("DefineConstant[^;]*\\b" + name + "\\b")))
      throw InputError(script.string(), name, "is no constant of the script",
                       "define it there: DefineConstant[ " + name + " = ... ];");
  }
}

/// Repeats an error about the mesh as one about the script that made it.
[[noreturn]] void refuse_mesh(const std::filesystem::path& script, const std::filesystem::path& file,
                              std::string said) {
  if (const auto name = file.string(); said.rfind(name + ": ", 0) == 0) said.erase(0, name.size() + 2);
  throw InputError(script.string(), "", "its mesh: " + said, "correct the script; gmsh itself shows the mesh");
}

/// Puts the sizes in place of all of the script's: those of points, curves and fields, and its bounds. These would keep
/// cells as long as they were where the error asks for shorter ones.
void set_sizes(const SizeField& sizes) {
  const std::size_t numbers = 4 * (static_cast<std::size_t>(sizes.dimension) + 1);
  const int view = gmsh::view::add("sizes");
  gmsh::view::addListData(view, sizes.dimension == 3 ? "SS" : "ST", static_cast<int>(sizes.simplices.size() / numbers),
                          sizes.simplices);
  const int field = gmsh::model::mesh::field::add("PostView");
  gmsh::model::mesh::field::setNumber(field, "ViewTag", view);
  gmsh::model::mesh::field::setAsBackgroundMesh(field);
  for (const char* other : {"Mesh.MeshSizeExtendFromBoundary", "Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature"})
    gmsh::option::setNumber(other, 0);
  gmsh::option::setNumber("Mesh.MeshSizeMin", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 1e22);  // gmsh's own: no bound
  gmsh::option::setNumber("Mesh.MeshSizeFactor", 1);  // the sizes are those of the mesh that it has been in
}

}  // namespace

AnyMesh mesh_of_geo_script(const std::filesystem::path& script, const std::map<std::string, double>& numbers, int order,
                           const std::filesystem::path& near, const SizeField* sizes) {
  require_constants(script, numbers);
  std::vector<std::string> arguments;
  for (const auto& [name, value] : numbers)
    arguments.insert(arguments.end(), {"-setnumber", name, fmt::format("{}", value)});

  const TemporaryMesh temporary(near, "geo-");
  int dimension = 0;
  std::string failure;
  {
    const GmshSession session(arguments);
    try {
      gmsh::option::setNumber("General.NumThreads", 1);
      gmsh::option::setNumber("Mesh.ElementOrder", order);
      gmsh::option::setNumber("Mesh.HighOrderOptimize", order > 1 ? 1 : 0);  // edges bent without folding cells
      gmsh::open(script.string());
      if (sizes != nullptr) set_sizes(*sizes);
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups);
      for (const auto& [group_dimension, tag] : groups) dimension = std::max(dimension, group_dimension);
      if (dimension >= 2) {
        gmsh::model::mesh::generate(dimension);
        gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
        gmsh::option::setNumber("Mesh.Binary", 1);
        gmsh::option::setNumber("Mesh.SaveAll", 0);
        gmsh::write(temporary.path().string());
      }
    } catch (...) {
      failure = GmshSession::last_error();
    }
  }
  if (!failure.empty())
    throw InputError(script.string(), "", "gmsh says: " + failure, "correct the script; gmsh itself shows the shape");
  if (dimension < 2)
    throw InputError(script.string(), "", "names no physical volume and no physical surface",
                     "add, for one, Physical Volume(\"fluid\") = {...};");
  try {
    // Drawn in the plane of x and y. Which kind of scene it is for is the case's to say.
    return read_gmsh(temporary.path(), gmsh_regions(temporary.path(), dimension), dimension, order,
                     TriangleGeometry::plane);
  } catch (const InputError& error) {
    refuse_mesh(script, temporary.path(), error.what());
  }
}

}  // namespace fsi
