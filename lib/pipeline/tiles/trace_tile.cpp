#include "pipeline/tiles/trace_tile.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "contours/tracer.hpp"
#include "core/context.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/reprojection.hpp"
#include "features/suspicious_values.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/run_setup.hpp"
#include "pipeline/tiles/file_cache.hpp"
#include "pipeline/tiles/traced_tile.hpp"
#include "pipeline/trace_contours.hpp"

namespace d2b {

/// Compresses the lines of a tile for the merge step: runs of squares, elevations just outside of contours
/// of level 1, and the sums over the points of each contour within the tile.
class TileLines : private ContourSink {
  public:
    /// @param seen the tile with its halo @param own the tile's own cells
    TileLines(const TraceFrame& frame, TraceMode mode, const Window& seen, const Window& own);

    /// Adds the next lines of the extent, from top to bottom.
    void add(std::vector<TraceLine>&& lines);
    /// Returns the packed lines. Call once, after the last add().
    [[nodiscard]] std::vector<PackedLine> finish();

  private:
    /// Line held back until the squares around its outside elevations are known.
    struct PendingLine {
        std::int32_t row = 0;
        std::size_t line = 0;  ///< index
        std::vector<TileSquares> squares;
        std::vector<double> outside;
    };
    using Runs = std::vector<Run>;

    std::int64_t take(FinishedContour&& finished) override;
    void add(TraceLine&& line);
    void emit_line(const PendingLine& pending, bool all);
    [[nodiscard]] std::vector<TileOutside> adjoining(std::span<const double> outside, bool all);

