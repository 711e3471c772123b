#include <cmath>
#include <numbers>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/score_case.hpp"
#include "core/text.hpp"
#include "support/vector_file.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

/// A rectangle with an elevation on its left and another on its right side.
std::string roof(double left, double low, double right, double high, double z_left, double z_right) {
    const auto corner = [](double x, double y, double z) {
        return number_text(x) + " " + number_text(y) + " " + number_text(z);
    };
    return "POLYGON Z((" + corner(left, low, z_left) + "," + corner(right, low, z_right) + "," +
           corner(right, high, z_right) + "," + corner(left, high, z_left) + "," + corner(left, low, z_left) +
           "))";
}

const std::string half_right = number_text(std::atan(0.5) * 180 / std::numbers::pi);  // 26.57 degrees

constexpr double x0 = 500000;
constexpr double y0 = 5800000;

class ScoreRoofs : public ScoreCase {
  protected:
    const std::vector<RowField> face_fields_{
        {"bldg_id", OFTInteger64}, {"roof_type"}, {"slope", OFTReal}, {"azimuth", OFTReal}};
    const std::vector<RowField> house_fields_{{"id", OFTInteger64}, {"roof_type"}};

    void rows_of(const std::string& file, const RowLayer& layer) const { write_rows(path(file), layer); }

    /// Truth: a gable of 10 x 10 m over the eaves at 20 m, water to the west and the east; a flat roof of 100
    /// m2 at 30 m.
    void write_reference(const std::string& file = "reference.gpkg") const {
        rows_of(file, {"roofs",
                       face_fields_,
                       {{roof(x0, y0, x0 + 5, y0 + 10, 20, 22.5), {"1", "gabled", half_right, "270"}},
                        {roof(x0 + 5, y0, x0 + 10, y0 + 10, 22.5, 20), {"1", "gabled", half_right, "90"}},
                        {roof(x0 + 20, y0, x0 + 30, y0 + 10, 30, 30), {"2", "flat", "0", {}}}}});
    }
    /// Found: the western half as it is; the eastern one 12 degrees off in azimuth and without its last 2 m;
    /// the flat one half 1.5 m too high and half of no known slope.
    void write_found(const std::string& file = "found.gpkg") const {
        rows_of(file, {"buildings",
                       house_fields_,
                       {{box(x0, y0, x0 + 8, y0 + 10), {"7", "gabled"}},
                        {box(x0 + 20, y0, x0 + 30, y0 + 10), {"8", "shed"}}}});
        rows_of(file, {"roofs",
                       face_fields_,
                       {{roof(x0, y0, x0 + 5, y0 + 10, 20, 22.5), {"7", {}, half_right, "270"}},
                        {roof(x0 + 5, y0, x0 + 8, y0 + 10, 22.5, 21), {"7", {}, half_right, "102"}},
                        {roof(x0 + 20, y0, x0 + 25, y0 + 10, 31.5, 31.5), {"8", {}, "0", {}}},
                        {roof(x0 + 25, y0, x0 + 30, y0 + 10, 30, 30), {"8", {}, {}, {}}}}});
    }
    const Arguments both_{"-roofs", "found.gpkg", "reference.gpkg"};
};

TEST_F(ScoreRoofs, measuresPlanes) {
    write_reference();
    write_found();
    const json result = score_json(both_);
    EXPECT_NEAR(result["reference"]["area_m2"], 200, 1e-6);
    EXPECT_NEAR(result["found"]["area_m2"], 180, 1e-6);
    EXPECT_NEAR(result["shared_m2"], 180, 1e-6);
    EXPECT_NEAR(result["covered"], 0.9, 1e-9);
    EXPECT_EQ(result["overlap"], 0);
    EXPECT_NEAR(result["slope_azimuth_right"], 100.0 / 180, 1e-9);
    EXPECT_NEAR(result["without_slope"], 50.0 / 180, 1e-9);
    EXPECT_NEAR(result["slope_error"]["p90_deg"], 0, 1e-9);
    EXPECT_NEAR(result["azimuth_error"]["median_deg"], 0, 1e-6);  // 50 of 80 m2
    EXPECT_NEAR(result["azimuth_error"]["p90_deg"], 12, 1e-6);
    EXPECT_NEAR(result["height_slope_right"], 80.0 / 180, 1e-6);
    EXPECT_NEAR(result["height_slope_iou"], 80.0 / 200, 1e-6);
    EXPECT_EQ(result["buildings"], 2);
    EXPECT_EQ(result["buildings_compared"], 2);
    EXPECT_EQ(result["type_right"], 0.5);
    EXPECT_EQ(result["pairs"], 2);
    EXPECT_EQ(result["types"], json::parse(R"({"flat": {"shed": 1}, "gabled": {"gabled": 1}})"));
    EXPECT_EQ(result["found"]["layer"], "roofs");
    EXPECT_EQ(result["found"]["faces"], 4);
    EXPECT_EQ(result["limited"], false);
    EXPECT_EQ(result["crs"], "ETRS89 / UTM zone 32N");
}

