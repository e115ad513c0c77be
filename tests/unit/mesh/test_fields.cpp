// Fields of files at any place, and shapes of regions.

#include <gtest/gtest.h>
#include <lzma.h>
#include <zlib.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "fields/field_units.hpp"
#include "fields/near_points.hpp"
#include "fields/point_field.hpp"
#include "fields/point_table.hpp"
#include "fields/region_shape.hpp"
#include "fields/vtk_file.hpp"

namespace fsi::test {

namespace {

double linear(const Point& x) {
  return 2 + 3 * x[0] - x[1] + 0.5 * x[2];
}

FieldSamples cloud(double step) {
  FieldSamples samples;
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; j <= 6; ++j)
      for (int k = 0; k <= 6; ++k) {
        const double shake = 0.2 * std::sin(7.0 * i + 5.0 * j + 3.0 * k);
        samples.places.push_back({step * (i + shake), step * (j - shake), step * (k + shake)});
        samples.values.push_back(linear(samples.places.back()));
      }
  return samples;
}

TEST(PointField, OfPointsIsExactForLinearOnesAndHasHoles) {
  const PointField field(cloud(0.1), 0);
  for (const Point& x : {Point{0.31, 0.27, 0.33}, Point{0.2, 0.4, 0.35}, Point{0.45, 0.12, 0.5}})
    EXPECT_NEAR(field.at(x).value(), linear(x), 1e-10);
  EXPECT_GT(field.within(), 0.1);
  EXPECT_LT(field.within(), 0.5);
  EXPECT_FALSE(field.at({2, 2, 2}));
  EXPECT_NEAR(field.distance_to({0.6, 0.6, 2.6}), 2, 0.1);
  EXPECT_TRUE(PointField(cloud(0.1), 5).at({2, 2, 2}));
}

TEST(PointField, OfASurfaceDoesNotChangeAlongItsNormal) {
  FieldSamples samples;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      samples.places.push_back({0.1 * i, 0.1 * j, 0.7});
      samples.values.push_back(1 + 2 * samples.places.back()[0]);
    }
  const PointField field(samples, 0.3);
  EXPECT_NEAR(field.at({0.43, 0.52, 0.7}).value(), 1.86, 1e-9);
  EXPECT_NEAR(field.at({0.43, 0.52, 0.85}).value(), 1.86, 1e-9);
}

TEST(PointField, StaysWithinTheValuesAroundAJump) {
  FieldSamples samples = cloud(0.1);
  for (std::size_t i = 0; i < samples.places.size(); ++i) samples.values[i] = samples.places[i][0] < 0.3 ? 10 : 1000;
  const PointField field(samples, 0);
  for (int i = 0; i < 60; ++i) {
    const double value = field.at({0.01 * i, 0.3, 0.3}).value();
    EXPECT_GE(value, 10);
    EXPECT_LE(value, 1000);
  }
}

TEST(PointField, OfCellsTakesTheCellThatHoldsThePlace) {
  FieldSamples samples;
  samples.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  samples.cells = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  samples.places = {{0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}};
  samples.values = {7, 9};
  samples.place_of_cell = {0, 1};
  const PointField of_cells(samples, 0.2);
  EXPECT_EQ(of_cells.at({0.3, 0.3, 0.3}).value(), 7);
  EXPECT_EQ(of_cells.at({0.4, 0.4, 0.4}).value(), 9);
  EXPECT_FALSE(of_cells.at({-0.5, 0, 0}));
  samples.places = samples.nodes;
  samples.place_of_cell.clear();
  samples.values.clear();
  for (const Point& x : samples.nodes) samples.values.push_back(linear(x));
  EXPECT_NEAR(PointField(samples, 0.2).at({0.3, 0.2, 0.1}).value(), linear({0.3, 0.2, 0.1}), 1e-14);
}

