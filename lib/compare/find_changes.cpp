#include "compare/find_changes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "compare/common_area.hpp"
#include "compare/match_buildings.hpp"
#include "compare/survey_shift.hpp"

namespace d2b::compare {
namespace {

constexpr double height_limit_m = 2;
constexpr double area_limit_m2 = 20;
constexpr double area_limit_share = 0.1;
constexpr double compared_share = 0.5;  ///< of the area that both surveys have data of
constexpr double alike_iou = 0.5;

Change change_of(const ChangedBuilding& building) {
    if (building.old_indices.empty() && std::isnan(building.area_old_m2))
        return Change::built;
    if (building.new_indices.empty() && std::isnan(building.area_new_m2))
        return Change::gone;
    const double rise = building.p90_new_m - building.p90_old_m;
    if (rise > height_limit_m)
        return Change::raised;
    if (rise < -height_limit_m)
        return Change::lowered;
    const double growth = building.area_new_m2 - building.area_old_m2;
    if (std::abs(growth) > std::max(area_limit_m2, area_limit_share * building.area_old_m2))
        return growth > 0 ? Change::grown : Change::shrunk;
    return Change::same;
}

/// Buildings of a survey that are compared.
struct ComparedSide {
    std::vector<std::size_t> sure;      ///< indices of buildings
    std::vector<std::size_t> doubtful;  ///< indices of doubtful objects
    std::vector<double> shares;         ///< per building: share of its area in which both surveys have data
    std::size_t outside = 0;
};

std::vector<Polygons> outlines_of(const SurveyedPlace& place) {
    std::vector<Polygons> outlines;
    outlines.reserve(place.buildings.size());
    for (const SurveyedBuilding& building : place.buildings)
        outlines.push_back(building.outline);
    return outlines;
}

std::vector<Polygons> outlines_of(const SurveyedPlace& place, std::span<const std::size_t> indices) {
    std::vector<Polygons> outlines;
    outlines.reserve(indices.size());
    for (const std::size_t i : indices)
        outlines.push_back(place.buildings[i].outline);
    return outlines;
}

ComparedSide compared_side(const SurveyedPlace& place, const std::optional<Polygons>& region,
                           Overlay& overlay) {
    ComparedSide side;
    side.shares.assign(place.buildings.size(), 1);
    if (region)
        side.shares = shares_in_region(outlines_of(place), *region, overlay);
    for (std::size_t i = 0; i < place.buildings.size(); ++i) {
        const bool doubtful = place.buildings[i].doubtful;
        if (side.shares[i] >= compared_share)
            (doubtful ? side.doubtful : side.sure).push_back(i);
        else if (!doubtful)
            ++side.outside;
    }
    return side;
}

std::optional<Polygons> common_region(const SurveyedPlace& one, const SurveyedPlace& other,
                                      Overlay& overlay) {
    if (!one.covered || !other.covered)
        return one.covered ? one.covered : other.covered;
    return overlay.intersection(*one.covered, *other.covered);
}

/// What a survey knows of the buildings of a match.
struct JointValues {
    double p90_m = RoofHeights::nan;
    double area_m2 = RoofHeights::nan;
    double confidence = RoofHeights::nan;
};

JointValues joint_values(const SurveyedPlace& place, const ComparedSide& side,
                         std::span<const std::size_t> indices) {
    JointValues joint;
    if (indices.empty())
        return joint;
    std::vector<const SurveyedBuilding*> buildings;
    joint.area_m2 = 0;
    for (const std::size_t i : indices) {
        const SurveyedBuilding& building = place.buildings[i];
        buildings.push_back(&building);
        joint.area_m2 += building.area_m2 * side.shares[i];
        joint.confidence = std::fmin(joint.confidence, building.confidence);
    }
    joint.p90_m = joint_p90(buildings);
    return joint;
}

/// True if a doubtful object has the shape and height of a building.
bool stands_for(const SurveyedBuilding& doubtful, const SurveyedBuilding& building,
                const SharedArea& shared) {
    const double iou = 1 / (1 / shared.of_old + 1 / shared.of_new - 1);
    return iou >= alike_iou && !(std::abs(doubtful.heights.p90() - building.heights.p90()) > height_limit_m);
}

class ChangeFinder {
  public:
    ChangeFinder(const SurveyedPlace& old_place, const SurveyedPlace& new_place)
        : old_place_(old_place), new_place_(new_place) {
        const std::optional<Polygons> region = common_region(old_place, new_place, overlay_);
        old_ = compared_side(old_place, region, overlay_);
        new_ = compared_side(new_place, region, overlay_);
    }