TEST_F(ScoreRoofs, printsATable) {
    write_reference();
    write_found();
    const std::string table = score(both_).out;
    expect_has(table, "found                 found.gpkg, layer roofs\n");
    expect_has(table, "roofs covered         90.00 %       180.0 m2 of 200.0 m2\n");
    expect_has(table, "slope and azimuth     55.56 %       of 180.0 m2, within 5 and 10 deg\n");
    expect_has(table, "without a slope       27.78 %       of 180.0 m2\n");
    expect_has(table, "azimuth error, p90    12.00 deg\n");
    expect_has(table, "  IoU                 40.00 %       of the area in either\n");
    expect_has(table, "roof type             50.00 %       1 of 2 buildings covered by half, of 2\n");
    expect_has(table, "  flat                0 of 1        shed 1\n");
    const std::string quiet = score({"-q", both_[0], both_[1], both_[2]}).out;
    EXPECT_EQ(quiet.find("found.gpkg"), std::string::npos);
    EXPECT_EQ(quiet.find("flat"), std::string::npos);
}

TEST_F(ScoreRoofs, hasTheSameKeysAlways) {
    write_reference();
    write_found();
    const auto report = nlohmann::ordered_json::parse(score({"-json", both_[0], both_[1], both_[2]}).out);
    std::string keys;
    for (const auto& [key, value] : report.items())
        keys += key + " ";
    EXPECT_EQ(
        keys,
        "version found reference crs metres limited min_object_m2 shared_m2 covered overlap "
        "slope_azimuth_right without_slope slope_error azimuth_error height_slope_right height_slope_iou "
        "buildings buildings_compared type_right pairs pair_type_right types warnings ");
}

TEST_F(ScoreRoofs, keepsToTheAreaOfInterest) {
    write_reference();
    write_found();
    layer_of("reference.gpkg", {"aoi", {{box(x0, y0, x0 + 8, y0 + 10)}}});
    const json result = score_json(both_);
    EXPECT_EQ(result["limited"], true);
    EXPECT_NEAR(result["reference"]["area_m2"], 80, 1e-6);
    EXPECT_NEAR(result["slope_azimuth_right"], 50.0 / 80, 1e-9);
    EXPECT_EQ(result["buildings"], 1);
}

TEST_F(ScoreRoofs, takesTypesOfRoofsWithoutFaces) {
    // A cone has no planes. It counts only if its building is known, and hips are wrong for it.
    write_reference();
    write_found();
    rows_of("found.gpkg", {"more", house_fields_, {{box(x0 + 40, y0, x0 + 50, y0 + 10), {"9", "hipped"}}}});
    rows_of("truth.gpkg", {"buildings",
                           {{"id", OFTInteger64}, {"roof"}},
                           {{box(x0, y0, x0 + 10, y0 + 10), {"1", "hipped"}},
                            {box(x0 + 20, y0, x0 + 30, y0 + 10), {"3", "cone"}}}});
    const json result = score_json({"-roof_types", "truth.gpkg", both_[0], both_[1], both_[2]});
    EXPECT_EQ(result["buildings"], 3);
    // Building 1 has faces, whose type counts. Building 3 lies where a shed was found.
    EXPECT_EQ(result["types"],
              json::parse(R"({"domed": {"shed": 1}, "flat": {"shed": 1}, "gabled": {"gabled": 1}})"));
}

TEST_F(ScoreRoofs, comparesTwoResults) {
    write_found();
    rows_of("other.gpkg", {"buildings",
                           house_fields_,
                           {{box(x0, y0, x0 + 10, y0 + 10), {"1", "domed"}},
                            {box(x0 + 20, y0, x0 + 30, y0 + 10), {"2", {}}}}});
    rows_of("other.gpkg", {"roofs",
                           {{"slope", OFTReal}, {"azimuth", OFTReal}, {"bldg_id", OFTInteger64}},
                           {{roof(x0, y0, x0 + 10, y0 + 10, 22, 22), {"0", {}, "1"}}}});
    const json result = score_json({"-roofs", "found.gpkg", "other.gpkg"});
    EXPECT_EQ(result["types"], json::parse(R"({"domed": {"gabled": 1}})"));
    EXPECT_EQ(result["slope_azimuth_right"], 0);
}