const std::string text_of_vtk =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "<UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 "
    "1</DataArray></Points>\n"
    "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray>\n"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells>\n"
    "<PointData><DataArray type=\"Float64\" Name=\"young\" format=\"binary\">"
    // four numbers 1, 2, 3, 4 behind their size in bytes, 32
    "IAAAAAAAAAAAAPA/AAAAAAAAAEAAAAAAAAAIQAAAAAAAABBA</DataArray></PointData>\n"
    "<CellData><DataArray type=\"Float32\" Name=\"part\" format=\"ascii\">5</DataArray></CellData>\n"
    "</Piece></UnstructuredGrid></VTKFile>\n";

TEST(PointTable, HeadersMaySayUnits) {
  const auto table = point_table("x_cm,y [mm],z (m),young [dyn/cm2]\n1,2,3,4e5\n0,0,0,1e5\n", "young", "t.csv", "");
  EXPECT_DOUBLE_EQ(table.places[0][0], 10);
  EXPECT_DOUBLE_EQ(table.places[0][1], 2);
  EXPECT_DOUBLE_EQ(table.places[0][2], 3000);
  EXPECT_EQ(table.values[0], 4e5);
  EXPECT_EQ(table.unit, "dyn/cm2");
  EXPECT_EQ(table.length_unit, "cm");
  const auto plain = point_table("x,y,z,young,young_cm\n1,2,3,4,5\n0,0,0,1,1\n", "young", "t.csv", "");
  EXPECT_EQ(plain.values[0], 4);
  EXPECT_EQ(plain.unit + plain.length_unit, "");
  // Another name is no unit, and a unit of something else no length.
  EXPECT_THROW(point_table("x,y,z,young_modulus\n1,2,3,4\n0,0,0,1\n", "young", "t.csv", ""), InputError);
  EXPECT_THROW(point_table("x [s],y,z,young\n1,2,3,4\n0,0,0,1\n", "young", "t.csv", ""), InputError);
}

/// Points around a tube of radius 1.5 and length 18 mm that begins at the origin.
TEST(LengthSlip, IsTheUnitThatBringsPointsToTheirPlaces) {
  std::vector<Point> places;
  for (int k = 0; k <= 36; ++k)
    for (int i = 0; i < 8; ++i) places.push_back({1.5 * std::cos(i), 1.5 * std::sin(i), 0.5 * k});
  for (const auto& [unit, factor] : {std::pair{"cm", 10.0}, {"m", 1000.0}, {"um", 1e-3}, {"in", 25.4}}) {
    std::vector<Point> points = places;
    for (Point& x : points)
      for (double& c : x) c /= factor;
    const auto slip = length_slip(points, places);
    ASSERT_TRUE(slip) << unit;
    EXPECT_EQ(slip->unit, unit);
    EXPECT_EQ(slip->factor, factor);
    // Of a field, however far it goes beyond the places.
    points.push_back({5 / factor, 5 / factor, 5 / factor});
    const NearPoints near(points);
    const auto distance = [&](const Point& x) { return std::sqrt(near.nearest(x, 1).front().first); };
    for (const double within : {0.0, 0.5}) {
      const auto of_field = length_slip(places, distance, within, 0.5 / factor);
      ASSERT_TRUE(of_field) << unit;
      EXPECT_EQ(of_field->unit, unit);
    }
  }
  EXPECT_FALSE(length_slip(places, places));
  std::vector<Point> line;  // a centre line, and one of another vessel
  for (int k = 0; k <= 18; ++k) line.push_back({0, 0, 1.0 * k});
  EXPECT_FALSE(length_slip(line, places));
  for (Point& x : line) x[0] += 300;
  EXPECT_FALSE(length_slip(line, places));
}

TEST(VtkFile, IsReadAsTextAndInBase64) {
  const VtkMesh mesh = read_vtk(text_of_vtk, "a.vtu");
  ASSERT_EQ(mesh.nodes.size(), 4u);
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.kinds[0], 10);
  ASSERT_EQ(mesh.arrays.size(), 2u);
  EXPECT_EQ(mesh.arrays[0].values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_TRUE(mesh.arrays[1].of_cells);
}

