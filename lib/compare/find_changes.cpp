#include "compare/find_changes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include "compare/compare_heights.hpp"
#include "compare/survey_shift.hpp"
#include "core/disjoint_sets.hpp"
#include "geometry/box_tree.hpp"
#include "score/measure.hpp"

namespace d2b::compare {
namespace {

/// Overlap of two buildings.
struct SharedArea {
    std::size_t old_index = 0;
    std::size_t new_index = 0;
    double of_old = 0;  ///< share of the old building's area
    double of_new = 0;  ///< share of the new building's area
};

/// Buildings of both surveys that are the same or parts of the same. One side is empty if nothing of the
/// other survey stands there.
struct MatchedBuildings {
    std::vector<std::size_t> old_indices;
    std::vector<std::size_t> new_indices;
};

constexpr double matching_share = 0.5;

std::uint32_t set_element(std::size_t i) {
    return static_cast<std::uint32_t>(i);
}

/// Buildings of the other survey in the place of one building.
struct Coverage {
    double share = 0;
    double most = 0;
    std::size_t by = 0;  ///< index of the building that shares most

    void add(double part, std::size_t index) {
        share += part;
        if (part > most) {
            most = part;
            by = index;
        }
    }
};

/// All overlaps, by old building.
std::vector<SharedArea> shared_areas(std::span<const Polygons> old_outlines,
                                     std::span<const Polygons> new_outlines, Overlay& overlay) {
    std::vector<Box> boxes;
    boxes.reserve(new_outlines.size());
    for (const Polygons& outline : new_outlines)
        boxes.push_back(box_of(outline));
    const BoxTree tree(boxes);
    std::vector<SharedArea> all;
    for (std::size_t i = 0; i < old_outlines.size(); ++i) {
        const Polygons& outline = old_outlines[i];
        const double old_area = score::area_of(outline);
        std::vector<std::size_t> near;
        tree.query(box_of(outline), [&](std::size_t k) { near.push_back(k); });
        std::ranges::sort(near);
        for (const std::size_t k : near) {
            const double area = score::area_of(overlay.intersection(outline, new_outlines[k]));
            if (area > 0)
                all.push_back({i, k, score::share(area, old_area),
                               score::share(area, score::area_of(new_outlines[k]))});
        }
    }
    return all;
}

/// Matches buildings that share at least half of the smaller one, and buildings that several of the other
/// survey cover by half. A match may have several of each, because either survey may divide buildings.
/// @return every building once: first those with a new building, by their first one, then the others
std::vector<MatchedBuildings> match_buildings(std::size_t old_count, std::size_t new_count,
                                              std::span<const SharedArea> shared) {
    // New buildings come first, then the old ones.
    DisjointSets sets(set_element(new_count + old_count));
    std::vector<Coverage> coverage(new_count + old_count);
    std::vector<bool> is_matched(new_count + old_count, false);
    const auto match = [&](std::size_t one, std::size_t other) {
        sets.join(set_element(one), set_element(other));
        is_matched[one] = is_matched[other] = true;
    };
    for (const SharedArea& pair : shared) {
        const std::size_t of_old = new_count + pair.old_index;
        coverage[of_old].add(pair.of_old, pair.new_index);
        coverage[pair.new_index].add(pair.of_new, of_old);
        if (std::max(pair.of_old, pair.of_new) >= matching_share)
            match(pair.new_index, of_old);
    }
    for (std::size_t i = 0; i < coverage.size(); ++i)
        if (!is_matched[i] && coverage[i].share >= matching_share)
            match(i, coverage[i].by);

    std::map<std::uint32_t, MatchedBuildings> by_root;
    for (std::size_t i = 0; i < coverage.size(); ++i) {
        MatchedBuildings& one = by_root[sets.find(set_element(i))];
        if (i < new_count)
            one.new_indices.push_back(i);
        else
            one.old_indices.push_back(i - new_count);
    }
    std::vector<MatchedBuildings> all;
    all.reserve(by_root.size());
    for (auto& [root, one] : by_root)  // the root is the smallest element
        all.push_back(std::move(one));
    return all;
}

constexpr double height_limit_m = 2;
constexpr double ground_limit_m = 2;  ///< heights below it are ground
constexpr double area_limit_m2 = 20;
constexpr double area_limit_share = 0.1;
constexpr double compared_share = 0.5;  ///< of the area that both surveys have data of

/// Distance by which all walls of a building must have moved to be changed. Cells of another size move them
/// by up to half a cell.
double wall_limit_m(const SurveyedPlace& old_place, const SurveyedPlace& new_place) {
    constexpr double same_cells = 1.1;
    const auto [fine, coarse] = std::minmax(old_place.cell_m, new_place.cell_m);
    return coarse > same_cells * fine ? coarse / 2 : 0;
}

Change change_of(const ChangedBuilding& building, double wall_limit) {
    if (building.rise_m > height_limit_m)
        return Change::raised;
    if (building.rise_m < -height_limit_m)
        return Change::lowered;
    const double growth = building.area_new_m2 - building.area_old_m2;
    const double around_square_m2 = 4 * std::sqrt(building.area_old_m2) * wall_limit;
    if (std::abs(growth) >
        std::max({area_limit_m2, area_limit_share * building.area_old_m2, around_square_m2}))
        return growth > 0 ? Change::grown : Change::shrunk;
    return Change::same;
}

/// Buildings of a survey that are compared.
struct ComparedSide {
    std::vector<std::size_t> inside;  ///< indices of buildings
    std::vector<double> shares;       ///< per building: share of its area in which both surveys have data
};

std::vector<Polygons> outlines_of(const SurveyedPlace& place, std::span<const std::size_t> indices) {
    std::vector<Polygons> outlines;
    outlines.reserve(indices.size());
    for (const std::size_t i : indices)
        outlines.push_back(place.buildings[i].outline);
    return outlines;
}

/// Share of a building in which both surveys have heights.
double share_known(const Polygons& outline, const SurveyHeights& one, const SurveyHeights& other,
                   double step) {
    const std::vector<Position> positions = positions_in(outline, step);
    const std::vector<double> of_one = one.at(positions);
    const std::vector<double> of_other = other.at(positions);
    std::size_t known = 0;
    for (std::size_t i = 0; i < positions.size(); ++i)
        known += std::isnan(of_one[i]) || std::isnan(of_other[i]) ? 0U : 1U;
    return positions.empty() ? 1 : static_cast<double>(known) / static_cast<double>(positions.size());
}

/// @param step between positions at which heights are looked up
ComparedSide compared_side(const SurveyedPlace& place, const SurveyedPlace& other, double step) {
    ComparedSide side;
    for (std::size_t i = 0; i < place.buildings.size(); ++i) {
        side.shares.push_back(
            place.heights && other.heights
                ? share_known(place.buildings[i].outline, *place.heights, *other.heights, step)
                : 1);
        if (side.shares.back() >= compared_share)
            side.inside.push_back(i);
    }
    return side;
}

/// Values of the buildings of a match in one survey.
struct JointValues {
    RoofHeights heights;
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
    joint.heights = joint_heights(buildings);
    return joint;
}

class ChangeFinder {
  public:
    ChangeFinder(const SurveyedPlace& old_place, const SurveyedPlace& new_place, double metres)
        : old_place_(old_place),
          new_place_(new_place),
          metres_(metres),
          wall_limit_m_(wall_limit_m(old_place, new_place)),
          old_(compared_side(old_place, new_place, step())),
          new_(compared_side(new_place, old_place, step())) {}

