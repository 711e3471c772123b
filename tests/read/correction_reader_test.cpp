#include "read/correction_reader.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "read/rasters.hpp"
#include "read/side_rasters.hpp"
#include "support/error_of.hpp"
#include "support/vector_file.hpp"

namespace d2b::reading {
namespace {

using namespace test;

/// A DEM of 20 x 20 cells of 1 m, and datasets beside it.
class EditorTest : public ReadTest {
  protected:
    /// "x y" of a column and row
    static std::string at(double col, double row) {
        return number_text(500000 + col) + " " + number_text(5700020 - row);
    }
    static std::string box(double left, double top, double right, double bottom) {
        return "POLYGON((" + at(left, top) + "," + at(right, top) + "," + at(right, bottom) + "," +
               at(left, bottom) + "," + at(left, top) + "))";
    }
    void write_edits(const std::string& layer, const std::vector<VectorRow>& rows, int epsg = 25832) {
        write_rows(path("e.gpkg"), {.name = layer, .fields = {{"kind"}}, .rows = rows, .epsg = epsg});
    }
    [[nodiscard]] std::unique_ptr<CorrectionSource> corrections(const std::string& layer = "") {
        return open_corrections({path("e.gpkg"), layer}, metre_grid(), callbacks_);
    }
    [[nodiscard]] std::vector<double> excluded(const std::string& layer, double buffer_m) {
        const auto source = open_exclusion({path("e.gpkg"), layer, buffer_m}, metre_grid(), callbacks_);
        std::vector<double> cells(400);
        source->read({0, 0, 20, 20}, cells);
        return cells;
    }
};

std::string text_of(const Correction& correction) {
    std::string text = correction.name + (correction.is_point ? " point" : "");
    for (const CellRun& run : correction.cells)
        text +=
            " " + std::to_string(run.row) + ":" + std::to_string(run.begin) + "-" + std::to_string(run.end);
    for (const CellCut& cut : correction.cuts)
        text += " " + std::to_string(cut.row) + "," + std::to_string(cut.col) + (cut.below ? "_" : "|");
    return text;
}

/// Cells whose centres a polygon holds, the cell of a point, and pairs of cells that a line separates.
TEST_F(EditorTest, CorrectionsAreCells) {
    write_edits("edits", {{box(2, 3, 5.4, 4.6), {"building"}},
                          {"POINT(" + at(7.9, 8.1) + ")", {" No Building "}},
                          {"LINESTRING(" + at(3.2, 0) + "," + at(3.2, 2) + ")", {"CUT"}},
                          {box(90, 90, 95, 95), {"no building"}}});
    const auto source = corrections();
    const std::vector<Correction>& all = source->corrections();
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(text_of(all[0]), "feature 1 3:2-5 4:2-5");
    EXPECT_EQ(all[0].kind, CorrectionKind::building);
    EXPECT_EQ(text_of(all[1]), "feature 2 point 8:7-8");
    EXPECT_EQ(all[1].kind, CorrectionKind::no_building);
    EXPECT_EQ(text_of(all[2]), "feature 3 0,2| 1,2|");
    EXPECT_EQ(all[2].kind, CorrectionKind::cut);
    EXPECT_EQ(text_of(all[3]), "feature 4");
    EXPECT_TRUE(all[3].is_outside());
    EXPECT_EQ(source->unusable(), 0);
    EXPECT_EQ(warnings_, std::vector<std::string>());
}

/// An editor keeps points, lines and polygons in layers of their own.
TEST_F(EditorTest, CorrectionsOfAllLayersAreRead) {
    write_edits("points", {{"POINT(" + at(1, 1) + ")", {"building"}}});
    write_edits("lines", {{"LINESTRING(" + at(1, 1) + "," + at(9, 9) + ")", {"cut"}}});
    write_rows(path("e.gpkg"), {.name = "photos", .fields = {{"name"}}, .rows = {{"POINT(1 1)", {"a"}}}});
    const auto both = corrections();
    ASSERT_EQ(both->corrections().size(), 2U);
    EXPECT_EQ(both->corrections()[0].name, "feature 1 of 'points'");
    EXPECT_EQ(both->corrections()[1].name, "feature 1 of 'lines'");
    ASSERT_EQ(corrections("lines")->corrections().size(), 1U);
    EXPECT_EQ(corrections("lines")->corrections()[0].name, "feature 1");
    EXPECT_EQ(error_of<OptionError>([&] { static_cast<void>(corrections("photos")); }),
              "The layer 'photos' of the correction dataset '" + path("e.gpkg") +
                  "' has no field 'kind'; its fields are 'name'.");
    EXPECT_EQ(error_of<OptionError>([&] { static_cast<void>(corrections("areas")); }),
              "The correction dataset '" + path("e.gpkg") +
                  "' has no layer 'areas'; it has 'points', 'lines' and 'photos'.");
}

/// The centre of cell (8, 8) in degrees.
TEST_F(EditorTest, CorrectionsComeInAnyCrs) {
    const OGRSpatialReferenceH from = OSRNewSpatialReference(wkt_of(25832).c_str());
    const OGRSpatialReferenceH to = OSRNewSpatialReference(wkt_of(4326).c_str());
    OSRSetAxisMappingStrategy(to, OAMS_TRADITIONAL_GIS_ORDER);
    const OGRCoordinateTransformationH transform = OCTNewCoordinateTransformation(from, to);
    double x = 500008.5;
    double y = 5700011.5;
    ASSERT_TRUE(OCTTransform(transform, 1, &x, &y, nullptr));
    OCTDestroyCoordinateTransformation(transform);
    OSRRelease(from);
    OSRRelease(to);
    write_edits("edits", {{"POINT(" + number_text(x) + " " + number_text(y) + ")", {"building"}}}, 4326);
    EXPECT_EQ(text_of(corrections()->corrections().at(0)), "feature 1 point 8:8-9");
}

TEST_F(EditorTest, FeaturesThatAreNoCorrectionsAreNamed) {
    write_edits("edits", {{box(2, 3, 5, 5), {"hall"}},
                          {box(2, 3, 5, 5), {std::nullopt}},
                          {box(2, 3, 5, 5), {"cut"}},
                          {"LINESTRING(" + at(1, 1) + "," + at(9, 9) + ")", {"building"}},
                          {"POINT(" + at(1, 1) + ")", {"building"}}});
    const auto source = corrections();
    EXPECT_EQ(source->corrections().size(), 1U);
    EXPECT_EQ(source->unusable(), 4);
    const std::string name = "The correction dataset '" + path("e.gpkg") + "' has features ";
    EXPECT_EQ(warnings_,
              (std::vector<std::string>{
                  name + "whose kind is not 'building', 'no building' or 'cut', and which are ignored: 2, "
                         "feature 1 ('hall'), feature 2 (NULL).",
                  name + "whose geometry does not suit their kind (a cut is a line, the others are points or "
                         "polygons), and which are ignored: 2, feature 3 ('cut'), feature 4 ('building')."}));
}

TEST_F(EditorTest, ADatasetWithoutCorrectionsIsRefused) {
    EXPECT_TRUE(error_of<InputError>([&] {
                    static_cast<void>(corrections());
                }).starts_with("The correction dataset '" + path("e.gpkg") + "' cannot be opened: "));
    write_rows(path("e.gpkg"), {.name = "photos", .fields = {{"name"}}, .rows = {{"POINT(1 1)", {"a"}}}});
    EXPECT_EQ(error_of<InputError>([&] { static_cast<void>(corrections()); }),
              "No layer of the correction dataset '" + path("e.gpkg") +
                  "' has geometries and a field 'kind'; add that field, with the words 'building', 'no "
                  "building' or 'cut'.");
}

/// A box of 4 x 4 m in the middle, and all within 2.6 m of it: 25 + 4 * 4 * 2.6 + the quarters of a circle.
TEST_F(EditorTest, ExclusionsAreWidened) {
    write_edits("bridges", {{box(8, 8, 12, 12), {}}});
    const auto count = [&](double buffer_m) {
        double sum = 0;
        for (const double cell : excluded("", buffer_m))
            sum += cell;
        return sum;
    };
    EXPECT_EQ(count(0), 16);
    double expected = 0;
    for (int row = 0; row < 20; ++row)
        for (int col = 0; col < 20; ++col) {
            const auto beyond = [](int i) { return std::max({8 - (i + 0.5), i + 0.5 - 12, 0.0}); };
            expected += std::hypot(beyond(row), beyond(col)) < 2.6 ? 1 : 0;
        }
    EXPECT_EQ(count(2.6), expected);
    EXPECT_GT(expected, 16 + 4 * 4 * 2);
    EXPECT_EQ(warnings_, std::vector<std::string>());
}

TEST_F(EditorTest, ExclusionsElsewhereLeaveNothingOut) {
    write_edits("bridges", {{box(80, 80, 90, 90), {}}});
    for (const double cell : excluded("bridges", 0))
        EXPECT_EQ(cell, 0);
    EXPECT_EQ(warnings_,
              std::vector<std::string>{"The exclusion dataset '" + path("e.gpkg") +
                                       "' has no polygon in the part of 'dem.tif' that is used, so "
                                       "it leaves nothing out."});
    EXPECT_EQ(error_of<OptionError>([&] { static_cast<void>(excluded("ships", 0)); }),
              "The exclusion dataset '" + path("e.gpkg") + "' has no layer 'ships'; it has 'bridges'.");
    write_edits("points", {{"POINT(" + at(1, 1) + ")", {}}});
    EXPECT_EQ(error_of<InputError>([&] { static_cast<void>(excluded("points", 0)); }),
              "The layer 'points' of the exclusion dataset '" + path("e.gpkg") +
                  "' has no polygons; give one that has, for example with -exclude_layer.");
}

}  // namespace
}  // namespace d2b::reading
