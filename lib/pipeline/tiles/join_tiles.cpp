#include <algorithm>
#include <cmath>
#include <utility>

#include "features/contour_drawer.hpp"
#include "filter/contour_shelf.hpp"
#include "pipeline/feature_input.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/tiles/draw_margin.hpp"
#include "pipeline/tiles/tile_rasters.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "tiles/joined_tile.hpp"

namespace d2b {
namespace {

/// Where an object lies in a unit.
struct SeenPlace {
    Window box;
    std::int32_t cells = 0;  ///< of the unit's own
};

/// What is known of a unit when all tiles have been looked at, but for the labels of its cells.
struct SeenUnit {
    std::vector<SeenObject> objects;  ///< until it has been compared
    std::vector<SeenPlace> places;    ///< likewise of all objects
    UnitEdges edges;
    std::size_t first = 0;  ///< what was added to its labels
};

/// A joined object: where its cells are, and the unit that owns most of them.
struct JoinedObject {
    Window box;
    std::int32_t cells = 0;  ///< of that unit
    std::int64_t unit = 0;
};

SeenUnit seen_unit(FoundUnit&& found) {
    SeenUnit unit{std::move(found.objects), {}, std::move(found.edges), 0};
    unit.places.reserve(unit.objects.size());
    for (std::size_t i = 0; i < unit.objects.size(); ++i)
        unit.places.push_back({found.boxes[i], static_cast<std::int32_t>(unit.objects[i].own_cells)});
    return unit;
}

class Join {
  public:
    explicit Join(TileRun& run)
        : run_(run),
          units_(static_cast<std::size_t>(run.tiles().units().count())),
          known_(units_.size()),
          seams_(run.tiles().units().cols()),
          facts_(run.no_facts()) {}

    /// Reads all tiles. What units saw of the seams between them is compared as soon as it is known.
    void load();
    void join();
    void write_tiles();
    /// Last: where it is there, so is the rest.
    void write_frame();

  private:
    void compare_next();
    [[nodiscard]] Label number(const SeenUnit& unit, std::size_t object) const {
        return merged_.number[unit.first + object + 1];
    }
    void place_objects();
    /// What a unit's labels are to a tile with these objects.
    [[nodiscard]] JoinedUnit labels_for(std::int64_t number, const std::vector<Label>& numbers) const;
    [[nodiscard]] JoinedTile joined(const std::vector<Label>& numbers) const;

    TileRun& run_;
    std::vector<SeenUnit> units_;
    std::vector<bool> known_;  ///< by unit
    std::size_t next_ = 0;     ///< unit that is to be compared
    UnitMerger merger_;
    UnitSeams seams_;
    FoundFacts facts_;
    UnitMerger::Merged merged_;
    std::vector<JoinedObject> objects_;  ///< as those that are merged
};

void Join::load() {
    for (std::int64_t tile = 0; tile < run_.tiles().count(); ++tile) {
        run_.context().check_stop();
        FoundTile found = run_.load_found(tile);
        facts_.merge(found.facts);
        const std::vector<PlacedUnit> placed = run_.tiles().units_of(tile);
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const auto number = static_cast<std::size_t>(placed[i].number);
            units_[number] = seen_unit(std::move(found.units[i]));
            known_[number] = true;
        }
        while (next_ < units_.size() && known_[next_])
            compare_next();
    }
}

/// Row by row: the lines of a unit are as long as it is wide, so they go as soon as they can.
void Join::compare_next() {
    SeenUnit& unit = units_[next_];
    unit.first = merger_.add(std::exchange(unit.objects, {}));
    unit.edges.add(static_cast<Label>(unit.first));
    const auto cols = static_cast<std::size_t>(run_.tiles().units().cols());
    seams_.add(static_cast<std::int32_t>(next_ % cols), std::exchange(unit.edges, {}), merger_);
    ++next_;
}

void Join::join() {
    Context& context = run_.context();
    merged_ = join_units(merger_, run_.setup().plan, run_.tiles().units(), run_.setup().cell, context.report);
    facts_.tally.merge(context.report);
    place_objects();
}

void Join::place_objects() {
    objects_.resize(merged_.objects.size());
    for (std::size_t i = 0; i < units_.size(); ++i)
        for (std::size_t k = 0; k < units_[i].places.size(); ++k) {
            const SeenPlace& place = units_[i].places[k];
            const Label label = number(units_[i], k);
            if (label == 0)
                continue;
            JoinedObject& object = objects_[label - 1];
            object.box = around(object.box, place.box);
            if (place.cells > object.cells) {
                object.cells = place.cells;
                object.unit = static_cast<std::int64_t>(i);
            }
        }
}

JoinedUnit Join::labels_for(std::int64_t number, const std::vector<Label>& numbers) const {
    const SeenUnit& seen = units_[static_cast<std::size_t>(number)];
    const auto other = static_cast<Label>(numbers.size() + 1);
    JoinedUnit unit{number, {0}};
    for (std::size_t k = 0; k < seen.places.size(); ++k) {
        const Label label = this->number(seen, k);
        const auto place = std::ranges::lower_bound(numbers, label);
        unit.number.push_back(label == 0 ? 0
                              : place != numbers.end() && *place == label
                                  ? static_cast<Label>(place - numbers.begin() + 1)
                                  : other);
    }
    return unit;
}

/// A tile. @param numbers of its objects, ascending: what is doubtful comes last
JoinedTile Join::joined(const std::vector<Label>& numbers) const {
    JoinedTile joined;
    for (const Label label : numbers) {
        const SeenObject& seen = merged_.objects[label - 1];
        joined.buildings.push_back({label <= merged_.buildings, seen.object.doubt, seen.ground,
                                    seen.object.confidence, seen.object.parcel});
        joined.window = around(joined.window, objects_[label - 1].box);
    }
    if (!numbers.empty()) {
        const LatticePoint margin = draw_margin(run_.setup(), run_.context());
        joined.window = grown(joined.window, margin.row, margin.col, run_.window());
        for (const PlacedUnit& placed : run_.tiles().units_in(joined.window))
            joined.units.push_back(labels_for(placed.number, numbers));
    }
    return joined;
}

void Join::write_tiles() {
    std::vector<std::vector<Label>> numbers(static_cast<std::size_t>(run_.tiles().count()));
    for (std::size_t i = 0; i < objects_.size(); ++i)
        numbers[static_cast<std::size_t>(run_.tiles().tile_of(objects_[i].unit))].push_back(
            static_cast<Label>(i + 1));
    SealedFiles files(run_.folder(TileStep::join));
    for (std::int64_t tile = 0; tile < run_.tiles().count(); ++tile) {
        run_.context().check_stop();
        ByteWriter writer;
        save(joined(numbers[static_cast<std::size_t>(tile)]), writer);
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
