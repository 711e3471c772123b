#include "score/roofs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "geometry/box_tree.hpp"
#include "score/measure.hpp"
#include "score/objects.hpp"

namespace d2b::score {
namespace {

/// In degrees and metres: far above rounding errors, so that exact limits are kept.
constexpr double rounding = 1e-6;

/// An error and the area that has it.
struct Weighted {
    double error = 0;
    double area = 0;
};

/// The least error that is not exceeded on a share of the area. @param sorted not empty
double quantile(std::span<const Weighted> sorted, double share_below) {
    const double area = std::accumulate(sorted.begin(), sorted.end(), 0.0,
                                        [](double sum, const Weighted& one) { return sum + one.area; });
    double sum = 0;
    for (const Weighted& one : sorted) {
        sum += one.area;
        if (at_least(sum, share_below * area))
            return one.error;
    }
    return sorted.back().error;
}

std::optional<AngleErrors> angle_errors(std::vector<Weighted> errors) {
    if (errors.empty())
        return std::nullopt;
    std::ranges::sort(errors, {}, &Weighted::error);
    return AngleErrors{quantile(errors, 0.5), quantile(errors, 0.9)};
}

/// Difference of two directions, at most 180 degrees.
double turn_between(double degrees, double other_degrees) {
    return std::abs(std::remainder(degrees - other_degrees, 360));
}

/// Part of a ring where a plane is not negative. Where the ring leaves and enters that part several times,
/// the result runs forth and back along the plane's zero line, which does not change its area.
WorldRing clipped(const WorldRing& ring, const RoofPlane& plane) {
    WorldRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& p = ring[i];
        const Position& q = ring[(i + 1) % ring.size()];
        const double at_p = plane.at(p);
        const double at_q = plane.at(q);
        if (at_p >= 0)
            result.push_back(p);
        if ((at_p < 0) != (at_q < 0)) {
            const double t = at_p / (at_p - at_q);
            result.push_back({std::lerp(p.x, q.x, t), std::lerp(p.y, q.y, t)});
        }
    }
    return result;
}

/// Index of the areas that are not empty.
class AreaIndex {
  public:
    explicit AreaIndex(std::span<const Polygons> areas) {
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < areas.size(); ++i)
            if (const Box box = box_of(areas[i]); !box.empty()) {
                boxes.push_back(box);
                areas_.push_back(i);
            }
        tree_.emplace(boxes);
    }
    /// Calls visit(i) for every area whose box meets that of another area.
    template <typename Visit>
    void query(const Polygons& area, const Visit& visit) const {
        if (const Box box = box_of(area); !box.empty())
            tree_->query(box, [&](std::size_t i) { visit(areas_[i]); });
    }

  private:
    std::vector<std::size_t> areas_;
    std::optional<BoxTree> tree_;
};

/// Area of the part of polygons where two planes differ by at most `near`.
double area_near(const Polygons& area, const RoofPlane& a, const RoofPlane& b, double near) {
    const RoofPlane below{a.origin, near - a.elevation + b.at(a.origin), b.east - a.east, b.north - a.north};
    const RoofPlane above{a.origin, near + a.elevation - b.at(a.origin), a.east - b.east, a.north - b.north};
    double sum = 0;
    for (WorldPolygon polygon : area) {
        polygon.exterior = clipped(clipped(polygon.exterior, below), above);
        for (WorldRing& ring : polygon.interiors)
            ring = clipped(clipped(ring, below), above);
        sum += area_of(polygon);
    }
    return sum;
}

class RoofScorer {
  public:
    RoofScorer(const RoofSide& found, const RoofSide& reference, const RoofScoreOptions& options)
        : found_(found), reference_(reference), options_(options) {}

    RoofScore run() {
        score_.found_faces = found_.faces.size();
        score_.reference_faces = reference_.faces.size();
        compare_faces();
        compare_types();
        return score_;
    }

  private:
    [[nodiscard]] Polygons in_region(const Polygons& area) {
        return options_.region ? overlay_.intersection(area, *options_.region) : area;
    }

    void compare_faces() {
        std::vector<Polygons> areas;
        double found_area = 0;
        for (const RoofFace& face : found_.faces) {
            areas.push_back(in_region(face.area));
            found_area += area_of(areas.back());
        }
        const Dissolved dissolved = overlay_.dissolve(areas);
        score_.overlap = share(area_of(dissolved.twice), area_of(dissolved.once));
        const AreaIndex index(areas);
        double reference_area = 0;
        for (const RoofFace& face : reference_.faces) {
            const Polygons area = in_region(face.area);
            reference_area += area_of(area);
            index.query(area, [&](std::size_t i) {
                add_overlap(overlay_.intersection(area, areas[i]), found_.faces[i], face);
            });
        }
        // Rounding may make the sum of the parts exceed the whole.
        shared_ = std::min({shared_, found_area, reference_area});
        const double square_metres = options_.metres * options_.metres;
        score_.found_m2 = found_area * square_metres;
        score_.reference_m2 = reference_area * square_metres;
        score_.shared_m2 = shared_ * square_metres;
        score_.covered = share(shared_, reference_area);
        score_.angles_right = std::min(1.0, share(angles_right_, shared_));
        score_.without_slope = std::min(1.0, share(without_slope_, shared_));
        score_.heights_right = std::min(1.0, share(heights_right_, shared_));
        score_.heights_iou = share(heights_right_, found_area + reference_area - shared_);
        score_.slope = angle_errors(std::move(slopes_));
        score_.azimuth = angle_errors(std::move(azimuths_));
    }

