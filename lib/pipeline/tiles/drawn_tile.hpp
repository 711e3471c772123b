#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contours/contour_archive.hpp"
#include "contours/merge_regions.hpp"
#include "core/byte_stream.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/world_polygon.hpp"
#include "features/contour_drawer.hpp"
#include "features/divided_buildings.hpp"
#include "features/drawn_stack.hpp"
#include "features/feature_writer.hpp"
#include "geometry/box_tree.hpp"
#include "pipeline/tiles/checkpoint_file.hpp"
#include "pipeline/tiles/found_tile.hpp"

namespace d2b::tiles {

/// Serialises a drawn contour without the cells of the contour.
void save(const features::DrawnContour& drawn, ByteWriter& writer);
/// Deserialises a contour. @throws CorruptRecord
[[nodiscard]] features::DrawnContour load_drawn_contour(ByteReader& reader);

/// Serialises the cells of a building without its spires.
void save(const contours::BuildingCells& cells, ByteWriter& writer);
/// Deserialises cells. @throws CorruptRecord
[[nodiscard]] contours::BuildingCells load_building_cells(ByteReader& reader);

/// Building whose outlines depend on those of another tile.
struct DeferredBuilding {
    JoinedBuilding facts;
    std::vector<double> thresholds;
    contours::BuildingCells cells;  ///< without spires; empty unless it has a roof
};

/// Contour of such a building.
struct DeferredContour {
    contours::ContourHead head;  ///< label: index of its building in deferred_buildings, plus one; parent:
                                 ///< index of an earlier contour
    contours::StoredContours::Stored stored;
};

/// Elevations of the cells needed to draw such buildings.
struct DeferredCells {
    std::vector<RowSpan> runs;
    std::vector<double> elevations;  ///< values of all runs, one run after the other
};

/// Results of step draw for a tile, other than the drawn contours.
struct DrawnTile {
    Tally tally;
    std::int32_t levels = 1;                   ///< number of levels of the tallest stack, including the root
    std::int64_t buildings = 0;                ///< footprints that are buildings with certainty
    features::StackError error;                ///< error of the drawn stacks
    std::vector<features::PartOfWhole> parts;  ///< labels of the tile that have a footprint
    std::vector<DeferredBuilding> deferred_buildings;
    std::vector<DeferredContour> left;
    DeferredCells cells;
};
void save(const DrawnTile& tile, ByteWriter& writer);
/// Deserialises a tile. @throws CorruptRecord
[[nodiscard]] DrawnTile load_drawn_tile(ByteReader& reader);

/// Consecutive contours of one level drawn by a tile.
struct DrawnBlock {
    PayloadBlocks::Block bytes;
    contours::ContourKey first;  ///< key of its first contour
};

/// Contours drawn by a tile, in blocks that are read one at a time. Contours are ordered by level, then by
/// row, and a block has a single level, so that step merge only needs the blocks of tiles at its front in
/// memory.
class DrawnBlocks {
  public:
    /// Adds a contour. @pre contours come in the order of their keys
    void add(const features::DrawnContour& drawn);
    /// Ends the last block.
    void finish();
    [[nodiscard]] const std::vector<DrawnBlock>& blocks() const { return blocks_; }
    /// Bytes of all blocks.
    [[nodiscard]] std::span<const std::byte> bytes() const { return payload_.bytes(); }

  private:
    static constexpr std::size_t usual_bytes = std::size_t{1} << 17;
    ByteWriter block_;
    contours::ContourKey first_;
    PayloadBlocks payload_;
    std::vector<DrawnBlock> blocks_;
};

/// Reads the drawn contours of a file one by one.
class DrawnStream {
  public:
    DrawnStream(CheckpointFile file, std::vector<DrawnBlock> blocks)
        : file_(std::move(file)), blocks_(std::move(blocks)) {}

    /// Returns the key of the next contour, or nothing at the end, without reading a block. @throws
    /// InputError
    [[nodiscard]] std::optional<contours::ContourKey> key();
    /// Returns the next contour. @pre key() @throws InputError
    [[nodiscard]] features::DrawnContour take();

  private:
    void load_next();
    void load_block();

    CheckpointFile file_;
    std::vector<DrawnBlock> blocks_;
    std::size_t next_block_ = 0;
    std::uint64_t begin_ = 0;          ///< start of that block in the payload
    std::optional<ByteReader> block_;  ///< current block, while contours are left in it
    std::unique_ptr<features::DrawnContour> next_;
    std::optional<contours::ContourKey> last_;
};

/// Results of step merge for a tile whose features go into separate files. Contours of the tile drawn by
/// merge, with their numbers, follow in the payload of the file.
struct NumberedTile {
    features::AssignedIds numbers;  ///< numbers of the contours drawn by step draw
    std::vector<DrawnBlock> left;
};
void save(const NumberedTile& tile, ByteWriter& writer);
/// Deserialises a tile. @throws CorruptRecord
[[nodiscard]] NumberedTile load_numbered_tile(ByteReader& reader);

/// Layer that tiles write in parts.
struct NumberedLayer {
    std::int64_t features = 0;
    Box bounds;                       ///< of all vertices
    std::vector<std::int64_t> tiles;  ///< tiles with features in it, ascending

    /// Adds a feature. @param tile not before those of features added earlier
    void add(std::int64_t tile, const std::vector<WorldPolygon>& parts);
};

/// Results of step merge for all tiles.
struct NumberedWhole {
    std::int32_t levels = 1;  ///< number of levels of the tallest stack, including the root
    std::vector<NumberedLayer> layers;
};
void save(const NumberedWhole& whole, ByteWriter& writer);
/// @param tiles number of tiles of the plan @throws CorruptRecord
[[nodiscard]] NumberedWhole load_numbered_whole(ByteReader& reader, std::int64_t tiles);

}  // namespace d2b::tiles
