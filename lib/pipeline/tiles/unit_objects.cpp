#include "pipeline/tiles/unit_objects.hpp"

namespace d2b {
namespace {

std::vector<bool> labels_at_seams(const FoundUnit& unit) {
    std::vector<bool> at_seam(unit.objects.size() + 1);
    for (const UnitEdges::Lines* lines :
         {&unit.edges.above, &unit.edges.left, &unit.edges.below, &unit.edges.right})
        for (const std::vector<Label>& line : *lines)
            for (const Label label : line)
                at_seam[label] = true;
    return at_seam;
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

}  // namespace

UnitObjects divide_objects(const FoundUnit& unit, const LoneRules& rules, std::int64_t& doubtful) {
    const std::vector<bool> at_seam = labels_at_seams(unit);
    UnitObjects divided;
    divided.marks.assign(unit.objects.size(), UnitObjects::left_out);
    for (std::size_t i = 0; i < unit.objects.size(); ++i) {
        const auto label = static_cast<Label>(i + 1);
        if (at_seam[label]) {
            divided.at_seams.push_back(label);
            divided.marks[i] = static_cast<UnitObjects::Mark>(divided.at_seams.size());
            continue;
        }
        SeenObject seen = unit.objects[i];
        if (seen.own_cells < rules.least_cells)
            continue;
        doubtful += seen.is_building ? 0 : 1;
        if (!seen.is_building && !rules.doubtful)
            continue;
        divided.marks[i] = UnitObjects::lone;
        divided.alone.push_back({seen, unit.boxes[i], label});
    }
    return divided;
}

void LoneObjects::put(std::int64_t unit, const UnitObjects& objects) {
    kept_[static_cast<std::size_t>(unit)] = {put_list(*spool_, objects.marks),
                                             put_list(*spool_, objects.alone)};
}

std::vector<UnitObjects::Mark> LoneObjects::marks(std::int64_t unit) const {
    return take_list<UnitObjects::Mark>(*spool_, kept_[static_cast<std::size_t>(unit)].marks);
}

std::vector<LoneObject> LoneObjects::alone(std::int64_t unit) const {
    return take_list<LoneObject>(*spool_, kept_[static_cast<std::size_t>(unit)].alone);
}

}  // namespace d2b
