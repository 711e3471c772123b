#include "pipeline/tiles/join_tiles.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "pipeline/find_buildings.hpp"
#include "pipeline/tiles/tile_rasters.hpp"
#include "pipeline/tiles/tile_steps.hpp"

namespace d2b::tiles {
namespace {

std::vector<bool> labels_at_seams(const FoundUnit& unit) {
    std::vector<bool> at_seam(unit.objects.size() + 1);
    for (const detect::UnitEdges::Lines* lines :
         {&unit.edges.above, &unit.edges.left, &unit.edges.below, &unit.edges.right})
        for (const std::vector<Label>& line : *lines)
            for (const Label label : line)
                at_seam[label] = true;
    return at_seam;
}

/// Returns the bounding boxes of the objects' cells in the core of the unit, by label - 1.
std::vector<Window> boxes_of(const FoundUnit& unit) {
    std::vector<Window> boxes(unit.objects.size());
    for (const LabelRun& run : unit.runs) {
        Window& box = boxes[run.label - 1];
        box = bounding_window(box, {run.row, run.begin, 1, run.end - run.begin});
    }
    return boxes;
}

template <typename T>
SpoolEntry put_list(Spool& spool, const std::vector<T>& values) {
    ByteWriter writer;
    writer.put_list(values);
    return append(spool, writer);
}

template <typename T>
std::vector<T> take_list(const Spool& spool, const SpoolEntry& entry) {
    return ByteReader(spool, entry).take_list<T>();
}

/// Translates edge labels to indices of seam objects; labels of other objects become 0.
detect::UnitEdges seam_labels(detect::UnitEdges edges, const std::vector<UnitObjects::Mark>& marks) {
    for (detect::UnitEdges::Lines* lines : {&edges.above, &edges.left, &edges.below, &edges.right})
        for (std::vector<Label>& line : *lines)
            for (Label& label : line)
                label = label == 0 ? 0 : marks[label - 1];
    return edges;
}

class TileJoiner {
  public:
    explicit TileJoiner(TileRun& run)
        : run_(run),
          interior_(run.context().make_spool(), static_cast<std::size_t>(run.tiles().units().count())),
          seams_(static_cast<std::size_t>(run.tiles().units().count()), run.tiles().units().cols()),
          facts_(run.empty_facts()) {}

    /// Reads all tiles. Compares units across seams as early as possible, because their edges can be freed
    /// afterwards.
    void load();
    void join();
    void write_tiles();
    /// Called last, because the frame file marks the step as complete.
    void write_frame();

  private:
    void load(FoundUnit&& found, std::int64_t number, const InteriorRules& rules);
    [[nodiscard]] JoinedTile joined(std::int64_t tile) const;

