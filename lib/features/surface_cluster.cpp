#include "features/surface_cluster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "core/int128.hpp"
#include "outline/fine_geometry.hpp"
#include "roofs/make_roof.hpp"
#include "surface/partition.hpp"
#include "surface/vertex_snapping.hpp"

namespace d2b::features {
namespace {

/// Twice the absolute area in square steps. Exact.
Int128 twice_area(const FineRing& ring) {
    Int128 sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += outline::turn(ring[0], ring[i], ring[i + 1]);
    return sum < 0 ? -sum : sum;
}

Int128 twice_area(const FinePolygon& polygon) {
    Int128 sum = twice_area(polygon.exterior);
    for (const FineRing& interior : polygon.interiors)
        sum -= twice_area(interior);
    return sum;
}

/// Area in square steps.
double plan_steps(const FinePolygon& placed) {
    return static_cast<double>(twice_area(placed)) / 2;
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
    ClusterDrawer(const SurfaceInput& input, std::optional<RingTransform>& transform,
                  const std::set<std::int64_t>& stacked)
        : input_(input), transform_(transform), stacked_(stacked) {}

    [[nodiscard]] DrawnCluster draw(std::span<const std::uint32_t> contours);

  private:
    [[nodiscard]] const contours::ContourHead& head(std::uint32_t contour) const {
        return input_.features.contours.head(contour);
    }
    [[nodiscard]] bool is_wanted(std::uint32_t contour) const;
    [[nodiscard]] bool has_tiers(std::int64_t building) const {
        return input_.of == SurfaceOf::contours || as_tiers_.contains(building);
    }
    void add_building(std::uint32_t contour);
    void add_contour(std::uint32_t contour);
    void add_roof(std::uint32_t contour, const BuildingRecord& record);
    void add(surface::PartitionContour&& contour, std::int32_t level);
    [[nodiscard]] double top(std::uint32_t contour, const BuildingRecord& record) const;
    void place();
    void drop(const std::vector<bool>& is_lost);

    const SurfaceInput& input_;
    std::optional<RingTransform>& transform_;
    const std::set<std::int64_t>& stacked_;
    std::set<std::int64_t> as_tiers_;  // by building index, with SurfaceOf::roofs
    DrawnCluster drawn_;
    std::map<std::int64_t, std::int32_t> building_place_;  // by building index
    std::map<std::int64_t, std::int32_t> contour_place_;   // by contour index
};

bool ClusterDrawer::is_wanted(std::uint32_t contour) const {
    const contours::ContourHead& of = head(contour);
    return of.building >= 0 && !input_.features.is_low_confidence(contour) &&
           (of.key.level == 1 || has_tiers(of.building));
}

/// Returns the elevation of a flat roof, or of a tier of a stack.
double ClusterDrawer::top(std::uint32_t contour, const BuildingRecord& record) const {
    if (input_.of != SurfaceOf::buildings)
        return input_.records.top(contour);
    return flat_roof(record, input_.roof, input_.lattice);
}

/// Adds a building, unless its roof is not higher than its ground.
void ClusterDrawer::add_building(std::uint32_t contour) {
    const std::int64_t number = head(contour).building;
    const auto record = input_.buildings.of(number);
    if (!record)
        return;  // not in any layer; already reported
    const double base = input_.of == SurfaceOf::buildings ? record->ground : input_.records.base(contour);
    const double roof = top(contour, *record);
    const bool flat =
        input_.of == SurfaceOf::buildings &&
        !input_.lattice.gaps().rises_above(input_.lattice.height(roof), input_.lattice.height(base));
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

void ClusterDrawer::add(surface::PartitionContour&& contour, std::int32_t level) {
    drawn_.levels.push_back(level);
    drawn_.cluster.contours.push_back(std::move(contour));
}

/// Adds the faces of a roof, or marks the building as one of tiers if it has no roof.
void ClusterDrawer::add_roof(std::uint32_t contour, const BuildingRecord& record) {
    const std::int32_t building = building_place_.at(head(contour).building);
    const std::int64_t base = drawn_.cluster.buildings[static_cast<std::size_t>(building)].base;
    const auto roof = stacked_.contains(record.id) ? std::nullopt : input_.features.roofs->roof(contour);
    std::vector<surface::PartitionContour> faces;
    if (roof)
        for (const roofs::RoofFace& face : roof->faces) {
            auto plane =
                input_.lattice.place_plane(face.outline, face.elevations, roofs::roof_steps, transform_);
            if (!plane) {
                faces.clear();
                break;
            }
            const auto height = [&](double metres) {
                return input_.lattice.height(metres / input_.lattice.frame().vertical_metres);
            };
            std::int64_t lowest = height(std::ranges::min(face.elevations));
            // A slanted face has to stand on the ground with all corners. A level one below it is open
            // ground.
            if (!input_.lattice.gaps().rises_above(lowest, base)) {
                lowest = height(std::accumulate(face.elevations.begin(), face.elevations.end(), 0.0) /
                                static_cast<double>(face.elevations.size()));
                plane.reset();
                ++drawn_.levelled_faces;
            }
            faces.push_back({{face.outline.exterior, face.outline.interiors}, -1, building, lowest, plane});
        }
    if (faces.empty()) {
        as_tiers_.insert(head(contour).building);
        drawn_.stacked.push_back(record.id);
    }
    for (surface::PartitionContour& face : faces)
        add(std::move(face), 1);
}

void ClusterDrawer::add_contour(std::uint32_t contour) {
    if (head(contour).key.level == 1)
        add_building(contour);
    const auto building = building_place_.find(head(contour).building);
    if (building == building_place_.end())
        return;
    const BuildingRecord& record = drawn_.buildings[static_cast<std::size_t>(building->second)];
    if (input_.of == SurfaceOf::roofs && head(contour).key.level == 1) {
        add_roof(contour, record);
        if (!as_tiers_.contains(head(contour).building))
            return;
    }
    const outline::Outliner& outliner = input_.features.outliner;
    surface::PartitionContour plan;
    plan.outline =
        input_.of == SurfaceOf::buildings ? outliner.footprint(contour) : outliner.outline(contour);
    if (input_.of == SurfaceOf::roofs)
        plan.outline = roofs::refined(plan.outline);
    plan.building = building->second;
    plan.top = input_.lattice.height(top(contour, record));
    if (const auto parent = contour_place_.find(head(contour).parent); parent != contour_place_.end())
        plan.parent = parent->second;
    contour_place_[contour] = static_cast<std::int32_t>(drawn_.cluster.contours.size());
    add(std::move(plan), head(contour).key.level);
}

/// Nodes the outlines before rounding: vertices that touch edges of other outlines become vertices of these.
void ClusterDrawer::place() {
    std::vector<surface::PartitionContour>& contours = drawn_.cluster.contours;
    const bool slanted = input_.of == SurfaceOf::roofs;
    if (slanted) {
        surface::route_through_vertices(contours);
    } else if (!input_.lattice.is_exact()) {
        std::vector<FinePolygon> noded = surface::noded_outlines(contours);
        for (std::size_t i = 0; i < contours.size(); ++i)
            contours[i].outline = std::move(noded[i]);
    }
    std::vector<bool> is_lost(drawn_.buildings.size());
    for (surface::PartitionContour& contour : contours)
        if (auto placed = input_.lattice.place(contour.outline, transform_, slanted ? roofs::roof_steps : 1))
            contour.outline = std::move(*placed);
        else
            is_lost[static_cast<std::size_t>(contour.building)] = true;
    if (std::ranges::find(is_lost, true) != is_lost.end())
        drop(is_lost);
    if (slanted || !input_.lattice.is_exact())
        surface::snap_round(drawn_.cluster.contours);
    if (input_.of != SurfaceOf::buildings)
        return;
    for (surface::PartitionContour& contour : contours) {
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
        surface::PartitionContour& contour = drawn_.cluster.contours[i];
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
    rest.stacked = std::move(drawn_.stacked);
    rest.levelled_faces = drawn_.levelled_faces;
    drawn_ = std::move(rest);
}

DrawnCluster ClusterDrawer::draw(std::span<const std::uint32_t> contours) {
    for (const std::uint32_t contour : contours)
        if (is_wanted(contour))
            add_contour(contour);
    place();
    return std::move(drawn_);
}

class TierMerger {
  public:
    explicit TierMerger(DrawnCluster& drawn) : drawn_(drawn), contours_(drawn.cluster.contours) {
        for (std::size_t i = 0; i < contours_.size(); ++i) {
            merged_into_.push_back(i);
            is_raised_.push_back(false);
        }
    }

    void merge() {
        merge_equal();
        merge_covered();
        drop_merged();
    }

  private:
    /// Returns the tier below, after all merges so far.
    [[nodiscard]] std::size_t below(std::size_t tier) const {
        auto lower = static_cast<std::size_t>(contours_[tier].parent);
        while (merged_into_[lower] != lower)
            lower = merged_into_[lower];
        return lower;
    }
    void merge_equal();
    void merge_covered();
    void drop_merged();

    DrawnCluster& drawn_;
    std::vector<surface::PartitionContour>& contours_;
    std::vector<std::size_t> merged_into_;  ///< tier that each one has been merged into
    std::vector<bool> is_raised_;
};

/// Compares each tier with the outline that would remain, because otherwise small losses could accumulate.
void TierMerger::merge_equal() {
    std::vector<Int128> areas;
    for (const surface::PartitionContour& contour : contours_)
        areas.push_back(twice_area(contour.outline));
    for (std::size_t i = 0; i < contours_.size(); ++i) {
        if (contours_[i].parent < 0)
            continue;
        const std::size_t lower = below(i);
        if (areas[i] * 1000 < areas[lower] * 999)
            continue;
        merged_into_[i] = lower;
        is_raised_[lower] = true;
        contours_[lower].top = std::max(contours_[lower].top, contours_[i].top);
    }
}

void TierMerger::merge_covered() {
    for (std::size_t i = 0; i < contours_.size(); ++i) {
        if (contours_[i].parent < 0 || merged_into_[i] != i)
            continue;
        const std::size_t lower = below(i);
        if (is_raised_[lower] && contours_[i].top <= contours_[lower].top)
            merged_into_[i] = lower;
    }
}

void TierMerger::drop_merged() {
    std::vector<std::int32_t> place(contours_.size());
    std::vector<surface::PartitionContour> stay;
    std::vector<std::int32_t> levels;
    for (std::size_t i = 0; i < contours_.size(); ++i) {
        if (merged_into_[i] != i)
            continue;
        place[i] = static_cast<std::int32_t>(stay.size());
        const std::int32_t parent = contours_[i].parent < 0 ? -1 : place[below(i)];
        stay.push_back(std::move(contours_[i]));
        stay.back().parent = parent;
        levels.push_back(drawn_.levels[i]);
    }
    contours_ = std::move(stay);
    drawn_.levels = std::move(levels);
}

/// Negates rows because they increase southwards. The ring keeps its orientation as seen from above.
std::vector<SurfacePoint> roof_ring(const FineRing& ring, std::int64_t top) {
    std::vector<SurfacePoint> corners;
    corners.reserve(ring.size());
    for (const FinePoint& point : ring)
        corners.push_back({point.col, -point.row, top});
    return corners;
}

SurfaceTier tier_of(const surface::PartitionContour& contour, std::int32_t level, std::int32_t parent) {
    SurfaceTier tier{level, parent, contour.top, {roof_ring(contour.outline.exterior, contour.top)}};
    for (const FineRing& interior : contour.outline.interiors)
        tier.rings.push_back(roof_ring(interior, contour.top));
    return tier;
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

bool preserve_volumes(const std::vector<double>& area, surface::SurfaceCluster& cluster) {
    constexpr double least = 0.0003;  // below the resolution of heights (millimetres)
    constexpr double most = 0.01;     // above this, the shape itself has changed
    bool differs = false;
    for (surface::PartitionContour& contour : cluster.contours) {
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
                          std::optional<RingTransform>& transform, const std::set<std::int64_t>& stacked) {
    return ClusterDrawer(input, transform, stacked).draw(contours);
}

void merge_equal_tiers(DrawnCluster& drawn) {
    TierMerger(drawn).merge();
}

std::vector<SurfacePart> building_tiers(const DrawnCluster& drawn, SurfaceRoof roof,
                                        const SurfaceLattice& lattice) {
    std::vector<SurfacePart> parts(drawn.buildings.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        SurfaceBuilding& building = parts[i].buildings.emplace_back();
        building.id = drawn.buildings[i].id;
        building.base = drawn.cluster.buildings[i].base;
        building.roof = building.base;
    }
    std::vector<std::int32_t> indices;  // index of each contour among its building's tiers
    for (std::size_t i = 0; i < drawn.cluster.contours.size(); ++i) {
        const surface::PartitionContour& contour = drawn.cluster.contours[i];
        const auto place = static_cast<std::size_t>(contour.building);
        SurfaceBuilding& building = parts[place].buildings.front();
        std::vector<SurfaceTier>& tiers = building.tiers;
        // A building without height is drawn as a flat patch of its ground.
        if (contour.parent < 0)
            building.roof =
                std::max(building.base, block_roof(drawn.buildings[place], roof, contour.outline, lattice));
        indices.push_back(static_cast<std::int32_t>(tiers.size()));
        tiers.push_back(tier_of(contour, drawn.levels[i],
                                contour.parent < 0 ? -1 : indices[static_cast<std::size_t>(contour.parent)]));
    }
    return parts;
}

}  // namespace d2b::features
