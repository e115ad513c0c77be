#include "meshes/check_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "host/standard_streams.hpp"
#include "host/threads.hpp"
#include "mesh/boundary.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/facets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/flat_regions.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/opening_shape.hpp"
#include "mesh/overlap.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesh/surface_pieces.hpp"
#include "mesh/symmetry_planes.hpp"
#include "mesh/wall_faces.hpp"
#include "mesh_io/gmsh_file.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "mesh_io/temporary_mesh.hpp"
#include "mesher/corner_cells.hpp"
#include "meshes/converted.hpp"
#include "meshes/mesh_input.hpp"
#include "meshes/mesh_report.hpp"
#include "meshes/surface_input.hpp"

namespace fsi {

namespace {

struct CheckOptions {
  SurfaceInput input;
  double scale = 1;
  int threads = 0;
};

/// One line for each thing that is found.
class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  void note(const std::string& text) { text_ += text + "\n"; }
  void warning(const std::string& text, const std::string& remedy) { text_ += "warning: " + ended(text, remedy); }
  /// \param who  the program that it would stop
  void stop(const std::string& who, const std::string& text, const std::string& remedy) {
    text_ += "stops " + who + ": " + ended(text, remedy);
    ++stops_;
  }
  /// The text of an error without the file's name.
  void stop_by(const std::string& who, std::string error, const std::string& remedy) {
    for (const auto& name : {copy_, file_})
      if (!name.empty() && error.rfind(name + ": ", 0) == 0) error.erase(0, name.size() + 2);
    stop(who, error, remedy);
  }

  /// Options by which an import names the parts as they are taken here, with a blank before them.
  void import_needs(const std::string& options) { options_ = options; }
  const std::string& import_options() const { return options_; }

  /// Errors name this file then, which is made of the user's.
  void look_at_copy(const std::string& copy) { copy_ = copy; }

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }
  int stops() const { return stops_; }

 private:
  static std::string ended(const std::string& text, const std::string& remedy) {
    return text + (remedy.empty() ? "" : "; " + remedy) + "\n";
  }

  std::string file_, copy_, text_, options_;
  int stops_ = 0;
};

const std::string drivers = "fsi-monolithic and fsi-partitioned";

std::string import_with(const Findings& findings, const std::string& options) {
  return fmt::format("fsi-mesh import {}{} -o NEW.msh{}", printable(findings.file()), findings.import_options(),
                     options);
}

/// The command that mends a fault; empty where there is none.
std::string remedy_of(MeshFault::Kind kind, const Findings& findings) {
  using Kind = MeshFault::Kind;
  if (kind == Kind::unused_nodes || kind == Kind::inverted_cells) return import_with(findings, "") + " mends it";
  if (kind == Kind::doubled_nodes) return import_with(findings, " --join TOLERANCE") + " makes them one";
  return "";
}

template <int Dim, int Order>
class MeshDoctor {
  using Mesh = SimplexMesh<Dim, Order>;
  using Facet = typename Mesh::Facet;
  using Keys = std::set<FacetKey<Dim>>;

 public:
  MeshDoctor(const Mesh& mesh, TriangleGeometry geometry, Findings& findings)
      : mesh_(mesh), findings_(findings), fluid_(mesh.region_index(group::fluid)) {
    needs_.geometry = geometry;
    for (int r = 0; r < static_cast<int>(mesh.regions.size()); ++r)
      if (r != fluid_) {
        walls_.push_back(r);
        needs_.layers.push_back(mesh.regions[r]);
      }
    needs_.fluid = fluid_ >= 0;
    if (fluid_ >= 0)
      for (const auto& facet : boundary_facets(mesh, {fluid_})) fluid_sides_.insert(facet_key<Dim>(facet.nodes));
    if (!walls_.empty())
      for (const auto& facet : boundary_facets(mesh, walls_)) wall_sides_.insert(facet_key<Dim>(facet.nodes));
    sort_surfaces();
  }

