// Rows of houses of equal height whose party walls are exact, cut by their plots.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/run.hpp"
#include "seen_scene.hpp"

namespace d2b::test {
namespace {

struct Segment {
    Position a;
    Position b;
    [[nodiscard]] double length() const { return std::hypot(b.x - a.x, b.y - a.y); }
    [[nodiscard]] Position at(double share) const {
        return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
    }
    [[nodiscard]] double distance(const Position& p) const {
        const double square = length() * length();
        const double share =
            std::clamp(((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / square, 0.0, 1.0);
        return std::hypot(at(share).x - p.x, at(share).y - p.y);
    }
};

std::vector<Segment> edges_of(const WorldRing& ring) {
    std::vector<Segment> edges;
    for (std::size_t i = 0; i < ring.size(); ++i)
        if (const Segment edge{ring[i], ring[(i + 1) % ring.size()]}; edge.length() > 0)
            edges.push_back(edge);
    return edges;
}

/// Segments that two rings share, once in each direction. To the millimetre.
std::vector<Segment> shared_among(const std::vector<WorldRing>& rings) {
    using Place = std::pair<long long, long long>;
    const auto place = [](const Position& p) {
        return Place(std::llround(1000 * p.x), std::llround(1000 * p.y));
    };
    std::set<std::pair<Place, Place>> all;
    std::vector<Segment> shared;
    for (const WorldRing& ring : rings)
        for (const Segment& edge : edges_of(ring)) {
            all.insert({place(edge.a), place(edge.b)});
            if (all.contains({place(edge.b), place(edge.a)}))
                shared.push_back(edge);
        }
    return shared;
}

WorldRing in_world(WorldRing ring, const sample::Grid& grid) {
    for (Position& p : ring)
        p = grid.to_world(p);
    return ring;
}

bool holds(const WorldRing& ring, const Position& p) {
    bool inside = false;
    for (const Segment& edge : edges_of(ring))
        if ((edge.a.y > p.y) != (edge.b.y > p.y) &&
            p.x < edge.a.x + (edge.b.x - edge.a.x) * (p.y - edge.a.y) / (edge.b.y - edge.a.y))
            inside = !inside;
    return inside;
}

class Plots final : public ParcelSource {
  public:
    Plots(const sample::Scene& scene, const sample::Grid& grid) : grid_(grid) {
        for (const sample::Parcel& parcel : scene.parcels) {
            const WorldRing ring = in_world(parcel.polygon.exterior, grid);
            const auto [west, east] = std::ranges::minmax(ring, {}, &Position::x);
            const auto [south, north] = std::ranges::minmax(ring, {}, &Position::y);
            plots_.push_back({ring, west.x, east.x, south.y, north.y});
        }
    }
    void read(const Window& part, std::span<ParcelCell> cells) override {
        const auto& t = grid_.transform;
        for (std::int32_t i = 0; i < part.rows * part.cols; ++i) {
            const double col = part.col + i % part.cols + 0.5;
            const double row = part.row + i / part.cols + 0.5;
            const Position middle{t[0] + col * t[1] + row * t[2], t[3] + col * t[4] + row * t[5]};
            for (std::size_t k = 0; k < plots_.size(); ++k)
                if (plots_[k].may_hold(middle) && holds(plots_[k].ring, middle))
                    cells[static_cast<std::size_t>(i)].parcel = static_cast<std::int64_t>(k);
        }
    }
    std::string_view name(std::int64_t) override { return "plot"; }

  private:
    struct Plot {
        WorldRing ring;
        double west, east, south, north;
        [[nodiscard]] bool may_hold(const Position& p) const {
            return p.x >= west && p.x <= east && p.y >= south && p.y <= north;
        }
    };
    const sample::Grid& grid_;
    std::vector<Plot> plots_;
};

/// Share of the length of some that has one of others within reach.
double share_near(const std::vector<Segment>& some, const std::vector<Segment>& others, double reach) {
    double length = 0;
    double near = 0;
    for (const Segment& one : some)
        for (int i = 0; i < 20; ++i) {
            const Position p = one.at((i + 0.5) / 20);
            const bool is_near =
                std::ranges::any_of(others, [&](const Segment& other) { return other.distance(p) <= reach; });
            length += one.length() / 20;
            near += is_near ? one.length() / 20 : 0;
        }
    return near / length;
}

TEST(PartyWalls, OfEqualHousesAreFoundWithinHalfACell) {
    const sample::SceneChoice choice = sample::choose_scene("rows_lidar8");
    const sample::Scene scene = choice.place.make(1);
    const sample::Seen seen = sample::see(scene, sample::grid_over(choice), choice.survey);
    SeenScene source(seen);
    Plots plots(scene, seen.grid);
    MemorySink sink;
    Options options;
    options.detect.split_by = "plots";
    const RunReport report = run(options, {source, nullptr, nullptr, nullptr, &plots}, {sink});

    std::vector<WorldRing> found;
    for (const Feature& feature : sink.features[0])
        for (const WorldPolygon& part : feature.parts)
            found.push_back(part.exterior);
    std::vector<WorldRing> truth;
    for (const sample::Building& building : scene.buildings)
        truth.push_back(in_world(building.footprint.exterior, seen.grid));
    const std::vector<Segment> walls = shared_among(truth);
    const std::vector<Segment> cuts = shared_among(found);
    const double half = choice.survey.cell / 2;
    ASSERT_GT(walls.size(), 50U);
    RecordProperty("walls", static_cast<int>(walls.size()));
    RecordProperty("near", std::to_string(static_cast<int>(1000 * share_near(cuts, walls, half))));
    RecordProperty("found", std::to_string(static_cast<int>(1000 * share_near(walls, cuts, half))));
    EXPECT_GT(share_near(cuts, walls, half), 0.97);
    EXPECT_GT(share_near(walls, cuts, half), 0.9);
    // Each wall by most of its length.
    for (const Segment& wall : walls)
        if (wall.length() > 4) {
            EXPECT_GT(share_near({wall}, cuts, 2 * half), 0.7) << wall.a.x << " " << wall.a.y;
        }
    for (const std::string& warning : report.warnings)
        ADD_FAILURE() << warning;
}

}  // namespace
}  // namespace d2b::test