    TileRun& run_;
    InteriorObjects interior_;
    Tally interior_left_out_;
    BorderObjects seams_;
    ObjectAssignment placed_{run_.tiles(), interior_, seams_};
    FoundFacts facts_;
};

void TileJoiner::load() {
    const InteriorRules rules{pipeline::min_cells(run_.setup().plan, run_.tiles().units(), run_.setup().cell),
                              run_.setup().plan.asked.write.doubtful};
    for (std::int64_t tile = 0; tile < run_.tiles().count(); ++tile) {
        run_.context().check_stop();
        FoundTile found = run_.load_found(tile);
        facts_.merge(found.facts);
        const std::vector<NumberedUnit> placed = run_.tiles().units_of(tile);
        for (std::size_t i = 0; i < placed.size(); ++i)
            load(std::move(found.units[i]), placed[i].number, rules);
        seams_.compare_known();
    }
}

void TileJoiner::load(FoundUnit&& found, std::int64_t number, const InteriorRules& rules) {
    const UnitObjects divided = divide_objects(found, rules, interior_left_out_);
    interior_.put(number, divided);
    seams_.put(number, std::move(found), divided);
}

void TileJoiner::join() {
    Context& context = run_.context();
    detect::UnitMerger::Merged merged = pipeline::merge_found_units(
        seams_.merger(), run_.setup().plan, run_.tiles().units(), run_.setup().cell, context.report);
    context.report.Tally::merge(interior_left_out_);
    facts_.tally.merge(context.report);
    placed_.place(seams_.take(), std::move(merged));
}

JoinedTile TileJoiner::joined(std::int64_t tile) const {
    const std::vector<AssignedObject> objects = placed_.of(tile);
    JoinedTile joined;
    for (const AssignedObject& object : objects) {
        const detect::SeenObject& seen = object.seen;
        joined.buildings.push_back({seen.is_building, seen.object.doubt, seen.ground, seen.object.confidence,
                                    seen.object.parcel, object.whole});
        joined.window = bounding_window(joined.window, object.box);
    }
    if (!objects.empty()) {
        const LatticePoint margin = draw_margin(run_.setup(), run_.context());
        joined.window = expanded(joined.window, margin.row, margin.col, run_.window());
        for (const NumberedUnit& placed : run_.tiles().units_in(joined.window))
            joined.units.push_back(placed_.map_labels(placed.number, objects));
    }
    return joined;
}

void TileJoiner::write_tiles() {
    CheckpointBatch files(run_.folder(TileStep::join));
    for (std::int64_t tile = 0; tile < run_.tiles().count(); ++tile) {
        run_.context().check_stop();
        ByteWriter writer;
        save(joined(tile), writer);
        files.write(run_.file(TileStep::join, tile), writer.bytes());
    }
    files.finish();
}

void TileJoiner::write_frame() {
    ByteWriter writer;
    facts_.save(writer);
    write_checkpoint(run_.frame_file(), writer.bytes());
}

}  // namespace

UnitObjects divide_objects(const FoundUnit& unit, const InteriorRules& rules, Tally& tally) {
    const std::vector<bool> at_seam = labels_at_seams(unit);
    UnitObjects divided;
    divided.boxes = boxes_of(unit);
    divided.marks.assign(unit.objects.size(), UnitObjects::left_out);
    for (std::size_t i = 0; i < unit.objects.size(); ++i) {
        const auto label = static_cast<Label>(i + 1);
        if (at_seam[label]) {
            divided.at_seams.push_back(label);
            divided.marks[i] = static_cast<UnitObjects::Mark>(divided.at_seams.size());
            continue;
        }
        detect::SeenObject seen = unit.objects[i];
        if (seen.own_cells < rules.min_cells)
            continue;
        if (!seen.is_building)
            tally.count(Reason::building_doubtful);
        if (seen.object.left_out != detect::LeftOut::no) {
            tally.count(seen.object.left_out == detect::LeftOut::denied ? Reason::building_denied
                                                                        : Reason::building_excluded,
                        seen.is_building ? 1 : 0);
            continue;
        }
        if (seen.is_covered() || (!seen.is_building && !rules.doubtful))
            continue;
        divided.marks[i] = UnitObjects::interior;
        divided.interior_objects.push_back({seen, divided.boxes[i], label});
    }
    return divided;
}

void InteriorObjects::put(std::int64_t unit, const UnitObjects& objects) {
    kept_[static_cast<std::size_t>(unit)] = {put_list(*spool_, objects.marks),
                                             put_list(*spool_, objects.interior_objects)};
}

std::vector<UnitObjects::Mark> InteriorObjects::marks(std::int64_t unit) const {
    return take_list<UnitObjects::Mark>(*spool_, kept_[static_cast<std::size_t>(unit)].marks);
}

std::vector<InteriorObject> InteriorObjects::interior_objects(std::int64_t unit) const {
    return take_list<InteriorObject>(*spool_, kept_[static_cast<std::size_t>(unit)].interior_objects);
}

void BorderObjects::put(std::int64_t number, FoundUnit&& found, const UnitObjects& divided) {
    const auto i = static_cast<std::size_t>(number);
    Unit& unit = units_[i];
    for (const Label label : divided.at_seams) {
        const detect::SeenObject& seen = found.objects[label - 1];
        unit.objects.push_back(seen);
        unit.places.push_back({divided.boxes[label - 1], seen.own_cells, number, label, seen.object.whole});
    }
    unit.edges = seam_labels(std::move(found.edges), divided.marks);
    known_[i] = true;
}

void BorderObjects::compare_known() {
    while (next_ < units_.size() && known_[next_])
        compare_next();
}

void BorderObjects::compare_next() {
    Unit unit = std::exchange(units_[next_], {});
    first_[next_] = merger_.add(unit.objects);
    seen_.insert(seen_.end(), unit.places.begin(), unit.places.end());
    unit.edges.add(first_[next_]);
    const auto cols = static_cast<std::size_t>(cols_);
    seams_.add(static_cast<std::int32_t>(next_ % cols), std::move(unit.edges), merger_);
    ++next_;
}

std::vector<BorderObject> BorderObjects::take() {
    return std::exchange(seen_, std::vector<BorderObject>());
}

void ObjectAssignment::place(std::vector<BorderObject> seen, detect::UnitMerger::Merged merged) {
    number_ = std::move(merged.number);
    for (std::size_t label = 1; label < seen.size(); ++label)
        if (const BorderObject& part = seen[label]; part.whole != 0)
            wholes_.push_back({part.unit, part.whole, merged.wholes[label]});
    std::ranges::sort(wholes_, {}, [](const SeamWhole& whole) { return std::pair(whole.unit, whole.whole); });
    crossing_.resize(merged.objects.size());
    std::vector<BorderObject> owners(crossing_.size());
    for (std::size_t label = 1; label < seen.size(); ++label) {
        const Label number = number_[label];
        if (number == 0)
            continue;
        const BorderObject& place = seen[label];
        AssignedObject& object = crossing_[number - 1];
        if (object.joined == AssignedObject::none)
            object = {merged.objects[number - 1],        {}, place.unit, place.label, number - 1,
                      std::int64_t{merged.wholes[label]}};
        object.box = bounding_window(object.box, place.box);
        BorderObject& owner = owners[number - 1];
        if (place.cells > owner.cells)
            owner = place;
    }
    merged.objects = std::vector<detect::SeenObject>();  // = {} would keep the capacity
    seen = std::vector<BorderObject>();
    const auto tile = [&](const AssignedObject& object) {
        return tiles_.tile_of(owners[object.joined].unit);
    };
    std::ranges::stable_sort(crossing_, {}, tile);
    std::ranges::transform(crossing_, std::back_inserter(drawn_by_), tile);
}

std::vector<AssignedObject> ObjectAssignment::of(std::int64_t tile) const {
    const auto [begin, end] = std::equal_range(drawn_by_.begin(), drawn_by_.end(), tile);
    std::vector<AssignedObject> objects(crossing_.begin() + (begin - drawn_by_.begin()),
                                        crossing_.begin() + (end - drawn_by_.begin()));
    for (const NumberedUnit& placed : tiles_.units_of(tile))
        add_interior(placed.number, objects);
    std::ranges::sort(objects, {}, &AssignedObject::order);
    return objects;
}

/// Wholes without a part at a seam get negative numbers, because those at seams have the merger's labels.
void ObjectAssignment::add_interior(std::int64_t unit, std::vector<AssignedObject>& objects) const {
    const std::vector<InteriorObject> interior = interior_.interior_objects(unit);
    std::unordered_map<Label, std::int64_t> parts;
    for (const InteriorObject& object : interior)
        ++parts[object.seen.object.whole];
    const auto name_of = [&](Label whole) -> std::int64_t {
        constexpr int label_bits = std::numeric_limits<Label>::digits;
        if (whole == 0)
            return 0;
        const auto at_seam =
            std::ranges::lower_bound(wholes_, std::pair(unit, whole), {},
                                     [](const SeamWhole& w) { return std::pair(w.unit, w.whole); });
        if (at_seam != wholes_.end() && at_seam->unit == unit && at_seam->whole == whole)
            return at_seam->name;
        return parts[whole] > 1 ? -((unit << label_bits) | whole) : 0;
    };
    for (const InteriorObject& object : interior)
        objects.push_back({object.seen, object.box, unit, object.label, AssignedObject::none,
                           name_of(object.seen.object.whole)});
}

JoinedUnit ObjectAssignment::map_labels(std::int64_t number,
                                        const std::vector<AssignedObject>& objects) const {
    const auto other = static_cast<Label>(objects.size() + 1);
    const std::vector<UnitObjects::Mark> marks = interior_.marks(number);
    JoinedUnit unit{number, std::vector<Label>(marks.size() + 1, other)};
    unit.number[0] = 0;
    std::unordered_map<std::size_t, Label> joined;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto place = static_cast<Label>(i + 1);
        if (objects[i].joined != AssignedObject::none)
            joined[objects[i].joined] = place;
        else if (objects[i].unit == number)
            unit.number[objects[i].label] = place;
    }
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i] == UnitObjects::interior)
            continue;
        const Label label = marks[i] == UnitObjects::left_out ? 0 : number_[seams_.label(number, marks[i])];
        const auto own = label == 0 ? joined.end() : joined.find(label - 1);
        unit.number[i + 1] = label == 0 ? 0 : own != joined.end() ? own->second : other;
    }
    return unit;
}

void join_tiles(TileRun& run) {
    if (checkpoint_exists(run.frame_file()))
        return;
    TileJoiner join(run);
    join.load();
    join.join();
    join.write_tiles();
    publish_rasters(run);
    join.write_frame();
    run.remove_leftovers(TileStep::find);
    run.remove_leftovers(TileStep::join);
}

}  // namespace d2b::tiles