    SurveyChanges run() {
        SurveyChanges changes;
        changes.old_outside = old_.outside;
        changes.new_outside = new_.outside;
        const auto shared = shared_between(old_.sure, new_.sure);
        for (const MatchedBuildings& match : match_buildings(old_.sure.size(), new_.sure.size(), shared))
            changes.buildings.push_back(building_of(match));
        find_doubtful(changes.buildings);
        for (ChangedBuilding& building : changes.buildings)
            building.change = change_of(building);
        return changes;
    }

  private:
    [[nodiscard]] std::vector<SharedArea> shared_between(std::span<const std::size_t> old_indices,
                                                         std::span<const std::size_t> new_indices) {
        return shared_areas(outlines_of(old_place_, old_indices), outlines_of(new_place_, new_indices),
                            overlay_);
    }

    void set_old(ChangedBuilding& building, const JointValues& joint) const {
        building.p90_old_m = joint.p90_m;
        building.area_old_m2 = joint.area_m2;
        building.confidence = std::fmin(building.confidence, joint.confidence);
    }
    void set_new(ChangedBuilding& building, const JointValues& joint) const {
        building.p90_new_m = joint.p90_m;
        building.area_new_m2 = joint.area_m2;
        building.confidence = std::fmin(building.confidence, joint.confidence);
    }

    [[nodiscard]] ChangedBuilding building_of(const MatchedBuildings& match) const {
        ChangedBuilding building;
        for (const std::size_t i : match.old_indices)
            building.old_indices.push_back(old_.sure[i]);
        for (const std::size_t i : match.new_indices)
            building.new_indices.push_back(new_.sure[i]);
        set_old(building, joint_values(old_place_, old_, building.old_indices));
        set_new(building, joint_values(new_place_, new_, building.new_indices));
        return building;
    }

    /// Completes buildings of one survey with what is doubtful in the other.
    void find_doubtful(std::vector<ChangedBuilding>& buildings);

    const SurveyedPlace& old_place_;
    const SurveyedPlace& new_place_;
    Overlay overlay_;
    ComparedSide old_;
    ComparedSide new_;
};

void ChangeFinder::find_doubtful(std::vector<ChangedBuilding>& buildings) {
    std::vector<std::size_t> old_sure;  // that the new survey lacks
    std::vector<std::size_t> new_sure;
    std::vector<std::size_t> of_old;  // places of these among all
    std::vector<std::size_t> of_new;
    for (std::size_t i = 0; i < buildings.size(); ++i) {
        if (buildings[i].new_indices.empty()) {
            old_sure.push_back(buildings[i].old_indices.front());
            of_old.push_back(i);
        } else if (buildings[i].old_indices.empty()) {
            new_sure.push_back(buildings[i].new_indices.front());
            of_new.push_back(i);
        }
    }
    for (const SharedArea& shared : shared_between(old_sure, new_.doubtful)) {
        const std::size_t other = new_.doubtful[shared.new_index];
        if (stands_for(new_place_.buildings[other], old_place_.buildings[old_sure[shared.old_index]], shared))
            set_new(buildings[of_old[shared.old_index]],
                    joint_values(new_place_, new_, std::span(&other, 1)));
    }
    for (const SharedArea& shared : shared_between(old_.doubtful, new_sure)) {
        const std::size_t other = old_.doubtful[shared.old_index];
        if (stands_for(old_place_.buildings[other], new_place_.buildings[new_sure[shared.new_index]], shared))
            set_old(buildings[of_new[shared.new_index]],
                    joint_values(old_place_, old_, std::span(&other, 1)));
    }
}

/// Translates a survey and the area in which it has data.
void translate_place(SurveyedPlace& place, double east, double north) {
    for (SurveyedBuilding& building : place.buildings)
        translate(building.outline, east, north);
    if (place.covered)
        translate(*place.covered, east, north);
}

std::vector<SurveyedBuilding> sure_buildings(const SurveyedPlace& place) {
    std::vector<SurveyedBuilding> sure;
    std::ranges::copy_if(place.buildings, std::back_inserter(sure),
                         [](const SurveyedBuilding& building) { return !building.doubtful; });
    return sure;
}

}  // namespace

SurveyChanges find_changes(SurveyedPlace old_place, const SurveyedPlace& new_place, double metres) {
    const SurveyShift shift = estimate_shift(sure_buildings(old_place), sure_buildings(new_place),
                                             std::max(old_place.cell_m, new_place.cell_m), metres);
    translate_place(old_place, shift.east_m / metres, shift.north_m / metres);
    SurveyChanges changes = ChangeFinder(old_place, new_place).run();
    changes.shift = shift;
    return changes;
}

}  // namespace d2b::compare
