#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "mesh_io/gmsh_writer.hpp"
#include "mesher/geo_script.hpp"

namespace fsi {

inline constexpr const char* mesh_program = "fsi-mesh";

/// What every command of fsi-mesh is told about its output.
struct MeshOutput {
  std::string file;
  std::string shown;  ///< what the report calls it, where it is to be moved; empty: its name
  GmshFormat format;
  int threads = 0;
  bool quiet = false;
  bool advise = false;  ///< for a shape of the user's: says what its cells across the lumen are good for
};

void add_threads_option(CLI::App& command, int& threads);

/// -o, --format, --binary, --threads and -q.
void add_output_options(CLI::App& command, MeshOutput& output, bool file_required = true);

/// The format is named by the version and --binary; another extension would promise another format.
/// \throws InputError
void require_known_extension(const std::string& file);

/// Writes the mesh and reports its quality as the solvers will see it; warnings of bad elements go to stderr. Cells of the
/// fluid in corners (mesher/corner_cells.hpp) are divided first, which the report says.
/// \param plane     where a mesh of triangles lies
/// \param foreword  printed before the report; a sentence with its newline, or empty
/// \param warn      false: its stretched elements are meant
void write_and_report(const AnyMesh& given, const MeshOutput& output, TriangleGeometry plane,
                      const std::string& foreword = "", bool warn = true);

}  // namespace fsi
