#include "downtown.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "draft.hpp"
#include "random.hpp"
#include "site.hpp"

namespace d2b::bench {

namespace {

using sample::Draft;
using sample::Random;
using sample::Rect;
using sample::Roof;

constexpr double lot = 48;  // metres along a side

/// A side of a quarter from avenue to avenue.
struct Span {
    double from = 0;
    double to = 0;

    /// Beginnings of its lots: as many as there is room for, in its middle.
    [[nodiscard]] std::vector<double> lots() const {
        constexpr double avenue = 12;
        constexpr double street = 16;
        const double room = to - from - 2 * avenue + street;
        const auto count = std::max(0, static_cast<int>(room / (lot + street)));
        const double first = (from + to - count * (lot + street) + street) / 2;
        std::vector<double> starts(static_cast<std::size_t>(count));
        for (std::size_t k = 0; k < starts.size(); ++k)
            starts[k] = first + static_cast<double>(k) * (lot + street);
        return starts;
    }
};

/// Storeys that step back from a square base.
Draft tower(const Rect& box, Random& random) {
    const double base = 4.0 * (3 + random.below(4));
    Draft draft = sample::box_house("tower", box, {Roof::flat, base, 0});
    double top = base;
    double inset = 6;
    while (inset < std::min(box.width(), box.depth()) / 2 - 3) {
        top += 4.0 * (2 + random.below(5));
        draft.parts.push_back(sample::wing(box.grown(-inset), {Roof::flat, top, 0}));
        inset += random.eighths(4, 7);
    }
    return draft;
}

Draft block(const Rect& box, Random& random) {
    const double eave = 3.5 * (3 + random.below(5));
    const double pitch = random.between(0.4, 0.9);
    switch (random.below(5)) {
        case 0:
            return sample::court_house("court", box, 13, {Roof::hipped, eave, pitch});
        case 1:
            return sample::l_house("corner", box, 15, {Roof::flat, eave, 0});
        case 2:
            return sample::round_house("drum", box.centre(), std::min(box.width(), box.depth()) / 2 - 1,
                                       {Roof::dome, eave, 0}, 5);
        default:
            return tower(box, random);
    }
}

void furnish(const sample::Site& site) {
    const std::size_t first = site.scene.buildings.size();
    const Rect box = site.rect().grown(-5);
    site.scene.ground.level(site.frame, box);
    site.scene.add(block(box, site.random), site.frame);
    for (int k = 0; 3 + 9 * k < site.width; ++k) {
        const double x = 3 + 9 * k;
        site.plant({x, 1}, site.random.between(6, 10), false, first);
        site.plant({x, site.depth - 1}, site.random.between(6, 10), false, first);
    }
    sample::furnish_street(site);
}

}  // namespace

bool is_downtown(const sample::TownPlan& plan, std::int32_t col, std::int32_t row) {
    return sample::uniform_at(plan.seed + 4, col, row) < 0.1;
}

void build_downtown(const sample::TownPlan& plan, std::int32_t col, std::int32_t row, sample::Scene& scene) {
    const std::array<Position, 4> quad = plan.corners(col, row);
    const Span along_x{std::max(quad[0].x, quad[3].x), std::min(quad[1].x, quad[2].x)};
    const Span along_y{std::max(quad[0].y, quad[1].y), std::min(quad[2].y, quad[3].y)};
    Random random(sample::hash(plan.seed + 5, col, row));
    for (const double y : along_y.lots()) {
        for (const double x : along_x.lots())
            furnish({scene, random, sample::Frame{{x, y}, {}}, lot, lot});
    }
}

}  // namespace d2b::bench
