#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "contours/contour_archive.hpp"
#include "features/record_builder.hpp"

namespace d2b::test {

/// Contours of a run side by side, with their relations.
struct ContourSet {
    std::vector<contours::Contour> contours;
    std::vector<std::int64_t> building;   ///< a contour: index into `buildings`, -1 in level 0
    std::vector<std::int64_t> buildings;  ///< the contours of level 1, in order
    std::vector<RoofElevations> roofs;    ///< a building
    std::shared_ptr<const contours::StoredContours> list;
};

inline ContourSet fetch_set(std::shared_ptr<const contours::StoredContours> list) {
    ContourSet set;
    for (std::size_t i = 0; i < list->size(); ++i) {
        contours::StoredContours::Stored stored = list->fetch_stored(i);
        set.contours.push_back(std::move(stored.contour));
        set.building.push_back(list->head(i).building);
        if (list->head(i).key.level == 1) {
            set.buildings.push_back(static_cast<std::int64_t>(i));
            set.roofs.push_back(stored.roof);
        }
    }
    set.list = std::move(list);
    return set;
}

/// A list of contours in memory.
class ContourVector : public contours::ContourList {
  public:
    explicit ContourVector(std::vector<contours::Contour> list) : contours_(std::move(list)) {
        for (const contours::Contour& contour : contours_)
            heads_.push_back({contour.key, contour.label, contour.parent});
    }
    [[nodiscard]] std::size_t size() const override { return contours_.size(); }
    [[nodiscard]] const contours::ContourHead& head(std::size_t i) const override { return heads_[i]; }
    [[nodiscard]] contours::Contour fetch(std::size_t i) const override { return contours_[i]; }

  private:
    std::vector<contours::Contour> contours_;
    std::vector<contours::ContourHead> heads_;
};

/// The records of all contours and of all buildings.
struct Records {
    std::vector<ContourRecord> contours;
    std::vector<BuildingRecord> buildings;
};

inline Records make_records(const ContourSet& set, const features::AttributeContext& context) {
    const features::RecordBuilder maker(*set.list, context);
    Records records;
    for (std::size_t i = 0; i < set.contours.size(); ++i) {
        records.contours.push_back(maker.contour(i, set.contours[i]));
        if (set.contours[i].key.level == 1)
            records.buildings.push_back(
                maker.building(i, set.contours[i], records.contours[i], set.roofs[records.buildings.size()]));
    }
    return records;
}

}  // namespace d2b::test
