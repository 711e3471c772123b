#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "geometry/geos.hpp"
#include "pipeline/made_town.hpp"
#include "pipeline/pipeline_case.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

constexpr std::size_t roof_layer = 2;  // after buildings and contours
constexpr double degree = std::numbers::pi / 180;

/// Town in which the gabled house has a shed roof that rises by `per_col` and `per_row` metres a cell.
std::vector<double> with_shed(double per_col, double per_row) {
    std::vector<double> z = MadeTown::surface();
    const Box& box = MadeTown::gabled;
    for (int r = box.row; r < box.row + box.rows; ++r)
        for (int c = box.col; c < box.col + box.cols; ++c)
            z[MadeTown::index(r, c)] =
                MadeTown::middle(box) + 5 + per_col * (c - box.col) + per_row * (r - box.row);
    return z;
}

struct RoofRun : TownRun {
    explicit RoofRun(std::vector<double> elevations = MadeTown::surface()) : TownRun(std::move(elevations)) {
        options.write.roofs = true;
    }
    void place(const AffineTransform& transform, const std::string& crs = "EPSG:25833") {
        dem.edit().transform = transform;
        dem.edit().georeferenced = true;
        dem.edit().crs_wkt = Crs(crs).wkt();
    }
    /// Faces of a building, as numbers of features.
    [[nodiscard]] std::vector<std::size_t> faces_of(std::int64_t building) const {
        std::vector<std::size_t> faces;
        for (std::size_t i = 0; i < count(roof_layer); ++i)
            if (sink.whole(roof_layer, i, "bldg_id") == building)
                faces.push_back(i);
        return faces;
    }
    [[nodiscard]] std::string kind(std::size_t face) const {
        return std::get<std::string>(sink.value(roof_layer, face, "kind"));
    }
    /// The face of pitched roofs with the largest area.
    [[nodiscard]] std::size_t largest_pitched() const {
        std::size_t largest = count(roof_layer);
        for (std::size_t i = 0; i < count(roof_layer); ++i)
            if (kind(i) == "pitched" &&
                (largest == count(roof_layer) ||
                 sink.number(roof_layer, i, "area_m2") > sink.number(roof_layer, largest, "area_m2")))
                largest = i;
        return largest;
    }
};

/// Slopes of the plane through the corners of a face by least squares, and their largest distance from it.
struct FittedFace {
    explicit FittedFace(const WorldPolygon& polygon) {
        std::vector<std::array<double, 3>> points;
        const auto add = [&](const WorldRing& ring) {
            for (const Position& p : ring)
                points.push_back({p.x, p.y, polygon.elevations.at(points.size())});
        };
        add(polygon.exterior);
        for (const WorldRing& ring : polygon.interiors)
            add(ring);
        std::array<double, 3> mean{};
        for (const auto& p : points)
            for (std::size_t k = 0; k < 3; ++k)
                mean[k] += p[k] / static_cast<double>(points.size());
        double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
        for (const auto& p : points) {
            const double x = p[0] - mean[0], y = p[1] - mean[1], z = p[2] - mean[2];
            xx += x * x, xy += x * y, yy += y * y, xz += x * z, yz += y * z;
        }
        const double determinant = xx * yy - xy * xy;
        x_slope = (xz * yy - yz * xy) / determinant;
        y_slope = (yz * xx - xz * xy) / determinant;
        for (const auto& p : points)
            distance = std::max(
                distance, std::abs(p[2] - mean[2] - x_slope * (p[0] - mean[0]) - y_slope * (p[1] - mean[1])));
    }
    [[nodiscard]] double slope() const { return std::atan(std::hypot(x_slope, y_slope)) / degree; }
    /// Direction in which water runs, clockwise from the y axis.
    [[nodiscard]] double azimuth() const {
        return std::fmod(std::atan2(-x_slope, -y_slope) / degree + 360, 360);
    }

    double x_slope = 0;
    double y_slope = 0;
    double distance = 0;
};

double turned(double one, double other) {
    return std::abs(std::remainder(one - other, 360));
}

