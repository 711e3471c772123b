#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "dem2buildings/run.hpp"
#include "support/memory_io.hpp"

namespace d2b::test {
namespace {

constexpr double cell = 0.5;  // m
constexpr int rows = 280;
constexpr int cols = 400;
constexpr Position origin{500000, 5700000};  ///< the lower left corner
constexpr double ground = 100;
constexpr double outside = -std::numeric_limits<double>::infinity();
constexpr std::size_t contours = 1;

/// A building whose roof is known everywhere: heights above the ground by metres from its middle.
struct Shape {
    std::string name;
    Position middle;  ///< from the lower left corner
    double turn;      ///< degrees
    std::function<double(double, double)> roof;
    bool flat;  ///< its tiers are steps, without slopes

    [[nodiscard]] double at(double x, double y) const {
        const double a = turn * std::numbers::pi / 180;
        const double dx = x - origin.x - middle.x;
        const double dy = y - origin.y - middle.y;
        return roof(dx * std::cos(a) + dy * std::sin(a), dy * std::cos(a) - dx * std::sin(a));
    }
};

bool in_box(double x, double y, double width, double depth) {
    return std::abs(x) < width / 2 && std::abs(y) < depth / 2;
}

double sawtooth(double x, double y) {
    const double along = (x + 20) / 8;
    return in_box(x, y, 40, 24) ? 6 + 4 * (along - std::floor(along)) : outside;
}

double dome(double x, double y) {
    const double r = std::hypot(x, y) / 13;
    return r < 1 ? 6 + 9 * std::sqrt(1 - r * r) : outside;
}

double mansard(double x, double y) {
    const double inset = std::min(14 - std::abs(x), 10 - std::abs(y));
    return inset <= 0 ? outside : inset < 2 ? 8 + 2 * inset : 12 + 0.3 * (inset - 2);
}

/// Six houses side by side, whose party walls are steps of half a metre to three.
double terrace(double x, double y) {
    constexpr double heights[] = {8, 8.6, 10.5, 8.2, 11, 9};
    return in_box(x, y, 42, 11) ? heights[static_cast<int>((x + 21) / 7)] : outside;
}

double stepped_tower(double x, double y) {
    return in_box(x, y, 10, 10) ? 36 : in_box(x, y, 18, 18) ? 22 : in_box(x, y, 28, 26) ? 10 : outside;
}

double round_tower(double x, double y) {
    const double r = std::hypot(x, y);
    return r < 6 ? 42 : r < 11 ? 30 : outside;
}

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all{{"sawtooth", {40, 105}, 12, sawtooth, false},
                                        {"dome", {100, 105}, 0, dome, false},
                                        {"mansard", {155, 105}, -25, mansard, false},
                                        {"terrace", {40, 40}, 20, terrace, true},
                                        {"stepped tower", {105, 40}, 33, stepped_tower, true},
                                        {"round tower", {160, 40}, 0, round_tower, true}};
    return all;
}

std::vector<double> surface() {
    std::vector<double> z;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < cols; ++c) {
            double height = 0;
            for (const Shape& shape : shapes())
                height = std::max(height,
                                  shape.at(origin.x + (c + 0.5) * cell, origin.y + (rows - r - 0.5) * cell));
            z.push_back(ground + height);
        }
    return z;
}

/// How far a place is from where a predicate changes, up to a few metres.
double distance_to_border(const std::function<bool(double, double)>& holds, const Position& place) {
    constexpr double step = 0.05;
    constexpr int directions = 72;
    const bool here = holds(place.x, place.y);
    for (double r = step; r < 4; r += step)
        for (int i = 0; i < directions; ++i) {
            const double a = 2 * std::numbers::pi * i / directions;
            if (holds(place.x + r * std::cos(a), place.y + r * std::sin(a)) != here)
                return r;
        }
    return 4;
}

double farthest_from_border(const std::function<bool(double, double)>& holds, const WorldRing& ring) {
    double farthest = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& a = ring[i];
        const Position& b = ring[(i + 1) % ring.size()];
        const int steps = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / 0.5) + 1;
        for (int k = 0; k < steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            farthest =
                std::max(farthest, distance_to_border(holds, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}));
        }
    }
    return farthest;
}

