#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "contours/contour_archive.hpp"
#include "contours/level_plan.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/spool.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/divided_buildings.hpp"
#include "features/drawn_stack.hpp"
#include "features/feature_writer.hpp"
#include "features/record_builder.hpp"
#include "features/reprojection.hpp"
#include "features/suspicious_values.hpp"
#include "pipeline/extract_roofs.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/run_setup.hpp"
#include "pipeline/tiles/drawn_tile.hpp"
#include "pipeline/tiles/file_cache.hpp"
#include "pipeline/tiles/tile_footprints.hpp"
#include "pipeline/tiles/tile_numbers.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "pipeline/write_footprints.hpp"

namespace d2b::tiles {

/// Elevations of the cells around deferred buildings, collected from all tiles and kept in a spool.
class DeferredElevations {
  public:
    explicit DeferredElevations(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// Adds cells; cells known from several tiles have equal elevations. @throws OutputError the spool is
    /// full
    void add(const DeferredCells& cells);
    /// Measures the error of a stack against them. @param window of the stack @throws OutputError
    [[nodiscard]] features::StackError error(const features::DrawnStack& stack, const Window& window,
                                             const FixedPoint& fixed) const;

  private:
    /// Block size in rows and columns of the whole raster.
    static constexpr std::int32_t block_rows = 64;
    static constexpr std::int32_t block_cols = 1024;
    std::unique_ptr<Spool> spool_;
    std::map<LatticePoint, std::vector<SpoolEntry>> blocks_;  ///< by first cell
};

/// Contours drawn by all tiles, and those that they left to the merge step.
class DrawnTiles {
  public:
    DrawnTiles(const TileRun& run, Context& context);

    Tally tally;
    int levels = 1;
    std::int64_t buildings = 0;
    features::StackError error;
    std::vector<DrawnStream> streams;
    std::unique_ptr<contours::StoredContours> left;
    std::vector<features::Footprint> footprints{{}};  ///< footprints of deferred buildings, by label
    contours::LevelPlan plan;                         ///< thresholds of deferred buildings, by label
    Label sure = 0;  ///< number of deferred labels that are buildings; higher ones are low-confidence
    std::vector<std::int64_t> tiles{-1};  ///< tile that deferred each label
    DeferredElevations elevations;

    /// Returns the wholes that were divided into several buildings, ascending.
    [[nodiscard]] std::vector<std::int64_t> divided() const { return features::divided_wholes(parts_); }
    /// Extracts the roofs of deferred buildings. @param outliner of `left` @throws OutputError, Cancelled
    [[nodiscard]] features::StoredRoofs extract_roofs(const outline::Outliner& outliner,
                                                      const features::RunSetup& setup,
                                                      Context& context) const;

  private:
    void take(DrawnTile&& tile);
    void number_deferred(double metres);

    FileHandleCache files_;                             ///< file handles of the streams
    std::vector<DeferredBuilding> deferred_buildings_;  ///< concatenated over tiles
    std::vector<std::int64_t> deferred_by_;             ///< tile of each deferred_buildings_ entry
    std::vector<DeferredContour> deferred_;  ///< concatenated over tiles, with labels and parents renumbered
    std::unique_ptr<Spool> cell_spool_;      ///< cells of deferred buildings
    std::vector<SpoolEntry> cells_;          ///< by label once they are numbered
    std::vector<features::PartOfWhole> parts_;  ///< of all tiles, with labels renumbered
    Label parts_before_ = 0;                    ///< highest of these labels
};

/// Merges the streams of drawn contours of all tiles into one sequence ordered by key.
class DrawnStreamMerger {
  public:
    /// @param streams by tile; all references must outlive this
    /// @param parts null if features go into one dataset
    /// @param spool for numbers that are not in memory
    DrawnStreamMerger(std::vector<DrawnStream>& streams, features::FeatureWriter& writer,
                      IdCollectorSink* parts, std::unique_ptr<Spool> spool);

    /// Writes all contours before a key, or all remaining ones if there is no key. @throws InputError,
    /// OutputError
    void write_before(const std::optional<contours::ContourKey>& end);
    /// Returns the ids assigned so far, by tile.
    [[nodiscard]] TileIds& numbers() { return numbers_; }

