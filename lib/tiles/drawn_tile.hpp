#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/byte_record.hpp"
#include "dem2buildings/report.hpp"
#include "features/contour_drawer.hpp"
#include "features/drawn_stack.hpp"
#include "filter/contour_store.hpp"
#include "tiles/joined_tile.hpp"
#include "tiles/sealed_file.hpp"
#include "tiles/tail_blocks.hpp"

namespace d2b {

/// Building whose outlines depend on those of another tile.
struct LeftBuilding {
    JoinedBuilding facts;
    std::vector<double> thresholds;
};

/// Contour of such a building.
struct LeftContour {
    ContourHead head;  ///< label: index of its building in left_buildings, plus one; parent: index of an
                       ///< earlier contour
    StoredContours::Stored stored;
};

/// Elevations of the cells needed to draw such buildings.
struct LeftCells {
    std::vector<RowSpan> runs;
    std::vector<double> elevations;  ///< values of all runs, one run after the other
};

/// Results of step draw for a tile, other than the drawn contours.
struct DrawnTile {
    Tally tally;
    std::int32_t levels = 1;     ///< number of levels of the tallest stack, including the root
    std::int64_t buildings = 0;  ///< footprints that are buildings with certainty
    StackError error;            ///< error of the drawn stacks
    std::vector<LeftBuilding> left_buildings;
    std::vector<LeftContour> left;
    LeftCells cells;
};
void save(const DrawnTile& tile, ByteWriter& writer);
/// Deserialises a tile. @throws BrokenRecord
[[nodiscard]] DrawnTile load_drawn_tile(ByteReader& reader);

/// Consecutive contours of one level drawn by a tile.
struct DrawnBlock {
    TailBlocks::Block bytes;
    ContourKey first;  ///< key of its first contour
};

/// Contours drawn by a tile, in blocks that are read one at a time. Contours are ordered by level, then by
/// row, and a block has a single level, so that step merge only needs the blocks of tiles at its front in
/// memory.
class DrawnBlocks {
  public:
    /// Adds a contour. @pre contours come in the order of their keys
    void add(const DrawnContour& drawn);
    /// Ends the last block.
    void finish();
    [[nodiscard]] const std::vector<DrawnBlock>& blocks() const { return blocks_; }
    /// Bytes of all blocks.
    [[nodiscard]] std::span<const std::byte> bytes() const { return tail_.bytes(); }

  private:
    static constexpr std::size_t usual_bytes = std::size_t{1} << 17;
    ByteWriter block_;
    ContourKey first_;
    TailBlocks tail_;
    std::vector<DrawnBlock> blocks_;
};

/// Reads the drawn contours of a file one by one.
class DrawnStream {
  public:
    DrawnStream(SealedFile file, std::vector<DrawnBlock> blocks)
        : file_(std::move(file)), blocks_(std::move(blocks)) {}

    /// Returns the key of the next contour, or nothing at the end, without reading a block. @throws
    /// InputError
    [[nodiscard]] std::optional<ContourKey> key();
    /// Returns the next contour. @pre key() @throws InputError
    [[nodiscard]] DrawnContour take();

  private:
    void load_next();
    void load_block();

    SealedFile file_;
    std::vector<DrawnBlock> blocks_;
    std::size_t next_block_ = 0;
    std::uint64_t begin_ = 0;          ///< start of that block in the payload
    std::optional<ByteReader> block_;  ///< current block, while contours are left in it
    std::unique_ptr<DrawnContour> next_;
    std::optional<ContourKey> last_;
};

}  // namespace d2b
