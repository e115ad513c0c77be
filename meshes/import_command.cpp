#include "meshes/import_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/names.hpp"
#include "base/output_file.hpp"
#include "host/removed_on_signal.hpp"
#include "host/standard_streams.hpp"
#include "host/threads.hpp"
#include "mesh_io/gmsh_file.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "mesh_io/temporary_mesh.hpp"
#include "mesher/name_wall_faces.hpp"
#include "meshes/converted.hpp"
#include "meshes/mesh_input.hpp"
#include "meshes/mesh_report.hpp"
#include "meshes/options.hpp"

namespace fsi {

namespace {

struct ImportRequest {
  std::vector<std::string> files;
  std::vector<std::string> groups, openings;
  std::string units, fibre_angle;  ///< of a case
  double scale = 1, join = 0;
  int order = 0;
  bool list = false, wall_faces = false, flat_ends = false;
  MeshOutput output;
};

/// What messages call the mesh.
std::string named(const ImportRequest& request) {
  return fmt::format("{}", fmt::join(request.files, " "));
}

/// Converts the files by fsi-compare, whose readers are Python's. Returns what it printed.
std::string convert(const ImportRequest& request, const std::vector<std::string>& more) {
  std::vector<std::string> words{"convert-mesh", "--scale", fmt::format("{}", request.scale)};
  if (request.join != 0) words.insert(words.end(), {"--join", fmt::format("{}", request.join)});
  for (const auto& group : request.groups) words.insert(words.end(), {"--group", group});
  words.insert(words.end(), more.begin(), more.end());
  words.emplace_back("--");
  words.insert(words.end(), request.files.begin(), request.files.end());
  // Of several files, and of NAME=FILE, the message names the one at fault.
  const bool one = request.files.size() == 1 && request.files.front().find('=') == std::string::npos;
  return converted(one ? request.files.front() : "", words, request.output.quiet);
}

/// The converted mesh, named as the options ask. \param said  sentences on what was named are added to it
AnyMesh read_any(const ImportRequest& request, const std::filesystem::path& file, std::string& said) {
  const auto openings = flat_parts_of(request.openings);
  const int dimension = gmsh_dimension(file);
  if (dimension != 3 && !openings.empty())
    throw InputError(named(request), "--opening", "is for meshes of volumes", "name curves by --group");
  for (const auto& [option, asked] :
       {std::pair{"--wall-faces", request.wall_faces}, std::pair{"--flat-ends", request.flat_ends}})
    if (dimension != 3 && asked)
      throw InputError(named(request), option, "is for meshes of volumes", "name curves by --group");
  // Second-order cells keep their order unless another is asked for.
  const int order = request.order > 0 ? request.order : gmsh_order(parse_gmsh(file), dimension);
  AnyMesh mesh;
  try {
    mesh = read_gmsh(file, gmsh_regions(file, dimension), dimension, order, TriangleGeometry::plane);
  } catch (const InputError& error) {
    refuse_file(named(request), file.string(), error.what());
  }
  std::visit(
      [&](auto& read) {
        warn_of_astray(named(request), read);
        if constexpr (std::decay_t<decltype(read)>::dim == 3) {
          name_flat_parts(read, openings);
          if (request.flat_ends) said += name_flat_ends(read);
          if (request.wall_faces) said += name_wall_faces(read, named(request));
        }
      },
      mesh);
  return mesh;
}

/// A file of XML that is to become a folder is a case: case.toml and mesh.msh, not a mesh alone.
bool is_case(const ImportRequest& request) {
  return request.files.size() == 1 &&
         lower_case(std::filesystem::path(request.files.front()).extension().string()) == ".xml" && !request.list &&
         lower_case(std::filesystem::path(request.output.file).extension().string()) != ".msh";
}

/// A folder beside the one that it is to become; removed with what is in it unless it was moved to its name.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::filesystem::path& final_name)
      : final_name_(final_name),
        path_(final_name.string() + fmt::format(".{}.part", getpid())),
        on_signal_(path_, FilesInside::go) {
    std::error_code error;
    if (std::filesystem::exists(final_name_, error))
      throw InputError(final_name_.string(), "", "is there already", "name another folder with -o, or remove it");
    if (!std::filesystem::create_directory(path_, error) || error)
      throw InputError(final_name_.string(), "", "cannot be made: " + error.message(), "name another folder with -o");
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void move_into_place() const {
    std::error_code error;
    std::filesystem::rename(path_, final_name_, error);
    if (error)
      throw InputError(final_name_.string(), "", "cannot be made: " + error.message(), "name another folder with -o");
  }

 private:
  std::filesystem::path final_name_, path_;
  RemovedOnSignal on_signal_;
};

/// The path without the slash that a shell leaves behind a folder's name.
std::filesystem::path folder_of(const std::string& given) {
  std::filesystem::path folder(given);
  return folder.has_filename() ? folder : folder.parent_path();
}

void make_case(const ImportRequest& request) {
  const auto refuse = [](const char* option, const char* remedy) {
    throw InputError(mesh_program, option, "is not for cases", remedy);
  };
  if (!request.groups.empty()) refuse("--group", "the case names its faces");
  if (!request.openings.empty()) refuse("--opening", "the case names its faces");
  if (request.wall_faces) refuse("--wall-faces", "the case names its faces");
  if (request.flat_ends) refuse("--flat-ends", "the case names its faces");
  if (request.scale != 1) refuse("--scale", "give --units");
  if (request.output.file.empty())
    throw InputError(mesh_program, "--output", "is not given", "give -o FOLDER, which is made");
  set_threads(request.output.threads);
  const auto folder = folder_of(request.output.file);
  const TemporaryFolder made(folder);
  std::vector<std::string> words{"convert-case", "-o", made.path().string()};
  if (!request.units.empty()) words.insert(words.end(), {"--units", request.units});
  // In one word: it may begin with a minus.
  if (!request.fibre_angle.empty()) words.emplace_back("--fibre-angle=" + request.fibre_angle);
  if (request.join != 0) words.insert(words.end(), {"--join", fmt::format("{}", request.join)});
  words.insert(words.end(), {"--", request.files.front()});
  std::string said = converted("", words, request.output.quiet);
  ImportRequest mesh = request;
  const auto given = made.path() / "given.msh";
  mesh.output.file = (made.path() / "mesh.msh").string();
  mesh.output.shown = (folder / "mesh.msh").string();
  const AnyMesh read = read_any(mesh, given, said);
  write_and_report(read, mesh.output, TriangleGeometry::plane, said);
  std::filesystem::remove(given);
  made.move_into_place();
  if (!request.output.quiet)
    print(fmt::format("{0}: case.toml, mesh.msh and import.log. Look at it by fsi-monolithic {0}/case.toml --check.\n",
                      folder.string()));
}

void make(const ImportRequest& request) {
  if (is_case(request)) {
    make_case(request);
    return;
  }
  if (!request.units.empty() || !request.fibre_angle.empty())
    throw InputError(mesh_program, request.units.empty() ? "--fibre-angle" : "--units", "is for cases (.xml) alone",
                     "give --scale for the unit of a mesh");
  if (request.list) {
    print(convert(request, {"--list"}));
    return;
  }
  if (request.output.file.empty())
    throw InputError(mesh_program, "--output", "is not given", "give -o FILE.msh, or --list");
  require_known_extension(request.output.file);
  set_threads(request.output.threads);
  const TemporaryMesh temporary(regular_output_file(request.output.file), "import-");
  std::string said = convert(request, {"-o", temporary.path().string()});
  const AnyMesh mesh = read_any(request, temporary.path(), said);
  write_and_report(mesh, request.output, TriangleGeometry::plane, said);
}

}  // namespace

MeshCommand import_command(CLI::App& app) {
  auto* options = app.add_subcommand(
      "import", "A mesh of another program: VTU, MED, Exodus, Abaqus, ...; a case of svMultiPhysics");
  const auto request = std::make_shared<ImportRequest>();
  options
      ->add_option(
          "files", request->files,
          "The mesh: simplices, as VTU, XDMF, Exodus, MED, Abaqus or what meshio reads; NAME=FILE: all cells of "
          "the file, or triangles of a .vtp, are NAME; or a case, solver.xml of svMultiPhysics, with -o FOLDER")
      ->required();
  options->add_flag("--list", request->list, "Say which parts the file names or numbers, and write nothing");
  options->add_option("--group", request->groups,
                      "NAME=PART: a volume or surface of this name, from a part that --list shows; sets of points give "
                      "the surface between them; unless given all parts with a name of their own");
  options->add_option("--opening", request->openings,
                      "NAME=X,Y,Z: surface of the fluid, the flat part of its boundary on which this point lies");
  options->add_flag("--flat-ends", request->flat_ends,
                    "Names the flat ends of the fluid that have no name: end_1, end_2 and so on, the largest first");
  options->add_flag("--wall-faces", request->wall_faces,
                    "Of a wall without fluid: names its faces inner and outer and its plane ends wall_ends");
  options->add_option("--scale", request->scale, "From the file's unit of length to mm: 1000 for a mesh in m")
      ->capture_default_str();
  options->add_option(
      "--join", request->join,
      "Points at most so far apart, mm, are one; unless given, those of different files that agree in single "
      "precision");
  options->add_option("--units", request->units,
                      "Of a case (CASE.xml -o FOLDER), which says none: cgs, the default, si or mm-g-s");
  options->add_option("--fibre-angle", request->fibre_angle,
                      "Of a case that gives fibres by vectors: degrees between fibre and circumference");
  options->add_option("--order", request->order, "1: straight edges; 2: quadratic cells; the file's unless given")
      ->check(CLI::Range(1, 2));
  add_output_options(*options, request->output, false);
  return {options, [request] { make(*request); }};
}

}  // namespace fsi
