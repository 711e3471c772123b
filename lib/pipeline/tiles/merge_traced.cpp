#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "core/stage_clock.hpp"
#include "features/target_frame.hpp"
#include "pipeline/feature_input.hpp"
#include "pipeline/measure_stack.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/tiles/trace_tile.hpp"
#include "pipeline/tiles/traced_frame.hpp"
#include "pipeline/trace_contours.hpp"
#include "tiles/recent_files.hpp"
#include "tiles/traced_tile.hpp"

namespace d2b {
namespace {

/// Lines of one row of tiles. They are read in parallel, a piece at a time. Thread-safe.
class TileRow {
  public:
    /// @param first tile of the row @throws InputError
    TileRow(const TileRun& run, std::int64_t first, const TraceFrame& frame, RunReport& report);

    /// Number of pieces into which the lines are divided.
    [[nodiscard]] std::size_t pieces() const { return pieces_; }
    /// Reads the lines of a piece. @throws InputError
    [[nodiscard]] std::vector<TraceLine> lines(std::size_t piece) const;
    /// Returns the error message for files that are consistent alone but not with each other.
    [[nodiscard]] std::string damaged(const std::string& what) const {
        return tiles_.front().file.damaged(what + ", or one beside it does not fit it");
    }

  private:
    struct Tile {
        SealedFile file;
        TracedTile head;
        std::vector<std::uint64_t> begins;  ///< offsets of its blocks
    };
    /// Adds the contribution of one block of a tile to its lines.
    static void load(const Tile& tile, std::size_t block, std::span<LineJoiner> lines);
    [[nodiscard]] std::size_t lines_before(std::size_t block) const {
        return std::min<std::size_t>(block * TracedTile::lines_a_block, tiles_.front().head.lines);
    }

