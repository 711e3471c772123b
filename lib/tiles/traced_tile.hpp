#pragma once

#include <cstdint>
#include <vector>

#include "core/byte_record.hpp"
#include "dem2buildings/report.hpp"
#include "tiles/tail_blocks.hpp"
#include "trace/take_apart.hpp"

namespace d2b {

/// A stop of the sweep line as far as a tile knows it. Columns count from the first of the whole window.
struct TileLine {
    /// Squares below the line that belong to the same levels.
    struct Squares {
        std::int32_t begin = 0;  ///< columns
        std::int32_t end = 0;
        std::int32_t count = 0;  ///< of levels
    };
    /// Part of TraceLine::outside, as far as outlines of level 1 may run beside it.
    struct Outside {
        std::int32_t begin = 0;  ///< column
        std::vector<double> elevations;
    };

    std::int32_t line = TraceLine::none;
    std::vector<Squares> squares;  ///< from left to right
    std::vector<Outside> outside;  ///< likewise
    std::vector<ContourSum> sums;
};
/// @param frame of the whole @throws BrokenRecord also where it speaks of more levels or columns
[[nodiscard]] TileLine load_tile_line(ByteReader& reader, const TraceFrame& frame);

/// Such a line as it is written: all that is known of a tile stays in memory until the tile ends.
class PackedLine {
  public:
    explicit PackedLine(std::int32_t line) : line_(line) {}

    [[nodiscard]] std::int32_t line() const { return line_; }
    /// At most, that save() takes.
    [[nodiscard]] std::size_t bytes() const {
        constexpr std::size_t largest_varint = 10;
        return sizeof(line_) + cells_.bytes().size() + largest_varint + packed_sums_.bytes().size();
    }
    /// Once.
    void set(const std::vector<TileLine::Squares>& squares, const std::vector<TileLine::Outside>& outside);
    void add(const ContourSum& sum);
    /// As load_tile_line() takes it. @pre set()
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

/// Puts lines side by side that tiles know parts of.
/// @param parts from left to right; they may share a square @throws BrokenRecord where they are not of one
/// line
[[nodiscard]] TraceLine join_lines(std::vector<TileLine>&& parts, const TraceFrame& frame);

}  // namespace d2b
