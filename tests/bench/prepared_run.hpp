#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contours/contour_archive.hpp"
#include "contours/level_plan.hpp"
#include "contours/tracer.hpp"
#include "core/context.hpp"
#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "options/run_plan.hpp"
#include "pipeline/find_buildings.hpp"

namespace d2b::bench {

// Stages of all modules are measured one after the other.
using namespace contours;
using namespace detect;
using namespace features;
using namespace d2b::outline;
using namespace pipeline;
using namespace reading;

/// Input of every stage from those before it, made once.
class PreparedRun {
  public:
    PreparedRun(const std::string& dem, Preset preset);

    Context context;
    RunPlan decided;
    std::unique_ptr<DemSource> source;
    Crs crs;
    Georeference georeference;
    SquareArea area;
    CellSize cell;
    FoundBuildings found;  ///< empty with the thesis preset
    using Rows = PointRows<std::uint8_t>;
    std::vector<Rows> bands;  ///< with labels and counts
    std::vector<Rows> above;  ///< the rows above each band that it is taken apart with
    LevelPlan plan;
    TraceFrame frame;
    std::vector<FinishedContour> traced;
    std::unique_ptr<StoredContours> contours;

    [[nodiscard]] std::int64_t points() const;
    [[nodiscard]] MetreGrid surface() const;
    /// Statistics, thresholds and counts.
    void make_levels();
    void trace(ContourSink& sink) const;
    [[nodiscard]] std::unique_ptr<StoredContours> filter(std::vector<FinishedContour>&& finished);

  private:
    void read();
    void find();
};

}  // namespace d2b::bench
