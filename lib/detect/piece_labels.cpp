#include "detect/piece_labels.hpp"

#include <algorithm>
#include <span>

namespace d2b {
namespace {

/// Shifts the labels of doubtful objects to make room for more buildings.
void shift_doubtful(Detection& detection, Label buildings) {
    for (Label& label : detection.labels.values)
        if (label > detection.buildings)
            label += buildings - detection.buildings;
}

}  // namespace

void write_pieces(const Regions& regions, const std::vector<Label>& number, Detection& detection) {
    const Label pieces = *std::max_element(number.begin(), number.end());
    shift_doubtful(detection, pieces);
    std::vector<DetectedObject> objects(pieces);
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            const std::span<Label> cells = detection.labels.row(r).subspan(
                static_cast<std::size_t>(run.begin), static_cast<std::size_t>(run.end - run.begin));
            const Label label = number[run.label];
            DetectedObject& object = objects[label - 1];
            if (object.cells == 0) {
                object = detection.objects[cells.front() - 1];
                object.cells = 0;
            }
            object.cells += run.end - run.begin;
            std::fill(cells.begin(), cells.end(), label);
        }
    objects.insert(objects.end(), detection.objects.begin() + detection.buildings, detection.objects.end());
    detection.objects = std::move(objects);
    detection.buildings = pieces;
}

}  // namespace d2b
