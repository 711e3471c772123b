#include "features/surface_lattice.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"

namespace d2b::features {
namespace {

/// A grid of 100 x 200 cells (rows x columns).
class SurfaceLatticeTest : public ::testing::Test {
  protected:
    SurfaceLattice lattice(const AffineTransform& transform, const std::string& crs = "EPSG:25832",
                           const std::string& target = "", double cell_m = 1,
                           std::optional<std::array<double, 3>> origin = {}, double vertical = 1) {
        georeference_.emplace(transform, TraceMode::cells);
        crs_ = Crs(crs);
        target_ = Crs(target);
        const Window window{0, 0, 100, 200};
        transform_ = output_transform(crs_, target_, *georeference_, window, {});
        return SurfaceLattice(
            {*georeference_, crs_, target_, window, {{0, 0}, {100, 200}}, cell_m, vertical, origin});
    }
    /// Place of a point of the lattice, in the units of the CRS.
    std::array<double, 3> placed(const SurfaceLattice& on, LatticePoint point) {
        const FinePoint p = fine(point);
        const auto polygon = on.place({{p, {p.row + 8, p.col}, {p.row + 8, p.col + 8}}, {}}, transform_);
        FinePoint first = polygon->exterior.front();
        for (const FinePoint& q : polygon->exterior) {  // mirrored ones run the other way
            const std::array<double, 3> at = on.frame().coordinates({q.col, -q.row, 0});
            const Position expected = georeference_->position(p);
            if (std::hypot(at[0] - expected.x, at[1] - expected.y) < 1e-3)
                first = q;
        }
        return on.frame().coordinates({first.col, -first.row, 0});
    }