TEST(VtkFile, TakesNumbersTooSmallOrTooLargeForADoubleAsTheNearestOnes) {
  const std::vector<std::pair<std::string, double>> numbers{{"1e-400", 0},
                                                            {"1e400", std::numeric_limits<double>::infinity()}};
  for (const auto& [word, value] : numbers) {
    std::string text = text_of_vtk;
    text.replace(text.find(">5<") + 1, 1, word);
    EXPECT_EQ(read_vtk(text, "a.vtu").arrays[1].values, std::vector<double>{value}) << word;
  }
}

TEST(VtkFile, IsRefusedWhereItIsDamaged) {
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{100}, text_of_vtk.find("AAAA"), text_of_vtk.size() / 2}) {
    const std::string torn = text_of_vtk.substr(0, length);
    try {
      read_vtk(torn, "a.vtu");
      ADD_FAILURE() << "no message for " << length;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("a.vtu: ", 0), 0u) << error.what();
    }
  }
  std::string other = text_of_vtk;
  other.replace(other.find("0 1 2 3<"), 8, "0 1 2 9<");
  EXPECT_THROW(read_vtk(other, "a.vtu"), InputError);
  other = text_of_vtk;
  for (const char* numbers : {">5 6<", "><"}) {
    other = text_of_vtk;
    other.replace(other.find(">5<"), 3, numbers);
    EXPECT_THROW(read_vtk(other, "a.vtu"), InputError) << numbers;
  }
}

/// A whole number as a header or an array has it, most significant byte first or last.
std::string bytes_of(std::uint64_t number, int size, bool turned) {
  std::string bytes;
  for (int k = 0; k < size; ++k) bytes += static_cast<char>(number >> 8 * (turned ? size - 1 - k : k) & 0xFF);
  return bytes;
}

/// A field `a&b` of 1, 2, 300 at three points, appended raw. \param words  of the file's first tag \param data  of the field
std::string appended_vtk(const std::string& words, const std::string& data, char mark = '"') {
  return "<VTKFile type=\"PolyData\" " + words + "><PolyData><Piece NumberOfPoints=\"3\" NumberOfLines=\"2\"><Points>" +
         "<DataArray type=\"Float32\" NumberOfComponents=\"3\">0 0 0 1 0 0 0 1 0</DataArray></Points><PointData>" +
         "<DataArray type=\"UInt16\" Name=\"a&amp;b\" format=\"appended\" "
         "offset=\"0\"/></PointData></Piece></PolyData>" +
         "<AppendedData encoding=" + mark + "raw" + mark + ">_" + data + "</AppendedData></VTKFile>";
}

