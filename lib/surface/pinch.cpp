#include "surface/pinch.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace d2b {
namespace {

constexpr std::int64_t anything = std::numeric_limits<std::int64_t>::min();

using Arms = std::vector<NodeArm>;
using Stands = std::function<bool(std::int32_t contour)>;

/// Returns the runs of sectors for which stands(contour) == wanted.
std::vector<SectorRun> runs_of(const Arms& arms, const Stands& stands, bool wanted) {
    const std::size_t n = arms.size();
    const auto is = [&](std::size_t i) { return stands(arms[i % n].left) == wanted; };
    std::vector<SectorRun> runs;
    for (std::size_t i = 0; i < n; ++i) {
        if (!is(i) || is(i + n - 1))
            continue;
        SectorRun run{i, 1};
        while (is(run.first + run.count))
            ++run.count;
        runs.push_back(run);
    }
    return runs;
}

std::vector<std::int32_t> buildings_in(const Arms& arms, const SectorRun& run, const Heights& heights) {
    std::vector<std::int32_t> buildings;
    for (std::size_t i = 0; i < run.count; ++i)
        buildings.push_back(heights.building(arms[(run.first + i) % arms.size()].left));
    return buildings;
}

bool share_a_building(const Arms& arms, const SectorRun& a, const SectorRun& b, const Heights& heights) {
    const std::vector<std::int32_t> others = buildings_in(arms, b, heights);
    return std::ranges::any_of(buildings_in(arms, a, heights), [&](std::int32_t building) {
        return std::ranges::find(others, building) != others.end();
    });
}

/// Gaps and runs alternate, so a gap follows the run with the same index.
std::optional<Pinch> pinch_of(const Arms& arms, const Stands& stands, const Heights& heights) {
    const std::vector<SectorRun> runs = runs_of(arms, stands, true);
    if (runs.size() < 2)
        return std::nullopt;
    Pinch pinch;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const SectorRun& run = runs[i];
        const SectorRun& next = runs[(i + 1) % runs.size()];
        const std::size_t begin = run.first + run.count;
        if (share_a_building(arms, run, next, heights))
            pinch.runs.push_back({begin % arms.size(), (next.first + arms.size() - begin) % arms.size()});
    }
    pinch.fills = !pinch.runs.empty();
    if (!pinch.fills)
        pinch.runs = runs;
    return pinch;
}

template <typename Number>
std::vector<Number> distinct(std::vector<Number> numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

}  // namespace

Arms arms_of(const Arms& all, const SectorRun& run) {
    Arms arms;
    for (std::size_t i = 0; i <= run.count; ++i)
        arms.push_back(all[(run.first + i) % all.size()]);
    return arms;
}

std::optional<Pinch> find_pinch(const Arms& arms, const Heights& heights) {
    if (arms.size() < 4)
        return std::nullopt;
    std::vector<std::int64_t> levels{anything};
    std::vector<std::int32_t> buildings;
    std::vector<std::int32_t> contours;
    for (const NodeArm& arm : arms)
        if (arm.left != open_ground) {
            levels.push_back(heights.contours[static_cast<std::size_t>(arm.left)].top);
            buildings.push_back(heights.building(arm.left));
            contours.push_back(arm.left);
        }
    for (const std::int64_t level : distinct(std::move(levels))) {
        if (auto pinch = pinch_of(
                arms, [&](std::int32_t c) { return heights.exceeds(c, level); }, heights))
            return pinch;
        for (const std::int32_t building : distinct(buildings))
            if (auto pinch = pinch_of(
                    arms,
                    [&](std::int32_t c) {
                        return heights.building(c) == building && heights.exceeds(c, level);
                    },
                    heights))
                return pinch;
    }
    for (const std::int32_t contour : distinct(std::move(contours)))
        if (auto pinch = pinch_of(
                arms, [&](std::int32_t c) { return c == contour; }, heights))
            return pinch;
    return std::nullopt;
}

}  // namespace d2b
