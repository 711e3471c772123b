#include "pipeline/tiles/traced_tile.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "contours/open_chains.hpp"
#include "core/byte_stream.hpp"

namespace d2b {
namespace {

void save_sum(const ContourSum& sum, ByteWriter& writer) {
    writer.put_varint(2 * static_cast<std::uint64_t>(sum.level) + (sum.above ? 1 : 0));
    writer.put_varint(static_cast<std::uint64_t>(sum.col));
    writer.put(sum.stats);
    if (sum.level == 1)
        sum.roof.save(writer);
}

ContourSum load_sum(ByteReader& reader, const TraceFrame& frame) {
    ContourSum sum;
    const std::int32_t level = reader.take_varint(2 * frame.levels - 1);
    sum.above = level % 2 == 1;
    sum.level = level / 2;
    sum.col = reader.take_varint(frame.window.cols - 1);
    sum.stats = reader.take<PointStats>();
    if (sum.level == 1)
        sum.roof = ElevationSample::load(reader);
    return sum;
}

/// Delta encoding of the bounds of ranges that come from left to right.
class DeltaCoder {
  public:
    void put(std::int32_t to, ByteWriter& writer) {
        writer.put_varint(static_cast<std::uint64_t>(to - at_));
        at_ = to;
    }
    /// @param last largest valid value @throws CorruptRecord
    [[nodiscard]] std::int32_t take(ByteReader& reader, std::int32_t last) {
        at_ += reader.take_varint(last - at_);
        return at_;
    }
    /// @throws CorruptRecord
    void pass(std::size_t length, std::int32_t last) {
        if (length == 0 || length > static_cast<std::size_t>(last - at_))
            throw CorruptRecord("a line is longer than the window");
        at_ += static_cast<std::int32_t>(length);
    }

  private:
    std::int32_t at_ = 0;
};

}  // namespace

void PackedLine::set(const std::vector<TileSquares>& squares, const std::vector<TileOutside>& outside) {
    cells_.put_varint(squares.size());
    DeltaCoder gaps;
    for (const TileSquares& stretch : squares) {
        gaps.put(stretch.begin, cells_);
        gaps.put(stretch.end, cells_);
        cells_.put_varint(static_cast<std::uint64_t>(stretch.count));
    }
    cells_.put_varint(outside.size());
    DeltaCoder beside;
    for (const TileOutside& stretch : outside) {
        beside.put(stretch.begin, cells_);
        put_elevations(stretch.elevations, cells_);
        beside.pass(stretch.elevations.size(), std::numeric_limits<std::int32_t>::max());
    }
}

void PackedLine::add(const ContourSum& sum) {
    ++sums_;
    save_sum(sum, packed_sums_);
}

void PackedLine::save(ByteWriter& writer) const {
    writer.put(line_);
    writer.put_bytes(cells_.bytes());
    writer.put_varint(sums_);
    writer.put_bytes(packed_sums_.bytes());
}

void save(const TracedTile& tile, ByteWriter& writer) {
    writer.put(tile.tally);
    writer.put(tile.lines);
    writer.put_list(tile.blocks);
}

TracedTile load_traced_tile(ByteReader& reader) {
    TracedTile tile;
    tile.tally = reader.take<Tally>();
    tile.lines = reader.take<std::uint64_t>();
    tile.blocks = reader.take_list<PayloadBlocks::Block>();
    if (tile.lines > tile.blocks.size() * TracedTile::lines_per_block ||
        tile.lines + TracedTile::lines_per_block <= tile.blocks.size() * TracedTile::lines_per_block)
        throw CorruptRecord("there are not as many blocks as lines need");
    return tile;
}

LineJoiner::LineJoiner(const TraceFrame& frame, TraceLine& line)
    : frame_(frame), line_(line), cutter_(line.squares) {
    line_.squares.levels.resize(static_cast<std::size_t>(frame.levels));
    line_.outside.resize(static_cast<std::size_t>(frame.window.cols), nothing_outside);
}

void LineJoiner::add(ByteReader& reader) {
    const auto line = reader.take<std::int32_t>();
    if (begun_ && line != line_.line)
        throw CorruptRecord("its lines are not those of its neighbour");
    begun_ = true;
    line_.line = line;
    add_squares(reader);
    add_outside(reader);
    for (std::uint64_t left = reader.take_varint(); left > 0; --left)
        line_.sums.push_back(load_sum(reader, frame_));
}

void LineJoiner::add_squares(ByteReader& reader) {
    DeltaCoder gaps;
    for (std::uint64_t left = reader.take_varint(); left > 0; --left) {
        const std::int32_t first = gaps.take(reader, frame_.window.cols);
        const std::int32_t end = gaps.take(reader, frame_.window.cols);
        const std::int32_t count = reader.take_varint(frame_.levels);
        if (first == end || count == 0)
            throw CorruptRecord("squares belong to no level");
        const std::int32_t begin = std::max(first, end_);  // skips squares of the previous tile
        if (begin < end)
            cutter_.add(begin, end, count, 1);
        end_ = std::max(end_, end);
    }
}

void LineJoiner::add_outside(ByteReader& reader) {
    DeltaCoder gaps;
    for (std::uint64_t left = reader.take_varint(); left > 0; --left) {
        const std::int32_t begin = gaps.take(reader, frame_.window.cols);
        const auto beside = std::span(line_.outside).subspan(static_cast<std::size_t>(begin));
        gaps.pass(take_elevations(reader, beside), frame_.window.cols);
    }
}

}  // namespace d2b
