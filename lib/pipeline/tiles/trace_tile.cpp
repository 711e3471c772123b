#include "pipeline/tiles/trace_tile.hpp"

#include <algorithm>
#include <utility>

#include "elevations/part_source.hpp"
#include "pipeline/tiles/tile_lines.hpp"
#include "pipeline/tiles/traced_frame.hpp"
#include "pipeline/trace_contours.hpp"
#include "tiles/traced_tile.hpp"

namespace d2b {
namespace {

/// Returns the cells of a tile, in point mode with the surrounding points that its squares depend on.
Window seen_by(const Window& own, TraceMode mode, const Window& whole) {
    if (mode == TraceMode::cells)
        return own;
    Window seen = grown(own, rows_above(mode), 1, whole);
    seen.rows = own.end_row() - seen.row;  // squares between two tiles belong to the lower one
    return seen;
}

TailBlocks blocks_of(std::vector<PackedLine>&& lines) {
    TailBlocks blocks;
    std::size_t bytes = 0;
    for (const PackedLine& line : lines)
        bytes += line.bytes();
    blocks.reserve(bytes);
    for (std::size_t first = 0; first < lines.size(); first += TracedTile::lines_a_block) {
        ByteWriter block;
        for (std::size_t i = first; i < std::min(first + TracedTile::lines_a_block, lines.size()); ++i)
            std::exchange(lines[i], PackedLine(0)).save(block);
        blocks.add(block);
    }
    return blocks;
}

}  // namespace

void trace_tile(TileRun& run, std::int64_t tile) {
    const auto path = run.file(TileStep::draw, tile);
    const Seal seal = run.seal(TileStep::draw, tile);
    if (is_sealed(path, seal))
        return;
    Context& context = run.context();
    const TraceMode mode = run.setup().plan.trace;
    Context uncounted;  // dropped levels are counted once for all tiles
    const TracedFrame traced = traced_frame(run, run.load_frame(), uncounted);
    const Window own = run.tiles().whole(tile).own;
    const Window seen = seen_by(own, mode, run.window());
    PartSource part(run.sources().dem, seen);
    ElevationReader reader(part, context, {.keep_bytes = 0});  // read only once
    reader.apply(run.sift_rules());
    TileLines lines(traced.frame, mode, seen, own);
    const ColSpan summed{own.col - seen.col, own.end_col() - seen.col};
    take_bands_apart(
        reader, {traced.frame, {traced.plan, nullptr, nullptr}, mode, summed},
        [&](const BandShape& band, std::vector<TraceLine>&& more) {
            lines.add(std::move(more));
            context.progress(static_cast<double>(band.first_row + band.rows - seen.row) / seen.rows);
        });
    std::vector<PackedLine> all = lines.finish();
    const std::uint64_t count = all.size();
    const TailBlocks blocks = blocks_of(std::move(all));
    TracedTile drawn{{}, count, blocks.blocks()};
    drawn.tally.merge(context.report);
    ByteWriter writer;
    save(drawn, writer);
    write_sealed(path, seal, writer.bytes(), blocks.bytes());
}

}  // namespace d2b
