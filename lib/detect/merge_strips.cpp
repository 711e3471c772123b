#include "detect/merge_strips.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace d2b {

Label StripMerger::add(std::span<const SeenObject> objects) {
    const auto before = static_cast<Label>(seen_.size() - 1);
    for (const SeenObject& object : objects) {
        sets_.add();
        seen_.push_back(object);
    }
    return before;
}

void StripMerger::compare(std::span<const Label> upper, std::span<const Label> lower) {
    std::map<std::pair<Label, Label>, std::int64_t> shared;
    std::map<Label, std::int64_t> cells;
    for (std::size_t i = 0; i < upper.size(); ++i) {
        for (const Label label : {upper[i], lower[i]})
            if (label != 0)
                ++cells[label];
        if (upper[i] != 0 && lower[i] != 0)
            ++shared[{upper[i], lower[i]}];
    }
    // Where strips do not see quite the same, a few cells of a neighbour do not make it the same object.
    for (const auto& [labels, n] : shared)
        if (2 * n >= std::min(cells[labels.first], cells[labels.second]))
            sets_.join(labels.first, labels.second);
}

StripMerger::Merged StripMerger::finish(std::int64_t least_cells) {
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
