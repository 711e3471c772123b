#include "pipeline/tiles/seam_objects.hpp"

#include <utility>

namespace d2b {
namespace {

/// Translates edge labels to indices of seam objects; labels of other objects become 0.
UnitEdges seam_labels(UnitEdges edges, const std::vector<UnitObjects::Mark>& marks) {
    for (UnitEdges::Lines* lines : {&edges.above, &edges.left, &edges.below, &edges.right})
        for (std::vector<Label>& line : *lines)
            for (Label& label : line)
                label = label == 0 ? 0 : marks[label - 1];
    return edges;
}

}  // namespace

void SeamObjects::put(std::int64_t number, FoundUnit&& found, const UnitObjects& divided) {
    const auto i = static_cast<std::size_t>(number);
    Unit& unit = units_[i];
    for (const Label label : divided.at_seams) {
        const SeenObject& seen = found.objects[label - 1];
        unit.objects.push_back(seen);
        unit.places.push_back({found.boxes[label - 1], seen.own_cells, number, label});
    }
    unit.edges = seam_labels(std::move(found.edges), divided.marks);
    known_[i] = true;
}

void SeamObjects::compare_known() {
    while (next_ < units_.size() && known_[next_])
        compare_next();
}

void SeamObjects::compare_next() {
    Unit unit = std::exchange(units_[next_], {});
    first_[next_] = merger_.add(unit.objects);
    seen_.insert(seen_.end(), unit.places.begin(), unit.places.end());
    unit.edges.add(first_[next_]);
    const auto cols = static_cast<std::size_t>(cols_);
    seams_.add(static_cast<std::int32_t>(next_ % cols), std::move(unit.edges), merger_);
    ++next_;
}

std::vector<SeamObject> SeamObjects::take() {
    return std::exchange(seen_, std::vector<SeamObject>());
}

}  // namespace d2b