/// Faces of each building are valid, tile it, are plane, and have fields that agree with their corners.
void expect_sound(const RoofRun& town) {
    Geos geos;
    ASSERT_EQ(town.sink.layers[roof_layer].name, "roofs");
    EXPECT_TRUE(town.sink.layers[roof_layer].with_z);
    std::size_t all = 0;
    for (std::size_t b = 0; b < town.count(buildings); ++b) {
        const std::int64_t id = town.sink.whole(buildings, b, "id");
        SCOPED_TRACE("building " + std::to_string(id));
        const Feature& building = town.sink.features[buildings][b];
        ASSERT_EQ(building.parts.size(), 1U);
        double sum = 0;
        double sum_m2 = 0;
        const auto faces = town.faces_of(id);
        EXPECT_FALSE(faces.empty());
        for (const std::size_t i : faces) {
            ++all;
            const Feature& face = town.sink.features[roof_layer][i];
            ASSERT_EQ(face.parts.size(), 1U);
            EXPECT_EQ(geos.invalidity(face.parts), "");
            EXPECT_LT(geos.area_outside(face.parts[0], building.parts[0]), 1e-6 * area_of(building.parts));
            sum += area_of(face.parts);
            sum_m2 += town.sink.number(roof_layer, i, "area_m2");
            const FittedFace fitted(face.parts[0]);
            EXPECT_LT(fitted.distance, 1e-3);
            EXPECT_LT(fitted.slope(), 65);
            if (town.kind(i) == "doubtful") {
                EXPECT_EQ(town.sink.value(roof_layer, i, "slope"), FieldValue{});
                EXPECT_EQ(town.sink.value(roof_layer, i, "azimuth"), FieldValue{});
                continue;
            }
            EXPECT_NEAR(town.sink.number(roof_layer, i, "slope"), fitted.slope(), 0.3);
            EXPECT_EQ(town.kind(i), town.sink.number(roof_layer, i, "slope") < 8 ? "flat" : "pitched");
            if (town.kind(i) == "pitched")
                EXPECT_LT(turned(town.sink.number(roof_layer, i, "azimuth"), fitted.azimuth()), 1);
            else
                EXPECT_EQ(town.sink.value(roof_layer, i, "azimuth"), FieldValue{});
            const auto [low, high] = std::ranges::minmax(face.parts[0].elevations);
            EXPECT_EQ(town.sink.number(roof_layer, i, "z_low"), low);
            EXPECT_EQ(town.sink.number(roof_layer, i, "z_high"), high);
        }
        EXPECT_NEAR(sum, area_of(building.parts), 1e-6 * area_of(building.parts));
        EXPECT_NEAR(sum_m2, town.sink.number(buildings, b, "area_m2"),
                    0.01 * static_cast<double>(faces.size() + 1));
    }
    EXPECT_EQ(all, town.count(roof_layer));
    ASSERT_TRUE(town.report.roofs);
    EXPECT_EQ(town.report.roofs->faces(), static_cast<std::int64_t>(all));
    EXPECT_EQ(town.report.counted(Reason::roof_face_doubtful), town.report.roofs->doubtful);
}

/// The gable rises by 4 m over 6 m, to both sides of a ridge that runs from west to east.
TEST(Roofs, OfTheMadeTown) {
    RoofRun town;
    town.place({391000, 1, 0, 5820000, 0, -1});
    town.run();
    ASSERT_EQ(town.count(), 3U);
    expect_sound(town);
    const std::size_t gabled = town.at(MadeTown::gabled);
    const auto text = [&](std::size_t building) {
        return std::get<std::string>(town.sink.value(buildings, building, "roof_type"));
    };
    EXPECT_EQ(text(gabled), "gabled");
    EXPECT_EQ(text(town.at(MadeTown::flat)), "flat");
    EXPECT_EQ(text(town.at(MadeTown::podium)), "flat");
    const double ground = MadeTown::middle(MadeTown::gabled);
    EXPECT_NEAR(town.sink.number(buildings, gabled, "ridge_z"), ground + MadeTown::ridge, 0.1);
    EXPECT_NEAR(town.sink.number(buildings, gabled, "eave_z"), ground + MadeTown::eaves, 0.15);
    EXPECT_EQ(town.sink.number(buildings, gabled, "flat_m2"), 0);
    EXPECT_LT(town.sink.number(buildings, gabled, "roof_rmse"), 0.1);
    EXPECT_NEAR(town.sink.number(buildings, town.at(MadeTown::flat), "flat_m2"), MadeTown::flat.area(), 6);
    const auto faces = town.faces_of(town.sink.whole(buildings, gabled, "id"));
    ASSERT_EQ(faces.size(), 2U);
    std::vector<double> azimuths;
    for (const std::size_t i : faces) {
        EXPECT_NEAR(town.sink.number(roof_layer, i, "slope"), std::atan(4.0 / 6) / degree, 0.5);
        EXPECT_NEAR(town.sink.number(roof_layer, i, "area_m2"), MadeTown::gabled.area() / 2, 6);
        EXPECT_NEAR(town.sink.number(roof_layer, i, "roof_m2"),
                    town.sink.number(roof_layer, i, "area_m2") * std::hypot(1, 4.0 / 6), 1);
        azimuths.push_back(std::remainder(town.sink.number(roof_layer, i, "azimuth"), 360));
    }
    std::ranges::sort(azimuths, {}, [](double azimuth) { return std::abs(azimuth); });
    EXPECT_NEAR(azimuths[0], 0, 1);
    EXPECT_NEAR(std::abs(azimuths[1]), 180, 1);
}

