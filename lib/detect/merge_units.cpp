#include "detect/merge_units.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace d2b {

Label UnitMerger::add(std::span<const SeenObject> objects) {
    const auto before = static_cast<Label>(seen_.size() - 1);
    for (const SeenObject& object : objects) {
        sets_.add();
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
    // Where units do not see quite the same, a few cells of a neighbour do not make it the same object.
    for (const auto& [labels, n] : shared)
        if (2 * n >= std::min(cells[labels.first], cells[labels.second]))
            sets_.join(labels.first, labels.second);
}

UnitMerger::Merged UnitMerger::finish(std::int64_t least_cells) {
    Merged merged;
    std::vector<std::int64_t> cells(seen_.size(), 0);  // of a set, by the label that stands for it
    std::vector<Label> told(seen_.size(), 0);          // the one of a set that says what it is
    for (Label label = 1; label < seen_.size(); ++label) {
        const Label set = sets_.find(label);
        cells[set] += seen_[label].own_cells;
        if (told[set] == 0 || seen_[label].own_cells > seen_[told[set]].own_cells)
            told[set] = label;
    }
    merged.number.assign(seen_.size(), 0);
    for (const bool sure : {true, false}) {
        for (Label set = 1; set < seen_.size(); ++set) {
            if (told[set] == 0 || seen_[told[set]].is_building != sure || cells[set] < least_cells)
                continue;
            merged.objects.push_back(seen_[told[set]]);
            merged.objects.back().own_cells = merged.objects.back().object.cells = cells[set];
            merged.number[set] = static_cast<Label>(merged.objects.size());
        }
        if (sure)
            merged.buildings = static_cast<Label>(merged.objects.size());
    }
    for (Label label = 1; label < seen_.size(); ++label)
        merged.number[label] = merged.number[sets_.find(label)];
    return merged;
}

}  // namespace d2b
