#include "detect/best_of_looks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/row_bands.hpp"
#include "detect/best_nested.hpp"
#include "detect/odds.hpp"
#include "detect/region_overlaps.hpp"

namespace d2b {
namespace {

/// Chosen objects of a pass, by label.
using Chosen = std::vector<std::uint8_t>;

/// Gain of choosing an object.
double gain_of(const DetectedObject& object) {
    constexpr double surest = 0.999;  // confidences are clamped to this
    const double log_odds = std::log(odds(std::clamp(object.confidence, 1 - surest, surest)));
    return static_cast<double>(object.cells) * log_odds;
}

std::vector<Chosen> choose(std::span<const JudgedObjects> looks) {
    std::vector<NestedCandidate> candidates;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const std::vector<DetectedObject>& objects = looks[i].objects;
        const std::size_t next = candidates.size() + objects.size();
        std::vector<Label> holder(objects.size() + 1, 0);
        if (i + 1 < looks.size())
            holder = holders(looks[i].regions, looks[i + 1].regions);
        for (std::size_t k = 0; k < objects.size(); ++k)
            candidates.push_back({gain_of(objects[k]),
                                  holder[k + 1] == 0 ? NestedCandidate::nothing : next + holder[k + 1] - 1});
    }
    const std::vector<bool> best = best_nested(candidates);
    std::vector<Chosen> chosen;
    auto next = best.begin();
    for (const JudgedObjects& look : looks) {
        chosen.emplace_back(look.objects.size() + 1);
        for (std::size_t k = 1; k < chosen.back().size(); ++k)
            chosen.back()[k] = *next++ ? 1 : 0;
    }
    return chosen;
}

void paint(const Regions& regions, const Chosen& chosen, Mask& cells, Executor& threads) {
    for_row_bands(threads, cells.rows, cells.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            for (const RegionRun& run : regions.row(r))
                if (chosen[run.label] != 0)
                    std::fill(cells.row(r).begin() + run.begin, cells.row(r).begin() + run.end,
                              std::uint8_t{1});
    });
}

/// True if a mask has a set cell in columns [begin, end) of a row. Both may exceed the grid.
bool any(const Mask& mask, std::int32_t row, std::int32_t begin, std::int32_t end) {
    if (row < 0 || row >= mask.rows)
        return false;
    const auto cells = mask.row(row);
    const auto last = cells.begin() + std::min(end, mask.cols);
    return std::find(cells.begin() + std::max(begin, 0), last, 1) != last;
}

/// Also chooses objects that neither overlap nor touch a mask.
void keep_what_is_apart(const Mask& taken, const Regions& regions, Chosen& chosen) {
    Chosen apart(chosen.size(), 1);
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            if (any(taken, r, run.begin - 1, run.end + 1) || any(taken, r - 1, run.begin, run.end) ||
                any(taken, r + 1, run.begin, run.end))
                apart[run.label] = 0;
    for (std::size_t label = 1; label < chosen.size(); ++label)
        chosen[label] |= apart[label];
}

/// Merges the chosen objects.
/// @param cells cells of the chosen objects. Each connected part inherits the classification of the chosen
/// object with most cells in it; the strictest pass wins ties, then the first object
JudgedObjects put_together(std::span<const JudgedObjects> looks, const std::vector<Chosen>& chosen,
                           const Mask& cells, Executor& threads) {
    JudgedObjects result;
    result.regions = connected_regions(cells, 1, 0, threads);
    const std::size_t count = result.regions.cells.size() - 1;
    result.objects.resize(count);
    result.evidence.resize(count);
    std::vector<std::int64_t> most(count, 0);
    for (std::size_t i = 0; i < looks.size(); ++i)
        for (const RegionOverlap& overlap : region_overlaps(result.regions, looks[i].regions)) {
            const std::size_t part = overlap.one - 1;
            if (chosen[i][overlap.other] == 0 || overlap.cells <= most[part])
                continue;
            most[part] = overlap.cells;
            result.objects[part] = looks[i].objects[overlap.other - 1];
            result.evidence[part] = looks[i].evidence[overlap.other - 1];
        }
    for (std::size_t part = 0; part < count; ++part)
        result.objects[part].cells = result.regions.cells[part + 1];
    return result;
}

LeftOut still_left_out(LeftOut left_out, const Mask& cells) {
    const auto is_in = [&](FirstCell cell) { return cells.at(cell.row, cell.col) != 0; };
    std::erase_if(left_out.small, is_in);
    std::erase_if(left_out.crowns, [&](const CutCrown& crown) { return is_in(crown.first); });
    return left_out;
}

}  // namespace

JudgedObjects best_of_looks(std::span<const JudgedObjects> looks, std::size_t usual, Executor& threads) {
    std::vector<Chosen> chosen = choose(looks);
    const Regions& shape = looks[usual].regions;
    Mask taken(shape.rows, shape.cols, 0, threads);
    for (std::size_t i = 0; i < looks.size(); ++i)
        paint(looks[i].regions, chosen[i], taken, threads);
    keep_what_is_apart(taken, shape, chosen[usual]);
    paint(shape, chosen[usual], taken, threads);
    JudgedObjects result = put_together(looks, chosen, taken, threads);
    result.left_out = still_left_out(looks[usual].left_out, taken);
    return result;
}

}  // namespace d2b