struct Placed {
    std::string name;
    AffineTransform transform;
    double azimuth;
    double slope;
    std::string crs = "EPSG:25833";
    double tolerance = 0.6;
};

class ShedRoof : public testing::TestWithParam<Placed> {};

/// A shed that rises by 0.4 m a column and 0.2 m a row. With the north up, water runs 0.4 to the west and 0.2
/// to the north: 360 - atan(2) = 296.57 degrees, at atan(sqrt(0.2)) = 24.09 degrees.
TEST_P(ShedRoof, SlopesInTheDirectionOfItsRaster) {
    RoofRun town(with_shed(0.4, 0.2));
    town.place(GetParam().transform, GetParam().crs);
    town.run();
    ASSERT_GT(town.count(roof_layer), 0U);
    const std::size_t shed = town.largest_pitched();
    ASSERT_LT(shed, town.count(roof_layer));
    EXPECT_LT(turned(town.sink.number(roof_layer, shed, "azimuth"), GetParam().azimuth),
              GetParam().tolerance);
    EXPECT_NEAR(town.sink.number(roof_layer, shed, "slope"), GetParam().slope, GetParam().tolerance);
    EXPECT_EQ(town.kind(shed), "pitched");
}

constexpr double c30 = 0.8660254037844386;

INSTANTIATE_TEST_SUITE_P(
    Rasters, ShedRoof,
    testing::Values(
        Placed{"north_up", {391000, 1, 0, 5820000, 0, -1}, 296.565, 24.095},
        // Rows to the north: water runs 0.2 to the south.
        Placed{"south_up", {391000, 1, 0, 5820000, 0, 1}, 243.435, 24.095},
        // Columns to the west: water runs 0.4 to the east.
        Placed{"mirrored", {391000, -1, 0, 5820000, 0, -1}, 63.435, 24.095},
        // Turned anticlockwise by 30 degrees.
        Placed{"rotated", {391000, c30, 0.5, 5820000, 0.5, -c30}, 266.565, 24.095},
        // Rows of half a metre: 0.4 a metre to the north.
        Placed{"oblong", {391000, 1, 0, 5820000, 0, -0.5}, 315, 29.496},
        // Each row half a metre further east: 0.4 c + 0.2 r is 0.4 x, and water runs to the west.
        Placed{"sheared", {391000, 1, 0.5, 5820000, 0, -1}, 270, 21.801},
        // A degree of latitude 60 has 111,412 m to the north and 55,800 m to the east.
        Placed{"geographic", {10, 1 / 55800.0, 0, 60, 0, -1 / 111412.0}, 296.565, 24.095, "EPSG:4326"},
        // Feet of 0.3048 m in the plane, elevations in metres: slopes are 1 / 0.9 of those with 0.9 m.
        Placed{"feet",
               {1400000, 3, 0, 700000, 0, -3},
               296.565,
               std::atan(std::sqrt(0.2) / 0.9144) / degree,
               "EPSG:2263+5703"}),
    [](const auto& placed) { return placed.param.name; });

