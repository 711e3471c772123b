#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/band.hpp"
#include "core/byte_stream.hpp"
#include "core/context.hpp"
#include "dem2buildings/dem_source.hpp"
#include "detect/detection.hpp"
#include "detect/footprint_fit.hpp"
#include "detect/scene_statistics.hpp"
#include "detect/units.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/record_builder.hpp"

namespace d2b::tiles {

/// Run of cells with one label in a row of the whole raster.
struct LabelRun {
    std::int32_t row = 0;
    std::int32_t begin = 0;  ///< columns [begin, end)
    std::int32_t end = 0;
    Label label = 0;
};
/// Returns the runs in the core of a unit, row by row. @param labels of its whole extent
[[nodiscard]] std::vector<LabelRun> label_runs(const detect::Unit& unit, const Grid<Label>& labels);

/// Given footprint as a unit sees it.
struct SeenGiven {
    std::uint64_t footprint = 0;  ///< its index in the order of the source
    detect::SeenFootprint seen;   ///< its label is not used
};

/// Results of step find for a unit. Labels are local to the unit and begin at 1.
struct FoundUnit {
    std::vector<detect::SeenObject> objects;  ///< indexed by label - 1
    std::vector<LabelRun> runs;
    detect::UnitEdges edges;
    std::vector<SeenGiven> footprints{};
};

/// Facts about everything searched in a tile, or in the whole raster.
struct FoundFacts {
    explicit FoundFacts(const ValidityRules& rules, double min_height)
        : survey{{}, SuspiciousValues(rules), {}}, scene(min_height) {}
    void merge(const FoundFacts& other);
    void save(ByteWriter& writer) const;
    /// Loads facts that were saved under the same rules. @throws CorruptRecord
    void load(ByteReader& reader);

    ElevationSurvey survey;  ///< cells in the core of the tile
    detect::SceneStatistics scene;
    std::int64_t terrain_outside = 0;  ///< cells of a terrain model outside of its range; sums over tiles
                                       ///< count some of them more than once
    Tally tally;
    std::vector<std::string> warnings;
    std::set<std::size_t> effective;  ///< corrections that have had an effect
};

/// Results of step find for a tile.
struct FoundTile {
    FoundFacts facts;
    std::vector<FoundUnit> units;  ///< row by row
};
void save(const FoundTile& tile, ByteWriter& writer);
/// @param facts empty facts with the rules of the run @param windows cores of the tile's units
/// @throws CorruptRecord also for invalid labels or cells
[[nodiscard]] FoundTile load_found_tile(ByteReader& reader, FoundFacts facts,
                                        const std::vector<Window>& windows);

/// Certain or possible building that a tile draws.
struct JoinedBuilding {
    bool is_building = false;
    detect::CounterEvidence doubt = detect::CounterEvidence::rough;
    double ground = 0;  ///< elevation in m; NaN if unknown
    double confidence = 0;
    std::int64_t parcel = ParcelCell::no_parcel;
    std::int64_t whole = 0;  ///< shared by all buildings, of any tile, into which one may be divided; 0: none

    /// @param metres per vertical unit
    [[nodiscard]] features::Footprint footprint(double metres) const {
        return {ground / metres, confidence, detect::counter_evidence_name(doubt), parcel, whole};
    }
};

/// Mapping from the labels of a unit to those of a tile.
struct JoinedUnit {
    std::int64_t unit = 0;      ///< number of the unit, row by row
    std::vector<Label> number;  ///< indexed by the label in the unit: 0 if rejected, 1 to n for a building of
                                ///< the tile, n + 1 for one of another tile
};

/// Results of step join for a tile: its buildings and their location.
struct JoinedTile {
    std::vector<JoinedBuilding> buildings;  ///< possible buildings come last
    Window window;  ///< bounds of their cells and of the surroundings needed to draw them; empty if there are
                    ///< no buildings
    std::vector<JoinedUnit> units;  ///< units whose cores overlap the window

    /// Number of certain buildings.
    [[nodiscard]] Label sure() const;
    [[nodiscard]] Label other() const { return static_cast<Label>(buildings.size() + 1); }
};
void save(const JoinedTile& tile, ByteWriter& writer);
/// @param window of the whole raster @param units number of units in it @throws CorruptRecord
[[nodiscard]] JoinedTile load_joined_tile(ByteReader& reader, const Window& window, std::int64_t units);

}  // namespace d2b::tiles
