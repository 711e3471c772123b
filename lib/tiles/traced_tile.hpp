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
void save(const TileLine& line, ByteWriter& writer);
/// @param frame of the whole @throws BrokenRecord also where it speaks of more levels or columns
[[nodiscard]] TileLine load_tile_line(ByteReader& reader, const TraceFrame& frame);

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