/// Water runs 0.0029 degrees to the west of north, at atan(0.2): rounded to hundredths that is north, and 0
/// as all directions are below 360.
TEST(Roofs, NorthIsZeroDegrees) {
    RoofRun town(with_shed(0.00001, 0.2));
    town.place({391000, 1, 0, 5820000, 0, -1});
    town.run();
    const std::size_t shed = town.largest_pitched();
    ASSERT_LT(shed, town.count(roof_layer));
    EXPECT_NEAR(town.sink.number(roof_layer, shed, "slope"), 11.31, 0.01);
    EXPECT_EQ(town.sink.number(roof_layer, shed, "azimuth"), 0);
}

/// 2 c - r / 2 rises by 2 to the east and 1.5 to the north: 68.2 degrees, although only 64 if rows and
/// columns were at right angles.
TEST(Roofs, NoneIsTooSteepOnAShearedGrid) {
    RoofRun town(with_shed(2, -0.5));
    town.place({391000, 1, 0.5, 5820000, 0, -1});
    town.run();
    ASSERT_GT(town.count(roof_layer), 0U);
    expect_sound(town);
}

/// Elevations in feet are of the same building; corners and fields have the unit of the raster.
TEST(Roofs, ElevationsInFeet) {
    RoofRun metres;
    metres.place({391000, 1, 0, 5820000, 0, -1});
    metres.run();
    std::vector<double> z = MadeTown::surface();
    for (double& value : z)
        value /= 0.3048;
    RoofRun feet(z);
    feet.place({391000, 1, 0, 5820000, 0, -1});
    feet.options.read.vertical_unit = "ft";
    feet.run();
    ASSERT_EQ(feet.count(roof_layer), metres.count(roof_layer));
    for (std::size_t i = 0; i < feet.count(roof_layer); ++i) {
        EXPECT_NEAR(feet.sink.number(roof_layer, i, "z_high") * 0.3048,
                    metres.sink.number(roof_layer, i, "z_high"), 0.02);
        EXPECT_NEAR(feet.sink.number(roof_layer, i, "z_low") * 0.3048,
                    metres.sink.number(roof_layer, i, "z_low"), 0.02);
        EXPECT_NEAR(feet.sink.number(roof_layer, i, "slope"), metres.sink.number(roof_layer, i, "slope"),
                    0.1);
        EXPECT_NEAR(feet.sink.number(roof_layer, i, "rmse_m"), metres.sink.number(roof_layer, i, "rmse_m"),
                    0.01);
    }
    const std::size_t gabled = feet.at(MadeTown::gabled);
    EXPECT_NEAR(feet.sink.number(buildings, gabled, "ridge_z") * 0.3048,
                MadeTown::middle(MadeTown::gabled) + MadeTown::ridge, 0.1);
}

/// A face belongs to one part, and the parts of a building are tiled each by themselves.
TEST(Roofs, OfPartsBelongToTheirPart) {
    RoofRun town;
    town.options.detect.split_height = 3;
    town.place({391000, 1, 0, 5820000, 0, -1});
    town.run();
    ASSERT_EQ(town.count(), 4U);
    expect_sound(town);
    // The tower and its podium were one building; its name is the lower id of both.
    const std::int64_t tower = town.sink.whole(buildings, town.at(MadeTown::tower), "id");
    std::set<std::int64_t> divided;
    std::set<std::int64_t> named;
    for (std::size_t i = 0; i < town.count(roof_layer); ++i)
        if (town.sink.value(roof_layer, i, "part_id") != FieldValue{}) {
            divided.insert(town.sink.whole(roof_layer, i, "bldg_id"));
            named.insert(town.sink.whole(roof_layer, i, "part_id"));
        }
    ASSERT_EQ(divided.size(), 2U);
    EXPECT_EQ(named, std::set<std::int64_t>{*divided.begin()});
    EXPECT_TRUE(divided.contains(tower));
}

