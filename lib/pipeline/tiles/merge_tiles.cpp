#include <algorithm>
#include <optional>
#include <queue>
#include <utility>

#include "features/feature_writer.hpp"
#include "features/target_frame.hpp"
#include "filter/contour_shelf.hpp"
#include "pipeline/feature_input.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/tiles/left_elevations.hpp"
#include "pipeline/tiles/part_numbers.hpp"
#include "pipeline/tiles/tile_numbers.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "pipeline/tiles/trace_tile.hpp"
#include "pipeline/tiles/traced_frame.hpp"
#include "tiles/drawn_tile.hpp"
#include "tiles/recent_files.hpp"

namespace d2b {
namespace {

/// What all tiles have drawn and left.
class DrawnTiles {
  public:
    DrawnTiles(const TileRun& run, Context& context);

    Tally tally;
    int levels = 1;
    std::int64_t buildings = 0;
    StackError error;
    std::vector<DrawnStream> streams;
    std::unique_ptr<StoredContours> left;
    std::vector<Footprint> footprints{{}};  ///< of what is left, by label
    LevelPlan plan;                         ///< likewise
    Label sure = 0;                         ///< of these labels
    std::vector<std::int64_t> tiles{-1};    ///< that have left them, likewise
    LeftElevations elevations;

  private:
    void take(DrawnTile&& tile);
    void number_left(double metres);

    // Tiles are read by turns: what the system would read ahead is gone when it is asked for.
    RecentFiles files_{RecentFiles::ReadAhead::none};  ///< of the streams

    std::vector<LeftBuilding> left_buildings_;  ///< of one tile after the other
    std::vector<std::int64_t> left_by_;         ///< the tile of each
    std::vector<LeftContour> left_;             ///< likewise, with labels and parents among all
};

DrawnTiles::DrawnTiles(const TileRun& run, Context& context) : elevations(context.make_spool()) {
    for (std::int64_t i = 0; i < run.tiles().count(); ++i) {
        context.check_stop();
        SealedFile file(run.file(TileStep::draw, i), run.seal(TileStep::draw, i), &files_);
        std::vector<DrawnBlock> blocks;
        DrawnTile tile = load_body(file, [&](ByteReader& reader) {
            DrawnTile loaded = load_drawn_tile(reader);
            blocks = reader.take_list<DrawnBlock>();
            return loaded;
        });
        streams.emplace_back(std::move(file), std::move(blocks));
        take(std::move(tile));
    }
    number_left(run.metres());
    ContourShelf shelf(context.make_spool());
    for (const LeftContour& contour : left_)
        shelf.add(contour.head, contour.stored);
    left = shelf.finish();
    left_ = std::vector<LeftContour>();  // {} would keep the room
}

void DrawnTiles::take(DrawnTile&& tile) {
    tally.merge(tile.tally);
    levels = std::max(levels, static_cast<int>(tile.levels));
    buildings += tile.buildings;
    error.merge(tile.error);
    elevations.add(tile.cells);
    const auto labels = static_cast<Label>(left_buildings_.size());
    const auto before = static_cast<std::int64_t>(left_.size());
    left_buildings_.insert(left_buildings_.end(), tile.left_buildings.begin(), tile.left_buildings.end());
    left_by_.resize(left_buildings_.size(), static_cast<std::int64_t>(streams.size()) - 1);
    for (LeftContour& contour : tile.left) {
        contour.head.label += labels;
        if (contour.head.parent >= 0)
            contour.head.parent += before;
        left_.push_back(std::move(contour));
    }
}

/// Buildings first, then what may be some.
void DrawnTiles::number_left(double metres) {
    std::vector<Label> number(left_buildings_.size() + 1);
    plan.footprints = true;
    plan.thresholds = {{}};
    for (const bool is_sure : {true, false}) {
        for (std::size_t i = 0; i < left_buildings_.size(); ++i) {
            const JoinedBuilding& facts = left_buildings_[i].facts;
            if (facts.is_building != is_sure)
                continue;
            number[i + 1] = static_cast<Label>(footprints.size());
            footprints.push_back(
                {facts.ground / metres, facts.confidence, doubt_name(facts.doubt), facts.parcel});
            plan.thresholds.push_back(left_buildings_[i].thresholds);
            tiles.push_back(left_by_[i]);
        }
        if (is_sure)
            sure = static_cast<Label>(footprints.size() - 1);
    }
    for (LeftContour& contour : left_)
        contour.head.label = number[contour.head.label];
}

/// Hands out what tiles have drawn in the order of keys.
class Sequence {
  public:
    /// @param parts null where features go into one dataset
    /// @param spool for numbers that wait
    Sequence(std::vector<DrawnStream>& streams, FeatureWriter& writer, PartNumbers* parts,
             std::unique_ptr<Spool> spool)
        : streams_(streams), writer_(writer), parts_(parts), numbers_(std::move(spool), streams.size()) {
        for (std::size_t i = 0; i < streams.size(); ++i)
            if (const auto key = streams[i].key())
                next_.emplace(*key, i);
    }
    /// Writes what comes before a key; without one all that is left.
    void write_before(const std::optional<ContourKey>& end) {
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
                numbers_.put_aside(i);
        }
    }
    /// Of what each tile has drawn.
    [[nodiscard]] TileNumbers& numbers() { return numbers_; }

