#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contours/split_into_runs.hpp"
#include "core/byte_stream.hpp"
#include "dem2buildings/report.hpp"
#include "pipeline/tiles/checkpoint_file.hpp"

namespace d2b {

/// Range of squares below a line that belong to the same levels. Columns count from the first one of the
/// whole window.
struct TileSquares {
    std::int32_t begin = 0;  ///< columns [begin, end)
    std::int32_t end = 0;
    std::int32_t count = 0;  ///< number of levels
};

/// Part of TraceLine::outside, as far as outlines of level 1 may run along it.
struct TileOutside {
    std::int32_t begin = 0;  ///< first column, likewise
    std::span<const double> elevations;
};

/// Serialised part of a stop of the sweep line that lies in a tile. Compact, because all lines of a tile stay
/// in memory until the tile ends.
class PackedLine {
  public:
    explicit PackedLine(std::int32_t line) : line_(line) {}

    [[nodiscard]] std::int32_t line() const { return line_; }
    /// Upper bound of the bytes written by save().
    [[nodiscard]] std::size_t bytes() const {
        constexpr std::size_t largest_varint = 10;
        return sizeof(line_) + cells_.bytes().size() + largest_varint + packed_sums_.bytes().size();
    }
    /// Sets squares and elevations. Call once. @param squares, outside from left to right
    void set(const std::vector<TileSquares>& squares, const std::vector<TileOutside>& outside);
    void add(const ContourSum& sum);
    /// Writes the line in the format that LineJoiner reads. @pre set()
    void save(ByteWriter& writer) const;

  private:
    std::int32_t line_;
    ByteWriter cells_;
    std::uint64_t sums_ = 0;
    ByteWriter packed_sums_;
};

/// Results of step draw for a tile, other than its lines, if one label may fill the window.
struct TracedTile {
    Tally tally;
    std::uint64_t lines = 0;
    std::vector<PayloadBlocks::Block> blocks;  ///< `lines_per_block` lines each, except the last

    static constexpr std::size_t lines_per_block = 16;
};
void save(const TracedTile& tile, ByteWriter& writer);
/// Deserialises a tile. @throws CorruptRecord
[[nodiscard]] TracedTile load_traced_tile(ByteReader& reader);

/// Joins the parts of a line from adjacent tiles.
class LineJoiner {
  public:
    /// @param frame of the whole window. Both arguments must outlive this object
    LineJoiner(const TraceFrame& frame, TraceLine& line);

    /// Adds the part of the next tile to the right; it may share a square with the previous one.
    /// @throws CorruptRecord also if it belongs to another line or exceeds the levels or columns of the frame
    void add(ByteReader& reader);
    /// Completes the line after the last part.
    void finish() { cutter_.finish(); }

  private:
    void add_squares(ByteReader& reader);
    void add_outside(ByteReader& reader);

    const TraceFrame& frame_;
    TraceLine& line_;
    RunEncoder cutter_;
    std::int32_t end_ = 0;  ///< end of the squares covered so far
    bool begun_ = false;    ///< true if a part has been added
};

}  // namespace d2b