    TraceFrame frame_;
    Window seen_;
    Window own_;
    Tracer tracer_;
    std::int32_t next_row_;  ///< next row of cells or points
    std::deque<PendingLine> pending_;
    std::deque<Runs> footprints_;  ///< runs of level 1 in the latest rows of squares, latest last
    std::vector<PackedLine> lines_;
    std::vector<std::uint8_t> wanted_;  ///< columns of the extent to keep, one byte per column
    std::int64_t taken_ = 0;            ///< number of contours
};

TracedFrame traced_frame(const TileRun& run, const FoundFacts& facts, Context& context) {
    const ElevationStatistics& statistics = facts.survey.statistics;
    const RunPlan& decided = run.setup().plan;
    TracedFrame traced{plan_global_levels(statistics, decided.asked.levels, decided.levels, context), {}};
    traced.frame = {run.window(), traced.plan.level_count(), statistics.fixed_point(), statistics.range()};
    return traced;
}

FoundFacts load_and_report_frame(TileRun& run, FeatureSink& features) {
    Context& context = run.context();
    FoundFacts facts = run.load_frame();
    report_suspicious_values(facts.survey.suspicious, facts.survey.statistics.moments.n, run.undeclared(),
                             run.setup().dem, run.setup().plan.asked.read, context);
    for (const std::string& text : facts.warnings)
        context.warn(text);
    pass_warnings(run.sources(), {features}, context);
    return facts;
}

namespace {

/// Rows and columns at the border of a tile that may adjoin squares of its neighbours.
constexpr std::int32_t border = 2;

/// Returns the frame cut to the columns of the extent.
TraceFrame frame_of(const TraceFrame& whole, const Window& seen) {
    TraceFrame frame = whole;
    frame.window.col = seen.col;
    frame.window.cols = seen.cols;
    return frame;
}

/// Returns the wanted runs of columns with a valid elevation outside of the contours of level 1.
/// @param wanted one byte per column, modified @param first column
std::vector<TileOutside> column_runs(std::span<std::uint8_t> wanted, std::span<const double> outside,
                                     std::int32_t first) {
    for (std::size_t c = 0; c < wanted.size(); ++c)
        wanted[c] = outside[c] != nothing_outside ? wanted[c] : std::uint8_t{0};
    std::vector<TileOutside> found;
    for (auto end = wanted.begin();;) {
        const auto begin = std::find(end, wanted.end(), 1);
        if (begin == wanted.end())
            return found;
        end = std::find(begin, wanted.end(), 0);
        found.push_back({first + static_cast<std::int32_t>(begin - wanted.begin()),
                         outside.subspan(static_cast<std::size_t>(begin - wanted.begin()),
                                         static_cast<std::size_t>(end - begin))});
    }
}

}  // namespace

TileLines::TileLines(const TraceFrame& frame, TraceMode mode, const Window& seen, const Window& own)
    : frame_(frame),
      seen_(seen),
      own_(own),
      tracer_(frame_of(frame, seen), mode, *this, Outlines::none),
      next_row_(seen.row) {}

/// Keeps only the point sums, because the geometry of contours is cut at the tile's border.
std::int64_t TileLines::take(FinishedContour&& finished) {
    const ContourKey& key = finished.contour.key;
    if (finished.contour.own.n > 0 || finished.sample.size() > 0) {
        const auto line = std::ranges::lower_bound(lines_, key.first.row, {}, &PackedLine::line);
        // Contours that begin in the rows of the tile above continue in the first line.
        line->add({line->line() != key.first.row, key.level, key.first.col - frame_.window.col,
                   finished.contour.own, std::move(finished.sample)});
    }
    return taken_++;
}

void TileLines::add(std::vector<TraceLine>&& lines) {
    for (TraceLine& line : lines)
        add(std::move(line));
}

void TileLines::add(TraceLine&& line) {
    const std::int32_t row = next_row_++;
    const std::int32_t to_window = seen_.col - frame_.window.col;
    if (row >= own_.row) {
        PendingLine& pending =
            pending_.emplace_back(PendingLine{row, lines_.size(), {}, std::move(line.outside)});
        pending.squares.reserve(line.squares.top_runs.size());
        for (const TopRun& squares : line.squares.top_runs)
            pending.squares.push_back(
                {squares.begin + to_window, squares.end + to_window, squares.level + 1});
        lines_.emplace_back(line.line);
    } else {
        line.point_runs.clear();  // counted by the tile above
    }
    // The lines before the first and after the last row have no squares.
    footprints_.push_back(line.squares.levels.size() > 1 ? line.squares.levels[1] : Runs());
    constexpr std::size_t around = 4;
    if (footprints_.size() > around)
        footprints_.pop_front();
    std::vector<TraceLine> one;
    one.push_back(std::move(line));
    tracer_.trace(std::move(one));
    // In point mode, squares lie between two rows, so those below a row arrive with the next one.
    while (!pending_.empty() && pending_.front().row + border <= row) {
        emit_line(pending_.front(), pending_.front().row < own_.row + border);
        pending_.pop_front();
    }
}

/// @param all keeps all columns, not only those near squares
void TileLines::emit_line(const PendingLine& pending, bool all) {
    lines_[pending.line].set(pending.squares, adjoining(pending.outside, all));
}

std::vector<TileOutside> TileLines::adjoining(std::span<const double> outside, bool all) {
    if (outside.empty())
        return {};
    const auto first = static_cast<std::size_t>(own_.col - seen_.col);
    const auto cols = static_cast<std::size_t>(own_.cols);
    wanted_.assign(first + cols, all ? 1 : 0);
    const auto want = [&](std::int32_t begin, std::int32_t end) {
        std::fill(wanted_.begin() + std::clamp<std::ptrdiff_t>(begin, 0, std::ssize(wanted_)),
                  wanted_.begin() + std::clamp<std::ptrdiff_t>(end, 0, std::ssize(wanted_)), 1);
    };
    const auto begin = static_cast<std::int32_t>(first);
    want(begin, begin + border);
    want(begin + own_.cols - border, begin + own_.cols);
    for (const Runs& runs : footprints_)
        for (const Run& run : runs)
            want(run.begin - 1, run.end + border);
    return column_runs(std::span(wanted_).subspan(first), outside.subspan(first, cols),
                       own_.col - frame_.window.col);
}

std::vector<PackedLine> TileLines::finish() {
    for (const PendingLine& pending : pending_)
        emit_line(pending, true);
    pending_.clear();
    TraceLine end;  // closes all contours, even if the window continues below the tile
    end.line = next_row_;
    end.squares.levels.resize(static_cast<std::size_t>(frame_.levels));
    std::vector<TraceLine> last;
    last.push_back(std::move(end));
    tracer_.trace(std::move(last));
    return std::move(lines_);
}

namespace {

/// Returns the cells of a tile, in point mode with the surrounding points that its squares depend on.
Window seen_by(const Window& own, TraceMode mode, const Window& whole) {
    if (mode == TraceMode::cells)
        return own;
    Window seen = expanded(own, rows_above(mode), 1, whole);
    seen.rows = own.end_row() - seen.row;  // squares between two tiles belong to the lower one
    return seen;
}

PayloadBlocks blocks_of(std::vector<PackedLine>&& lines) {
    PayloadBlocks blocks;
    std::size_t bytes = 0;
    for (const PackedLine& line : lines)
        bytes += line.bytes();
    blocks.reserve(bytes);
    for (std::size_t first = 0; first < lines.size(); first += TracedTile::lines_per_block) {
        ByteWriter block;
        for (std::size_t i = first; i < std::min(first + TracedTile::lines_per_block, lines.size()); ++i)
            std::exchange(lines[i], PackedLine(0)).save(block);
        blocks.add(block);
    }
    return blocks;
}

}  // namespace

void trace_tile(TileRun& run, std::int64_t tile) {
    const auto path = run.file(TileStep::draw, tile);
    const CheckpointId seal = run.seal(TileStep::draw, tile);
    if (checkpoint_exists(path, seal))
        return;
    Context& context = run.context();
    const TraceMode mode = run.setup().plan.trace;
    Context uncounted;  // dropped levels are counted once for all tiles
    const TracedFrame traced = traced_frame(run, run.load_frame(), uncounted);
    const Window own = run.tiles().whole(tile).own;
    const Window seen = seen_by(own, mode, run.window());
    SubwindowSource part(run.sources().dem, seen);
    ElevationReader reader(part, context, {.keep_bytes = 0});  // read only once
    reader.apply(run.validity_rules());
    TileLines lines(traced.frame, mode, seen, own);
    const ColRange summed{own.col - seen.col, own.end_col() - seen.col};
    split_bands_into_runs(
        reader, {traced.frame, {traced.plan, nullptr, nullptr}, mode, summed},
        [&](const BandShape& band, std::vector<TraceLine>&& more) {
            lines.add(std::move(more));
            context.progress(static_cast<double>(band.first_row + band.rows - seen.row) / seen.rows);
        });
    std::vector<PackedLine> all = lines.finish();
    const std::uint64_t count = all.size();
    const PayloadBlocks blocks = blocks_of(std::move(all));
    TracedTile drawn{{}, count, blocks.blocks()};
    drawn.tally.merge(context.report);
    ByteWriter writer;
    save(drawn, writer);
    write_checkpoint(path, seal, writer.bytes(), blocks.bytes());
}

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
        CheckpointFile file;
        TracedTile head;
        std::vector<std::uint64_t> begins;  ///< offsets of its blocks
    };
    /// Adds the contribution of one block of a tile to its lines.
    static void load(const Tile& tile, std::size_t block, std::span<LineJoiner> lines);
    [[nodiscard]] std::size_t lines_before(std::size_t block) const {
        return std::min<std::size_t>(block * TracedTile::lines_per_block, tiles_.front().head.lines);
    }

    const TraceFrame& frame_;
    FileHandleCache files_;
    std::vector<Tile> tiles_;
    std::size_t pieces_ = 0;
    std::size_t blocks_per_piece_;
};