    const TraceFrame& frame_;
    RecentFiles files_;
    std::vector<Tile> tiles_;
    std::size_t pieces_ = 0;
    std::size_t blocks_a_piece_;
};

/// Chooses pieces as high as the bands of an untiled run unless the window is too wide, because pieces are
/// joined line by line.
std::size_t blocks_a_piece(const TraceFrame& frame) {
    constexpr std::int64_t most_points = 1 << 21;
    constexpr std::int64_t most_lines = 64;
    const std::int64_t lines = std::min(most_points / frame.window.cols, most_lines);
    return std::max<std::size_t>(static_cast<std::size_t>(lines) / TracedTile::lines_a_block, 1);
}

TileRow::TileRow(const TileRun& run, std::int64_t first, const TraceFrame& frame, RunReport& report)
    : frame_(frame), blocks_a_piece_(blocks_a_piece(frame)) {
    for (std::int64_t tile = first; tile < first + run.tiles().cols(); ++tile) {
        SealedFile file(run.file(TileStep::draw, tile), run.seal(TileStep::draw, tile), &files_);
        TracedTile head = load_body(file, load_traced_tile);
        std::vector<std::uint64_t> begins{0};
        for (const TailBlocks::Block& block : head.blocks)
            begins.push_back(begins.back() + block.size);
        report.merge(head.tally);
        if (!tiles_.empty() && head.lines != tiles_.front().head.lines)
            throw InputError(file.damaged("it has other lines than its neighbour"));
        pieces_ = (head.blocks.size() + blocks_a_piece_ - 1) / blocks_a_piece_;
        tiles_.push_back({std::move(file), std::move(head), std::move(begins)});
    }
}

void TileRow::load(const Tile& tile, std::size_t block, std::span<LineJoiner> lines) {
    ByteReader reader = read_block(tile.file, tile.begins[block], tile.head.blocks[block]);
    try {
        for (LineJoiner& line : lines)
            line.add(reader);
    } catch (const BrokenRecord& broken) {
        throw InputError(tile.file.damaged(broken.what()));
    }
}

std::vector<TraceLine> TileRow::lines(std::size_t piece) const {
    const std::size_t first = piece * blocks_a_piece_;
    const std::size_t end = std::min(first + blocks_a_piece_, tiles_.front().head.blocks.size());
    std::vector<TraceLine> lines(lines_before(end) - lines_before(first));
    std::vector<LineJoiner> joiners;
    joiners.reserve(lines.size());
    for (TraceLine& line : lines)
        joiners.emplace_back(frame_, line);
    for (const Tile& tile : tiles_)
        for (std::size_t block = first; block < end; ++block)
            load(tile, block,
                 std::span(joiners).subspan(lines_before(block) - lines_before(first),
                                            lines_before(block + 1) - lines_before(block)));
    for (LineJoiner& joiner : joiners)
        joiner.finish();
    return lines;
}

/// Traces the runs of all tiles. The tracer's memory is released at the end.
void trace_into(ContourStore& store, TileRun& run, const TraceFrame& frame) {
    constexpr std::size_t ahead = 2;  // few, because lines span the whole window
    Context& context = run.context();
    const TraceMode mode = run.setup().plan.trace;
    Tracer tracer(frame, mode, store);
    std::vector<Tally> tallies(static_cast<std::size_t>(context.threads->threads()));
    for (std::int64_t first = 0; first < run.tiles().count(); first += run.tiles().cols()) {
        const TileRow row(run, first, frame, context.report);
        try {
            context.threads->in_order(
                row.pieces(),
                [&](std::size_t piece, std::size_t thread) {
                    const StageClock clock(tallies[thread], Stage::trace);
                    return trace_band(frame, mode, row.lines(piece), store, tallies[thread]);
                },
                [&](std::size_t, TracedBand&& band) {
                    const StageClock clock(context.report, Stage::trace);
                    join_band(std::move(band), tracer, store);
                },
                ahead);
        } catch (const BrokenRecord& broken) {
            throw InputError(row.damaged(broken.what()));
        }
        context.progress(0.5 * static_cast<double>(first) / static_cast<double>(run.tiles().count()));
    }
    for (const Tally& tally : tallies)
        context.report.merge(tally);
}

std::unique_ptr<StoredContours> trace_tiles(TileRun& run, const TraceFrame& frame) {
    Context& context = run.context();
    const RunSetup& setup = run.setup();
    ContourStore store = contour_store(frame, nullptr, setup.plan, setup.area, run.metres(), context);
    trace_into(store, run, frame);
    const StageClock clock(context.report, Stage::filter);
    return store.finish();
}

/// Measures the error of a stack by reading the elevations again.
StackError measure_again(TileRun& run, const DrawnStack& stack, const FixedPoint& fixed) {
    ElevationReader reader(run.sources().dem, run.context(), {.keep_bytes = 0});
    reader.apply(run.sift_rules());
    return measure_stack(stack, fixed, reader);
}

}  // namespace

void merge_traced(TileRun& run, FeatureSink& features, CommitList& commit) {
    Context& context = run.context();
    RunReport& report = context.report;
    const RunSetup& setup = run.setup();
    const FoundFacts facts = tell_frame(run, features);
    const auto [plan, frame] = traced_frame(run, facts, context);
    report.merge(facts.tally);
    const auto contours = trace_tiles(run, frame);
    const std::vector<Footprint> none;
    const RecordMaker records(
        *contours, {plan, frame.fixed, none, run.metres(), lattice_frame(run.window(), setup.plan.trace)});
    report_levels(plan, plan.level_count(), report);
    constexpr Label all = std::numeric_limits<Label>::max();
    warn_of_result(setup, plan, buildings_up_to(all, *contours), nullptr, context);
    const Outliner outliner = draw_outlines(*contours, setup, context);
    const FixedPoint fixed = frame.fixed;
    const FeatureInput input =
        feature_input(setup, {*contours, outliner, all, fixed}, report,
                      [&](const DrawnStack& stack) { return measure_again(run, stack, fixed); });
    write_features(input, records, features, context);
    prepare_sinks({features}, commit, context);
}

}  // namespace d2b