TEST(Roofs, InAnotherCrsKeepTheirElevations) {
    RoofRun town;
    town.place({391000, 1, 0, 5820000, 0, -1});
    town.run();
    RoofRun other;
    other.place({391000, 1, 0, 5820000, 0, -1});
    other.options.outline.target_crs = "EPSG:4326";
    other.run();
    ASSERT_EQ(other.count(roof_layer), town.count(roof_layer));
    for (std::size_t i = 0; i < town.count(roof_layer); ++i) {
        const WorldPolygon& there = other.sink.features[roof_layer][i].parts.at(0);
        const WorldPolygon& here = town.sink.features[roof_layer][i].parts.at(0);
        EXPECT_NEAR(there.exterior[0].x, 13.4, 0.1);
        ASSERT_EQ(there.elevations.size(),
                  there.exterior.size() + (there.interiors.empty() ? 0 : there.interiors[0].size()));
        EXPECT_EQ(std::ranges::min(there.elevations), std::ranges::min(here.elevations));
        EXPECT_EQ(std::ranges::max(there.elevations), std::ranges::max(here.elevations));
        // West of the central meridian the north of the grid lies west of the true one.
        if (town.kind(i) == "pitched") {
            const double longitude = there.exterior[0].x - 15;
            const double convergence = longitude * std::sin(there.exterior[0].y * degree);
            EXPECT_LT(turned(other.sink.number(roof_layer, i, "azimuth"),
                             town.sink.number(roof_layer, i, "azimuth") + convergence),
                      0.05);
        }
        EXPECT_EQ(other.sink.value(roof_layer, i, "area_m2"), town.sink.value(roof_layer, i, "area_m2"));
    }
}

/// A window of a raster has the roofs of a raster that is no larger than the window.
TEST(Roofs, OfAWindowOfALargerRaster) {
    RoofRun whole;
    whole.place({391000, 1, 0, 5820000, 0, -1});
    whole.run();
    const DemInfo& info = whole.dem.info();
    constexpr std::int32_t above = 7;
    constexpr std::int32_t left = 11;
    const std::int32_t cols = info.cols + left;
    const std::vector<double> town = MadeTown::surface();
    std::vector<double> z(static_cast<std::size_t>((info.rows + above) * cols), 0.0);
    for (std::int32_t r = 0; r < info.rows; ++r)
        std::copy_n(town.begin() + std::ptrdiff_t{r} * info.cols, info.cols,
                    z.begin() + std::ptrdiff_t{r + above} * cols + left);
    MemorySource larger(info.rows + above, cols, z);
    larger.edit().transform = {391000 - left, 1, 0, 5820000 + above, 0, -1};
    larger.edit().georeferenced = true;
    larger.edit().crs_wkt = info.crs_wkt;
    larger.edit().window = {above, left, info.rows, info.cols};
    const Result part(larger, whole.options);
    const std::vector<Feature>& expected = whole.sink.features[roof_layer];
    const std::vector<Feature>& faces = part.sink.features[roof_layer];
    ASSERT_FALSE(expected.empty());
    ASSERT_EQ(faces.size(), expected.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        EXPECT_EQ(faces[i].values, expected[i].values);
        EXPECT_EQ(faces[i].parts.at(0).exterior, expected[i].parts.at(0).exterior);
        EXPECT_EQ(faces[i].parts.at(0).elevations, expected[i].parts.at(0).elevations);
    }
}

TEST(Roofs, WithoutTheOptionNothingIsDifferent) {
    TownRun plain;
    plain.run();
    EXPECT_EQ(plain.sink.layers.size(), 2U);
    EXPECT_FALSE(plain.report.roofs);
    RoofRun town;
    town.run();
    ASSERT_EQ(town.sink.layers.size(), 3U);
    ASSERT_EQ(town.count(), plain.count());
    for (std::size_t i = 0; i < plain.count(); ++i)
        for (const FieldSpec& field : plain.sink.layers[buildings].fields)
            EXPECT_EQ(town.sink.value(buildings, i, field.name), plain.sink.value(buildings, i, field.name));
}

TEST(Roofs, OfALibraryAreRefusedWhereTheyMakeNoSense) {
    const auto refusal = [](const std::function<void(Options&)>& change) {
        RoofRun town;
        change(town.options);
        return error_of([&] { town.run(); });
    };
    EXPECT_EQ(refusal([](Options& o) { o.preset = Preset::thesis; }),
              "-roofs has no effect with -preset thesis; it detects no buildings, so leave one of them out.");
    EXPECT_EQ(refusal([](Options& o) { o.levels.detail = 0; }),
              "-roofs cannot be used together with -detail 0; borders between faces would cost nothing, so "
              "give a larger -detail.");
    EXPECT_EQ(refusal([](Options& o) { o.write.layers = Layers::contours; }),
              "-roofs has no effect with -layers contours; only buildings have roofs.");
}

