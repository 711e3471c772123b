#include <algorithm>
#include <iterator>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "features/contour_drawer.hpp"
#include "filter/contour_shelf.hpp"
#include "pipeline/feature_input.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/tiles/draw_margin.hpp"
#include "pipeline/tiles/tile_rasters.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "pipeline/tiles/unit_objects.hpp"
#include "tiles/joined_tile.hpp"

namespace d2b {
namespace {

/// An object at a seam, as a unit saw it.
struct SeamObject {
    Window box;              ///< around those of its cells that are the unit's own
    std::int64_t cells = 0;  ///< likewise
    std::int64_t unit = 0;
    Label label = 0;  ///< of the unit
};

/// What lies at the seams of a unit, until it has been compared.
struct SeamUnit {
    std::vector<SeenObject> objects;
    std::vector<SeamObject> places;  ///< of these
    UnitEdges edges;
};

/// A building, or what may be one, of a tile.
struct PlacedObject {
    SeenObject seen;
    Window box;
    std::int64_t unit = 0;      ///< the first that saw it
    Label label = 0;            ///< in that unit
    std::size_t joined = none;  ///< place among what is joined at seams; none: it lies at none

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    /// What is doubtful comes last, and objects in the order of units.
    [[nodiscard]] auto order() const { return std::tuple(!seen.is_building, unit, label); }
};

/// Labels that are none of the objects at the seams are 0 in the lines beside them.
UnitEdges seam_labels(UnitEdges edges, const std::vector<UnitObjects::Mark>& marks) {
    for (UnitEdges::Lines* lines : {&edges.above, &edges.left, &edges.below, &edges.right})
        for (std::vector<Label>& line : *lines)
            for (Label& label : line)
                label = label == 0 ? 0 : marks[label - 1];
    return edges;
}

class Join {
  public:
    explicit Join(TileRun& run)
        : run_(run),
          units_(static_cast<std::size_t>(run.tiles().units().count())),
          known_(units_.size()),
          first_(units_.size()),
          lone_(run.context().make_spool(), units_.size()),
          seams_(run.tiles().units().cols()),
          facts_(run.no_facts()) {}

    /// Reads all tiles. What units saw of the seams between them is compared as soon as it is known.
    void load();
    void join();
    void write_tiles();
    /// Last: where it is there, so is the rest.
    void write_frame();

  private:
    void load(FoundUnit&& found, std::int64_t number, const LoneRules& rules);
    void compare_next();
    /// Where joined objects are, and in which order tiles draw them.
    void place_objects();
    [[nodiscard]] std::vector<PlacedObject> objects_of(std::int64_t tile);
    /// What a unit's labels are to a tile with these objects.
    [[nodiscard]] JoinedUnit labels_for(std::int64_t number, const std::vector<PlacedObject>& objects) const;
    [[nodiscard]] JoinedTile joined(std::int64_t tile);

