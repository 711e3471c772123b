#include <cstdint>
#include <optional>
#include <utility>

#include "contours/contour_archive.hpp"
#include "features/feature_writer.hpp"
#include "features/reprojection.hpp"
#include "features/roof_layer.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/run_setup.hpp"
#include "pipeline/tiles/tile_steps.hpp"

namespace d2b::tiles {
namespace {

NumberedWhole load_whole(const TileRun& run) {
    CheckpointFile file(run.frame_file(TileStep::merge));
    return load_body(file,
                     [&](ByteReader& reader) { return load_numbered_whole(reader, run.tiles().count()); });
}

/// Opens the drawn contours of a tile, in the order of keys.
DrawnStream drawn_stream(const TileRun& run, std::int64_t tile) {
    CheckpointFile file(run.file(TileStep::draw, tile));
    std::vector<DrawnBlock> blocks = load_body(file, [](ByteReader& reader) {
        (void)load_drawn_tile(reader);
        return reader.take_list<DrawnBlock>();
    });
    return {std::move(file), std::move(blocks)};
}

/// Assigns the ids found by the merge step to the contours of a tile.
class Numbering {
  public:
    Numbering(const features::AssignedIds& numbers, std::string damaged)
        : numbers_(numbers), damaged_(std::move(damaged)) {}

    /// Numbers the next contour. Call in the order of drawing.
    void number(features::DrawnContour& drawn) {
        drawn.record.id = at(numbers_.written, next_++);
        drawn.record.parent_id = drawn.parent < 0 ? 0 : at(numbers_.written, drawn.parent);
        if (drawn.building_index < 0)
            return;
        const features::BuildingIds building = at(numbers_.buildings, drawn.building_index);
        drawn.record.building_id = drawn.building_record.id = building.id;
        drawn.building_record.whole = building.whole;
        features::number_faces(drawn.faces, drawn.building_record, building.first_face);
    }

  private:
    template <typename T>
    [[nodiscard]] T at(const std::vector<T>& numbers, std::int64_t place) const {
        if (place >= std::ssize(numbers))
            throw InputError(damaged_);
        return numbers[static_cast<std::size_t>(place)];
    }
    const features::AssignedIds& numbers_;
    std::string damaged_;
    std::int64_t next_ = 0;
};

void write_features(const TileRun& run, std::int64_t tile, features::FeatureWriter& writer) {
    CheckpointFile file(run.file(TileStep::merge, tile));
    NumberedTile numbered = load_body(file, [](ByteReader& reader) { return load_numbered_tile(reader); });
    Numbering numbering(numbered.numbers, file.damaged("it lacks the numbers of some contours"));
    DrawnStream drawn = drawn_stream(run, tile);
    DrawnStream left(std::move(file), std::move(numbered.left));
    for (std::size_t i = 0;; ++i) {
        const auto own = drawn.key();
        const auto other = left.key();
        if (!own && !other)
            return;
        const bool is_own = own && (!other || *own < *other);
        features::DrawnContour contour = is_own ? drawn.take() : left.take();
        if (is_own)
            numbering.number(contour);
        writer.add_with_ids(i, std::move(contour));
    }
}

}  // namespace

bool are_numbered(const TileRun& run) {
    return checkpoint_exists(run.frame_file(TileStep::merge));
}

void write_tile(TileRun& run, std::int64_t tile, FeatureSink& features) {
    const Checkpoint place = run.file(TileStep::write, tile);
    if (checkpoint_exists(place))
        return;
    Context& context = run.context();
    const features::RunSetup& setup = run.setup();
    const FoundFacts facts = run.load_frame();
    const FixedPoint fixed = facts.survey.statistics.fixed_point();
    // Same levels as in the merge step, because the files carry them as metadata.
    contours::LevelPlan plan = contours::plan_global_levels(facts.survey.statistics, setup.plan.asked.levels,
                                                            setup.plan.levels, context);
    plan.footprints = true;
    plan.thresholds = {{}};
    pipeline::report_levels(plan, load_whole(run).levels, context.report);
    const std::unique_ptr<contours::StoredContours> none =
        contours::ContourMerger(context.make_spool()).finish();
    const std::vector<features::Footprint> footprints{{}};
    const features::RecordBuilder records(*none, {plan, fixed, footprints, run.metres(),
                                                  features::lattice_frame(run.window(), setup.plan.trace)});
    const outline::Outliner outliner = features::draw_outlines(*none, setup, context);
    const features::FeatureInput input{setup, *none, outliner, 0, fixed, run.sources().parcels};
    features::FeatureWriter writer(input, records, features, context);
    writer.begin();
    write_features(run, tile, writer);
    CommitList commit;
    pipeline::prepare_sinks({features}, commit, context);
    commit.publish();
    write_checkpoint(place, {});
}

std::optional<NumberedWhole> written_totals(const TileRun& run, std::int64_t after) {
    const std::int64_t count = run.tiles().count();
    for (std::int64_t i = 1; i <= count; ++i) {
        const std::int64_t tile = (after + i) % count;
        if (!checkpoint_exists(run.file(TileStep::write, tile)))
            return {};
    }
    return load_whole(run);
}

}  // namespace d2b::tiles
