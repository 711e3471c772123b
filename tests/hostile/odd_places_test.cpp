#include <cmath>

#include "hostile/hostile_case.hpp"

namespace d2b::test {
namespace {

using Transform = std::array<double, 6>;

class OddPlaces : public HostileTest {
  protected:
    /// The areas that one block has there, in the plane and on the ellipsoid.
    struct Areas {
        double plane = 0;
        double square_metres = 0;
    };
    Areas areas(const Transform& transform, const std::string& crs) const {
        RasterSpec spec = one_block();
        spec.transform = transform;
        spec.crs = crs;
        const Layer found = buildings(spec);
        EXPECT_EQ(found.records.size(), 1U);
        if (found.records.size() != 1)
            return {};
        return {found.records[0].area(), found.records[0].number("area_m2")};
    }
};
INSTANTIATE_TEST_SUITE_P(All, OddPlaces, ::testing::ValuesIn(ways()), way_name);

TEST_P(OddPlaces, southUpMirroredAndTurned) {
    const double c = std::cos(0.5);
    const double s = std::sin(0.5);
    const double expected = areas({391000, 1, 0, 5820000, 0, -1}, "EPSG:25833").plane;
    EXPECT_NEAR(expected, block_area(), slack());
    for (const Transform& transform : {Transform{391000, 1, 0, 5820000, 0, 1},
                                       {391000, -1, 0, 5820000, 0, -1},
                                       {391000, c, s, 5820000, s, -c},
                                       {391000, 0, 1, 5820000, 1, 0}})
        EXPECT_NEAR(areas(transform, "EPSG:25833").plane, expected, 1e-6);
}

TEST_P(OddPlaces, singularTransformsAreRefused) {
    for (const Transform& transform : {Transform{391000, 1, 2, 5820000, 2, 4}}) {
        RasterSpec spec = one_block();
        spec.transform = transform;
        write(path("flat.tif"), spec);
        Arguments arguments = GetParam().arguments;
        arguments.insert(arguments.end(), {"--", "flat.tif", "out.gpkg"});
        expect_error(1, "gives its cells no area; correct it", arguments);
    }
}

TEST_P(OddPlaces, acrossTheAntimeridian) {
    // 1e-5 degrees are 1.1 m; column 21 of 60 begins beyond 180 degrees. Areas do not depend on longitude.
    const Areas across = areas({179.9998, 1e-5, 0, 10, 0, -1e-5}, "EPSG:4326");
    const Areas elsewhere = areas({10, 1e-5, 0, 10, 0, -1e-5}, "EPSG:4326");
    EXPECT_NEAR(across.square_metres, elsewhere.square_metres, 1e-5);
    EXPECT_GT(across.square_metres, 500);
    EXPECT_LT(across.square_metres, 650);
}

TEST_P(OddPlaces, besideAPole) {
    // The top edge is the pole itself: cells there are 1.1 m high and have no width.
    RasterSpec spec = one_block();
    spec.transform = Transform{10, 1e-5, 0, 90, 0, -1e-5};
    spec.crs = "EPSG:4326";
    const Layer found = buildings(spec);
    EXPECT_LE(found.records.size(), 1U);
    for (const Record& record : found.records) {
        EXPECT_GE(record.number("area_m2"), 0);    // rounded to hundredths
        EXPECT_LT(record.number("area_m2"), 0.2);  // 22 m long and 7 mm wide
    }
}

/// The middle of a block may lie beyond the raster, and the pole, where areas are measured in blocks of
/// cells.
TEST_P(OddPlaces, nothingIsMeasuredBeyondThePole) {
    RasterSpec spec = one_block();
    spec.crs = "EPSG:4326";
    for (const Transform& transform : {Transform{10, 5e-4, 0, -89.99978, 0, -4.4e-6},  // south, 24 m off
                                       {10, 5e-4, 0, 89.99978, 0, 4.4e-6},
                                       {10, 1, 0, -20, 0, -1.4},  // coarse, down to the pole
                                       {-180, 6, 0, 90, 0, -3.6}}) {
        spec.transform = transform;
        static_cast<void>(buildings(spec));  // status 0
    }
    // Rows of a metre from 61 to 11 m before the south pole, columns of half a degree: the block is 20 m long
    // and 12.5 degrees wide at 36 m on average, or 19 m and 12 degrees between its points.
    spec.transform = Transform{10, 0.5, 0, -90 + 5.5e-4, 0, -9e-6};
    const Layer found = buildings(spec);
    EXPECT_LE(found.records.size(), 1U);
    if (thesis()) {
        ASSERT_EQ(found.records.size(), 1U);
    }
    for (const Record& record : found.records)
        EXPECT_NEAR(record.number("area_m2"), 150, 30);
}

TEST_P(OddPlaces, cellsOfAPicometre) {
    RasterSpec spec = one_block();
    spec.transform = Transform{391000, 1e-12, 0, 5820000, 0, -1e-12};
    spec.crs = "";
    for (const Record& record : buildings(spec).records)
        EXPECT_LE(record.area(), 1e-20);
}

TEST_P(OddPlaces, cellsThatAreFarFromSquare) {
    for (const Transform& transform : {Transform{0, 1e-9, 0, 5820000, 0, -1},
                                       {0, 1, 0, 5820000, 0, -1e-6},
                                       {0, 1e3, 0, 5820000, 0, -1e-6}})
        for (const char* walls : {"auto", "right", "off"}) {
            RasterSpec spec = one_block();
            spec.transform = transform;
            spec.crs = "";
            for (const Record& record : buildings(spec, {"-regularize", walls}).records)
                EXPECT_LE(record.area(), 3000 * std::abs(transform[1] * transform[5]));
        }
}

TEST_P(OddPlaces, aLocalSystem) {
    const std::string site = R"(LOCAL_CS["site",UNIT["metre",1],AXIS["x",EAST],AXIS["y",NORTH]])";
    const Areas local = areas({0, 1, 0, 0, 0, -1}, site);
    EXPECT_NEAR(local.plane, block_area(), slack());
    EXPECT_NEAR(local.square_metres, local.plane, 0.005 + 1e-9);  // fields are rounded to hundredths
}

TEST_P(OddPlaces, coordinatesWithoutAPlaceOnEarthAreRefused) {
    RasterSpec spec = one_block();
    spec.transform = Transform{1e14, 1, 0, 5820000, 0, -1};
    write(path("far.tif"), spec);
    Arguments arguments = GetParam().arguments;
    arguments.insert(arguments.end(), {"--", "far.tif", "out.gpkg"});
    expect_error(1, "check which coordinate reference system the coordinates are in", arguments);
}

}  // namespace
}  // namespace d2b::test