    SurveyChanges run() {
        SurveyChanges changes;
        changes.old_outside = old_place_.buildings.size() - old_.inside.size();
        changes.new_outside = new_place_.buildings.size() - new_.inside.size();
        const auto shared = shared_areas(outlines_of(old_place_, old_.inside),
                                         outlines_of(new_place_, new_.inside), overlay_);
        for (const MatchedBuildings& match : match_buildings(old_.inside.size(), new_.inside.size(), shared))
            changes.buildings.push_back(building_of(match));
        for (ChangedBuilding& building : changes.buildings)
            if (building.change == Change::built || building.change == Change::gone)
                look_for(building);
            else if (building.change == Change::grown || building.change == Change::shrunk)
                confirm_growth(building);
        return changes;
    }

  private:
    /// Compares a building with one or more of the other survey.
    void set_values(ChangedBuilding& building, const JointValues& before, const JointValues& after) const;
    [[nodiscard]] ChangedBuilding building_of(const MatchedBuildings& match) const;
    void look_for(ChangedBuilding& building) const;
    /// Area of a building in one survey that is ground in the other, and outside of its outline there.
    [[nodiscard]] double area_on_ground(const ChangedBuilding& building, bool in_new) const;
    void confirm_growth(ChangedBuilding& building) const;
    /// Distance between positions at which heights are compared, in units of the coordinates.
    [[nodiscard]] double step() const { return std::min(old_place_.cell_m, new_place_.cell_m) / metres_; }