    TileRun& run_;
    std::vector<SeamUnit> units_;
    std::vector<bool> known_;   ///< by unit
    std::vector<Label> first_;  ///< by unit: what was added to the places of its objects at the seams
    std::size_t next_ = 0;      ///< unit that is to be compared
    LoneObjects lone_;
    std::int64_t lone_doubtful_ = 0;
    std::vector<SeamObject> seen_{{}};  ///< by label of the merger
    UnitMerger merger_;
    UnitSeams seams_;
    FoundFacts facts_;
    UnitMerger::Merged merged_;
    std::vector<PlacedObject> crossing_;  ///< objects at seams, by the tile that draws them
    std::vector<std::int64_t> drawn_by_;  ///< that tile, likewise
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
        while (next_ < units_.size() && known_[next_])
            compare_next();
    }
}

void Join::load(FoundUnit&& found, std::int64_t number, const LoneRules& rules) {
    const auto i = static_cast<std::size_t>(number);
    const UnitObjects divided = divide_objects(found, rules, lone_doubtful_);
    lone_.put(number, divided);
    SeamUnit& unit = units_[i];
    for (const Label label : divided.at_seams) {
        const SeenObject& seen = found.objects[label - 1];
        unit.objects.push_back(seen);
        unit.places.push_back({found.boxes[label - 1], seen.own_cells, number, label});
    }
    unit.edges = seam_labels(std::move(found.edges), divided.marks);
    known_[i] = true;
}

/// Row by row: the lines of a unit are as long as it is wide, so they go as soon as they can.
void Join::compare_next() {
    SeamUnit unit = std::exchange(units_[next_], {});
    first_[next_] = merger_.add(unit.objects);
    seen_.insert(seen_.end(), unit.places.begin(), unit.places.end());
    unit.edges.add(first_[next_]);
    const auto cols = static_cast<std::size_t>(run_.tiles().units().cols());
    seams_.add(static_cast<std::int32_t>(next_ % cols), std::move(unit.edges), merger_);
    ++next_;
}

void Join::join() {
    Context& context = run_.context();
    merged_ = join_units(merger_, run_.setup().plan, run_.tiles().units(), run_.setup().cell, context.report);
    context.report.count(Reason::building_doubtful, lone_doubtful_);
    facts_.tally.merge(context.report);
    place_objects();
}

void Join::place_objects() {
    crossing_.resize(merged_.objects.size());
    std::vector<SeamObject> owners(crossing_.size());
    for (std::size_t label = 1; label < seen_.size(); ++label) {
        const Label number = merged_.number[label];
        if (number == 0)
            continue;
        const SeamObject& seen = seen_[label];
        PlacedObject& object = crossing_[number - 1];
        if (object.joined == PlacedObject::none)
            object = {merged_.objects[number - 1], {}, seen.unit, seen.label, number - 1};
        object.box = around(object.box, seen.box);
        SeamObject& owner = owners[number - 1];
        if (seen.cells > owner.cells)
            owner = seen;
    }
    merged_.objects = std::vector<SeenObject>();  // {} would keep the room
    seen_ = std::vector<SeamObject>();
    const auto tile = [&](const PlacedObject& object) {
        return run_.tiles().tile_of(owners[object.joined].unit);
    };
    std::ranges::stable_sort(crossing_, {}, tile);
    std::ranges::transform(crossing_, std::back_inserter(drawn_by_), tile);
}

std::vector<PlacedObject> Join::objects_of(std::int64_t tile) {
    const auto [begin, end] = std::equal_range(drawn_by_.begin(), drawn_by_.end(), tile);
    std::vector<PlacedObject> objects(crossing_.begin() + (begin - drawn_by_.begin()),
                                      crossing_.begin() + (end - drawn_by_.begin()));
    for (const PlacedUnit& placed : run_.tiles().units_of(tile))
        for (const LoneObject& object : lone_.alone(placed.number))
            objects.push_back({object.seen, object.box, placed.number, object.label, PlacedObject::none});
    std::ranges::sort(objects, {}, &PlacedObject::order);
    return objects;
}

JoinedUnit Join::labels_for(std::int64_t number, const std::vector<PlacedObject>& objects) const {
    const auto other = static_cast<Label>(objects.size() + 1);
    const std::vector<UnitObjects::Mark> marks = lone_.marks(number);
    JoinedUnit unit{number, std::vector<Label>(marks.size() + 1, other)};
    unit.number[0] = 0;
    std::unordered_map<std::size_t, Label> joined;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto place = static_cast<Label>(i + 1);
        if (objects[i].joined != PlacedObject::none)
            joined[objects[i].joined] = place;
        else if (objects[i].unit == number)
            unit.number[objects[i].label] = place;
    }
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i] == UnitObjects::lone)
            continue;
        const Label label = marks[i] == UnitObjects::left_out
                                ? 0
                                : merged_.number[first_[static_cast<std::size_t>(number)] + marks[i]];
        const auto own = label == 0 ? joined.end() : joined.find(label - 1);
        unit.number[i + 1] = label == 0 ? 0 : own != joined.end() ? own->second : other;
    }
    return unit;
}

JoinedTile Join::joined(std::int64_t tile) {
    const std::vector<PlacedObject> objects = objects_of(tile);
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
            joined.units.push_back(labels_for(placed.number, objects));
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