  void examine(const std::vector<MeshFault>& of_reader) {
    for (const auto& fault : of_reader) findings_.stop_by(drivers, fault.text, remedy_of(fault.kind, findings_));
    const auto of_scene = scene_mesh_faults(mesh_, needs_, findings_.file());
    for (const auto& fault : of_scene)
      if (!is_known(fault, of_reader)) findings_.stop_by(drivers, fault.text, remedy_of(fault.kind, findings_));
    if (Dim == 2 && of_reader.empty() && of_scene.empty()) at_rest();
    corners();
    overlapping();
    openings();
    walls();
    if (of_reader.empty()) quality();
  }

 private:
  /// Groups of facets by where they lie: as a case would use them.
  void sort_surfaces() {
    for (const auto& group : mesh_.facet_groups) {
      if (group.facets.empty() || group::is_symmetry_plane(group.name)) continue;
      const auto all = [&](const Keys& on, const Keys& off) {
        return std::all_of(group.facets.begin(), group.facets.end(), [&](const Facet& facet) {
          const auto key = facet_key<Dim>(facet);
          return on.count(key) > 0 && off.count(key) == 0;
        });
      };
      const std::string& name = group.name;
      if (name == group::inlet || name == group::outlet) {
        (name == group::inlet ? needs_.inlet : needs_.outlet) = true;
        openings_.push_back(&group);
      } else if (name == group::outer || name == group::inner || name == group::wall_ends || name == group::wall) {
        if (name == group::inner) needs_.inner_surface = fluid_ < 0;
      } else if (all(fluid_sides_, wall_sides_)) {
        if (!looks_one_way(group.facets)) continue;  // the side of a rigid wall
        needs_.openings.push_back(name);
        openings_.push_back(&group);
      } else if (all(wall_sides_, fluid_sides_)) {
        needs_.supports.push_back(name);
      }
    }
    needs_.holding.insert(needs_.holding.end(), needs_.supports.begin(), needs_.supports.end());
    needs_.clamping = needs_.holding;
    // Any face may be held by a support. What a case names is not known here.
    for (const char* name : {group::outer, group::inner})
      if (mesh_.facets(group::wall_ends) == nullptr && mesh_.facets(name) != nullptr) needs_.holding.emplace_back(name);
  }

  bool looks_one_way(const std::vector<Facet>& facets) const {
    Point sum{0, 0, 0};
    double size = 0;
    for (const auto& f : facets) {
      const Point vector = Dim == 3
                               ? triangle_area_vector(mesh_.nodes[f[0]], mesh_.nodes[f[1]], mesh_.nodes[f[Dim - 1]])
                               : mesh_.nodes[f[1]] - mesh_.nodes[f[0]];
      sum = sum + vector;
      size += norm(vector);
    }
    return norm(sum) > 0.5 * size;
  }

  /// Curved cells are looked at by the reader and again by the drivers' checks.
  static bool is_known(const MeshFault& fault, const std::vector<MeshFault>& known) {
    return fault.kind == MeshFault::Kind::folded_curved_cells &&
           std::any_of(known.begin(), known.end(), [&](const MeshFault& other) { return other.kind == fault.kind; });
  }

  void corners() {
    const auto cells = corner_cells(mesh_);
    if (cells.empty()) return;
    findings_.stop(
        drivers + " with the element p2p1 where the velocity is given all round",
        fmt::format("cells of the fluid in corners, {} {}, have pressures without an equation, the first at {}",
                    cells.size(), cells.size() == 1 ? CellWords<Dim>::cell : CellWords<Dim>::cells,
                    place_of(centre_of_vertices(mesh_, cells.front()))),
        std::filesystem::path(findings_.file()).extension() == ".msh"
            ? fmt::format("fsi-mesh refine {} --times 0 -o NEW.msh divides them", printable(findings_.file()))
            : import_with(findings_, "") + " divides them");
  }

