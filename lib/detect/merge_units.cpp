#include "detect/merge_units.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace d2b {

Label UnitMerger::add(std::span<const SeenObject> objects) {
    const auto before = static_cast<Label>(seen_.size() - 1);
    std::unordered_map<Label, Label> first;  // label by whole
    for (const SeenObject& object : objects) {
        const Label label = sets_.add();
        wholes_.add();
        if (object.object.whole != 0)
            wholes_.join(first.try_emplace(object.object.whole, label).first->second, label);
        seen_.push_back(object);
    }
    return before;
}

void UnitMerger::compare(std::span<const Label> first, std::span<const Label> second) {
    std::map<std::pair<Label, Label>, std::int64_t> shared;
    std::map<Label, std::int64_t> cells;
    for (std::size_t i = 0; i < first.size(); ++i) {
        for (const Label label : {first[i], second[i]})
            if (label != 0)
                ++cells[label];
        if (first[i] != 0 && second[i] != 0)
            ++shared[{first[i], second[i]}];
    }
    // Units may differ slightly, so a few shared cells do not make two neighbours the same object.
    for (const auto& [labels, n] : shared)
        if (2 * n >= std::min(cells[labels.first], cells[labels.second]))
            sets_.join(labels.first, labels.second);
}

std::unordered_map<Label, UnitMerger::Joined> UnitMerger::joined_sets() {
    std::unordered_map<Label, Joined> all;
    for (Label label = 1; label < seen_.size(); ++label) {
        const Label set = sets_.find(label);
        if (set == label)
            continue;  // the representative comes before the other members
        Joined& joined = all.try_emplace(set, Joined{set, seen_[set].own_cells}).first->second;
        joined.cells += seen_[label].own_cells;
        if (seen_[label].own_cells > seen_[joined.says].own_cells)
            joined.says = label;
    }
    return all;
}

UnitMerger::Merged UnitMerger::finish(std::int64_t least_cells) {
    const std::unordered_map<Label, Joined> joined = joined_sets();
    const auto object = [&](Label set) {
        const auto known = joined.find(set);
        SeenObject merged = seen_[known == joined.end() ? set : known->second.says];
        merged.own_cells = merged.object.cells =
            known == joined.end() ? merged.own_cells : known->second.cells;
        return merged;
    };
    Merged merged;
    merged.objects.reserve(seen_.size() - 1);
    merged.number.assign(seen_.size(), 0);
    for (const bool sure : {true, false}) {
        for (Label set = 1; set < seen_.size(); ++set) {
            if (sets_.find(set) != set)
                continue;
            const SeenObject whole = object(set);
            if (whole.is_building != sure || whole.own_cells < least_cells)
                continue;
            merged.objects.push_back(whole);
            merged.number[set] = static_cast<Label>(merged.objects.size());
        }
        if (sure)
            merged.buildings = static_cast<Label>(merged.objects.size());
    }
    for (Label label = 1; label < seen_.size(); ++label)
        merged.number[label] = merged.number[sets_.find(label)];
    name_wholes(merged.number, merged.objects);
    seen_ = {};
    return merged;
}

void UnitMerger::name_wholes(const std::vector<Label>& number, std::vector<SeenObject>& objects) {
    for (Label label = 1; label < number.size(); ++label)
        wholes_.join(label, sets_.find(label));
    std::vector<Label> lowest(number.size(), 0);  // number by whole
    for (Label label = 1; label < number.size(); ++label)
        if (Label& of = lowest[wholes_.find(label)]; number[label] != 0)
            of = of == 0 ? number[label] : std::min(of, number[label]);
    for (Label label = 1; label < number.size(); ++label)
        if (number[label] != 0)
            objects[number[label] - 1].object.whole = lowest[wholes_.find(label)];
}

}  // namespace d2b