/// Houses of random sizes and directions with roofs of any kind, on a raster of 1 m or less.
class RandomHouses {
  public:
    explicit RandomHouses(unsigned seed) : random_(seed) {
        for (int i = 0; i < side * side; ++i)
            z_.push_back(40 + 0.01 * (i % side) + 0.02 * share());
        for (int row = 0; row < 3; ++row)
            for (int col = 0; col < 3; ++col)
                house(25 + 50 * row + 6 * (share() - 0.5), 25 + 50 * col + 6 * (share() - 0.5));
    }
    static constexpr int side = 150;
    [[nodiscard]] const std::vector<double>& surface() const { return z_; }

  private:
    [[nodiscard]] double share() { return static_cast<double>(random_() % 100000) / 100000; }
    void house(double row, double col) {
        const double half_width = 4 + 6 * share();
        const double half_length = half_width + 7 * share();
        const double angle = std::numbers::pi * share();
        const double slope = 0.2 + share();
        const double eaves = 44 + 5 * share();
        const std::size_t kind = random_() % 5;
        for (int r = 0; r < side; ++r)
            for (int c = 0; c < side; ++c) {
                const double x = c + 0.5 - col;
                const double y = r + 0.5 - row;
                const double along = x * std::cos(angle) + y * std::sin(angle);
                const double across = y * std::cos(angle) - x * std::sin(angle);
                const double from_side = half_width - std::abs(across);
                const double from_end = half_length - std::abs(along);
                if (from_side < 0 || from_end < 0)
                    continue;
                const std::array<double, 5> rise{
                    0.0,                                                             // flat
                    slope * from_side,                                               // gabled
                    slope * std::min(from_side, from_end),                           // hipped
                    0.5 * slope * (half_width + across),                             // shed
                    along > 0 ? slope * from_side : 3.0 + 0.2 * slope * from_side};  // two in one
                z_[static_cast<std::size_t>(r * side + c)] = eaves + rise[kind] + 0.04 * (share() - 0.5);
            }
    }

    std::mt19937 random_;
    std::vector<double> z_;
};

struct HouseRun : RoofRun {
    explicit HouseRun(const std::vector<double>& surface) {
        std::vector<double> z = surface;
        houses.emplace(RandomHouses::side, RandomHouses::side, std::move(z));
        houses->edit().transform = {391000, 1, 0, 5820000, 0, -1};
        houses->edit().georeferenced = true;
        houses->edit().crs_wkt = Crs("EPSG:25833").wkt();
    }
    void run(int threads, const BandSize& size = {}) {
        options.run.threads = threads;
        report = d2b::run(options, {*houses}, {sink}, {}, size);
    }
    std::optional<MemorySource> houses;
};

class RandomRoofs : public testing::TestWithParam<unsigned> {};

TEST_P(RandomRoofs, AreValidPlaneAndTileTheirBuildings) {
    HouseRun town(RandomHouses(GetParam()).surface());
    const std::array<Walls, 4> walls{Walls::automatic, Walls::off, Walls::right, Walls::free};
    town.options.outline.walls = walls[GetParam() % 4];
    town.options.levels.detail = GetParam() % 3 == 0 ? 0.25 : 0.5;
    town.run(2);
    EXPECT_GE(town.count(), 6U);
    expect_sound(town);
}

TEST_P(RandomRoofs, AreTheSameOnAnyNumberOfThreadsAndInAnyBands) {
    const RandomHouses houses(GetParam());
    HouseRun one(houses.surface());
    one.run(1);
    HouseRun four(houses.surface());
    four.run(4, {1 << 10, 0});
    ASSERT_EQ(four.count(roof_layer), one.count(roof_layer));
    for (std::size_t i = 0; i < one.count(roof_layer); ++i) {
        EXPECT_EQ(four.sink.features[roof_layer][i].values, one.sink.features[roof_layer][i].values);
        const WorldPolygon& here = one.sink.features[roof_layer][i].parts[0];
        const WorldPolygon& there = four.sink.features[roof_layer][i].parts[0];
        EXPECT_EQ(there.exterior, here.exterior);
        EXPECT_EQ(there.interiors, here.interiors);
        EXPECT_EQ(there.elevations, here.elevations);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRoofs, testing::Range(0U, 24U));

}  // namespace
}  // namespace d2b::test