  void overlapping() {
    for (const auto& overlap : overlaps(mesh_))
      findings_.stop(drivers + " sooner or later",
                     fmt::format("{} cells of {} reach into cells of {}, one at {}: they overlap", overlap.cells,
                                 mesh_.regions[overlap.of],
                                 overlap.of == overlap.within ? "the same volume" : mesh_.regions[overlap.within],
                                 place_of(overlap.first)),
                     overlap.of == overlap.within ? "mesh it again" : "mesh both together, with one shared surface");
  }

  void openings() {
    if (fluid_ < 0) return;
    for (const auto* opening : openings_) {
      const auto pieces = pieces_of<Dim>(mesh_.nodes, opening->facets);
      std::string what, wrong = said_of<Dim>(pieces);
      if constexpr (Dim == 3) {
        const auto shape = shape_of_opening(mesh_.nodes, opening->facets);
        what = to_text(shape);
        if (pieces.whole()) wrong = said_of(shape);
      } else {
        what = places_of<Dim>(pieces.pieces);
      }
      if (pieces.pieces.size() == 1) findings_.note(fmt::format("opening {}: {}, one piece", opening->name, what));
      if (!wrong.empty())
        findings_.warning(fmt::format("opening {} {}", opening->name, wrong),
                          "give each flat end a name of its own: --opening NAME=X,Y,Z of fsi-mesh import");
    }
    if constexpr (Dim == 3) unnamed_ends();
  }

  /// Flat parts of the fluid's surface that may be openings.
  void unnamed_ends() {
    Keys named = wall_sides_;
    for (const auto& group : mesh_.facet_groups)
      for (const auto& facet : group.facets) named.insert(facet_key<Dim>(facet));
    std::vector<std::string> places, words;
    for (const auto& part : unnamed_flat_parts(mesh_)) {
      places.push_back(fmt::format("{:.3g} mm^2 about {}", part.area, place_of(part.centre)));
      const Point at = without_rounding(part.centre);
      words.push_back(fmt::format(" --opening NAME{}={:.4g},{:.4g},{:.4g}", words.size() + 1, at[0], at[1], at[2]));
    }
    if (places.empty()) {
      const bool open = std::any_of(fluid_sides_.begin(), fluid_sides_.end(),
                                    [&](const FacetKey<Dim>& side) { return named.count(side) == 0; });
      if (openings_.empty() && open)
        findings_.warning("the fluid has no opening: no flat end with a sharp rim, and no surface with a name",
                          "name the ends where the mesh is made, or say closed in the case");
      return;
    }
    const auto text = fmt::format("flat parts of the fluid's surface have no name: {}", fmt::join(places, ", "));
    const auto remedy = import_with(findings_, fmt::format("{}", fmt::join(words, ""))) + " names them";
    if (openings_.empty())
      findings_.stop(drivers, text, remedy);
    else
      findings_.note(text + "; where they are openings, " + remedy);
  }

  /// What static runs and prestress alone refuse.
  void at_rest() {
    SceneMeshNeeds needs = needs_;
    needs.at_rest = true;
    for (const auto& fault : scene_mesh_faults(mesh_, needs, findings_.file()))
      findings_.note("static runs and prestress refuse it: " + fault.text);
  }

  void walls() {
    if (walls_.empty()) return;
    if (fluid_ < 0 && mesh_.facets(group::inner) == nullptr)
      findings_.note(
          "wall: its inner face has no name, so its thickness is not known; pressures act on a surface inner: " +
          import_with(findings_, " --wall-faces") + " names the faces of a tube");
    for (const auto& range : thickness_ranges(mesh_)) {
      const int region = mesh_.region_index(range.name);
      const int layers = region >= 0 ? element_layers(mesh_, region) : 0;
      std::string text = to_text(std::vector<ThicknessRange>{range});
      text.pop_back();
      findings_.note(text + (layers > 0 ? fmt::format("; {} {} across", layers, layers == 1 ? "cell" : "cells") : ""));
    }
  }