  private:
    using Next = std::pair<ContourKey, std::size_t>;
    std::vector<DrawnStream>& streams_;
    FeatureWriter& writer_;
    PartNumbers* parts_;
    TileNumbers numbers_;
    std::priority_queue<Next, std::vector<Next>, std::greater<>> next_;
};

/// @param parts the sink, where tiles write features into files of their own, else null
/// @return the numbers of what each tile has drawn
TileNumbers write_all(const FeatureInput& input, const RecordMaker& records, DrawnTiles& drawn,
                      FeatureSink& sink, PartNumbers* parts, Context& context) {
    constexpr std::size_t piece = 64;  // contours that a thread draws at a time
    FeatureWriter writer(input, records, sink, context);
    writer.begin();
    Sequence sequence(drawn.streams, writer, parts, context.make_spool());
    GivenNumbers numbers;
    const std::size_t count = input.contours.size();
    context.threads->in_order(
        (count + piece - 1) / piece,
        [&](std::size_t k, std::size_t thread) {
            std::vector<DrawnContour> all;
            for (std::size_t i = k * piece; i < std::min(count, (k + 1) * piece); ++i)
                all.push_back(writer.drawer().draw(i, thread));
            return all;
        },
        [&](std::size_t k, std::vector<DrawnContour> all) {
            for (std::size_t i = 0; i < all.size(); ++i) {
                sequence.write_before(all[i].key);
                writer.number(numbers, all[i]);
                if (parts != nullptr) {
                    parts->set_tile(drawn.tiles[input.contours.head(k * piece + i).label]);
                    parts->keep(all[i]);
                }
                writer.add_numbered(numbers, k * piece + i, std::move(all[i]));
            }
            context.progress(static_cast<double>(k * piece) / static_cast<double>(count));
        });
    sequence.write_before({});
    writer.finish();
    return std::move(sequence.numbers());
}

/// Each tile knows some of a terrain model. Where any of it can be no elevation, the whole is read once more,
/// which judges it as a run does.
void judge_terrain(TileRun& run, const FoundFacts& facts, FeatureSink& features) {
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
    pass_warnings(run.sources(), {features}, context);
}

/// @throws Error
void merge_drawn(TileRun& run, FeatureSink& features, PartNumbers* parts) {
    Context& context = run.context();
    RunReport& report = context.report;
    const RunSetup& setup = run.setup();
    const Options& options = setup.plan.asked;
    const FoundFacts facts = tell_frame(run, features);
    const ElevationStatistics& statistics = facts.survey.statistics;
    const FixedPoint fixed = statistics.fixed_point();
    const LevelPlan global = plan_global_levels(statistics, options.levels, setup.plan.levels, context);
    report.merge(facts.tally);
    judge_terrain(run, facts, features);
    DrawnTiles drawn(run, context);
    report.merge(drawn.tally);
    drawn.plan.minimum = global.minimum;
    const RecordMaker records(*drawn.left, {drawn.plan, fixed, drawn.footprints, run.metres(),
                                            lattice_frame(run.window(), setup.plan.trace)});
    report_levels(drawn.plan, drawn.levels, report);
    const SearchFacts search{facts.fit, facts.slope, facts.sides, facts.parcels, facts.sampling};
    warn_of_result(setup, drawn.plan, static_cast<std::size_t>(drawn.buildings), &search, context);
    const Outliner outliner = draw_outlines(*drawn.left, setup, context);
    const FeatureInput input =
        feature_input(setup, {*drawn.left, outliner, drawn.sure, fixed, run.sources().parcels}, report,
                      [&](const DrawnStack& stack) {
                          StackError error = drawn.elevations.error(stack, run.window(), fixed);
                          error.merge(drawn.error);
                          return error;
                      });
    const TileNumbers numbers = write_all(input, records, drawn, features, parts, context);
    finish_sinks({features}, context);
    if (parts != nullptr)
        parts->write(run, numbers, drawn.levels);
}

RunReport merge(TileRun& run, FeatureSink& features, PartNumbers* parts) {
    try {
        if (run.setup().plan.detects_buildings())
            merge_drawn(run, features, parts);
        else
            merge_traced(run, features);
    } catch (...) {
        pass_warnings(run.sources(), {features}, run.context());  // which may say why
        throw;
    }
    pass_warnings(run.sources(), {features}, run.context());
    run.tidy(TileStep::draw);
    return run.context().report;
}

}  // namespace

RunReport merge_tiles(TileRun& run, FeatureSink& features) {
    return merge(run, features, nullptr);
}

RunReport number_tiles(TileRun& run) {
    PartNumbers parts(run.context().make_spool());
    return merge(run, parts, &parts);
}

}  // namespace d2b
