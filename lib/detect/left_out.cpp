#include "detect/left_out.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/regions.hpp"

namespace d2b::detect {
namespace {

/// Cells of an object.
struct CountedCells {
    std::int64_t all = 0;
    std::int64_t inside = 0;  ///< those in a mask
};

/// @return by label - 1
std::vector<CountedCells> count_cells(const Detection& detection, const Mask& mask, Executor& threads) {
    std::vector<CountedCells> counts(detection.objects.size());
    const Grid<Label>& labels = detection.labels;
    for_row_bands(threads, labels.rows, labels.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            const auto in_mask = mask.row(r).begin();
            for_equal_runs(labels.row(r), [&](std::int32_t begin, std::int32_t end, Label label) {
                CountedCells& object = counts[label - 1];
                const std::int64_t inside = std::count(in_mask + begin, in_mask + end, std::uint8_t{1});
                std::atomic_ref(object.all).fetch_add(end - begin, std::memory_order_relaxed);
                std::atomic_ref(object.inside).fetch_add(inside, std::memory_order_relaxed);
            });
        }
    });
    return counts;
}

}  // namespace

void mark_left_out(const Mask& where, LeftOut reason, Detection& detection, Executor& threads) {
    const std::vector<CountedCells> counts = count_cells(detection, where, threads);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        DetectedObject& object = detection.objects[i];
        const bool is_decided = object.confirmed || object.left_out == LeftOut::denied;
        if (counts[i].inside > 0 && 2 * counts[i].inside >= counts[i].all &&
            (reason == LeftOut::denied || !is_decided))
            object.left_out = reason;
    }
}

}  // namespace d2b::detect