    std::optional<Georeference> georeference_;
    Crs crs_;
    Crs target_;
    std::optional<RingTransform> transform_;
};

TEST_F(SurfaceLatticeTest, isThatOfTheCellsOnUnrotatedGrids) {
    const SurfaceLattice on = lattice({391000, 0.5, 0, 5820000, 0, -0.25});
    EXPECT_TRUE(on.is_exact());
    EXPECT_EQ(on.frame().scale, (std::array<double, 3>{0.5 / 1024, 0.25 / 1024, 0.001}));
    EXPECT_EQ(on.frame().translate, (std::array<double, 3>{391000, 5820000 - 25, 0}));
    EXPECT_EQ(on.frame().origin, (std::array<double, 3>{391050, 5819988, 0}));
    EXPECT_EQ(placed(on, {10, 20}), (std::array<double, 3>{391010, 5820000 - 2.5, 0}));
}

/// Rows to the north, columns to the west: exact as well, and counter-clockwise.
TEST_F(SurfaceLatticeTest, turnsOverWhatIsMirrored) {
    for (const double east : {1.0, -1.0})
        for (const double north : {1.0, -1.0}) {
            const SurfaceLattice on = lattice({391000, east, 0, 5820000, 0, north});
            EXPECT_TRUE(on.is_exact());
            const auto polygon = on.place({{{0, 0}, {1024, 0}, {1024, 1024}, {0, 1024}}, {}}, transform_);
            std::int64_t twice_area = 0;
            for (std::size_t i = 0; i < 4; ++i) {
                const FinePoint a = polygon->exterior[i];
                const FinePoint b = polygon->exterior[(i + 1) % 4];
                twice_area += a.col * -b.row - b.col * -a.row;
            }
            EXPECT_EQ(twice_area, 2 * 1024 * 1024);
            EXPECT_EQ(placed(on, {3, 5}), (std::array<double, 3>{391000 + 5 * east, 5820000 + 3 * north, 0}));
        }
}

TEST_F(SurfaceLatticeTest, isAsFineOnOtherGrids) {
    const SurfaceLattice turned = lattice({391000, 0.4, 0.3, 5820000, 0.3, -0.4}, "EPSG:25832", "", 0.5);
    EXPECT_FALSE(turned.is_exact());
    EXPECT_EQ(turned.frame().scale[0], 0.5 / 1024);
    const auto at = placed(turned, {10, 20});
    EXPECT_NEAR(at[0], 391000 + 20 * 0.4 + 10 * 0.3, turned.frame().scale[0] / 2);
    EXPECT_NEAR(at[1], 5820000 + 20 * 0.3 - 10 * 0.4, turned.frame().scale[1] / 2);
    const SurfaceLattice feet = lattice({391000, 1, 0, 5820000, 0, -1}, "EPSG:25832", "EPSG:2263", 1);
    EXPECT_FALSE(feet.is_exact());
    EXPECT_DOUBLE_EQ(feet.frame().horizontal_metres, 1200.0 / 3937);
    EXPECT_EQ(feet.frame().scale[0], 2.0 / 1024);  // of feet
}

TEST_F(SurfaceLatticeTest, heightsAreMillimetres) {
    SurfaceLattice on = lattice({391000, 1, 0, 5820000, 0, -1}, "EPSG:25832", "", 1, {}, 0.3048);
    EXPECT_EQ(on.height(10), 3048);
    EXPECT_EQ(on.height(-0.5), -152);
    on.set_lowest(-10);
    EXPECT_EQ(on.frame().origin[2], -4);
    EXPECT_NEAR(on.frame().local({0, 0, 3048})[2], 3.048 + 4, 1e-12);
    SurfaceLattice given =
        lattice({391000, 1, 0, 5820000, 0, -1}, "EPSG:25832", "", 1, std::array<double, 3>{1, 2, 3});
    given.set_lowest(-10);
    EXPECT_EQ(given.frame().origin, (std::array<double, 3>{1, 2, 3}));
}

TEST_F(SurfaceLatticeTest, anglesAreRefused) {
    EXPECT_THROW(lattice({8, 1e-5, 0, 50, 0, -1e-5}, "EPSG:4326"), OptionError);
    EXPECT_THROW(lattice({391000, 1, 0, 5820000, 0, -1}, "EPSG:25832", "EPSG:4326"), OptionError);
}

/// Up to the limit neighbouring steps differ in single precision by two of its steps at least.
TEST_F(SurfaceLatticeTest, singlePrecision) {
    const auto on = [&](double west, double cell) {
        return lattice({west, cell, 0, 0, 0, -cell}, "", "", cell, std::array<double, 3>{0, 0, 0});
    };
    EXPECT_NO_THROW(on(8192 - 200, 1).require_single_precision());
    EXPECT_THROW(on(8193 - 200, 1).require_single_precision(), OptionError);
    EXPECT_NO_THROW(on(4096 - 100, 0.5).require_single_precision());
    EXPECT_THROW(on(4097 - 100, 0.5).require_single_precision(), OptionError);
    constexpr float most = 8192;
    EXPECT_LE(2 * (most - std::nextafter(most, 0.0F)), 1 / 1024.0F);
    EXPECT_GT(2 * (std::nextafter(most, 1e9F) - most), 1 / 1024.0F);
    const SurfaceLattice low = on(0, 1);
    EXPECT_NO_THROW(low.require_single_precision(-8000, 8000));
    EXPECT_THROW(low.require_single_precision(0, 8200), OptionError);
}

/// Steps in a centimetre on the ground: of a metre 10.24, of half a metre 20.48; of a survey foot 33.6.
TEST_F(SurfaceLatticeTest, gapsAreLengthsOnTheGround) {
    EXPECT_EQ(lattice({391000, 1, 0, 5820000, 0, -1}).gaps().pinch, (surface::LatticeDistance{11, 11}));
    EXPECT_EQ(lattice({391000, 0.5, 0, 5820000, 0, -2}, "EPSG:25832", "", 1).gaps().pinch,
              (surface::LatticeDistance{6, 21}));
    EXPECT_EQ(lattice({391000, 30, 0, 5820000, 0, -30}, "EPSG:25832", "", 30).gaps().pinch,
              (surface::LatticeDistance{2, 2}));
    // Michigan South in feet.
    EXPECT_EQ(lattice({13290000, 1, 0, 280000, 0, -1}, "EPSG:2253", "", 0.3048).gaps().pinch,
              (surface::LatticeDistance{34, 34}));
    // Degrees, of which some 9e-6 are a metre, become metres in a lattice of 2^-11 m.
    EXPECT_EQ(lattice({13.4, 9e-6, 0, 52.5, 0, -9e-6}, "EPSG:4326", "EPSG:25833", 0.8).gaps().pinch,
              (surface::LatticeDistance{21, 21}));
    // A unit of Web Mercator at 60 degrees north is half a metre.
    EXPECT_EQ(lattice({391000, 1, 0, 8400000, 0, -1}, "EPSG:3857", "", 0.5).gaps().pinch,
              (surface::LatticeDistance{21, 21}));
    // No CRS: units are metres.
    EXPECT_EQ(lattice({0, 1, 0, 0, 0, -1}, "").gaps().pinch, (surface::LatticeDistance{11, 11}));
}

TEST_F(SurfaceLatticeTest, knowsTheScaleOfAreas) {
    // At 52.5 degrees in the middle of a UTM zone; feet; at 60 degrees; equal areas; no CRS.
    EXPECT_NEAR(lattice({500000, 1, 0, 5820000, 0, -2}).area_scale(), 0.9996 * 0.9996, 1e-6);
    EXPECT_NEAR(lattice({13290000, 1, 0, 280000, 0, -1}, "EPSG:2253", "", 0.3048).area_scale(), 1, 2e-4);
    EXPECT_NEAR(lattice({391000, 1, 0, 8399738, 0, -1}, "EPSG:3857", "", 0.5).area_scale(), 4, 0.04);
    EXPECT_NEAR(lattice({13.4, 9e-6, 0, 52.5, 0, -9e-6}, "EPSG:4326", "EPSG:3857", 0.8).area_scale(), 2.7,
                0.03);
    EXPECT_NEAR(lattice({4000000, 1, 0, 3500000, 0, -1}, "EPSG:3035").area_scale(), 1, 1e-6);
    EXPECT_EQ(lattice({0, 1, 0, 0, 0, -1}, "").area_scale(), 1);
}

}  // namespace
}  // namespace d2b::features
