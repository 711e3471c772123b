#include "features/surface_cluster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "core/int128.hpp"
#include "surface/partition.hpp"
#include "surface/snap_rounded.hpp"

namespace d2b {
namespace {

/// Absolute area in square steps.
double plan_area(const FineRing& ring) {
    Int128 twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const FinePoint& a = ring[i];
        const FinePoint& b = ring[i + 1 < ring.size() ? i + 1 : 0];
        twice += Int128{a.col - ring[0].col} * (b.row - ring[0].row) -
                 Int128{b.col - ring[0].col} * (a.row - ring[0].row);
    }
    return std::abs(static_cast<double>(twice)) / 2;
}

double plan_steps(const FinePolygon& placed) {
    double steps = plan_area(placed.exterior);
    for (const FineRing& interior : placed.interiors)
        steps -= plan_area(interior);
    return steps;
}

/// Area in the plane of the output CRS, which must have units of length.
double plan_area_m2(const FinePolygon& placed, const SurfaceFrame& frame) {
    return plan_steps(placed) * frame.scale[0] * frame.scale[1] * frame.horizontal_metres *
           frame.horizontal_metres;
}

/// Returns the roof elevation of a single-block building.
double flat_roof(const BuildingRecord& record, SurfaceRoof roof, const SurfaceLattice& lattice) {
    if (roof == SurfaceRoof::max)
        return record.roof;
    const double height_m =
        roof == SurfaceRoof::mean ? record.mean_m : record.heights_m[static_cast<std::size_t>(roof)];
    return record.ground + height_m / lattice.frame().vertical_metres;
}

class ClusterDrawer {
  public:
    ClusterDrawer(const SurfaceInput& input, std::optional<RingTransform>& transform)
        : input_(input), transform_(transform) {}

    [[nodiscard]] DrawnCluster draw(std::span<const std::uint32_t> contours);

  private:
    [[nodiscard]] const ContourHead& head(std::uint32_t contour) const {
        return input_.features.contours.head(contour);
    }
    [[nodiscard]] bool is_wanted(std::uint32_t contour) const;
    void add_building(std::uint32_t contour);
    void add_contour(std::uint32_t contour);
    [[nodiscard]] double top(std::uint32_t contour, const BuildingRecord& record) const;
    void place();
    void drop(const std::vector<bool>& is_lost);

