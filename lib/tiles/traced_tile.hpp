#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/byte_record.hpp"
#include "dem2buildings/report.hpp"
#include "tiles/tail_blocks.hpp"
#include "trace/take_apart.hpp"

namespace d2b {

/// Squares below a line that belong to the same levels. Columns count from the first of the whole window.
struct TileSquares {
    std::int32_t begin = 0;  ///< columns
    std::int32_t end = 0;
    std::int32_t count = 0;  ///< of levels
};

/// Part of TraceLine::outside, as far as outlines of level 1 may run beside it.
struct TileOutside {
    std::int32_t begin = 0;  ///< column, likewise
    std::span<const double> elevations;
};

/// A stop of the sweep line as far as a tile knows it, as it is written: all that is known of a tile stays in
/// memory until the tile ends.
class PackedLine {
  public:
    explicit PackedLine(std::int32_t line) : line_(line) {}

    [[nodiscard]] std::int32_t line() const { return line_; }
    /// At most, that save() takes.
    [[nodiscard]] std::size_t bytes() const {
        constexpr std::size_t largest_varint = 10;
        return sizeof(line_) + cells_.bytes().size() + largest_varint + packed_sums_.bytes().size();
    }
    /// Once. @param squares, outside from left to right
    void set(const std::vector<TileSquares>& squares, const std::vector<TileOutside>& outside);
    void add(const ContourSum& sum);
    /// As LineJoiner takes it. @pre set()
    void save(ByteWriter& writer) const;

  private:
    std::int32_t line_;
    ByteWriter cells_;
    std::uint64_t sums_ = 0;
    ByteWriter packed_sums_;
};

/// What draw says of a tile where one label may fill the window, beside its lines.
struct TracedTile {
    Tally tally;
    std::uint64_t lines = 0;
    std::vector<TailBlocks::Block> blocks;  ///< of `lines_a_block` lines each, but the last

    static constexpr std::size_t lines_a_block = 16;
};
void save(const TracedTile& tile, ByteWriter& writer);
/// @throws BrokenRecord
[[nodiscard]] TracedTile load_traced_tile(ByteReader& reader);

/// Makes a line of the window of what tiles side by side know of it.
class LineJoiner {
  public:
    /// @param frame of the whole, which must outlive this, as the line must
    LineJoiner(const TraceFrame& frame, TraceLine& line);

    /// The next tile to the right; it may share a square with the one before.
    /// @throws BrokenRecord also where it is of another line, or speaks of more levels or columns
    void add(ByteReader& reader);
    /// After the last.
    void finish() { cutter_.finish(); }

  private:
    void add_squares(ByteReader& reader);
    void add_outside(ByteReader& reader);

    const TraceFrame& frame_;
    TraceLine& line_;
    RunCutter cutter_;
    std::int32_t end_ = 0;  ///< of the squares that are known
    bool begun_ = false;    ///< a tile has been added
};

}  // namespace d2b
