#include <cmath>

#include "cli/cli_test_case.hpp"
#include "cli/geometries.hpp"

namespace d2b::test {
namespace {

/// Whether each polygon lies in the other with a margin.
bool near(OGRGeometryH one, OGRGeometryH other, double margin) {
    const Geometry around_one(OGR_G_Buffer(one, margin, 30));
    const Geometry around_other(OGR_G_Buffer(other, margin, 30));
    return OGR_G_Contains(around_one.get(), other) != 0 && OGR_G_Contains(around_other.get(), one) != 0;
}

class Samples : public CliTest {
  protected:
    Layer buildings(const std::string& name, Arguments arguments) const {
        arguments.insert(arguments.begin(), {"-q", sample(name + ".tif"), "out.gpkg"});
        run_well(arguments);
        Layer result = layer("out.gpkg", "buildings");
        for (const Record& record : result.records)
            EXPECT_TRUE(record.valid()) << name;
        return result;
    }
    static Layer truth(const std::string& name) { return read_layer(sample("samples_truth.gpkg"), name); }

    /// The building that covers most of a true one.
    static const Record& match(const Layer& found, const Record& real) {
        const Record* best = nullptr;
        double most = 0;
        for (const Record& record : found.records) {
            const Geometry common(OGR_G_Intersection(record.geometry(), real.geometry()));
            if (OGR_G_Area(common.get()) > most) {
                most = OGR_G_Area(common.get());
                best = &record;
            }
        }
        if (best == nullptr)
            throw std::runtime_error("no building was found at " + real.text("kind"));
        return *best;
    }
    /// Each true building is found, every edge within a diagonal of a cell.
    static void expect_truth(const Layer& found, const Layer& real, double cell) {
        EXPECT_EQ(found.records.size(), real.records.size());
        for (const Record& record : real.records)
            EXPECT_TRUE(
                near(match(found, record).geometry(), record.geometry(), std::sqrt(2.0) * cell + 1e-9))
                << record.text("kind");
    }
};

TEST_F(Samples, thesisExampleHasOneRingOf24PointsAnd4Corners) {
    const Layer found = buildings("thesis_11x7", {"-fl", "15"});
    ASSERT_EQ(found.records.size(), 1U);
    // Points 12, 20, 64 and 56 of 11 columns: (row 1, col 1), (1, 9), (5, 9), (5, 1); centres of cells of 1
    // m.
    EXPECT_EQ(found.records[0].wkt(),
              "MULTIPOLYGON (((424801.5 4512998.5,424801.5 4512994.5,424809.5 4512994.5,424809.5 4512998.5,"
              "424801.5 4512998.5)))");
    EXPECT_EQ(buildings("thesis_11x7", {"-fl", "15", "-nf", "24", "-overwrite"}).records.size(), 1U);
    run_warned({"-q", "-nf", "25", "-fl", "15", "--", sample("thesis_11x7.tif"), "none.gpkg"},
               {"No building was found"});
    EXPECT_DOUBLE_EQ(found.records[0].number("height"), 50 * 0.3048);
}

TEST_F(Samples, thesisGridHasItsThreeShapes) {
    const Layer found = buildings("thesis_50x36", {"-fl", "4", "-trace", "cells"});
    const Layer real = truth("thesis_50x36");
    expect_truth(found, real, 1);
    for (const Record& record : real.records)
        EXPECT_DOUBLE_EQ(match(found, record).number("height"), record.number("roof_h"))
            << record.text("kind");
    const Record& l_shape = real.where("roof_h", 8);
    const Geometry difference(OGR_G_SymDifference(match(found, l_shape).geometry(), l_shape.geometry()));
    EXPECT_EQ(OGR_G_Area(difference.get()), 0);  // its edges are edges of cells
}

TEST_F(Samples, hotelHasItsSizeInFeetAndItsHeightInMetres) {
    const Layer found = buildings("hotel_70x85", {"-fl", "67.5", "-trace", "cells"});  // at half its height
    ASSERT_EQ(found.records.size(), 1U);
    const Layer real = truth("hotel_70x85");
    expect_truth(found, real, 1);
    const Record& hotel = found.records[0];
    EXPECT_EQ(hotel.vertices(), 13);  // an H, and closed
    const OGREnvelope box = hotel.box();
    EXPECT_NEAR((box.MaxX - box.MinX) / 0.3048, 176, 1 / 0.3048);
    EXPECT_NEAR((box.MaxY - box.MinY) / 0.3048, 200, 1 / 0.3048);
    EXPECT_NEAR(hotel.number("height"), 185 * 0.3048, 2 * 0.3048);
    EXPECT_NEAR(hotel.number("p50"), 135 * 0.3048, 1 * 0.3048);
    EXPECT_NEAR(hotel.number("roof"), 185, 1);  // in feet, as the DEM
    EXPECT_EQ(hotel.number("at_edge"), 0);
}

TEST_F(Samples, courtyardIsAnInteriorRing) {
    const Layer found = buildings("courtyard_utm", {"-fl", "521", "-trace", "cells"});
    ASSERT_EQ(found.records.size(), 1U);
    EXPECT_EQ(found.records[0].holes(), 1);
    const Layer real = truth("courtyard_utm");
    expect_truth(found, real, 0.5);
    EXPECT_NEAR(found.records[0].area(), real.records[0].area(), 0.03 * real.records[0].area());
}

TEST_F(Samples, areasInDegreesAreGeodesic) {
    const Layer found =
        buildings("degrees", {"-fl", "38.5", "-trace", "cells", "-min_area", "60"});  // without trees
    const Layer real = truth("degrees");
    EXPECT_EQ(found.crs, "WGS 84");
    expect_truth(found, real, 1.5e-5);
    // Square metres in a square degree, from the radii of curvature of WGS 84 at 52.0004 degrees.
    const double degree = M_PI / 180;
    const double e2 = 0.00669437999014;
    const double w = 1 - e2 * std::pow(std::sin(52.0004 * degree), 2);
    const double meridian = 6378137 * (1 - e2) / std::pow(w, 1.5);
    const double parallel = 6378137 / std::sqrt(w) * std::cos(52.0004 * degree);
    const double scale = meridian * parallel * degree * degree;
    for (const Record& record : found.records)
        EXPECT_NEAR(record.number("area_m2"), record.area() * scale, 0.005 + 1e-5 * record.number("area_m2"));
    for (const Record& record : real.records) {
        const Record& building = match(found, record);
        // Half a cell along the outline is more than what is lost or won.
        EXPECT_NEAR(building.number("area_m2"), record.area() * scale,
                    0.5 * 1.07 * building.number("perim_m"));
        EXPECT_NEAR(building.number("area_m2"), record.area() * scale, 0.08 * record.area() * scale);
    }
}

TEST_F(Samples, nodataIsNoPartOfAnything) {
    const Layer found = buildings("nodata", {"-fl", "34", "-trace", "cells"});
    const Layer real = truth("nodata");
    EXPECT_EQ(found.records.size(), real.records.size());
    int at_edge = 0;
    for (const Record& record : found.records)
        at_edge += record.number("at_edge") == 1 ? 1 : 0;
    EXPECT_EQ(at_edge, 1);
    for (const Record& record : real.records)
        (void)match(found, record);
    const OpenDataset dem(GDALOpen(sample("nodata.tif").c_str(), GA_ReadOnly));
    std::vector<double> values(120 * 100);
    ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dem.get(), 1), GF_Read, 0, 0, 120, 100, values.data(), 120, 100,
                           GDT_Float64, 0, 0),
              CE_None);
    const auto valid = std::count_if(values.begin(), values.end(), [](double z) { return z > -9999; });
    EXPECT_LT(valid, 120 * 100);
    EXPECT_EQ(layer("out.gpkg", "contours").sum("n_points", 0), valid);
    buildings("nodata", {"-fl", "34", "-trace", "cells", "-nf", "0", "-overwrite"});  // no hole is filled
    double area = 0;
    int holes = 0;
    for (const Record& record : layer("out.gpkg", "contours").records) {
        area += record.number("level") == 0 ? record.area() : 0;
        holes += record.number("level") == 0 ? record.holes() : 0;
    }
    EXPECT_EQ(area, static_cast<double>(valid));
    EXPECT_GT(holes, 1);  // the lake and single cells
}

TEST_F(Samples, townRuns) {
    for (const Arguments& more : {Arguments{}, {"-trace", "cells", "-lod", "8"}, {"-i", "3", "-disjoint"}}) {
        Arguments arguments = more;
        arguments.push_back("-overwrite");
        EXPECT_GT(buildings("town", arguments).records.size(), 0U);
        const Layer stack = layer("out.gpkg", "contours");
        EXPECT_GT(stack.records.size(), 100U);
        for (const Record& record : stack.records)
            EXPECT_TRUE(record.valid());
    }
}

}  // namespace
}  // namespace d2b::test
