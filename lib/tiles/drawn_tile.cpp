#include "tiles/drawn_tile.hpp"

#include <algorithm>
#include <utility>

#include "filter/contour_shelf.hpp"
#include "tiles/drawn_contour.hpp"

namespace d2b {
namespace {

void save(const LeftBuilding& building, ByteWriter& writer) {
    writer.put(building.facts);
    writer.put_list(building.thresholds);
}

LeftBuilding load_left_building(ByteReader& reader) {
    LeftBuilding building;
    building.facts = reader.take<JoinedBuilding>();
    building.thresholds = reader.take_list<double>();
    return building;
}

void save(const LeftContour& left, ByteWriter& writer) {
    writer.put(left.head);
    save(left.stored, left.head.key.level, writer);
}

/// @param tile its contours loaded so far
LeftContour load_left_contour(ByteReader& reader, const DrawnTile& tile) {
    LeftContour left;
    left.head = reader.take<ContourHead>();
    const ContourHead& head = left.head;
    const auto before = static_cast<std::int64_t>(tile.left.size());
    if (head.label == 0 || head.label > tile.left_buildings.size() || head.parent < -1 ||
        head.parent >= before || head.key.level < 1 || (head.key.level > 1) != (head.parent >= 0))
        throw BrokenRecord("a contour stands on none");
    if (static_cast<std::size_t>(head.key.level) > tile.left_buildings[head.label - 1].thresholds.size())
        throw BrokenRecord("a contour is of a level that its building does not have");
    if (head.parent >= 0 &&
        tile.left[static_cast<std::size_t>(head.parent)].head.key.level != head.key.level - 1)
        throw BrokenRecord("a contour stands on one that is not the level below it");
    left.stored = load_stored(head.key.level, reader);
    return left;
}

}  // namespace

void save(const DrawnTile& tile, ByteWriter& writer) {
    writer.put(tile.tally);
    writer.put(tile.levels);
    writer.put(tile.buildings);
    writer.put(tile.error);
    writer.put(static_cast<std::uint64_t>(tile.left_buildings.size()));
    for (const LeftBuilding& building : tile.left_buildings)
        save(building, writer);
    writer.put(static_cast<std::uint64_t>(tile.left.size()));
    for (const LeftContour& left : tile.left)
        save(left, writer);
    writer.put_list(tile.cells.runs);
    writer.put_list(tile.cells.elevations);
}

DrawnTile load_drawn_tile(ByteReader& reader) {
    DrawnTile tile;
    tile.tally = reader.take<Tally>();
    tile.levels = reader.take<std::int32_t>();
    tile.buildings = reader.take<std::int64_t>();
    tile.error = reader.take<StackError>();
    tile.left_buildings.resize(reader.take_count(sizeof(JoinedBuilding)));
    for (LeftBuilding& building : tile.left_buildings)
        building = load_left_building(reader);
    const std::size_t left = reader.take_count(sizeof(ContourHead));
    for (std::size_t i = 0; i < left; ++i)
        tile.left.push_back(load_left_contour(reader, tile));
    tile.cells.runs = reader.take_list<RowSpan>();
    tile.cells.elevations = reader.take_list<double>();
    std::uint64_t cells = 0;
    for (const RowSpan& run : tile.cells.runs) {
        if (run.begin >= run.end)
            throw BrokenRecord("a run of cells is empty");
        cells += static_cast<std::uint64_t>(std::int64_t{run.end} - run.begin);
    }
    if (cells != tile.cells.elevations.size())
        throw BrokenRecord("there are not as many elevations as cells");
    return tile;
}

void DrawnBlocks::add(const DrawnContour& drawn) {
    if (block_.bytes().empty())
        first_ = drawn.key;
    else if (block_.bytes().size() >= usual_bytes || drawn.key.level != first_.level) {
        finish();
        first_ = drawn.key;
    }
    save(drawn, block_);
}

void DrawnBlocks::finish() {
    if (block_.bytes().empty())
        return;
    tail_.add(std::exchange(block_, {}));
    blocks_.push_back({tail_.blocks().back(), first_});
}

std::optional<ContourKey> DrawnStream::key() {
    if (next_)
        return next_->key;
    if (block_) {
        load_next();
        return next_->key;
    }
    if (next_block_ < blocks_.size())
        return blocks_[next_block_].first;
    return {};
}

DrawnContour DrawnStream::take() {
    if (!block_)
        load_block();
    if (!next_)
        load_next();
    DrawnContour drawn = std::move(*next_);
    next_.reset();
    if (block_->left() == 0)
        block_.reset();
    return drawn;
}

void DrawnStream::load_block() {
    const DrawnBlock& block = blocks_[next_block_++];
    block_.emplace(read_block(file_, begin_, block.bytes));
    begin_ += block.bytes.size;
    load_next();
    if (next_->key != block.first)
        throw InputError(file_.damaged("a block begins with another contour than is announced"));
}

void DrawnStream::load_next() {
    try {
        next_ = std::make_unique<DrawnContour>(load_drawn_contour(*block_));
    } catch (const BrokenRecord& broken) {
        throw InputError(file_.damaged(broken.what()));
    }
    if (last_ && !(*last_ < next_->key))
        throw InputError(file_.damaged("its contours are not in order"));
    last_ = next_->key;
}

}  // namespace d2b
