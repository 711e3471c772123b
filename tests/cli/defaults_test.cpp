#include <cmath>
#include <ostream>

#include "cli/cli_test_case.hpp"
#include "cli/geometries.hpp"

namespace d2b::test {
namespace {

/// The share of what both cover in what either covers.
double overlap(OGRGeometryH one, OGRGeometryH other) {
    const Geometry common(OGR_G_Intersection(one, other));
    const Geometry either(OGR_G_Union(one, other));
    return OGR_G_Area(common.get()) / OGR_G_Area(either.get());
}

/// A sample with its truth, and how well the program does on it when no option is given.
struct Expected {
    const char* name;
    const char* truth;  ///< file and layer
    const char* layer;
    double least_overlap;
};

void PrintTo(const Expected& expected, std::ostream* stream) {
    *stream << expected.name;
}

class Defaults : public CliTest, public ::testing::WithParamInterface<Expected> {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
    }
    Layer found() const {
        run_well({"-q", sample(std::string(GetParam().name) + ".tif"), "out.gpkg"});
        return layer("out.gpkg", "buildings");
    }
    static Layer truth() { return read_layer(sample(GetParam().truth), GetParam().layer); }
};

TEST_P(Defaults, FindTheTruth) {
    const Layer buildings = found();
    const auto real = static_cast<double>(truth().records.size());
    EXPECT_NEAR(static_cast<double>(buildings.records.size()), real, 0.01 * real);  // the town has 363
    EXPECT_GE(overlap(united(buildings).get(), united(truth()).get()), GetParam().least_overlap);
}

TEST_P(Defaults, GiveValidPolygonsThatDoNotOverlap) {
    const Layer buildings = found();
    double sum = 0;
    for (const Record& record : buildings.records) {
        EXPECT_TRUE(record.valid());
        sum += record.area();
    }
    EXPECT_NEAR(OGR_G_Area(united(buildings).get()), sum, 1e-9 * sum);
    for (const Record& record : layer("out.gpkg", "contours").records)
        EXPECT_TRUE(record.valid());
}

INSTANTIATE_TEST_SUITE_P(
    Samples, Defaults,
    ::testing::Values(Expected{"thesis_50x36", "samples_truth.gpkg", "thesis_50x36", 0.93},
                      Expected{"hotel_70x85", "samples_truth.gpkg", "hotel_70x85", 0.92},
                      Expected{"courtyard_utm", "samples_truth.gpkg", "courtyard_utm", 0.97},
                      Expected{"degrees", "samples_truth.gpkg", "degrees", 0.93},
                      Expected{"nodata", "samples_truth.gpkg", "nodata", 0.96},
                      Expected{"town", "town_truth.gpkg", "blocks_dissolved", 0.94}),
    [](const auto& test) { return std::string(test.param.name); });

class DefaultHeights : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
    }
    /// Each true building with the one that overlaps it most.
    void expect_heights(const std::string& name, double metres, double tolerance) const {
        run_well({"-q", "-overwrite", sample(name + ".tif"), "out.gpkg"});
        const Layer found = layer("out.gpkg", "buildings");
        for (const Record& real : read_layer(sample("samples_truth.gpkg"), name).records) {
            const Record* best = nullptr;
            double most = 0.5;
            for (const Record& record : found.records)
                if (const double share = overlap(record.geometry(), real.geometry()); share > most) {
                    most = share;
                    best = &record;
                }
            ASSERT_NE(best, nullptr) << real.text("kind");
            // The top of a roof is seen at the middles of cells, and ground is that of the lower side.
            EXPECT_NEAR(best->number("roof"), real.number("ground") + real.number("roof_h"),
                        tolerance / metres)
                << real.text("kind");
            EXPECT_NEAR(best->number("ground"), real.number("ground"), tolerance / metres)
                << real.text("kind");
            EXPECT_NEAR(best->number("height"), metres * real.number("roof_h"), tolerance)
                << real.text("kind");
        }
    }
};

TEST_F(DefaultHeights, OnLevelGround) {
    expect_heights("thesis_50x36", 1, 1e-6);
    expect_heights("hotel_70x85", 0.3048, 0.3);
}

TEST_F(DefaultHeights, OnSlopes) {
    expect_heights("degrees", 1, 1.0);
    expect_heights("nodata", 1, 1.0);
    expect_heights("courtyard_utm", 1, 2.0);
}

/// 11 x 7 points of 1 m with a block of 9 x 5 in feet, which leaves too little ground to estimate one from.
TEST_F(DefaultHeights, OfTheThesisExample) {
    run_well({"-q", "-ground", "none", sample("thesis_11x7.tif"), "out.gpkg"});
    const Layer found = layer("out.gpkg", "buildings");
    ASSERT_EQ(found.records.size(), 1U);
    EXPECT_NEAR(found.records[0].area(), 9 * 5, 5);  // a cell or so in each corner
    EXPECT_DOUBLE_EQ(found.records[0].number("height"), 50 * 0.3048);
}

}  // namespace
}  // namespace d2b::test