  private:
    using Next = std::pair<contours::ContourKey, std::size_t>;
    std::vector<DrawnStream>& streams_;
    features::FeatureWriter& writer_;
    IdCollectorSink* parts_;
    TileIds numbers_;
    std::priority_queue<Next, std::vector<Next>, std::greater<>> next_;
};

void DeferredElevations::add(const DeferredCells& cells) {
    std::map<LatticePoint, ByteWriter> parts;
    auto next = cells.elevations.begin();
    for (const RowSpan& run : cells.runs)
        for (std::int32_t begin = run.begin; begin < run.end;) {
            const std::int32_t block_col = begin - begin % block_cols;
            const RowSpan part{run.row, begin, std::min(run.end, block_col + block_cols)};
            ByteWriter& writer = parts[{run.row - run.row % block_rows, block_col}];
            writer.put(part);
            for (; begin < part.end; ++begin)
                writer.put(*next++);
        }
    for (const auto& [block, writer] : parts)
        blocks_[block].push_back(append(*spool_, writer));
}

features::StackError DeferredElevations::error(const features::DrawnStack& stack, const Window& window,
                                               const FixedPoint& fixed) const {
    features::StackError error;
    for (const auto& [first, entries] : blocks_) {
        const std::int32_t row = std::max(first.row, window.row);
        const std::int32_t col = std::max(first.col, window.col);
        ElevationBand band{{row, std::min(first.row + block_rows, window.end_row()) - row,
                            std::min(first.col + block_cols, window.end_col()) - col},
                           {}};
        if (band.shape.rows <= 0 || band.shape.cols <= 0)
            continue;
        band.elevations.assign(band.shape.size(), std::numeric_limits<double>::quiet_NaN());
        for (const SpoolEntry& entry : entries) {
            ByteReader reader(*spool_, entry);
            while (reader.left() > 0) {
                const auto run = reader.take<RowSpan>();
                for (std::int32_t c = run.begin; c < run.end; ++c) {
                    const auto z = reader.take<double>();
                    if (window.holds(run.row, c))
                        band.elevations[static_cast<std::size_t>(run.row - row) *
                                            static_cast<std::size_t>(band.shape.cols) +
                                        static_cast<std::size_t>(c - col)] = z;
                }
            }
        }
        error.merge(stack.error(band, fixed, col - window.col));
    }
    return error;
}

DrawnTiles::DrawnTiles(const TileRun& run, Context& context)
    : elevations(context.make_spool()), cell_spool_(context.make_spool()) {
    for (std::int64_t i = 0; i < run.tiles().count(); ++i) {
        context.check_stop();
        CheckpointFile file(run.file(TileStep::draw, i), &files_);
        std::vector<DrawnBlock> blocks;
        DrawnTile tile = load_body(file, [&](ByteReader& reader) {
            DrawnTile loaded = load_drawn_tile(reader);
            blocks = reader.take_list<DrawnBlock>();
            return loaded;
        });
        streams.emplace_back(std::move(file), std::move(blocks));
        take(std::move(tile));
    }
    number_deferred(run.metres());
    contours::ContourMerger merger(context.make_spool());
    for (const DeferredContour& contour : deferred_)
        merger.add(contour.head, contour.stored);
    left = merger.finish();
    deferred_ = std::vector<DeferredContour>();  // = {} would keep the capacity
}

void DrawnTiles::take(DrawnTile&& tile) {
    tally.merge(tile.tally);
    levels = std::max(levels, static_cast<int>(tile.levels));
    buildings += tile.buildings;
    error.merge(tile.error);
    elevations.add(tile.cells);
    Label last = parts_before_;
    for (const features::PartOfWhole& part : tile.parts) {
        parts_.push_back({part.whole, parts_before_ + part.label});
        last = std::max(last, parts_.back().label);
    }
    parts_before_ = last;
    const auto labels = static_cast<Label>(deferred_buildings_.size());
    const auto before = static_cast<std::int64_t>(deferred_.size());
    for (DeferredBuilding& building : tile.deferred_buildings) {
        ByteWriter writer;
        save(std::exchange(building.cells, {}), writer);
        cells_.push_back(append(*cell_spool_, writer));
        deferred_buildings_.push_back(std::move(building));
    }
    deferred_by_.resize(deferred_buildings_.size(), static_cast<std::int64_t>(streams.size()) - 1);
    for (DeferredContour& contour : tile.left) {
        contour.head.label += labels;
        if (contour.head.parent >= 0)
            contour.head.parent += before;
        deferred_.push_back(std::move(contour));
    }
}

/// Numbers buildings first, low-confidence candidates after them.
void DrawnTiles::number_deferred(double metres) {
    std::vector<Label> number(deferred_buildings_.size() + 1);
    std::vector<SpoolEntry> cells{{}};
    plan.footprints = true;
    plan.thresholds = {{}};
    for (const bool is_sure : {true, false}) {
        for (std::size_t i = 0; i < deferred_buildings_.size(); ++i) {
            const JoinedBuilding& facts = deferred_buildings_[i].facts;
            if (facts.is_building != is_sure)
                continue;
            number[i + 1] = static_cast<Label>(footprints.size());
            footprints.push_back(facts.footprint(metres));
            cells.push_back(cells_[i]);
            plan.thresholds.push_back(deferred_buildings_[i].thresholds);
            tiles.push_back(deferred_by_[i]);
        }
        if (is_sure)
            sure = static_cast<Label>(footprints.size() - 1);
    }
    cells_ = std::move(cells);
    for (DeferredContour& contour : deferred_)
        contour.head.label = number[contour.head.label];
}

features::StoredRoofs DrawnTiles::extract_roofs(const outline::Outliner& outliner,
                                                const features::RunSetup& setup, Context& context) const {
    const StageClock clock(context.report, Stage::roofs);
    pipeline::RoofExtractor roofs(*left, outliner, sure, setup, context);
    context.threads->for_each(sure, [&](std::size_t i) {
        ByteReader reader(*cell_spool_, cells_[i + 1]);
        roofs.extract(static_cast<Label>(i + 1), load_building_cells(reader));
    });
    return roofs.take();
}

DrawnStreamMerger::DrawnStreamMerger(std::vector<DrawnStream>& streams, features::FeatureWriter& writer,
                                     IdCollectorSink* parts, std::unique_ptr<Spool> spool)
    : streams_(streams), writer_(writer), parts_(parts), numbers_(std::move(spool), streams.size()) {
    for (std::size_t i = 0; i < streams.size(); ++i)
        if (const auto key = streams[i].key())
            next_.emplace(*key, i);
}

void DrawnStreamMerger::write_before(const std::optional<contours::ContourKey>& end) {
    while (!next_.empty() && (!end || next_.top().first < *end)) {
        const auto [key, i] = next_.top();
        next_.pop();
        if (parts_ != nullptr)
            parts_->set_tile(static_cast<std::int64_t>(i));
        writer_.add(numbers_.of(i), 0, streams_[i].take());
        const auto after = streams_[i].key();
        if (after)
            next_.emplace(*after, i);
        if (!after || after->level != key.level)
            numbers_.spool_level(i);
    }
}

namespace {

/// Writes all features, those of tiles and the deferred ones, in the order of keys.
/// @param parts the sink if tiles write features into files of their own, otherwise null
/// @return the ids of the contours that each tile has drawn
TileIds write_all(const features::FeatureInput& input, const features::RecordBuilder& records,
                  DrawnTiles& drawn, FeatureSink& sink, IdCollectorSink* parts, Context& context) {
    features::FeatureWriter writer(input, records, sink, context);
    writer.begin();
    DrawnStreamMerger sequence(drawn.streams, writer, parts, context.make_spool());
    features::AssignedIds numbers;
    writer.drawer().draw_all([&](std::size_t i, features::DrawnContour&& contour) {
        sequence.write_before(contour.key);
        writer.assign_ids(numbers, contour);
        if (parts != nullptr) {
            parts->set_tile(drawn.tiles[input.contours.head(i).label]);
            parts->add_deferred(contour);
        }
        numbers.written.push_back(writer.add_with_ids(i, std::move(contour)));
        if (i % features::contours_per_task == 0)
            context.progress(static_cast<double>(i) / static_cast<double>(input.contours.size()));
    });
    sequence.write_before({});
    if (const std::optional<features::DrawnStack> stack = writer.finish()) {
        features::StackError error = drawn.elevations.error(*stack, input.setup.dem.window, input.fixed);
        error.merge(drawn.error);
        context.report.stack_rmse_m = error.rms(input.fixed) * context.report.units.vertical_metres;
    }
    return std::move(sequence.numbers());
}

/// Checks the given terrain model. Each tile has seen only a part of it, so if any cell was outside the valid
/// range, reads all of it again to issue the same warnings as an untiled run.
void check_terrain_range(TileRun& run, const FoundFacts& facts, FeatureSink& features) {
    constexpr std::int32_t rows_at_once = 64;
    if (facts.terrain_outside == 0)
        return;
    Context& context = run.context();
    const Window& window = run.window();
    std::vector<double> values;
    for (std::int32_t row = window.row; row < window.end_row(); row += rows_at_once) {
        context.check_stop();
        const Window part{row, window.col, std::min(rows_at_once, window.end_row() - row), window.cols};
        values.resize(static_cast<std::size_t>(part.points()));
        run.sources().terrain->read(part, values);
    }
    context.report.count(Reason::terrain_outside_range, run.sources().terrain->cells_outside_range());
    pipeline::pass_warnings(run.sources(), {features}, context);
}

/// Loads the results of join and issues the same warnings as an untiled run. @throws InputError
FoundFacts load_and_report_frame(TileRun& run, FeatureSink& features) {
    Context& context = run.context();
    FoundFacts facts = run.load_frame();
    features::report_suspicious_values(facts.survey.suspicious, facts.survey.statistics.moments.n,
                                       run.undeclared(), run.setup().dem, run.setup().plan.asked.read,
                                       context);
    for (const std::string& text : facts.warnings)
        context.warn(text);
    pipeline::pass_warnings(run.sources(), {features}, context);
    return facts;
}

/// Measures and writes given footprints.
void write_given(TileRun& run, pipeline::GivenFootprints&& given, const pipeline::ElevationFrame& frame,
                 FeatureSink& features) {
    Context& context = run.context();
    add_seen_footprints(run, given);
    pipeline::label_footprints(given, context);
    ElevationReader reader(run.sources().dem, context);
    run.filter_elevations(reader);
    pipeline::write_footprints(std::move(given), reader, frame, run.setup(), features, context);
}

/// @throws Error
void merge_drawn(TileRun& run, FeatureSink& features, IdCollectorSink* parts, CommitList& commit) {
    Context& context = run.context();
    RunReport& report = context.report;
    const features::RunSetup& setup = run.setup();
    const Options& options = setup.plan.asked;
    std::optional<pipeline::GivenFootprints> given;
    if (run.has_footprints())
        given.emplace(pipeline::place_footprints(*run.sources().footprints, setup, context));
    const FoundFacts facts = load_and_report_frame(run, features);
    const ElevationStatistics& statistics = facts.survey.statistics;
    const FixedPoint fixed = statistics.fixed_point();
    const contours::LevelPlan global =
        contours::plan_global_levels(statistics, options.levels, setup.plan.levels, context);
    report.merge(facts.tally);
    check_terrain_range(run, facts, features);
    DrawnTiles drawn(run, context);
    report.merge(drawn.tally);
    drawn.plan.minimum = global.minimum;
    pipeline::report_corrections(run.sources().corrections, facts.effective, options.detect.corrections,
                                 context);
    const features::RecordBuilder records(*drawn.left,
                                          {drawn.plan, fixed, drawn.footprints, run.metres(),
                                           features::lattice_frame(run.window(), setup.plan.trace)});
    pipeline::report_levels(drawn.plan, drawn.levels, report);
    const std::size_t measured = given ? given->all.size() : 0;
    pipeline::warn_of_result(setup, drawn.plan, static_cast<std::size_t>(drawn.buildings) + measured,
                             &facts.scene, run.sources().terrain, context);
    const outline::Outliner outliner = features::draw_outlines(*drawn.left, setup, context);
    std::optional<features::StoredRoofs> roofs;
    if (setup.plan.needs_roofs())
        roofs.emplace(drawn.extract_roofs(outliner, setup, context));
    const features::FeatureInput input{
        setup,          *drawn.left,           outliner, drawn.sure,
        fixed,          run.sources().parcels, nullptr,  roofs ? &*roofs : nullptr,
        drawn.divided()};
    const TileIds numbers = write_all(input, records, drawn, features, parts, context);
    if (given)
        write_given(run, std::move(*given), {fixed, statistics.range(), global}, features);
    pipeline::prepare_sinks({features}, commit, context);
    if (parts != nullptr) {
        parts->write(run, numbers, drawn.levels);
        commit.add(*parts);
    }
}

RunReport merge(TileRun& run, FeatureSink& features, IdCollectorSink* parts,
                const ReportReader<RunReport>& reader) {
    const auto warn = [&] { pipeline::pass_warnings(run.sources(), {features}, run.context()); };
    CommitList commit;
    try {
        merge_drawn(run, features, parts, commit);
    } catch (...) {
        warn();  // may explain the error
        throw;
    }
    warn();
    if (reader.prepare)
        reader.prepare(run.context().report);
    commit.publish([&] {
        warn();
        if (reader.show)
            reader.show(run.context().report);
    });
    run.remove_leftovers(TileStep::draw);
    return run.context().report;
}

}  // namespace

RunReport merge_tiles(TileRun& run, FeatureSink& features, const ReportReader<RunReport>& reader) {
    return merge(run, features, nullptr, reader);
}

RunReport number_tiles(TileRun& run, const ReportReader<RunReport>& reader) {
    IdCollectorSink parts(run.context().make_spool());
    return merge(run, parts, &parts, reader);
}

}  // namespace d2b::tiles