    const SurfaceInput& input_;
    std::optional<RingTransform>& transform_;
    DrawnCluster drawn_;
    std::map<std::int64_t, std::int32_t> building_place_;  // by building index
    std::map<std::int64_t, std::int32_t> contour_place_;   // by contour index
};

bool ClusterDrawer::is_wanted(std::uint32_t contour) const {
    const ContourHead& of = head(contour);
    return of.building >= 0 && !input_.features.is_doubtful(contour) &&
           (of.key.level == 1 || input_.of == SurfaceOf::contours);
}

/// Returns the elevation of a flat roof, or of a tier of a stack.
double ClusterDrawer::top(std::uint32_t contour, const BuildingRecord& record) const {
    if (input_.of == SurfaceOf::contours)
        return input_.records.top(contour);
    return flat_roof(record, input_.roof, input_.lattice);
}

/// Adds a building, unless its roof is not higher than its ground.
void ClusterDrawer::add_building(std::uint32_t contour) {
    const std::int64_t number = head(contour).building;
    const auto record = input_.buildings.of(number);
    if (!record)
        return;  // not in any layer; already reported
    const double base = input_.of == SurfaceOf::contours ? input_.records.base(contour) : record->ground;
    const double roof = top(contour, *record);
    const bool flat =
        input_.of == SurfaceOf::buildings &&
        !input_.lattice.gaps().stands_out(input_.lattice.height(roof), input_.lattice.height(base));
    if (!std::isfinite(base) || !std::isfinite(roof) || flat) {
        const auto placed = input_.lattice.place(input_.features.outliner.footprint(contour), transform_);
        drawn_.lost.push_back(
            {record->id, record->area_m2, placed ? std::optional(placed->exterior.front()) : std::nullopt});
        return;
    }
    building_place_[number] = static_cast<std::int32_t>(drawn_.buildings.size());
    drawn_.cluster.buildings.push_back({record->id, input_.lattice.height(base)});
    drawn_.buildings.push_back(*record);
}

void ClusterDrawer::add_contour(std::uint32_t contour) {
    if (head(contour).key.level == 1)
        add_building(contour);
    const auto building = building_place_.find(head(contour).building);
    if (building == building_place_.end())
        return;
    const Outliner& outliner = input_.features.outliner;
    PlanContour plan;
    plan.outline = input_.of == SurfaceOf::contours ? outliner.outline(contour) : outliner.footprint(contour);
    plan.building = building->second;
    plan.top = input_.lattice.height(top(contour, drawn_.buildings[static_cast<std::size_t>(plan.building)]));
    if (const auto parent = contour_place_.find(head(contour).parent); parent != contour_place_.end())
        plan.parent = parent->second;
    drawn_.levels.push_back(head(contour).key.level);
    contour_place_[contour] = static_cast<std::int32_t>(drawn_.cluster.contours.size());
    drawn_.cluster.contours.push_back(std::move(plan));
}

/// Nodes the outlines before rounding: vertices that touch edges of other outlines become vertices of these.
void ClusterDrawer::place() {
    std::vector<PlanContour>& contours = drawn_.cluster.contours;
    if (!input_.lattice.is_exact()) {
        std::vector<FinePolygon> noded = noded_outlines(contours);
        for (std::size_t i = 0; i < contours.size(); ++i)
            contours[i].outline = std::move(noded[i]);
    }
    std::vector<bool> is_lost(drawn_.buildings.size());
    for (PlanContour& contour : contours)
        if (auto placed = input_.lattice.place(contour.outline, transform_))
            contour.outline = std::move(*placed);
        else
            is_lost[static_cast<std::size_t>(contour.building)] = true;
    if (std::ranges::find(is_lost, true) != is_lost.end())
        drop(is_lost);
    if (!input_.lattice.is_exact())
        snap_rounded(drawn_.cluster.contours);
    if (input_.of == SurfaceOf::contours)
        return;
    for (PlanContour& contour : contours) {
        const auto building = static_cast<std::size_t>(contour.building);
        contour.top =
            std::max(drawn_.cluster.buildings[building].base + 1,
                     block_roof(drawn_.buildings[building], input_.roof, contour.outline, input_.lattice));
    }
}

/// @param is_lost by building
void ClusterDrawer::drop(const std::vector<bool>& is_lost) {
    DrawnCluster rest;
    std::vector<std::int32_t> building(is_lost.size(), -1);
    for (std::size_t i = 0; i < is_lost.size(); ++i) {
        if (is_lost[i]) {
            drawn_.lost.push_back({drawn_.buildings[i].id, drawn_.buildings[i].area_m2, std::nullopt});
            continue;
        }
        building[i] = static_cast<std::int32_t>(rest.buildings.size());
        rest.buildings.push_back(drawn_.buildings[i]);
        rest.cluster.buildings.push_back(drawn_.cluster.buildings[i]);
    }
    std::vector<std::int32_t> place(drawn_.cluster.contours.size(), -1);
    for (std::size_t i = 0; i < place.size(); ++i) {
        PlanContour& contour = drawn_.cluster.contours[i];
        contour.building = building[static_cast<std::size_t>(contour.building)];
        if (contour.building < 0)
            continue;
        if (contour.parent >= 0)
            contour.parent = place[static_cast<std::size_t>(contour.parent)];
        place[i] = static_cast<std::int32_t>(rest.cluster.contours.size());
        rest.cluster.contours.push_back(std::move(contour));
        rest.levels.push_back(drawn_.levels[i]);
    }
    rest.lost = std::move(drawn_.lost);
    drawn_ = std::move(rest);
}

DrawnCluster ClusterDrawer::draw(std::span<const std::uint32_t> contours) {
    for (const std::uint32_t contour : contours)
        if (is_wanted(contour))
            add_contour(contour);
    place();
    return std::move(drawn_);
}

}  // namespace

std::int64_t block_roof(const BuildingRecord& record, SurfaceRoof roof, const FinePolygon& placed,
                        const SurfaceLattice& lattice) {
    constexpr double most = 0.01;
    double elevation = flat_roof(record, roof, lattice);
    const double stretch = record.area_m2 / plan_area_m2(placed, lattice.frame());
    if (roof == SurfaceRoof::mean && std::abs(stretch - 1) < most)
        elevation = record.ground + (elevation - record.ground) * stretch;
    return lattice.height(elevation);
}

bool fit_roofs(const std::vector<double>& area, SurfaceCluster& cluster) {
    constexpr double least = 0.0003;  // below the resolution of heights (millimetres)
    constexpr double most = 0.01;     // above this, the shape itself has changed
    bool differs = false;
    for (PlanContour& contour : cluster.contours) {
        const auto building = static_cast<std::size_t>(contour.building);
        const double drawn = plan_steps(contour.outline);
        if (area[building] <= 0 || drawn <= 0)
            continue;
        const double stretch = drawn / area[building];
        if (std::abs(stretch - 1) < least || std::abs(stretch - 1) > most)
            continue;
        const std::int64_t base = cluster.buildings[building].base;
        contour.top = base + std::llround(static_cast<double>(contour.top - base) * stretch);
        differs = true;
    }
    return differs;
}

DrawnCluster draw_cluster(const SurfaceInput& input, std::span<const std::uint32_t> contours,
                          std::optional<RingTransform>& transform) {
    return ClusterDrawer(input, transform).draw(contours);
}

}  // namespace d2b
