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

/// Cells of a row of the whole raster that have one label.
struct LabelRun {
    std::int32_t row = 0;
    std::int32_t begin = 0;  ///< columns
    std::int32_t end = 0;
    Label label = 0;
};
/// The runs of a unit's own cells, row by row. @param labels of what it sees
[[nodiscard]] std::vector<LabelRun> label_runs(const Unit& unit, const Grid<Label>& labels);

/// What find says of a unit. Labels are the unit's own, from 1 on.
struct FoundUnit {
    std::vector<SeenObject> objects;  ///< by label - 1
    std::vector<Window> boxes;        ///< around those of their cells that are the unit's own; likewise
    std::vector<LabelRun> runs;
    UnitEdges edges;
};
/// @param objects by label - 1, of which the boxes are made @param runs of their labels
[[nodiscard]] std::vector<Window> boxes_of(std::size_t objects, const std::vector<LabelRun>& runs);

/// What holds for all that a tile, or the whole, was searched for.
struct FoundFacts {
    explicit FoundFacts(const SiftRules& rules, double min_height)
        : survey{{}, StrangeValues(rules), {}}, fit(min_height) {}
    void merge(const FoundFacts& other);
    void save(ByteWriter& writer) const;
    /// Takes what facts under the same rules saved. @throws BrokenRecord
    void load(ByteReader& reader);

    ElevationSurvey survey;  ///< of the tile's own cells
    GroundFit fit;
    GroundSlope slope;
    SidesKnown sides{false, false, false};
    std::int64_t terrain_outside = 0;  ///< cells of a terrain model outside of its range; of several tiles
                                       ///< some count more than once
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;
    Tally tally;
    std::vector<std::string> warnings;
};

/// What find says of a tile.
struct FoundTile {
    FoundFacts facts;
    std::vector<FoundUnit> units;  ///< row by row
};
void save(const FoundTile& tile, ByteWriter& writer);
/// @param facts that are loaded into @param windows own cells of the tile's units
/// @throws BrokenRecord also where labels or cells are none of theirs
[[nodiscard]] FoundTile load_found_tile(ByteReader& reader, FoundFacts facts,
                                        const std::vector<Window>& windows);

}  // namespace d2b