double area_where(const std::function<bool(double, double)>& holds) {
    constexpr double step = 0.1;
    double area = 0;
    for (double y = step / 2; y < rows * cell; y += step)
        for (double x = step / 2; x < cols * cell; x += step)
            area += holds(origin.x + x, origin.y + y) ? step * step : 0;
    return area;
}

/// Contours of one shape and one threshold, and their differences from the surface above it.
struct Tier {
    double threshold = 0;
    double farthest = 0;
    double area = 0;
    double perimeter = 0;
};

class Tiers : public ::testing::Test {
  protected:
    void run(const std::function<void(Options&)>& change = {}) {
        MemorySource source(rows, cols, surface());
        source.edit().transform = {origin.x, cell, 0, origin.y + rows * cell, 0, -cell};
        source.edit().crs_wkt = Crs("EPSG:25832").wkt();
        source.edit().georeferenced = true;
        Options options;
        if (change)
            change(options);
        d2b::run(options, {source}, {sink_});
    }
    /// Tiers from low to high; that of level 1 has the threshold 0.
    [[nodiscard]] std::vector<Tier> tiers_of(const Shape& shape) const {
        std::map<std::int64_t, Tier> tiers;
        for (std::size_t i = 0; i < sink_.features[contours].size(); ++i) {
            const Feature& feature = sink_.features[contours][i];
            const Position& corner = feature.parts[0].exterior[0];
            if (distance_to_border([&](double x, double y) { return shape.at(x, y) > 0; }, corner) > 3.5 &&
                !(shape.at(corner.x, corner.y) > 0))
                continue;
            const std::int64_t level = sink_.whole(contours, i, "level");
            Tier& tier = tiers[level];
            tier.threshold = level == 1 ? 0 : sink_.number(contours, i, "threshold") - ground;
            tier.area += sink_.number(contours, i, "area_m2");
            tier.perimeter += sink_.number(contours, i, "perim_m");
            const auto above = [&](double x, double y) { return shape.at(x, y) > tier.threshold; };
            for (const WorldPolygon& part : feature.parts) {
                tier.farthest = std::max(tier.farthest, farthest_from_border(above, part.exterior));
                for (const WorldRing& ring : part.interiors)
                    tier.farthest = std::max(tier.farthest, farthest_from_border(above, ring));
            }
        }
        std::vector<Tier> sorted;
        for (const auto& [level, tier] : tiers)
            sorted.push_back(tier);
        return sorted;
    }
    void expect_near_truth(const Shape& shape, std::size_t least_tiers) const {
        constexpr double tolerance = 1.5 * cell;
        const std::vector<Tier> tiers = tiers_of(shape);
        EXPECT_GE(tiers.size(), least_tiers) << shape.name;
        for (const Tier& tier : tiers) {
            SCOPED_TRACE(shape.name + " above " + std::to_string(tier.threshold));
            EXPECT_LE(tier.farthest, tolerance);
            const double truth =
                area_where([&](double x, double y) { return shape.at(x, y) > tier.threshold; });
            EXPECT_NEAR(tier.area, truth, 0.25 * cell * tier.perimeter);
        }
    }

    MemorySink sink_;
};

TEST_F(Tiers, AreWhatLiesAboveTheirThresholds) {
    run([](Options& options) {
        options.levels.source = LevelSource::building;
        options.levels.detail = 0;
    });
    EXPECT_EQ(sink_.features[0].size(), shapes().size());
    for (const Shape& shape : shapes())
        expect_near_truth(shape, 3);
}

TEST_F(Tiers, OfStepsAreTheStepsInACleanImageToo) {
    run([](Options& options) {
        options.levels.source = LevelSource::natural;
        options.levels.detail = 2;
    });
    EXPECT_EQ(sink_.features[0].size(), shapes().size());
    for (const Shape& shape : shapes())
        if (shape.flat)
            expect_near_truth(shape, 2);
}

}  // namespace
}  // namespace d2b::test
