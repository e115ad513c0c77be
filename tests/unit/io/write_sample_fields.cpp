// Writes fields.h5 and fields.xdmf into the folder given as argument: steps 0 and 8 of three planned ones.

#include <filesystem>

#include "driver/program.hpp"
#include "sample_fields.hpp"

int main(int, char** argv) {
  return fsi::run_program(argv[0], [&] {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const auto grids = fsi::test::sample_grids();
    fsi::FieldsWriter writer(folder, grids, fsi::planned_field_steps(16, 8, fsi::test::steps_of(0.125)));
    writer.write(0, fsi::test::sample_values(grids, 0.0));
    writer.write(8, fsi::test::sample_values(grids, 1.0));
    return 0;
  });
}
