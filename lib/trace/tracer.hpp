#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/context.hpp"
#include "core/dem_info.hpp"
#include "core/options.hpp"
#include "levels/quantise.hpp"
#include "trace/sweep.hpp"

namespace d2b {

/// What the tracer needs to know of the whole DEM before its first row.
struct TraceFrame {
    Window window;
    std::int32_t levels = 1;  ///< root included
    FixedPoint fixed;         ///< for sums of elevations
    ElevationRange range;     ///< for percentiles
};

/// Collapsed contouring (Chittineni 2003, 4.2) of all levels in one pass over bands of rows. At each level
/// the region is the union of the unit squares (-trace points) or cells (-trace cells) that qualify; squares
/// that share an edge belong to one contour. Support: one row and column. Carry between bands: the rows next
/// to the line, open outlines and components.
/// @tparam Count as the levels are kept
template <typename Count>
class Tracer {
  public:
    Tracer(const TraceFrame& frame, const TraceOptions& options, StackSink& sink);

    /// The next rows, without gap or overlap.
    void trace(const ElevationBand& elevations, const LabelBand& labels, const LevelBand<Count>& levels);
    /// After the last row: hands out what is still open.
    void finish();

  private:
    struct PointRow {
        std::vector<double> elevations;
        std::vector<double>
            outside;  ///< elevation where a point is valid and does not qualify, else +infinity
        std::vector<Count> counts;
        std::vector<Label> labels;
    };
    /// The component that holds a square, and the one of level 1 under it.
    struct Owner {
        std::uint32_t component = no_index;
        std::uint32_t building = no_index;
        std::int32_t level = -1;
    };

    void take_row(PointRow& row, const ElevationBand& elevations, const LabelBand& labels,
                  const LevelBand<Count>& levels, std::int32_t i) const;
    void sweep_cells();
    void sweep_points();
    void sweep_line(std::int32_t line, const OutsideRows& outside);
    void add_cells();
    void add_points(const std::vector<double>& elevations);
    void add(const Owner& owner, double elevation);
    void spread_owners(std::vector<Owner>& owners);

    TraceFrame frame_;
    bool points_;
    StackSink& sink_;
    Sweep sweep_;
    std::int32_t next_row_;
    std::array<PointRow, 3> rows_;  ///< the newest first
    std::vector<Count> squares_;
    std::vector<Owner> upper_owners_;  ///< -trace points: of the squares above the line
    std::vector<Owner> lower_owners_;
};

extern template class Tracer<std::uint8_t>;
extern template class Tracer<std::uint16_t>;

}  // namespace d2b
