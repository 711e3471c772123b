#include "pipeline/tiles/tile_footprints.hpp"

#include <algorithm>

#include "core/byte_stream.hpp"
#include "pipeline/tiles/checkpoint_file.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "raster/row_spans.hpp"

namespace d2b::tiles {
namespace {

/// Windows that tiles see: tiles of one row see the same rows, tiles of one column the same columns.
class SeenWindows {
  public:
    explicit SeenWindows(const TileGrid& tiles) : cols_(tiles.cols()) {
        for (std::int64_t row = 0; row < tiles.rows(); ++row)
            rows_.push_back(tiles.whole(row * cols_).seen);
        for (std::int64_t col = 0; col < cols_; ++col)
            columns_.push_back(tiles.whole(col).seen);
    }

    /// Calls use(tile) for each that sees a part of the box.
    template <typename Use>
    void for_tiles(const Window& box, const Use& use) const {
        for (std::size_t row = 0; row < rows_.size(); ++row)
            for (std::size_t col = 0; col < columns_.size(); ++col)
                if (box.row < rows_[row].end_row() && box.end_row() > rows_[row].row &&
                    box.col < columns_[col].end_col() && box.end_col() > columns_[col].col)
                    use(row * static_cast<std::size_t>(cols_) + col);
    }

  private:
    std::int64_t cols_;
    std::vector<Window> rows_;
    std::vector<Window> columns_;
};

Window box_of(const std::vector<RowSpan>& spans) {
    Window box;
    for (const RowSpan& span : spans)
        box = bounding_window(box, {span.row, span.begin, 1, span.end - span.begin});
    return box;
}

/// Returns the parts of runs in a window.
std::vector<RowSpan> parts_in(const Window& window, const std::vector<RowSpan>& spans) {
    std::vector<RowSpan> parts;
    for (const RowSpan& span : spans) {
        const std::int32_t begin = std::max(span.begin, window.col);
        const std::int32_t end = std::min(span.end, window.end_col());
        if (span.row >= window.row && span.row < window.end_row() && begin < end)
            parts.push_back({span.row, begin, end});
    }
    return parts;
}

/// @throws CorruptRecord
std::vector<RowSpan> load_spans(ByteReader& reader, const Window& window) {
    std::vector<RowSpan> spans = reader.take_list<RowSpan>();
    if (spans.empty())
        throw CorruptRecord("a footprint has no cells");
    for (const RowSpan& span : spans)
        if (span.begin >= span.end || !window.holds(span.row, span.begin) || span.end > window.end_col() ||
            span.row < spans.front().row || span.row > spans.back().row)
            throw CorruptRecord("a footprint has cells that its tile does not see");
    return spans;
}

}  // namespace

void plan_footprints(TileRun& run) {
    if (!run.has_footprints())
        return;
    Context& context = run.context();
    const pipeline::GivenFootprints given =
        pipeline::place_footprints(*run.sources().footprints, run.setup(), context);
    const SeenWindows seen(run.tiles());
    std::vector<std::vector<std::size_t>> by_tile(static_cast<std::size_t>(run.tiles().count()));
    for (std::size_t i = 0; i < given.all.size(); ++i)
        if (const std::vector<RowSpan> spans = given.cells(i); !spans.empty())
            seen.for_tiles(box_of(spans), [&](std::size_t tile) { by_tile[tile].push_back(i); });
    CheckpointBatch files(run.folder(TileStep::plan));
    for (std::int64_t tile = 0; tile < run.tiles().count(); ++tile) {
        context.check_stop();
        const Window window = run.tiles().whole(tile).seen;
        ByteWriter writer;
        for (const std::size_t i : by_tile[static_cast<std::size_t>(tile)])
            if (const std::vector<RowSpan> spans = parts_in(window, given.cells(i)); !spans.empty()) {
                writer.put(static_cast<std::uint64_t>(i));
                writer.put_list(spans);
            }
        files.write(run.file(TileStep::plan, tile), writer.bytes());
    }
    files.finish();
}

PlannedFootprints load_planned_footprints(TileRun& run, std::int64_t tile) {
    Context& context = run.context();
    PlannedFootprints planned{{{}, {}, context.make_spool(), run.tiles().whole(tile).seen}, {}};
    if (!run.has_footprints())
        return planned;
    pipeline::GivenFootprints& given = planned.footprints;
    CheckpointFile file(run.file(TileStep::plan, tile));
    load_body(file, [&](ByteReader& reader) {
        while (reader.left() > 0) {
            planned.indices.push_back(reader.take<std::uint64_t>());
            const std::vector<RowSpan> spans = load_spans(reader, given.window);
            pipeline::PlacedFootprint& placed = given.all.emplace_back();
            placed.first_row = spans.front().row;
            placed.end_row = spans.back().row + 1;
            for (const RowSpan& span : spans)
                placed.cell_count += span.end - span.begin;
            ByteWriter cells;
            cells.put_list(spans);
            placed.cells = append(*given.spool, cells);
        }
        return true;
    });
    pipeline::label_footprints(given, context);
    return planned;
}

void add_seen_footprints(const TileRun& run, pipeline::GivenFootprints& given) {
    struct SeenByUnit {
        std::int64_t unit;
        SeenGiven given;
    };
    std::vector<SeenByUnit> all;
    for (std::int64_t tile = 0; tile < run.tiles().count(); ++tile) {
        const FoundTile found = run.load_found(tile);
        const std::vector<NumberedUnit> units = run.tiles().units_of(tile);
        for (std::size_t i = 0; i < units.size(); ++i)
            for (const SeenGiven& seen : found.units[i].footprints) {
                if (seen.footprint >= given.all.size())
                    throw InputError(
                        "The footprints have changed since the plan was made; plan again, with a "
                        "new work folder.");
                all.push_back({units[i].number, seen});
            }
    }
    // A unit that has no more of a footprint than an earlier one does not change its ground.
    std::ranges::stable_sort(all, {}, &SeenByUnit::unit);
    for (const SeenByUnit& one : all)
        given.add(one.given.footprint, one.given.seen, run.metres());
}

}  // namespace d2b::tiles
