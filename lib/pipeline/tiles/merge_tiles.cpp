#include <algorithm>
#include <utility>

#include "features/feature_writer.hpp"
#include "features/target_frame.hpp"
#include "pipeline/feature_input.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/tiles/drawn_sequence.hpp"
#include "pipeline/tiles/drawn_tiles.hpp"
#include "pipeline/tiles/part_numbers.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "pipeline/tiles/trace_tile.hpp"
#include "pipeline/tiles/traced_frame.hpp"

namespace d2b {
namespace {

/// Writes all features, those of tiles and the deferred ones, in the order of keys.
/// @param parts the sink if tiles write features into files of their own, otherwise null
/// @return the ids of the contours that each tile has drawn
TileNumbers write_all(const FeatureInput& input, const RecordMaker& records, DrawnTiles& drawn,
                      FeatureSink& sink, PartNumbers* parts, Context& context) {
    constexpr std::size_t piece = 64;  // contours per task
    FeatureWriter writer(input, records, sink, context);
    writer.begin();
    DrawnSequence sequence(drawn.streams, writer, parts, context.make_spool());
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
                    parts->keep_contour(all[i]);
                }
                writer.add_numbered(numbers, k * piece + i, std::move(all[i]));
            }
            context.progress(static_cast<double>(k * piece) / static_cast<double>(count));
        });
    sequence.write_before({});
    writer.finish();
    return std::move(sequence.numbers());
}

/// Checks the given terrain model. Each tile has seen only a part of it, so if any cell was outside the valid
/// range, reads all of it again to issue the same warnings as an untiled run.
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
void merge_drawn(TileRun& run, FeatureSink& features, PartNumbers* parts, CommitList& commit) {
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
    const SearchFacts search{facts.fit,
                             facts.slope,
                             facts.sides,
                             facts.parcels,
                             facts.sampling,
                             facts.islands,
                             share_outside(run.sources().terrain)};
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
    prepare_sinks({features}, commit, context);
    if (parts != nullptr) {
        parts->write(run, numbers, drawn.levels);
        commit.add(*parts);
    }
}

RunReport merge(TileRun& run, FeatureSink& features, PartNumbers* parts,
                const ReportReader<RunReport>& reader) {
    const auto warn = [&] { pass_warnings(run.sources(), {features}, run.context()); };
    CommitList commit;
    try {
        if (run.setup().plan.detects_buildings())
            merge_drawn(run, features, parts, commit);
        else
            merge_traced(run, features, commit);
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
    run.tidy(TileStep::draw);
    return run.context().report;
}

}  // namespace

RunReport merge_tiles(TileRun& run, FeatureSink& features, const ReportReader<RunReport>& reader) {
    return merge(run, features, nullptr, reader);
}

RunReport number_tiles(TileRun& run, const ReportReader<RunReport>& reader) {
    PartNumbers parts(run.context().make_spool());
    return merge(run, parts, &parts, reader);
}

}  // namespace d2b
