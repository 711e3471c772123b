#include <utility>

#include "pipeline/find_buildings.hpp"
#include "pipeline/tiles/draw_margin.hpp"
#include "pipeline/tiles/placed_objects.hpp"
#include "pipeline/tiles/tile_rasters.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "tiles/joined_tile.hpp"

namespace d2b {
namespace {

class Join {
  public:
    explicit Join(TileRun& run)
        : run_(run),
          lone_(run.context().make_spool(), static_cast<std::size_t>(run.tiles().units().count())),
          seams_(static_cast<std::size_t>(run.tiles().units().count()), run.tiles().units().cols()),
          facts_(run.no_facts()) {}

    /// Reads all tiles. Compares units across seams as early as possible, because their edges can be freed
    /// afterwards.
    void load();
    void join();
    void write_tiles();
    /// Called last, because the frame file marks the step as complete.
    void write_frame();

  private:
    void load(FoundUnit&& found, std::int64_t number, const LoneRules& rules);
    [[nodiscard]] JoinedTile joined(std::int64_t tile) const;

    TileRun& run_;
    LoneObjects lone_;
    std::int64_t lone_doubtful_ = 0;
    SeamObjects seams_;
    PlacedObjects placed_{run_.tiles(), lone_, seams_};
    FoundFacts facts_;
};

void Join::load() {
    const LoneRules rules{least_cells(run_.setup().plan, run_.tiles().units(), run_.setup().cell),
                          run_.setup().plan.asked.write.doubtful};
    for (std::int64_t tile = 0; tile < run_.tiles().count(); ++tile) {
        run_.context().check_stop();
        FoundTile found = run_.load_found(tile);
        facts_.merge(found.facts);
        const std::vector<PlacedUnit> placed = run_.tiles().units_of(tile);
        for (std::size_t i = 0; i < placed.size(); ++i)
            load(std::move(found.units[i]), placed[i].number, rules);
        seams_.compare_known();
    }
}

void Join::load(FoundUnit&& found, std::int64_t number, const LoneRules& rules) {
    const UnitObjects divided = divide_objects(found, rules, lone_doubtful_);
    lone_.put(number, divided);
    seams_.put(number, std::move(found), divided);
}

void Join::join() {
    Context& context = run_.context();
    UnitMerger::Merged merged = join_units(seams_.merger(), run_.setup().plan, run_.tiles().units(),
                                           run_.setup().cell, context.report);
    context.report.count(Reason::building_doubtful, lone_doubtful_);
    facts_.tally.merge(context.report);
    placed_.place(seams_.take(), std::move(merged));
}

JoinedTile Join::joined(std::int64_t tile) const {
    const std::vector<PlacedObject> objects = placed_.of(tile);
    JoinedTile joined;
    for (const PlacedObject& object : objects) {
        const SeenObject& seen = object.seen;
        joined.buildings.push_back(
            {seen.is_building, seen.object.doubt, seen.ground, seen.object.confidence, seen.object.parcel});
        joined.window = around(joined.window, object.box);
    }
    if (!objects.empty()) {
        const LatticePoint margin = draw_margin(run_.setup(), run_.context());
        joined.window = grown(joined.window, margin.row, margin.col, run_.window());
        for (const PlacedUnit& placed : run_.tiles().units_in(joined.window))
            joined.units.push_back(placed_.labels_for(placed.number, objects));
    }
    return joined;
}

void Join::write_tiles() {
    SealedFiles files(run_.folder(TileStep::join));
    for (std::int64_t tile = 0; tile < run_.tiles().count(); ++tile) {
        run_.context().check_stop();
        ByteWriter writer;
        save(joined(tile), writer);
        files.write(run_.file(TileStep::join, tile), run_.seal(TileStep::join, tile), writer.bytes());
    }
    files.finish();
}

void Join::write_frame() {
    ByteWriter writer;
    facts_.save(writer);
    write_sealed(run_.frame_file(), run_.frame_seal(), writer.bytes());
}

}  // namespace

void join_tiles(TileRun& run) {
    if (is_sealed(run.frame_file(), run.frame_seal()))
        return;
    Join join(run);
    join.load();
    if (run.setup().plan.detects_buildings()) {
        join.join();
        join.write_tiles();
    }
    show_rasters(run);
    join.write_frame();
    run.tidy(TileStep::find);
    run.tidy(TileStep::join);
}

}  // namespace d2b