  void quality() {
    const auto measured = measure_quality(mesh_);
    for (const auto& line : warnings_of(measured)) {
      // Quadratic cells may be long and thin, as those of recommended meshes are (docs/guide/meshes.md).
      if (Order == 2 && measured.min_jacobian >= poor_jacobian)
        findings_.note(line);
      else
        findings_.warning(line, "");
    }
  }

  const Mesh& mesh_;
  Findings& findings_;
  int fluid_;
  std::vector<int> walls_;
  Keys fluid_sides_, wall_sides_;
  SceneMeshNeeds needs_;
  std::vector<const typename Mesh::FacetGroup*> openings_;
};

std::string size_of(std::size_t nodes, std::size_t cells, int dim, int order, const std::vector<std::string>& regions) {
  return fmt::format("{} nodes, {} {}{}: {}", nodes, cells, order == 2 ? "quadratic " : "",
                     dim == 3 ? "tetrahedra" : "triangles", fmt::join(regions, ", "));
}

template <int Dim, int Order>
void examine(const std::string& file, const std::vector<std::string>& regions, TriangleGeometry plane,
             Findings& findings) {
  std::vector<MeshFault> faults;
  SimplexMesh<Dim, Order> mesh;
  try {
    mesh = read_gmsh<Dim, Order>(file, regions, plane, &faults);
  } catch (const InputError& error) {
    for (const auto& fault : faults) findings.stop_by(drivers, fault.text, remedy_of(fault.kind, findings));
    findings.stop_by(drivers, error.what(), "");
    return;
  }
  findings.note(size_of(mesh.nodes.size(), mesh.cells.size(), Dim, Order, mesh.regions));
  MeshDoctor<Dim, Order>(mesh, plane, findings).examine(faults);
}

void examine_layout(const std::string& file, const MeshLayout& layout, Findings& findings) {
  const auto& regions = layout.regions;
  if (layout.dimension == 3) {
    layout.order == 1 ? examine<3, 1>(file, regions, layout.plane, findings)
                      : examine<3, 2>(file, regions, layout.plane, findings);
    return;
  }
  const auto examined_as = [&](TriangleGeometry geometry) {
    Findings found = findings;
    layout.order == 1 ? examine<2, 1>(file, regions, geometry, found) : examine<2, 2>(file, regions, geometry, found);
    return found;
  };
  Findings found = examined_as(layout.plane);
  // Sections in the plane z = 0 are plane or axisymmetric, which only a case says.
  if (found.stops() > findings.stops() && layout.plane == TriangleGeometry::plane)
    if (Findings other = examined_as(TriangleGeometry::axisymmetric); other.stops() < found.stops()) {
      other.note("taken for a section of an axisymmetric body");
      found = other;
    }
  findings = found;
}

/// What fsi-compare finds, which knows all formats: units, gaps, doubled points. \param into  a file for the mesh, or
/// empty
void examine_places(const CheckOptions& options, const std::string& into, Findings& findings) {
  std::vector<std::string> words{"convert-mesh", "--examine", "--scale", fmt::format("{}", options.scale)};
  if (!into.empty()) words.insert(words.end(), {"-o", into});
  words.insert(words.end(), {"--", options.input.file});
  std::istringstream lines(converted(options.input.file, words));
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("warning: ", 0) == 0)
      findings.warning(line.substr(9), "");
    else if (const std::string mark = "options:"; line.rfind(mark, 0) == 0)
      findings.import_needs(line.substr(mark.size()));
    else
      findings.note(line);
  }
}