TEST(VtkFile, IsReadAppendedInEitherOrderOfBytesAndPackedByZlibOrLzma) {
  for (const bool turned : {false, true}) {
    const std::string order = turned ? "byte_order=\"BigEndian\" " : "",
                      numbers = bytes_of(1, 2, turned) + bytes_of(2, 2, turned) + bytes_of(300, 2, turned);
    const auto packed = [&](const std::string& block) {
      return bytes_of(1, 8, turned) + bytes_of(6, 8, turned) + bytes_of(0, 8, turned) +
             bytes_of(block.size(), 8, turned) + block;
    };
    const auto* from = reinterpret_cast<const std::uint8_t*>(numbers.data());
    std::string by_zlib(200, ' '), by_lzma(200, ' ');
    uLongf zlib_bytes = by_zlib.size();
    ASSERT_EQ(compress(reinterpret_cast<Bytef*>(by_zlib.data()), &zlib_bytes, from, numbers.size()), Z_OK);
    by_zlib.resize(zlib_bytes);
    std::size_t lzma_bytes = 0;
    ASSERT_EQ(lzma_easy_buffer_encode(1, LZMA_CHECK_CRC32, nullptr, from, numbers.size(),
                                      reinterpret_cast<std::uint8_t*>(by_lzma.data()), &lzma_bytes, by_lzma.size()),
              LZMA_OK);
    by_lzma.resize(lzma_bytes);
    const std::string wide = order + "header_type=\"UInt64\" compressor=";
    for (const auto& text : {appended_vtk(order, bytes_of(6, 4, turned) + numbers, '\''),
                             appended_vtk(wide + "\"vtkZLibDataCompressor\"", packed(by_zlib)),
                             appended_vtk(wide + "\"vtkLZMADataCompressor\"", packed(by_lzma))}) {
      const VtkMesh mesh = read_vtk(text, "a.vtp");
      ASSERT_EQ(mesh.arrays.size(), 1u);
      EXPECT_EQ(mesh.arrays[0].name, "a&b");
      EXPECT_EQ(mesh.arrays[0].values, (std::vector<double>{1, 2, 300}));
      EXPECT_TRUE(mesh.is_surface);
      EXPECT_EQ(mesh.lines, 2);
      EXPECT_TRUE(read_vtk(text, "a.vtp", [](const VtkMesh::Array&) { return false; }).arrays[0].values.empty());
    }
    EXPECT_THROW(read_vtk(appended_vtk(wide + "\"vtkZLibDataCompressor\"", packed(by_lzma)), "a.vtp"), InputError);
    EXPECT_THROW(read_vtk(appended_vtk(wide + "\"vtkLZ4DataCompressor\"", packed(by_zlib)), "a.vtp"), InputError);
  }
  std::string bare = appended_vtk("", "");
  bare.erase(bare.find("<AppendedData"), bare.find("</VTKFile>") - bare.find("<AppendedData"));
  try {
    read_vtk(bare, "a.vtp");
    FAIL() << "no message";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a.vtp: has an appended array without AppendedData; write it anew as .vtu or .vtp");
  }
}

TEST(RegionDistance, OfEveryShape) {
  RegionShape box;
  box.low = {0, 0, 0};
  box.high = {1, 2, 3};
  EXPECT_NEAR(RegionDistance(box, 0)({0.5, 1, 1}), -0.5, 1e-15);
  EXPECT_NEAR(RegionDistance(box, 0)({4, 6, 1}), 5, 1e-15);
  RegionShape sphere;
  sphere.kind = RegionShape::Kind::sphere;
  sphere.centre = {1, 0, 0};
  sphere.radius = 2;
  EXPECT_NEAR(RegionDistance(sphere, 0)({1, 0, 5}), 3, 1e-15);
  RegionShape line;
  line.kind = RegionShape::Kind::line;
  line.line = std::make_shared<const std::vector<Point>>(std::vector<Point>{{0, 0, 0}, {0, 0, 2}, {0, 0, 10}});
  line.within = 1;
  line.from = 3;
  line.to = 6;
  const RegionDistance near_line(line, 0);
  EXPECT_NEAR(near_line({0.25, 0, 5}), -0.75, 1e-15);
  EXPECT_NEAR(near_line({2, 0, 4}), 1, 1e-15);
  EXPECT_NEAR(near_line({0, 0, 1}), 2, 1e-15);
  EXPECT_NEAR(near_line({0, 0, 8}), 2, 1e-15);
  RegionShape surface;
  surface.kind = RegionShape::Kind::surface;
  surface.within = 0.3;
  surface.surface =
      std::make_shared<const PaintedSurface>(PaintedSurface{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}});
  const RegionDistance near_surface(surface, 0.5);
  EXPECT_NEAR(near_surface({1, 1, 0.1}), -0.2, 1e-14);
  EXPECT_NEAR(near_surface({1, 1, -0.7}), 0.4, 1e-14);
  EXPECT_NEAR(near_surface({1, 1, 7}), 0.5, 1e-14) << "no farther than asked for";
}

}  // namespace

}  // namespace fsi::test
