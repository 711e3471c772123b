#include <algorithm>
#include <cmath>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

using Transform = std::array<double, 6>;

/// The same grid in another place must give the same contours.
class Variants : public CliTest {
  protected:
    static RasterSpec sample_grid(const std::string& name) {
        const OpenDataset dem(GDALOpen(sample(name).c_str(), GA_ReadOnly));
        RasterSpec spec = blocks();
        spec.cols = GDALGetRasterXSize(dem.get());
        spec.rows = GDALGetRasterYSize(dem.get());
        spec.values.resize(static_cast<std::size_t>(spec.cols * spec.rows));
        EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(dem.get(), 1), GF_Read, 0, 0, spec.cols, spec.rows,
                               spec.values.data(), spec.cols, spec.rows, GDT_Float64, 0, 0),
                  CE_None);
        return spec;
    }
    static RasterSpec upside_down(RasterSpec spec) {
        for (int row = 0; row < spec.rows / 2; ++row)
            std::swap_ranges(spec.values.begin() + row * spec.cols,
                             spec.values.begin() + (row + 1) * spec.cols,
                             spec.values.begin() + (spec.rows - 1 - row) * spec.cols);
        return spec;
    }
    /// (level, area in the plane) of every contour, sorted.
    std::vector<std::pair<double, double>> areas(RasterSpec spec, const Transform& transform,
                                                 const char* mode) const {
        spec.transform = transform;
        write(path("dem.tif"), spec);
        run_well({"-q", "-trace", mode, "-overwrite", "dem.tif", "out.gpkg"});
        std::vector<std::pair<double, double>> result;
        for (const Record& record : layer("out.gpkg", "contours").records) {
            EXPECT_TRUE(record.valid());
            result.emplace_back(record.number("level"), record.area());
        }
        std::sort(result.begin(), result.end());
        return result;
    }
    void expect_same(const RasterSpec& spec, const RasterSpec& other, const Transform& transform) const {
        const Transform north_up{391000, 1, 0, 5820000, 0, -1};
        for (const char* mode : {"points", "cells"}) {
            const auto expected = areas(spec, north_up, mode);
            const auto found = areas(other, transform, mode);
            ASSERT_EQ(found.size(), expected.size()) << mode;
            ASSERT_GT(found.size(), 2U);
            for (std::size_t i = 0; i < found.size(); ++i) {
                EXPECT_EQ(found[i].first, expected[i].first);
                // Coordinates of seven digits before the point are exact to 1e-9.
                EXPECT_NEAR(found[i].second, expected[i].second, 1e-6);
            }
        }
    }
};

constexpr std::array grids{"courtyard_utm.tif", "thesis_50x36.tif", "hotel_70x85.tif"};

TEST_F(Variants, southUp) {
    for (const char* name : grids) {
        const RasterSpec spec = sample_grid(name);
        expect_same(spec, upside_down(spec), {391000, 1, 0, 5820000.0 - spec.rows, 0, 1});
    }
}

TEST_F(Variants, southUpAtTheSamePlaces) {
    const RasterSpec spec = blocks();
    write(path("north.tif"), spec);
    RasterSpec south = upside_down(spec);
    south.transform = Transform{391000, 1, 0, 5819980, 0, 1};
    write(path("south.tif"), south);
    run_well({"-q", "-fl", "5", "--", "north.tif", "north.gpkg"});
    run_well({"-q", "-fl", "5", "--", "south.tif", "south.gpkg"});
    const Layer north = layer("north.gpkg", "buildings");
    const Layer found = layer("south.gpkg", "buildings");
    ASSERT_EQ(found.records.size(), north.records.size());
    for (const Record& record : north.records) {
        // The rings may begin elsewhere.
        const auto covers = [&](const Record& other) {
            return OGR_G_Contains(other.geometry(), record.geometry()) != 0 && other.area() == record.area();
        };
        EXPECT_EQ(std::count_if(found.records.begin(), found.records.end(), covers), 1);
    }
}

TEST_F(Variants, mirrored) {
    const RasterSpec spec = sample_grid("courtyard_utm.tif");
    expect_same(spec, spec, {391500, -1, 0, 5820000, 0, -1});
}

TEST_F(Variants, rotated) {
    for (const char* name : grids) {
        const RasterSpec spec = sample_grid(name);
        for (const double degrees : {30.0, 90.0, 137.0}) {
            const double c = std::cos(degrees * M_PI / 180);
            const double s = std::sin(degrees * M_PI / 180);
            expect_same(spec, spec, {391000, c, s, 5820000, s, -c});
        }
    }
}

TEST_F(Variants, notSquare) {
    for (const char* name : grids) {
        const RasterSpec spec = sample_grid(name);
        expect_same(spec, spec, {391000, 0.5, 0, 5820000, 0, -2});
    }
}

TEST_F(Variants, sheared) {
    const RasterSpec spec = sample_grid("hotel_70x85.tif");
    expect_same(spec, spec, {391000, 1, 0.5, 5820000, 0, -1});
}

}  // namespace
}  // namespace d2b::test
