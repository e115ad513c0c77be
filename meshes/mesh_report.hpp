#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "mesh_io/gmsh_reader.hpp"
#include "mesh_io/gmsh_writer.hpp"

namespace fsi {

inline constexpr const char* mesh_program = "fsi-mesh";

/// Options of the output, common to the commands of fsi-mesh.
struct MeshOutput {
  std::string file;
  std::string shown;  ///< its name in the report, if the file is moved later; empty: `file`
  GmshFormat format;
  int threads = 0;
  bool quiet = false;
  bool advise = false;  ///< report the cells across the lumen, and how many the elements need
};

void add_threads_option(CLI::App& command, int& threads);

/// -o, --format, --binary, --threads and -q.
void add_output_options(CLI::App& command, MeshOutput& output, bool file_required = true);

/// Refuses other extensions than .msh, which would promise another format. \throws InputError
void require_known_extension(const std::string& file);

/// Writes the mesh and reports its quality as the solvers will see it; warnings of bad elements go to stderr. Cells of
/// the fluid in corners (mesher/corner_cells.hpp) are divided first, which the report says.
/// \param plane     where a mesh of triangles lies
/// \param foreword  printed before the report; a sentence with its newline, or empty
/// \param warn      false: no warnings of bad elements, which are stretched on purpose
/// \throws InputError for a mesh that cannot be written, and a report that cannot
void write_and_report(const AnyMesh& given, const MeshOutput& output, TriangleGeometry plane,
                      const std::string& foreword = "", bool warn = true);

}  // namespace fsi
