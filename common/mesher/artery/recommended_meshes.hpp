#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/name_table.hpp"
#include "mesher/artery/options.hpp"

namespace fsi {

/// Which waves the steps of a run leave in its solution, and so what its mesh has to carry.
enum class Waves {
  damped,    ///< backward Euler with the paper's step, 1/8 ms: short waves die
  resolved,  ///< a scheme of second order with steps of 1/32 ms or less: they live, along the whole tube
};

/// Names of the two in case files and options.
const NameTable<Waves>& wave_kinds();

/// A mesh of the artery with the error that it leaves in the wave of the neo-Hookean case: the largest of t = 1.5, 3,
/// 4.5, 6, 7.5 and 9 ms of the relative L2 norm along z of the difference from a much finer mesh at the same time
/// steps, so that only space counts.
struct RecommendedMesh {
  std::string element;        ///< as in case files
  bool axisymmetric;          ///< else three-dimensional, whole or a sector
  Waves waves;                ///< the runs that it is for
  double pressure_error;      ///< of the centre-line pressure, percent
  double displacement_error;  ///< of the radial displacement of the inner wall, percent
  bool measured;              ///< else expected from the axisymmetric mesh of the same cells
  ArteryCells cells;

  double error() const { return pressure_error > displacement_error ? pressure_error : displacement_error; }
};

/// All of them: per element and geometry from few nodes to many.
const std::vector<RecommendedMesh>& recommended_meshes();

/// Where element and error were asked for, for messages: options of a program or keys of a case file.
struct AskedFor {
  std::string file, element, error;
};

/// The first one of that element, geometry and kind of waves whose pressure and displacement are both within `percent`.
/// Throws InputError naming `asked.element` for an element that has none, `asked.error` where none is as good as that.
const RecommendedMesh& recommended_mesh(const std::string& element, bool axisymmetric, Waves waves, double percent,
                                        const AskedFor& asked);

/// The number in "3%" or "0.5 %", if positive; else nothing: a number without the sign could mean a fraction.
std::optional<double> percent_of(const std::string& text);

/// Which cells a mesh has and what error it leaves, in one line for the console.
std::string to_text(const RecommendedMesh& mesh);

}  // namespace fsi