void examine_mesh(const CheckOptions& options, Findings& findings) {
  const std::string& file = options.input.file;
  const bool of_gmsh = std::filesystem::path(file).extension() == ".msh";
  bool ours = of_gmsh && options.scale == 1;
  if (of_gmsh) {
    const auto parsed = parse_gmsh(file);  // a file that cannot be read ends here
    const bool named =
        std::any_of(parsed.names.begin(), parsed.names.end(), [](const auto& name) { return name.dimension >= 2; });
    if (!named)
      findings.stop(drivers, "the file names no physical groups",
                    import_with(findings, " --group fluid=PART") + ", with parts that --list shows");
    ours = ours && named;
  }
  if (ours) {
    examine_places(options, "", findings);
    examine_layout(file, mesh_layout(file), findings);
    return;
  }
  const TemporaryMesh temporary(std::filesystem::temp_directory_path() / "check.msh", "check-");
  const std::string copy = temporary.path().string();
  examine_places(options, copy, findings);
  findings.look_at_copy(copy);
  auto layout = mesh_layout(copy);
  layout.plane = TriangleGeometry::plane;
  examine_layout(copy, layout, findings);
}

bool is_surface(const std::string& file) {
  auto extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".stl" || extension == ".ply" || extension == ".obj" || extension == ".vtp";
}

const std::string lumen_program = "fsi-mesh lumen";

void examine_surface(const CheckOptions& options, Findings& findings) {
  const auto surface = triangles_of_file(options.input);  // a file that cannot be read ends here
  const Point extent = BoundingBox(surface.nodes).extent();
  const auto extents = [&](double factor) {
    return fmt::format("{:.3g} x {:.3g} x {:.3g} mm", factor * extent[0], factor * extent[1], factor * extent[2]);
  };
  findings.note(fmt::format("surface of {} points and {} triangles: {}", surface.nodes.size(), surface.triangles.size(),
                            options.input.unit.empty()
                                ? fmt::format("{} in mm, {} in cm, {} in m", extents(1), extents(10), extents(1000))
                                : extents(1)));
  std::vector<std::string> done;
  try {
    const auto lumen = read_lumen_surface(options.input, done);
    for (const auto& sentence : done) findings.note(sentence);
    for (std::size_t i = 0; i < lumen.openings.size(); ++i) {
      const auto& opening = lumen.openings[i];
      findings.note(fmt::format("opening {}: {}, {:.4g} mm^2, radius {:.4g} mm, at {}", i + 1,
                                opening.capped ? "a flat cap" : "a hole", opening.area, opening.diameter() / 2,
                                place_of(opening.centre)));
    }
    if (const auto fault = not_a_lumen(lumen)) findings.stop(lumen_program, "surface: " + fault.problem, fault.remedy);
  } catch (const InputError& error) {
    findings.stop_by(lumen_program, error.what(), "");
  }
}

void check(const CheckOptions& options) {
  set_threads(options.threads);
  Findings findings(options.input.file);
  const bool surface = is_surface(options.input.file);
  if (surface)
    examine_surface(options, findings);
  else
    examine_mesh(options, findings);
  print(findings.text());
  if (findings.stops() > 0)
    throw InputError(options.input.file, "",
                     fmt::format("{} of the lines above would stop {}",
                                 findings.stops() == 1 ? "one" : std::to_string(findings.stops()),
                                 surface ? lumen_program : "a driver"),
                     "mend them and check again");
}

}  // namespace

MeshCommand check_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "check", "What is wrong with a mesh or a surface: a line for each thing, with its place and what mends it");
  const auto options = std::make_shared<CheckOptions>();
  command
      ->add_option("file", options->input.file,
                   "A mesh that import or the drivers read, or a surface: .stl, .ply, .obj, .vtp. Ends with 0 where "
                   "nothing would stop a driver, or fsi-mesh lumen, else with 1")
      ->required();
  command->add_option("--scale", options->scale, "Of a mesh: from the file's unit of length to mm")
      ->capture_default_str();
  command->add_option("--unit", options->input.unit, "Of a surface: its unit of length; mm unless given")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  add_threads_option(*command, options->threads);
  return {command, [options] { check(*options); }};
}

}  // namespace fsi
