#include "roofs/roof_type.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace d2b::roofs {
namespace {

constexpr double most = 0.75;          // of the area of a roof that is flat or slopes in one direction
constexpr double main_share = 0.6;     // of the area that slopes in the directions of a type
constexpr double negligible = 0.05;    // of the area of a side
constexpr double same_direction = 30;  // degrees
constexpr double hip_taper = 0.4;      // of a face that ends in a point
constexpr double longest_peak = 1;     // m: a shorter ridge is the peak of a pyramid

double angle(double one, double other) {
    return std::abs(std::remainder(one - other, 360));
}

/// Faces that slope in one direction.
struct SlopeSide {
    double azimuth = 0;
    double area = 0;
    double hip_area = 0;   ///< of faces that end in a point
    double peak_area = 0;  ///< of faces whose upper end is a peak
    std::vector<FaceShape> faces;

    /// True if gentle faces stand on steep ones; not on a sliver of one, such as the side of a dormer.
    [[nodiscard]] bool is_bent() const {
        constexpr double least_bend = 15;  // degrees between the faces
        constexpr double steep = 45;
        constexpr double gap = 1;            // m
        constexpr double least_share = 0.1;  // of the area of the side
        double below_bends = 0;
        for (const FaceShape& below : faces)
            if (below.slope > steep && std::ranges::any_of(faces, [&](const FaceShape& above) {
                    return below.slope - above.slope > least_bend && std::abs(above.low - below.high) < gap;
                }))
                below_bends += below.area;
        return below_bends >= least_share * area;
    }
};

std::vector<SlopeSide> sides_of(std::vector<FaceShape> faces, double total, double peak) {
    std::ranges::stable_sort(faces, std::greater<>(), &FaceShape::area);
    std::vector<SlopeSide> sides;
    for (const FaceShape& face : faces) {
        if (face.slope < flat_degrees)
            continue;
        auto side = std::ranges::find_if(
            sides, [&](const SlopeSide& s) { return angle(s.azimuth, face.azimuth) < same_direction; });
        if (side == sides.end())
            side = sides.insert(sides.end(), {face.azimuth, 0, 0, 0, {}});
        side->area += face.area;
        side->hip_area += face.taper < hip_taper ? face.area : 0;
        side->peak_area += face.top <= peak ? face.area : 0;
        side->faces.push_back(face);
    }
    std::ranges::stable_sort(sides, std::greater<>(), &SlopeSide::area);
    std::erase_if(sides, [&](const SlopeSide& side) { return side.area < negligible * total; });
    return sides;
}

/// Area of the sides that are turned from the main one by neither a right angle nor its multiples.
double oblique_area(const std::vector<SlopeSide>& sides) {
    constexpr double square = 20;  // degrees from a right angle
    double oblique = 0;
    for (const SlopeSide& side : sides)
        if (std::abs(std::remainder(side.azimuth - sides[0].azimuth, 90)) > square)
            oblique += side.area;
    return oblique;
}

/// Type of a roof with faces that slope in several directions.
std::string_view pitched_type(const std::vector<SlopeSide>& sides, double total, double roundness) {
    constexpr double round = 0.9;  // an octagon has 0.95, a square 0.79
    constexpr double oblique_share = 0.3;
    constexpr double mansard_share = 0.3;  // narrow lower faces are often merged with the upper ones
    if ((sides.size() >= 4 && roundness > round) ||
        (sides.size() >= 5 && oblique_area(sides) > oblique_share * total))
        return "domed";
    SlopeSide along;   // the main side and those opposite to it
    SlopeSide across;  // those at right angles
    bool has_opposite = false;
    double bent = 0;
    for (const SlopeSide& side : sides) {
        const double turned = angle(side.azimuth, sides[0].azimuth);
        SlopeSide* const group = turned < same_direction || turned > 150 ? &along
                                 : turned > 60 && turned < 120           ? &across
                                                                         : nullptr;
        if (group == nullptr)
            continue;
        has_opposite = has_opposite || turned > 150;
        group->area += side.area;
        group->hip_area += side.hip_area;
        group->peak_area += side.peak_area;
        bent += side.is_bent() ? side.area : 0;
    }
    const double area = along.area + across.area;
    if (!has_opposite || area < main_share * total)
        return "complex";
    if (bent >= mansard_share * area)
        return "mansard";
    if (across.hip_area <= across.area / 2)
        return "gabled";
    return along.peak_area > most * along.area ? "pyramidal" : "hipped";
}

}  // namespace

std::string_view roof_type(std::span<const FaceShape> faces, double roundness, double cell) {
    double whole = 0;
    double total = 0;  // without doubtful faces
    double flat = 0;
    for (const FaceShape& face : faces)
        whole += face.area;
    std::vector<FaceShape> sure;
    for (const FaceShape& face : faces) {
        if (face.doubtful)
            continue;
        sure.push_back(face);
        total += face.area;
        flat += face.slope < flat_degrees ? face.area : 0;
    }
    if (total <= 0 || total < whole / 2)
        return "unknown";
    if (flat >= most * total)
        return "flat";
    const std::vector<SlopeSide> sides = sides_of(sure, total, std::max(longest_peak, cell));
    if (sides.empty())
        return "complex";
    if (sides[0].area >= most * total)
        return "shed";
    return pitched_type(sides, total, roundness);
}

}  // namespace d2b::roofs
