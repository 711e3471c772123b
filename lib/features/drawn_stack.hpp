#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/int128.hpp"
#include "core/point_stats.hpp"
#include "core/row_slabs.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/spool.hpp"
#include "features/row_spans.hpp"

namespace d2b {

/// How far a stacked surface is from elevations. Adds up exactly, in any order.
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
    /// Root mean square; 0 where there is no point.
    [[nodiscard]] double rms(const FixedPoint& fixed) const;
};

/// What a contour adds to a stack.
struct StackTier {
    double own = 0;    ///< elevation of what no higher contour holds; NaN where that is nothing
    double whole = 0;  ///< the same where the stack ends at this contour
    std::int32_t level = 1;
};

/// The surface that a stack of contours stands for, from their polygons as they are drawn: in a cell of a
/// building the tier of the highest contour that holds its middle. Waits in a spool as runs of cells.
class DrawnStack {
  public:
    DrawnStack(std::unique_ptr<Spool> spool, const Window& window);

    /// @throws OutputError the spool has no room
    void add_building(const std::vector<RowSpan>& cells);
    /// What comes later stands on what came before.
    void add_contour(const std::vector<RowSpan>& cells, const StackTier& tier);
    /// In the cells of buildings that some contour holds, and that are valid. From any thread, once all are
    /// there. @throws OutputError the spool cannot be read
    [[nodiscard]] StackError error(const ElevationBand& band, const FixedPoint& fixed) const {
        return error(band, 0, fixed);
    }
    /// The same of some columns. @param first_col of the band, counted from the window's first
    [[nodiscard]] StackError error(const ElevationBand& band, std::int32_t first_col,
                                   const FixedPoint& fixed) const;
    /// The same of the stacks that end at level 1, 2, ... @param levels how many
    [[nodiscard]] std::vector<StackError> errors_by_level(const ElevationBand& band, const FixedPoint& fixed,
                                                          std::int32_t levels) const;

  private:
    struct Slab {
        std::vector<SpoolEntry> buildings;
        std::vector<SpoolEntry> contours;
    };
    class SlabTiers;
    /// Calls work(slab, rows, elevations) for the rows of a band that lie in one slab, slab by slab: what is
    /// worked on stays in the cache.
    template <typename Work>
    void for_slabs(const ElevationBand& band, const Work& work) const;
    /// Calls use(first, last, tier) with the runs of the entries that lie in the rows.
    template <typename Use>
    void for_runs(const SlabTiers& tiers, const std::vector<SpoolEntry>& entries, const Use& use) const;
    /// Where buildings stand there is no tier until a contour has one.
    void begin_buildings(SlabTiers& tiers, const Slab& slab) const;
    [[nodiscard]] StackError measured(SlabTiers& tiers, const Slab& slab, std::span<const double> elevations,
                                      const FixedPoint& fixed) const;
    void add(const std::vector<RowSpan>& cells, const StackTier& tier,
             std::vector<SpoolEntry> Slab::*entries);

    std::unique_ptr<Spool> spool_;
    Window window_;
    RowSlabs<Slab> slabs_;
};

}  // namespace d2b
