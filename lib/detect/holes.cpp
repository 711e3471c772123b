#include "detect/holes.hpp"

#include <cstring>
#include <vector>

#include "detect/regions.hpp"

namespace d2b {

void fill_small_holes(Mask& mask, std::int64_t fewer_than, Executor& threads) {
    const Regions holes = connected_regions(mask, 0, 0, threads);
    std::vector<std::uint8_t> fill(holes.cells.size(), 0);
    for (std::size_t i = 1; i < fill.size(); ++i)
        fill[i] = holes.cells[i] < fewer_than ? 1 : 0;
    for (std::int32_t r = 0; r < mask.rows; ++r)
        for (const RegionRun& run : holes.row(r))
            if (r == 0 || r + 1 == mask.rows || run.begin == 0 || run.end == mask.cols)
                fill[run.label] = 0;
    for_row_bands(threads, mask.rows, mask.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            for (const RegionRun& run : holes.row(r))
                if (fill[run.label] != 0)
                    std::memset(mask.row(r).data() + run.begin, 1,
                                static_cast<std::size_t>(run.end - run.begin));
    });
}

}  // namespace d2b