    const SurveyedPlace& old_place_;
    const SurveyedPlace& new_place_;
    double metres_;
    double wall_limit_m_;
    Overlay overlay_;
    ComparedSide old_;
    ComparedSide new_;
};

void ChangeFinder::set_values(ChangedBuilding& building, const JointValues& before,
                              const JointValues& after) const {
    building.p90_old_m = before.heights.p90();
    building.p90_new_m = after.heights.p90();
    building.area_old_m2 = before.area_m2;
    building.area_new_m2 = after.area_m2;
    building.rise_m = rise_m(before.heights, after.heights);
    building.confidence = std::fmin(before.confidence, after.confidence);
    building.change = change_of(building, wall_limit_m_);
}

ChangedBuilding ChangeFinder::building_of(const MatchedBuildings& match) const {
    ChangedBuilding building;
    for (const std::size_t i : match.old_indices)
        building.old_indices.push_back(old_.inside[i]);
    for (const std::size_t i : match.new_indices)
        building.new_indices.push_back(new_.inside[i]);
    set_values(building, joint_values(old_place_, old_, building.old_indices),
               joint_values(new_place_, new_, building.new_indices));
    if (match.old_indices.empty())
        building.change = Change::built;
    if (match.new_indices.empty())
        building.change = Change::gone;
    return building;
}

double ChangeFinder::area_on_ground(const ChangedBuilding& building, bool in_new) const {
    const auto outline = [](const SurveyedPlace& place, std::span<const std::size_t> indices) {
        Polygons parts;
        for (const std::size_t i : indices)
            std::ranges::copy(place.buildings[i].outline, std::back_inserter(parts));
        return parts;
    };
    std::vector<Position> inside = positions_in(outline(new_place_, building.new_indices), step());
    std::vector<Position> other = positions_in(outline(old_place_, building.old_indices), step());
    if (!in_new)
        std::swap(inside, other);
    const auto by_row = [](const Position& a, const Position& b) {
        return a.y < b.y || (a.y == b.y && a.x < b.x);
    };
    std::ranges::sort(inside, by_row);
    std::ranges::sort(other, by_row);
    std::vector<Position> added;
    std::ranges::set_difference(inside, other, std::back_inserter(added), by_row);
    const SurveyHeights& heights = in_new ? *old_place_.heights : *new_place_.heights;
    const auto low = std::ranges::count_if(heights.at(added), [](double h) { return h < ground_limit_m; });
    const double side_m = step() * metres_;
    return static_cast<double>(low) * side_m * side_m;
}

/// Trees at a wall make outlines larger and smaller. A building has grown where ground was, and it has shrunk
/// where ground is.
void ChangeFinder::confirm_growth(ChangedBuilding& building) const {
    if (!old_place_.heights || !new_place_.heights)
        return;
    ChangedBuilding confirmed = building;
    confirmed.area_new_m2 =
        building.area_old_m2 + area_on_ground(building, true) - area_on_ground(building, false);
    if (change_of(confirmed, wall_limit_m_) != building.change)
        building.change = Change::same;
}

/// Looks for a building of one survey in the heights of the other.
void ChangeFinder::look_for(ChangedBuilding& building) const {
    if (!old_place_.heights || !new_place_.heights)
        return;
    const bool gone = building.change == Change::gone;
    const SurveyedPlace& place = gone ? old_place_ : new_place_;
    const SurveyedBuilding& own =
        place.buildings[(gone ? building.old_indices : building.new_indices).front()];
    const std::vector<Position> positions = positions_in(own.outline, step());
    const SurveyHeights& other = gone ? *new_place_.heights : *old_place_.heights;
    const StandsThere found = stands_there(place.heights->at(positions), other.at(positions), own.confidence);
    if (!found.stands)
        return;
    building.rise_m = gone ? found.rise_m : -found.rise_m;
    (gone ? building.p90_new_m : building.p90_old_m) = own.heights.p90() + found.rise_m;
    building.change = change_of(building, wall_limit_m_);
}

/// Translates the outlines and the heights of a survey.
void translate_place(SurveyedPlace& place, double east, double north) {
    for (SurveyedBuilding& building : place.buildings)
        score::translate(building.outline, east, north);
    if (place.heights)
        place.heights->offset = {place.heights->offset.x + east, place.heights->offset.y + north};
}

}  // namespace

SurveyChanges find_changes(SurveyedPlace old_place, const SurveyedPlace& new_place, double metres) {
    const SurveyShift shift = estimate_shift(old_place.buildings, new_place.buildings,
                                             std::max(old_place.cell_m, new_place.cell_m), metres);
    translate_place(old_place, shift.east_m / metres, shift.north_m / metres);
    SurveyChanges changes = ChangeFinder(old_place, new_place, metres).run();
    changes.shift = shift;
    return changes;
}

}  // namespace d2b::compare
