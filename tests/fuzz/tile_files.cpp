#include "fuzz/tile_files.hpp"

#include <algorithm>
#include <vector>

#include "fuzz/bytes.hpp"
#include "pipeline/tiles/drawn_tile.hpp"
#include "pipeline/tiles/found_tile.hpp"

namespace d2b::test {
namespace {

/// Beginning of a file that has nothing to tell.
template <typename Begin>
ByteReader after(const Begin& begin, std::span<const std::byte> bytes) {
    ByteWriter writer;
    begin(writer);
    writer.put_bytes(bytes);
    return ByteReader({writer.bytes().begin(), writer.bytes().end()});
}

enum class Same : std::uint8_t { bytes, length };

/// Checks that a record is written as it was read. @param taken bytes that it was read from
template <typename Record>
void demand_same(const Record& record, std::span<const std::byte> taken, Same same = Same::bytes) {
    ByteWriter again;
    tiles::save(record, again);
    demand(again.bytes().size() == taken.size(), "it is written as long as it was");
    demand(same == Same::length || std::ranges::equal(again.bytes(), taken), "it is written as it was");
}

std::size_t read_found(std::span<const std::byte> bytes) {
    ByteReader reader = after([](ByteWriter& writer) { empty_facts().save(writer); }, bytes);
    const tiles::FoundTile tile = tiles::load_found_tile(reader, empty_facts(), {tile_window});
    const tiles::FoundUnit& unit = tile.units.at(0);
    for (const tiles::LabelRun& run : unit.runs) {
        demand(run.label >= 1 && run.label <= unit.objects.size(), "a run has the label of an object");
        demand(tile_window.holds(run.row, run.begin) && tile_window.holds(run.row, run.end - 1),
               "a run lies in its unit");
    }
    for (const auto* lines : {&unit.edges.above, &unit.edges.left, &unit.edges.below, &unit.edges.right})
        for (const std::vector<Label>& line : *lines)
            for (const Label label : line)
                demand(label <= unit.objects.size(), "a seam has labels of objects");
    return reader.left();
}

std::size_t read_joined(std::span<const std::byte> bytes) {
    ByteReader reader({bytes.begin(), bytes.end()});
    const tiles::JoinedTile tile = tiles::load_joined_tile(reader, tile_window, 3);
    for (const tiles::JoinedUnit& unit : tile.units) {
        demand(unit.unit >= 0 && unit.unit < 3, "a unit is one of the plan's");
        demand(std::ranges::all_of(unit.number, [&](Label label) { return label <= tile.other(); }),
               "labels are of buildings");
    }
    demand_same(tile, bytes.first(bytes.size() - reader.left()));
    return reader.left();
}

std::size_t read_drawn(std::span<const std::byte> bytes) {
    ByteReader reader = after(
        [](ByteWriter& writer) {
            writer.put(Tally());
            writer.put(std::int32_t{1});
            writer.put(std::int64_t{0});
            writer.put(features::StackError());
        },
        bytes);
    const tiles::DrawnTile tile = tiles::load_drawn_tile(reader);
    for (std::size_t i = 0; i < tile.left.size(); ++i) {
        const contours::ContourHead& head = tile.left[i].head;
        demand(head.parent < static_cast<std::int64_t>(i), "a contour stands on one before");
        demand(static_cast<std::size_t>(head.key.level) <=
                   tile.deferred_buildings.at(head.label - 1).thresholds.size(),
               "a contour has a threshold");
    }
    return reader.left();
}

std::size_t read_numbered(std::span<const std::byte> bytes) {
    ByteReader reader({bytes.begin(), bytes.end()});
    const tiles::NumberedTile tile = tiles::load_numbered_tile(reader);
    demand_same(tile, bytes.first(bytes.size() - reader.left()));
    return reader.left();
}

std::size_t read_numbered_whole(std::span<const std::byte> bytes) {
    ByteReader reader({bytes.begin(), bytes.end()});
    const tiles::NumberedWhole whole = tiles::load_numbered_whole(reader, 3);
    for (const tiles::NumberedLayer& layer : whole.layers)
        demand(layer.tiles.size() <= 3 &&
                   std::ranges::all_of(layer.tiles, [](std::int64_t tile) { return tile >= 0 && tile < 3; }),
               "a part is of one of the plan's tiles");
    return reader.left();
}

std::size_t read_contour(std::span<const std::byte> bytes) {
    ByteReader reader({bytes.begin(), bytes.end()});
    const features::DrawnContour drawn = tiles::load_drawn_contour(reader);
    demand(drawn.record.level == drawn.key.level, "a contour is on its level");
    // Any number but 0 is read as true, and written as 1.
    demand_same(drawn, bytes.first(bytes.size() - reader.left()), Same::length);
    return reader.left();
}

}  // namespace

tiles::FoundFacts empty_facts() {
    return tiles::FoundFacts({land_elevations, spikes_m, 1, {}}, 2);
}

std::size_t read_tile_file(std::span<const std::byte> file) {
    const std::span<const std::byte> bytes = file.subspan(1);
    switch (static_cast<TileFile>(static_cast<std::uint8_t>(file[0]) % tile_files)) {
        case TileFile::found:
            return read_found(bytes);
        case TileFile::joined:
            return read_joined(bytes);
        case TileFile::drawn:
            return read_drawn(bytes);
        case TileFile::numbered:
            return read_numbered(bytes);
        case TileFile::numbered_whole:
            return read_numbered_whole(bytes);
        case TileFile::contour:
            break;
    }
    return read_contour(bytes);
}

}  // namespace d2b::test
