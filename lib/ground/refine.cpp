#include "ground/refine.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/row_bands.hpp"
#include "ground/fill.hpp"
#include "ground/provisional.hpp"

namespace d2b::ground {
namespace {

/// Returns the low outliers in a row of the working grid.
std::span<const Pit> pits_in(std::span<const Pit> pits, std::int32_t row) {
    const auto first =
        std::partition_point(pits.begin(), pits.end(), [&](const Pit& p) { return p.row < row; });
    const auto last = std::partition_point(first, pits.end(), [&](const Pit& p) { return p.row == row; });
    return {first, last};
}

/// Marks points below the limits of outlier cells.
struct Outliers {
    std::span<const Pit> pits;  ///< of the working grid
    std::int32_t first_row;     ///< of that grid
    std::int32_t first_col;
    Factor factor;
    GridPlace place;

    /// @param below working terrain of the row
    void mark(std::int32_t row, std::span<const float> surface, std::span<const float> below,
              std::span<float> terrain, std::span<std::uint8_t> flags) const {
        for (const Pit& pit : pits_in(pits, block_of(place.row + row, factor.down) - first_row)) {
            const std::int32_t col = factor.across * (first_col + pit.col) - place.col;  // may be negative
            const auto end = std::min(static_cast<std::size_t>(col + factor.across), surface.size());
            for (auto j = static_cast<std::size_t>(std::max(col, 0)); j < end; ++j)
                if (surface[j] < pit.limit) {
                    terrain[j] = below[j];
                    flags[j] = low_outlier;
                }
        }
    }
};

/// Interpolates terrain and tolerance from the working grid, for a band of rows of the surface.
class Refinement {
  public:
    /// @param working only rows around the band are needed
    /// @param across weights for the columns of the surface
    Refinement(RowBand band, const GridPlace& place, const AlignedGrid& working, Factor factor,
               const Rules& rules, const Between& across)
        : first_(band.begin),
          working_(working),
          factor_(factor),
          rules_(rules),
          down_(place.row + band.begin, band.end - band.begin, working.first_row, working.grid.rows,
                factor.down),
          across_(across) {}

    /// Buffers for rows of the surface and one of the working grid.
    struct Rows {
        std::vector<float> terrain, tolerance, between;
        MetreGrid tolerances;        ///< rows of the working grid ...
        std::int32_t first_row = 0;  ///< ... starting at this one
    };

    [[nodiscard]] Rows rows() const {
        const auto cols = static_cast<std::size_t>(working_.grid.cols);
        Rows rows;
        rows.between.resize(cols);
        rows.first_row = down_[0].near;
        rows.tolerances = MetreGrid(
            down_[static_cast<std::int32_t>(down_.size()) - 1].next - rows.first_row + 1, working_.grid.cols);
        for (std::int32_t i = 0; i < rows.tolerances.rows; ++i) {
            const auto out = rows.tolerances.row(i);
            slopes_of_row(working_.grid, rows.first_row + i, working_.cell, out);
            for (float& value : out)
                value =
                    static_cast<float>(rules_.tolerance) + static_cast<float>(rules_.tolerance_slope) * value;
        }
        return rows;
    }

    void fill(std::int32_t row, Rows& rows) const {
        const Between::Place& place = down_[row - first_];
        between(working_.grid.row(place.near), working_.grid.row(place.next), place.share, rows.between,
                rows.terrain);
        between(rows.tolerances.row(place.near - rows.first_row),
                rows.tolerances.row(place.next - rows.first_row), place.share, rows.between, rows.tolerance);
    }

  private:
    /// Interpolates a row between two rows of the working grid at the centres of the surface's cells.
    void between(std::span<const float> near, std::span<const float> next, float share,
                 std::vector<float>& row, std::vector<float>& out) const {
        for (std::size_t j = 0; j < row.size(); ++j)
            row[j] = near[j] + share * (next[j] - near[j]);
        out.resize(across_.size());
        if (factor_.across == 1) {
            std::copy(row.begin(), row.end(), out.begin());
            return;
        }
        for (std::size_t j = 0; j < out.size(); ++j) {
            const Between::Place& place = across_[static_cast<std::int32_t>(j)];
            const float left = row[static_cast<std::size_t>(place.near)];
            out[j] = left + place.share * (row[static_cast<std::size_t>(place.next)] - left);
        }
    }

    std::int32_t first_;  ///< row of the surface
    const AlignedGrid& working_;
    Factor factor_;
    const Rules& rules_;
    Between down_;
    const Between& across_;
};

/// @param refinement of the band @param terrain any values
void refine_band(const MetreGrid& surface, RowBand band, const Refinement& refinement,
                 const Outliers& outliers, Terrain& terrain) {
    Refinement::Rows rows = refinement.rows();
    for (std::int32_t i = band.begin; i < band.end; ++i) {
        refinement.fill(i, rows);
        const auto from = surface.row(i);
        const auto out = terrain.elevation.row(i);
        const auto flags = terrain.flags.row(i);
        for (std::size_t j = 0; j < out.size(); ++j) {
            const bool bare = from[j] - rows.terrain[j] <= rows.tolerance[j];  // false for NaN
            out[j] = bare ? from[j] : rows.terrain[j];
            flags[j] = bare ? bare_ground : std::uint8_t{0};
        }
        outliers.mark(i, from, rows.terrain, out, flags);
    }
}

}  // namespace

Terrain refine(const MetreGrid& surface, const GridPlace& place, AlignedGrid working,
               const std::vector<Pit>& pits, Factor factor, const Rules& rules, Executor& threads) {
    const Outliers outliers{pits, working.first_row, working.first_col, factor, place};
    const Between across(place.col, surface.cols, working.first_col, working.grid.cols, factor.across);
    Terrain terrain{{}, Grid<std::uint8_t>::unset(surface.rows, surface.cols, threads)};
    if (factor.down != 1 || factor.across != 1) {
        terrain.elevation = MetreGrid::unset(surface.rows, surface.cols, threads);
        for_row_bands(threads, surface.rows, surface.cols, [&](RowBand band) {
            refine_band(surface, band, Refinement(band, place, working, factor, rules, across), outliers,
                        terrain);
        });
        return terrain;
    }
    terrain.elevation = std::move(working.grid);
    // Copies two rows around each band: it needs the next row, whose slope depends on the one after.
    for_band_copies(threads, terrain.elevation, 2, [&](BandCopy<float>& copy) {
        AlignedGrid around = shape_of(working);
        around.first_row += copy.first;
        around.grid = std::move(copy.rows);
        refine_band(surface, copy.band, Refinement(copy.band, place, around, factor, rules, across), outliers,
                    terrain);
        copy.rows = std::move(around.grid);
    });
    return terrain;
}

}  // namespace d2b::ground
