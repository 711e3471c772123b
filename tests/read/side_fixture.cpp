#include "read/side_fixture.hpp"

#include <cmath>

#include <ogr_srs_api.h>

namespace d2b::test {

namespace {

/// Transforms from one code to the other, in place; axes as GIS programs have them.
void transform(const std::string& from, const std::string& to, std::vector<double>& x,
               std::vector<double>& y) {
    if (to.empty() || from == to)
        return;
    const OGRSpatialReferenceH a = OSRNewSpatialReference(nullptr);
    const OGRSpatialReferenceH b = OSRNewSpatialReference(nullptr);
    ASSERT_EQ(OSRSetFromUserInput(a, from.c_str()), OGRERR_NONE);
    ASSERT_EQ(OSRSetFromUserInput(b, to.c_str()), OGRERR_NONE);
    OSRSetAxisMappingStrategy(a, OAMS_TRADITIONAL_GIS_ORDER);
    OSRSetAxisMappingStrategy(b, OAMS_TRADITIONAL_GIS_ORDER);
    const OGRCoordinateTransformationH operation = OCTNewCoordinateTransformation(a, b);
    ASSERT_EQ(OCTTransform(operation, static_cast<int>(x.size()), x.data(), y.data(), nullptr), TRUE);
    OCTDestroyCoordinateTransformation(operation);
    OSRDestroySpatialReference(a);
    OSRDestroySpatialReference(b);
}

}  // namespace

void SideTest::dem(RasterSpec spec) {
    write(path("dem.tif"), spec);
    grid_ = open("dem.tif")->info();
    warnings_.clear();
}

void SideTest::side(RasterSpec spec, const Surface& surface, const std::string& crs) {
    const std::array<double, 6>& g = *spec.transform;
    std::vector<double> x;
    std::vector<double> y;
    for (int row = 0; row < spec.rows; ++row)
        for (int col = 0; col < spec.cols; ++col) {
            x.push_back(g[0] + (col + 0.5) * g[1] + (row + 0.5) * g[2]);
            y.push_back(g[3] + (col + 0.5) * g[4] + (row + 0.5) * g[5]);
        }
    transform(spec.crs, crs, x, y);
    spec.values.clear();
    for (std::size_t i = 0; i < x.size(); ++i)
        spec.values.push_back(surface(x[i], y[i]));
    write(path("side.tif"), spec);
}

std::vector<double> SideTest::expected(const Surface& surface) const {
    const Window& w = grid_.window;
    const AffineTransform& g = grid_.transform;
    std::vector<double> values;
    for (int row = w.row; row < w.row + w.rows; ++row)
        for (int col = w.col; col < w.col + w.cols; ++col)
            values.push_back(surface(g[0] + (col + 0.5) * g[1] + (row + 0.5) * g[2],
                                     g[3] + (col + 0.5) * g[4] + (row + 0.5) * g[5]));
    return values;
}

std::vector<double> SideTest::terrain(double dem_vertical_metres) {
    const auto source = reading::open_terrain(path("side.tif"), grid_, dem_vertical_metres,
                                              land_elevations.times(1 / dem_vertical_metres), callbacks_);
    std::vector<double> elevations = all_of(*source);
    outside_range_ = source->cells_outside_range();
    return elevations;
}

std::vector<double> SideTest::mask(const std::string& name, const std::string& layer) {
    return all_of(*reading::open_mask(path(name), layer, grid_, callbacks_));
}

std::vector<double> SideTest::ndvi() {
    return all_of(*reading::open_ndvi(path("side.tif"), grid_, callbacks_));
}

void expect_near(const std::vector<double>& got, const std::vector<double>& expected, double tolerance) {
    ASSERT_EQ(got.size(), expected.size());
    double most = 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
        ASSERT_EQ(std::isnan(got[i]), std::isnan(expected[i])) << "value " << i << " is " << got[i];
        if (!std::isnan(got[i]))
            most = std::max(most, std::abs(got[i] - expected[i]));
    }
    EXPECT_LE(most, tolerance);
}

double plane(double x, double y) {
    return 100 + 0.03 * (x - 500000) - 0.02 * (y - 5538630);
}

}  // namespace d2b::test
