#include "roofs/roof_type.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace d2b::roofs {
namespace {

constexpr double most = 0.75;          // of the area that decides about a type
constexpr double negligible = 0.05;    // of the area of a face
constexpr double same_direction = 30;  // degrees

double angle(double one, double other) {
    return std::abs(std::remainder(one - other, 360));
}

/// Faces that slope in one direction.
struct Side {
    double azimuth = 0;
    double area = 0;
    double gentle = 0;  ///< slope of the gentlest face
    double steep = 0;
};

std::vector<Side> sides_of(std::vector<FaceShape> faces, double total) {
    std::ranges::stable_sort(faces, std::greater<>(), &FaceShape::area);
    std::vector<Side> sides;
    for (const FaceShape& face : faces) {
        if (face.slope < flat_degrees)
            continue;
        const auto side = std::ranges::find_if(
            sides, [&](const Side& s) { return angle(s.azimuth, face.azimuth) < same_direction; });
        if (side == sides.end()) {
            sides.push_back({face.azimuth, face.area, face.slope, face.slope});
            continue;
        }
        side->area += face.area;
        side->gentle = std::min(side->gentle, face.slope);
        side->steep = std::max(side->steep, face.slope);
    }
    std::ranges::stable_sort(sides, std::greater<>(), &Side::area);
    std::erase_if(sides, [&](const Side& side) { return side.area < 0.06 * total; });
    return sides;
}

}  // namespace

std::string_view roof_type(std::span<const FaceShape> faces) {
    double total = 0;
    double doubtful = 0;
    for (const FaceShape& face : faces) {
        total += face.area;
        doubtful += face.doubtful ? face.area : 0;
    }
    if (total <= 0 || doubtful > total / 2)
        return "unknown";
    std::vector<FaceShape> large;
    for (const FaceShape& face : faces)
        if (face.area >= negligible * total && !face.doubtful)
            large.push_back(face);
    total = 0;
    double flat = 0;
    for (const FaceShape& face : large) {
        total += face.area;
        flat += face.slope < flat_degrees ? face.area : 0;
    }
    if (total <= 0)
        return "complex";
    if (flat >= most * total)
        return "flat";
    const std::vector<Side> sides = sides_of(large, total);
    if (sides.empty())
        return "complex";
    if (sides.size() >= 5)
        return "domed";
    if (flat > 0.35 * total)
        return "complex";
    if (sides[0].area >= most * total)
        return "shed";
    double opposite = 0;
    double beside = 0;
    std::size_t beside_count = 0;
    double steps = 0;
    for (const Side& side : sides) {
        if (side.steep - side.gentle > 15)
            steps += side.area;
        if (&side == &sides[0])
            continue;
        const double turned = angle(side.azimuth, sides[0].azimuth);
        if (turned > 150)
            opposite += side.area;
        else if (turned > 60 && turned < 120) {
            beside += side.area;
            ++beside_count;
        }
    }
    if (opposite == 0)
        return "complex";
    if (sides[0].area + opposite + beside < most * total)
        return "complex";
    if (steps >= most * total)
        return "mansard";
    if (beside_count == 0)
        return "gabled";
    const double ridge = sides[0].area + opposite;
    if (beside_count >= 2 && ridge < 0.58 * (ridge + beside))
        return "pyramidal";
    return "hipped";
}

}  // namespace d2b::roofs
