// Whatever a file between two steps of a run in tiles holds, its readers take it or say what is wrong with
// it; what they take speaks of nothing that is not there, and is written again as it was.
#include <algorithm>
#include <cstring>
#include <vector>

#include "fuzz/bytes.hpp"
#include "tiles/drawn_contour.hpp"
#include "tiles/drawn_tile.hpp"
#include "tiles/found_tile.hpp"
#include "tiles/joined_tile.hpp"
#include "tiles/numbered_tile.hpp"
#include "tiles/traced_tile.hpp"

namespace d2b::test {
namespace {

constexpr Window window{10, 20, 8, 9};

FoundFacts no_facts() {
    return FoundFacts({on_land, spikes_m, 1, {}}, 2);
}

/// What a file begins with that has nothing to tell.
template <typename Begin>
ByteReader after(const Begin& begin, std::span<const std::byte> bytes) {
    ByteWriter writer;
    begin(writer);
    writer.put_bytes(bytes);
    return ByteReader({writer.bytes().begin(), writer.bytes().end()});
}

void read_found(std::span<const std::byte> bytes) {
    ByteReader reader = after([](ByteWriter& writer) { no_facts().save(writer); }, bytes);
    const FoundTile tile = load_found_tile(reader, no_facts(), {window});
    const FoundUnit& unit = tile.units.at(0);
    demand(unit.boxes.size() == unit.objects.size(), "every object has a box");
    for (const LabelRun& run : unit.runs) {
        demand(run.label >= 1 && run.label <= unit.objects.size(), "a run has the label of an object");
        demand(window.holds(run.row, run.begin) && window.holds(run.row, run.end - 1),
               "a run lies in its unit");
    }
    for (const auto* lines : {&unit.edges.above, &unit.edges.left, &unit.edges.below, &unit.edges.right})
        for (const std::vector<Label>& line : *lines)
            for (const Label label : line)
                demand(label <= unit.objects.size(), "a seam has labels of objects");
}

void read_joined(std::span<const std::byte> bytes) {
    ByteReader reader({bytes.begin(), bytes.end()});
    const JoinedTile tile = load_joined_tile(reader, window, 3);
    for (const JoinedUnit& unit : tile.units) {
        demand(unit.unit >= 0 && unit.unit < 3, "a unit is one of the plan's");
        demand(std::ranges::all_of(unit.number, [&](Label label) { return label <= tile.other(); }),
               "labels are of buildings");
    }
    ByteWriter again;
    save(tile, again);
    demand(std::ranges::equal(again.bytes(), bytes.first(bytes.size() - reader.left())),
           "it is written as it was");
}

void read_drawn(std::span<const std::byte> bytes) {
    ByteReader reader = after(
        [](ByteWriter& writer) {
            writer.put(Tally());
            writer.put(std::int32_t{1});
            writer.put(std::int64_t{0});
            writer.put(StackError());
        },
        bytes);
    const DrawnTile tile = load_drawn_tile(reader);
    for (std::size_t i = 0; i < tile.left.size(); ++i) {
        const ContourHead& head = tile.left[i].head;
        demand(head.parent < static_cast<std::int64_t>(i), "a contour stands on one before");
        demand(static_cast<std::size_t>(head.key.level) <=
                   tile.left_buildings.at(head.label - 1).thresholds.size(),
               "a contour has a threshold");
    }
}

void read_numbered(std::span<const std::byte> bytes) {
    ByteReader reader({bytes.begin(), bytes.end()});
    const NumberedTile tile = load_numbered_tile(reader);
    ByteWriter again;
    save(tile, again);
    demand(std::ranges::equal(again.bytes(), bytes.first(bytes.size() - reader.left())),
           "it is written as it was");
}

void read_numbered_whole(std::span<const std::byte> bytes) {
    ByteReader reader({bytes.begin(), bytes.end()});
    const NumberedWhole whole = load_numbered_whole(reader, 3);
    for (const NumberedLayer& layer : whole.layers)
        demand(layer.tiles.size() <= 3 &&
                   std::ranges::all_of(layer.tiles, [](std::int64_t tile) { return tile >= 0 && tile < 3; }),
               "a part is of one of the plan's tiles");
}

void read_contour(std::span<const std::byte> bytes) {
    ByteReader reader({bytes.begin(), bytes.end()});
    const DrawnContour drawn = load_drawn_contour(reader);
    demand(drawn.record.level == drawn.key.level, "a contour is on its level");
    ByteWriter again;
    save(drawn, again);
    demand(again.bytes().size() == bytes.size() - reader.left(), "it is written as long as it was");
}

void read_lines(std::span<const std::byte> bytes) {
    TraceFrame frame;
    frame.window = window;
    frame.levels = 4;
    ByteReader reader({bytes.begin(), bytes.end()});
    std::vector<TileLine> parts;
    parts.push_back(load_tile_line(reader, frame));
    parts.push_back(load_tile_line(reader, frame));
    ByteWriter again;
    for (const TileLine& part : parts) {
        save(part, again);
        for (const ContourSum& sum : part.sums)
            demand(sum.level >= 0 && sum.level < frame.levels && sum.col < window.cols,
                   "a sum is of a level and a column");
    }
    ByteReader twice({again.bytes().begin(), again.bytes().end()});
    for (const TileLine& part : parts)
        demand(load_tile_line(twice, frame).squares.size() == part.squares.size(), "it is written as it was");
    const TraceLine line = join_lines(std::move(parts), frame);
    for (const std::vector<Run>& runs : line.squares.levels)
        for (std::size_t i = 0; i < runs.size(); ++i) {
            demand(runs[i].begin < runs[i].end && runs[i].end <= window.cols, "a run lies in the window");
            demand(i == 0 || runs[i - 1].end < runs[i].begin, "runs of a level are apart");
        }
}

void read_traced(std::span<const std::byte> bytes) {
    ByteReader reader = after([](ByteWriter& writer) { writer.put(Tally()); }, bytes);
    const TracedTile tile = load_traced_tile(reader);
    demand((tile.lines + TracedTile::lines_a_block - 1) / TracedTile::lines_a_block == tile.blocks.size(),
           "there are as many blocks as lines need");
}

}  // namespace
}  // namespace d2b::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b::test;
    if (size == 0)
        return 0;
    const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size)).subspan(1);
    try {
        switch (data[0] % 8) {
            case 0:
                read_found(bytes);
                break;
            case 1:
                read_joined(bytes);
                break;
            case 2:
                read_drawn(bytes);
                break;
            case 3:
                read_numbered(bytes);
                break;
            case 4:
                read_numbered_whole(bytes);
                break;
            case 5:
                read_lines(bytes);
                break;
            case 6:
                read_traced(bytes);
                break;
            default:
                read_contour(bytes);
        }
    } catch (const d2b::BrokenRecord&) {
        return 0;
    }
    return 0;
}
