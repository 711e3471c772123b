#include "pipeline/tiles/placed_objects.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace d2b {

void PlacedObjects::place(std::vector<SeamObject> seen, UnitMerger::Merged merged) {
    number_ = std::move(merged.number);
    crossing_.resize(merged.objects.size());
    std::vector<SeamObject> owners(crossing_.size());
    for (std::size_t label = 1; label < seen.size(); ++label) {
        const Label number = number_[label];
        if (number == 0)
            continue;
        const SeamObject& place = seen[label];
        PlacedObject& object = crossing_[number - 1];
        if (object.joined == PlacedObject::none)
            object = {merged.objects[number - 1], {}, place.unit, place.label, number - 1};
        object.box = around(object.box, place.box);
        SeamObject& owner = owners[number - 1];
        if (place.cells > owner.cells)
            owner = place;
    }
    merged.objects = std::vector<SeenObject>();  // = {} would keep the capacity
    seen = std::vector<SeamObject>();
    const auto tile = [&](const PlacedObject& object) { return tiles_.tile_of(owners[object.joined].unit); };
    std::ranges::stable_sort(crossing_, {}, tile);
    std::ranges::transform(crossing_, std::back_inserter(drawn_by_), tile);
}

std::vector<PlacedObject> PlacedObjects::of(std::int64_t tile) const {
    const auto [begin, end] = std::equal_range(drawn_by_.begin(), drawn_by_.end(), tile);
    std::vector<PlacedObject> objects(crossing_.begin() + (begin - drawn_by_.begin()),
                                      crossing_.begin() + (end - drawn_by_.begin()));
    for (const PlacedUnit& placed : tiles_.units_of(tile))
        for (const LoneObject& object : lone_.alone(placed.number))
            objects.push_back({object.seen, object.box, placed.number, object.label, PlacedObject::none});
    std::ranges::sort(objects, {}, &PlacedObject::order);
    return objects;
}

JoinedUnit PlacedObjects::labels_for(std::int64_t number, const std::vector<PlacedObject>& objects) const {
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
        const Label label = marks[i] == UnitObjects::left_out ? 0 : number_[seams_.label(number, marks[i])];
        const auto own = label == 0 ? joined.end() : joined.find(label - 1);
        unit.number[i + 1] = label == 0 ? 0 : own != joined.end() ? own->second : other;
    }
    return unit;
}

}  // namespace d2b
