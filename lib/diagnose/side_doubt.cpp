#include "diagnose/side_doubt.hpp"

#include <cmath>

#include "diagnose/words.hpp"

namespace d2b {
namespace {

template <typename T, typename Counts>
bool any_known(const MetreGrid& surface, const Grid<T>& grid, const Window& cells, const Counts& counts) {
    for (std::int32_t r = cells.row; r < cells.end_row(); ++r)
        for (std::size_t i = grid.index(r, cells.col); i < grid.index(r, cells.end_col()); ++i)
            if (!std::isnan(surface.values[i]) && counts(grid.values[i]))
                return true;
    return false;
}

}  // namespace

bool meets(const MetreGrid& surface, const Mask& mask, const Window& cells) {
    return any_known(surface, mask, cells, [](std::uint8_t allowed) { return allowed != 0; });
}

bool meets(const MetreGrid& surface, const MetreGrid& values, const Window& cells) {
    return any_known(surface, values, cells, [](float value) { return !std::isnan(value); });
}

std::string empty_side_doubt(const SidesKnown& known, const Options& options) {
    if (!known.terrain)
        return "the terrain '" + options.ground.terrain +
               "' has no valid cell over the DEM; give one of the same place with -ground, or leave -ground "
               "out to have the ground estimated";
    if (!known.mask)
        return "the mask '" + options.detect.mask +
               "' has no cell over the DEM that is neither 0 nor NoData; give one with -mask that marks "
               "where "
               "buildings may be";
    return {};
}

std::string terrain_gap_doubt(const TerrainGap& gap, const std::string& dem, const std::string& terrain) {
    const std::int64_t missing = gap.cells - gap.known;
    // The share outside is measured on a lattice of points.
    const std::int64_t told = gap.outside + gap.outside / 50;
    if (gap.known == 0 || missing < gap.fewest || missing <= told)
        return {};
    return percent(static_cast<double>(missing) / static_cast<double>(gap.cells)) + " of the cells of '" +
           dem + "' that have an elevation have none in the terrain '" + terrain +
           "'; there is no ground there, and buildings are cut off or missing, so fill its NoData, for "
           "example "
           "with gdal_fillnodata.py, or leave -ground out to have the ground estimated";
}

std::string ndvi_doubt(const SidesKnown& known, const Options& options) {
    if (known.ndvi)
        return {};
    return "the NDVI '" + options.detect.ndvi +
           "' has no valid cell over the DEM, so it shows no plants; give one of the same place with -ndvi";
}

}  // namespace d2b
