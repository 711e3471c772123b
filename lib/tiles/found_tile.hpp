#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/byte_record.hpp"
#include "core/context.hpp"
#include "detect/label_rows.hpp"
#include "detect/merge_units.hpp"
#include "detect/unit_seams.hpp"
#include "diagnose/ground_fit.hpp"
#include "diagnose/ground_slope.hpp"
#include "diagnose/parcel_fit.hpp"
#include "diagnose/side_doubt.hpp"
#include "diagnose/surface_sampling.hpp"
#include "diagnose/valid_islands.hpp"
#include "elevations/elevation_reader.hpp"

namespace d2b {

/// Run of cells with one label in a row of the whole raster.
struct LabelRun {
    std::int32_t row = 0;
    std::int32_t begin = 0;  ///< columns [begin, end)
    std::int32_t end = 0;
    Label label = 0;
};
/// Returns the runs in the core of a unit, row by row. @param labels of its whole extent
[[nodiscard]] std::vector<LabelRun> label_runs(const Unit& unit, const Grid<Label>& labels);

/// Results of step find for a unit. Labels are local to the unit and begin at 1.
struct FoundUnit {
    std::vector<SeenObject> objects;  ///< indexed by label - 1
    std::vector<Window> boxes;        ///< bounding boxes of their cells in the core of the unit; likewise
    std::vector<LabelRun> runs;
    UnitEdges edges;
};
/// Returns the bounding boxes of objects. @param objects number of labels @param runs of their labels
[[nodiscard]] std::vector<Window> boxes_of(std::size_t objects, const std::vector<LabelRun>& runs);

/// Facts about everything searched in a tile, or in the whole raster.
struct FoundFacts {
    explicit FoundFacts(const SiftRules& rules, double min_height)
        : survey{{}, StrangeValues(rules), {}}, fit(min_height) {}
    void merge(const FoundFacts& other);
    void save(ByteWriter& writer) const;
    /// Loads facts that were saved under the same rules. @throws BrokenRecord
    void load(ByteReader& reader);

    ElevationSurvey survey;  ///< cells in the core of the tile
    GroundFit fit;
    GroundSlope slope;
    SidesKnown sides{false, false, false};
    std::int64_t terrain_outside = 0;  ///< cells of a terrain model outside of its range; sums over tiles
                                       ///< count some of them more than once
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;
    Tally tally;
    std::vector<std::string> warnings;
};

/// Results of step find for a tile.
struct FoundTile {
    FoundFacts facts;
    std::vector<FoundUnit> units;  ///< row by row
};
void save(const FoundTile& tile, ByteWriter& writer);
/// @param facts empty facts with the rules of the run @param windows cores of the tile's units
/// @throws BrokenRecord also for invalid labels or cells
[[nodiscard]] FoundTile load_found_tile(ByteReader& reader, FoundFacts facts,
                                        const std::vector<Window>& windows);

}  // namespace d2b