    void add_overlap(const Polygons& area, const RoofFace& found, const RoofFace& reference) {
        const double size = area_of(area);
        if (size <= 0)
            return;
        shared_ += size;
        if (!found.slope)
            without_slope_ += size;
        if (!found.slope || !reference.slope)
            return;
        const double slope = std::abs(*found.slope - *reference.slope);
        slopes_.push_back({slope, size});
        const bool slope_right = slope <= options_.slope_deg + rounding;
        if (slope_right)
            heights_right_ += area_near(area, found.plane, reference.plane, options_.height_m + rounding);
        const bool found_level = *found.slope < options_.level_below_deg;
        const bool reference_level = *reference.slope < options_.level_below_deg;
        bool azimuth_right = true;
        if (!found_level && !reference_level) {
            azimuth_right = found.azimuth && reference.azimuth;
            if (azimuth_right) {
                const double azimuth = turn_between(*found.azimuth, *reference.azimuth);
                azimuths_.push_back({azimuth, size});
                azimuth_right = azimuth <= options_.azimuth_deg + rounding;
            }
        }
        if ((found_level && reference_level) || (slope_right && azimuth_right))
            angles_right_ += size;
    }

    void compare_types() {
        const double least = options_.min_object_m2 / (options_.metres * options_.metres);
        std::vector<Polygons> areas;
        for (const TypedBuilding& building : found_.buildings)
            areas.push_back(building.area);
        const AreaIndex index(areas);
        for (const TypedBuilding& building : reference_.buildings) {
            const Polygons area = in_region(building.area);
            const double size = area_of(area);
            if (size <= 0 || !at_least(size, least))
                continue;
            ++score_.buildings;
            std::size_t best = 0;
            double overlap = 0;
            index.query(area, [&](std::size_t i) {
                const double common = area_of(overlay_.intersection(area, areas[i]));
                if (common > overlap) {
                    overlap = common;
                    best = i;
                }
            });
            if (overlap > 0 && at_least(overlap, 0.5 * size))
                count_type(building, found_.buildings[best],
                           overlap / (size + area_of(in_region(areas[best])) - overlap));
        }
        score_.type_right = share(score_.right, score_.compared);
        score_.pair_type_right = share(score_.pairs_right, score_.pairs);
    }

    void count_type(const TypedBuilding& reference, const TypedBuilding& found, double iou) {
        const std::size_t right = found.type == reference.type ? 1 : 0;
        ++score_.compared;
        score_.right += right;
        ++score_.types[reference.type][found.type];
        if (at_least(iou, options_.match_iou)) {
            ++score_.pairs;
            score_.pairs_right += right;
        }
    }

    const RoofSide& found_;
    const RoofSide& reference_;
    const RoofScoreOptions& options_;
    Overlay overlay_;
    RoofScore score_;
    double shared_ = 0;
    double angles_right_ = 0;
    double without_slope_ = 0;
    double heights_right_ = 0;
    std::vector<Weighted> slopes_;
    std::vector<Weighted> azimuths_;
};

}  // namespace

RoofPlane fitted_plane(const Polygons& area, std::span<const double> elevations) {
    std::vector<Position> positions;
    for (const WorldPolygon& polygon : area) {
        positions.insert(positions.end(), polygon.exterior.begin(), polygon.exterior.end());
        for (const WorldRing& ring : polygon.interiors)
            positions.insert(positions.end(), ring.begin(), ring.end());
    }
    // Sums are around the mean, because coordinates of a CRS are large.
    const auto count = static_cast<double>(positions.size());
    RoofPlane plane;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        plane.origin.x += positions[i].x / count;
        plane.origin.y += positions[i].y / count;
        plane.elevation += elevations[i] / count;
    }
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double xz = 0;
    double yz = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const double x = positions[i].x - plane.origin.x;
        const double y = positions[i].y - plane.origin.y;
        const double z = elevations[i] - plane.elevation;
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xz += x * z;
        yz += y * z;
    }
    const double determinant = xx * yy - xy * xy;
    constexpr double least_breadth = 1e-12;  // of the squared breadth to the squared length
    if (determinant > least_breadth * (xx + yy) * (xx + yy)) {
        plane.east = (xz * yy - yz * xy) / determinant;
        plane.north = (yz * xx - xz * xy) / determinant;
    }
    return plane;
}

RoofScore score_roofs(const RoofSide& found, const RoofSide& reference, const RoofScoreOptions& options) {
    return RoofScorer(found, reference, options).run();
}

}  // namespace d2b::score
