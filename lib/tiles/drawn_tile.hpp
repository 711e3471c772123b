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

/// A building whose outlines depend on those of another tile.
struct LeftBuilding {
    JoinedBuilding facts;
    std::vector<double> thresholds;
};

/// A contour of such a building.
struct LeftContour {
    ContourHead head;  ///< its label is the place of its building among those that are left, plus one; its
                       ///< parent the place of a contour before
    StoredContours::Stored stored;
};

/// Elevations of the cells that such buildings can be drawn in.
struct LeftCells {
    std::vector<RowSpan> runs;
    std::vector<double> elevations;  ///< of one run after the other
};

/// What draw says of a tile beside the contours that it has drawn.
struct DrawnTile {
    Tally tally;
    std::int32_t levels = 1;     ///< of the building with most, the root counted
    std::int64_t buildings = 0;  ///< footprints that are buildings for sure
    StackError error;            ///< of what is drawn
    std::vector<LeftBuilding> left_buildings;
    std::vector<LeftContour> left;
    LeftCells cells;
};
void save(const DrawnTile& tile, ByteWriter& writer);
/// @throws BrokenRecord
[[nodiscard]] DrawnTile load_drawn_tile(ByteReader& reader);

/// Contours of one level, some of those that a tile has drawn.
struct DrawnBlock {
    TailBlocks::Block bytes;
    ContourKey first;  ///< of its contours
};

/// The contours that a tile has drawn, in blocks that are read one at a time. Since a block is of one level,
/// merge holds those of the tiles that its front runs through alone: contours come level by level, and row by
/// row.
class DrawnBlocks {
  public:
    /// In the order of their keys.
    void add(const DrawnContour& drawn);
    /// Ends the last block.
    void finish();
    [[nodiscard]] const std::vector<DrawnBlock>& blocks() const { return blocks_; }
    /// Of all blocks.
    [[nodiscard]] std::span<const std::byte> bytes() const { return tail_.bytes(); }

  private:
    static constexpr std::size_t usual_bytes = std::size_t{1} << 17;
    ByteWriter block_;
    ContourKey first_;
    TailBlocks tail_;
    std::vector<DrawnBlock> blocks_;
};

/// Gives the drawn contours of a file back, one after the other.
class DrawnStream {
  public:
    DrawnStream(SealedFile file, std::vector<DrawnBlock> blocks)
        : file_(std::move(file)), blocks_(std::move(blocks)) {}

    /// The key of the next contour; nothing where there is none. No block is read for it. @throws InputError
    [[nodiscard]] std::optional<ContourKey> key();
    /// @pre key() @throws InputError
    [[nodiscard]] DrawnContour take();

  private:
    void load_next();
    void load_block();

    SealedFile file_;
    std::vector<DrawnBlock> blocks_;
    std::size_t next_block_ = 0;
    std::uint64_t begin_ = 0;          ///< of that block
    std::optional<ByteReader> block_;  ///< that contours are taken of, while there are some in it
    std::unique_ptr<DrawnContour> next_;
    std::optional<ContourKey> last_;
};

}  // namespace d2b