/// Chooses pieces as high as the bands of an untiled run unless the window is too wide, because pieces are
/// joined line by line.
std::size_t blocks_per_piece(const TraceFrame& frame) {
    constexpr std::int64_t most_points = 1 << 21;
    constexpr std::int64_t most_lines = 64;
    const std::int64_t lines = std::min(most_points / frame.window.cols, most_lines);
    return std::max<std::size_t>(static_cast<std::size_t>(lines) / TracedTile::lines_per_block, 1);
}

TileRow::TileRow(const TileRun& run, std::int64_t first, const TraceFrame& frame, RunReport& report)
    : frame_(frame), blocks_per_piece_(blocks_per_piece(frame)) {
    for (std::int64_t tile = first; tile < first + run.tiles().cols(); ++tile) {
        CheckpointFile file(run.file(TileStep::draw, tile), run.seal(TileStep::draw, tile), &files_);
        TracedTile head = load_body(file, load_traced_tile);
        std::vector<std::uint64_t> begins{0};
        for (const PayloadBlocks::Block& block : head.blocks)
            begins.push_back(begins.back() + block.size);
        report.merge(head.tally);
        if (!tiles_.empty() && head.lines != tiles_.front().head.lines)
            throw InputError(file.damaged("it has other lines than its neighbour"));
        pieces_ = (head.blocks.size() + blocks_per_piece_ - 1) / blocks_per_piece_;
        tiles_.push_back({std::move(file), std::move(head), std::move(begins)});
    }
}

void TileRow::load(const Tile& tile, std::size_t block, std::span<LineJoiner> lines) {
    ByteReader reader = read_block(tile.file, tile.begins[block], tile.head.blocks[block]);
    try {
        for (LineJoiner& line : lines)
            line.add(reader);
    } catch (const CorruptRecord& broken) {
        throw InputError(tile.file.damaged(broken.what()));
    }
}

std::vector<TraceLine> TileRow::lines(std::size_t piece) const {
    const std::size_t first = piece * blocks_per_piece_;
    const std::size_t end = std::min(first + blocks_per_piece_, tiles_.front().head.blocks.size());
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
void trace_into(ContourArchive& store, TileRun& run, const TraceFrame& frame) {
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
        } catch (const CorruptRecord& broken) {
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
    ContourArchive store = contour_store(frame, nullptr, setup.plan, setup.area, run.metres(), context);
    trace_into(store, run, frame);
    const StageClock clock(context.report, Stage::filter);
    return store.finish();
}

/// Measures the error of a stack by reading the elevations again.
StackError measure_again(TileRun& run, const DrawnStack& stack, const FixedPoint& fixed) {
    ElevationReader reader(run.sources().dem, run.context(), {.keep_bytes = 0});
    reader.apply(run.validity_rules());
    return measure_stack(stack, fixed, reader);
}

}  // namespace

void merge_traced(TileRun& run, FeatureSink& features, CommitList& commit) {
    Context& context = run.context();
    RunReport& report = context.report;
    const RunSetup& setup = run.setup();
    const FoundFacts facts = load_and_report_frame(run, features);
    const auto [plan, frame] = traced_frame(run, facts, context);
    report.merge(facts.tally);
    const auto contours = trace_tiles(run, frame);
    const std::vector<Footprint> none;
    const RecordBuilder records(
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