TEST_F(ScoreRoofs, turnsAzimuthsWithTheNorthOfTheirCrs) {
    // At 12 degrees east and 52 north, the north of zone 32 lies 2.36 degrees to the right of the true one:
    // atan(tan(3) sin(52)).
    const double turn = std::atan(std::tan(std::numbers::pi / 60) * std::sin(52 * std::numbers::pi / 180)) *
                        180 / std::numbers::pi;
    rows_of("found.gpkg", {.name = "buildings",
                           .fields = house_fields_,
                           .rows = {{box(12, 52, 12.0002, 52.0002), {"1", "shed"}}},
                           .epsg = 4326});
    rows_of("found.gpkg", {.name = "roofs",
                           .fields = face_fields_,
                           .rows = {{roof(12, 52, 12.0002, 52.0002, 20, 20), {"1", {}, "30", "90"}}},
                           .epsg = 4326});
    rows_of(
        "reference.gpkg",
        {"roofs",
         face_fields_,
         {{roof(705800, 5765200, 706100, 5765500, 20, 20), {"1", "shed", "30", number_text(90 - turn)}}}});
    const json result = score_json(both_);
    EXPECT_NEAR(result["shared_m2"], 13.728 * 22.25, 2);
    EXPECT_NEAR(result["azimuth_error"]["median_deg"], 0, 1e-3);
}

TEST_F(ScoreRoofs, takesOtherLayersOfPlanes) {
    write_reference();
    write_found();
    rows_of("found.gpkg",
            {"planes", face_fields_, {{roof(x0 + 20, y0, x0 + 30, y0 + 10, 30, 30), {"8", {}, "0", {}}}}});
    const json result = score_json({"-layer", "planes", both_[0], both_[1], both_[2]});
    EXPECT_NEAR(result["shared_m2"], 100, 1e-6);
    EXPECT_EQ(result["found"]["layer"], "planes");
}

TEST_F(ScoreRoofs, bearsEmptyLayers) {
    write_reference();
    rows_of("found.gpkg", {"buildings", house_fields_});
    rows_of("found.gpkg", {"roofs", face_fields_});
    const json result = score_json(both_, "Warning: The layer 'roofs' of 'found.gpkg' has no polygons.\n");
    EXPECT_EQ(result["covered"], 0);
    EXPECT_EQ(result["slope_error"], nullptr);
    EXPECT_EQ(result["type_right"], 0);
    expect_has(score(both_).out, "slope error, median   -\n");
}

TEST_F(ScoreRoofs, refusesMissingLayersAndFields) {
    write_reference();
    rows_of("found.gpkg", {"buildings", house_fields_, {{box(x0, y0, x0 + 8, y0 + 10), {"7", "flat"}}}});
    expect_refused(2, "'found.gpkg' has no layer 'roofs'; it has 'buildings'.", both_);
    expect_refused(2, "'reference.gpkg' has no layer 'buildings'; it has 'roofs'.",
                   {"-roofs", "reference.gpkg", "reference.gpkg"});
    rows_of("found.gpkg",
            {"roofs", {{"slope", OFTReal}, {"kind"}}, {{roof(x0, y0, x0 + 5, y0 + 10, 1, 1), {}}}});
    expect_refused(
        2, "The layer 'roofs' of 'found.gpkg' has no field 'azimuth'; its fields are 'slope' and 'kind'.",
        both_);
    rows_of("level.gpkg", {"buildings", {{"id"}}, {{box(x0, y0, x0 + 8, y0 + 10), {}}}});
    rows_of("level.gpkg", {"roofs", face_fields_, {{box(x0, y0, x0 + 8, y0 + 10), {"1", "flat", "0", {}}}}});
    expect_refused(
        1,
        "The layer 'roofs' of 'level.gpkg' has polygons without elevations; give one with the planes of "
        "roofs.",
        {"-roofs", "level.gpkg", "reference.gpkg"});
    rows_of(
        "typeless.gpkg",
        {"roofs", {{"slope", OFTReal}, {"azimuth", OFTReal}}, {{roof(x0, y0, x0 + 5, y0 + 10, 1, 1), {}}}});
    write_found("good.gpkg");
    expect_refused(
        2,
        "'typeless.gpkg' has neither types of roofs in its layer 'roofs' nor a layer 'buildings' with "
        "them; give a dataset with -roof_types.",
        {"-roofs", "good.gpkg", "typeless.gpkg"});
    expect_refused(2, "The layer 'buildings' of 'level.gpkg' has no field 'roof_type'; its fields are 'id'.",
                   {"-roofs", "-roof_types", "level.gpkg", "good.gpkg", "reference.gpkg"});
}

TEST_F(ScoreRoofs, refusesPlacesThatDoNotMeet) {
    write_reference();
    rows_of("found.gpkg", {"buildings", house_fields_, {{box(0, 0, 10, 10), {"7", "flat"}}}});
    rows_of("found.gpkg", {"roofs", face_fields_, {{roof(0, 0, 10, 10, 5, 5), {"7", {}, "0", {}}}}});
    expect_refused(
        1,
        "'found.gpkg' (0 0 to 10 10) and 'reference.gpkg' (500000 5800000 to 500030 5800010) do not "
        "meet; check the files and their coordinate reference systems.",
        both_);
}

}  // namespace
}  // namespace d2b::test
