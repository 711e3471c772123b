#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/int128.hpp"
#include "core/lattice.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/spool.hpp"
#include "raster/row_spans.hpp"

namespace d2b::features {

/// Deviation of a stacked surface from the elevations. Sums are exact, so their order does not matter.
struct StackError {
    std::int64_t n = 0;
    Int128 coarse_squares = 0;

    void add(double distance, const FixedPoint& fixed) {
        const std::int64_t c = FixedPoint::coarse(fixed.to_fixed(distance));
        coarse_squares += Int128{c} * c;
        ++n;
    }
    void merge(const StackError& other) {
        n += other.n;
        coarse_squares += other.coarse_squares;
    }
    /// Root mean square error; 0 without points.
    [[nodiscard]] double rms(const FixedPoint& fixed) const;
};

/// Elevations that a contour contributes to a stack.
struct StackTier {
    double own = 0;    ///< elevation of the cells outside of higher contours; NaN if there are none
    double whole = 0;  ///< same, for a stack truncated at this contour
    std::int32_t level = 1;
};

/// Surface represented by a stack of contours, rasterized from the drawn polygons: each cell of a building
/// has the tier of the highest contour that contains its centre. Runs of cells are kept in a spool.
class DrawnStack {
  public:
    DrawnStack(std::unique_ptr<Spool> spool, const Window& window);

    /// @throws OutputError the spool is full
    void add_building(const std::vector<RowSpan>& cells);
    /// Adds a contour on top of those added before.
    void add_contour(const std::vector<RowSpan>& cells, const StackTier& tier);
    /// Measures the error in valid cells of buildings that are covered by a contour. Thread-safe once
    /// everything is added.
    /// @param first_col of the band, relative to the window @throws OutputError the spool cannot be read
    [[nodiscard]] StackError error(const ElevationBand& band, const FixedPoint& fixed,
                                   std::int32_t first_col = 0) const;
    /// Same for each of the stacks truncated at level 1, 2, ... @param levels number of levels
    [[nodiscard]] std::vector<StackError> errors_by_level(const ElevationBand& band, const FixedPoint& fixed,
                                                          std::int32_t levels) const;

  private:
    struct Slab {
        std::vector<SpoolEntry> buildings;
        std::vector<SpoolEntry> contours;
    };
    class SlabTiers;
    /// Calls work(slab, rows, elevations) for the rows of a band, slab by slab because a slab fits in the
    /// cache.
    template <typename Work>
    void for_slabs(const ElevationBand& band, const Work& work) const;
    /// Calls use(first, last, tier) for the runs of the entries within the rows.
    template <typename Use>
    void for_runs(const SlabTiers& tiers, const std::vector<SpoolEntry>& entries, const Use& use) const;
    /// Clears the cells of buildings, which have no tier until a contour adds one.
    void begin_buildings(SlabTiers& tiers, const Slab& slab) const;
    [[nodiscard]] StackError measured(SlabTiers& tiers, const Slab& slab, std::span<const double> elevations,
                                      const FixedPoint& fixed) const;
    void add(const std::vector<RowSpan>& cells, const StackTier& tier,
             std::vector<SpoolEntry> Slab::*entries);

    std::unique_ptr<Spool> spool_;
    Window window_;
    RowSlabs<Slab> slabs_;
};

}  // namespace d2b::features
