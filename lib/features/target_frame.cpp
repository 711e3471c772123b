#include "features/target_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/georeference.hpp"
#include "features/ring_transform.hpp"

namespace d2b {
namespace {

double cross(const Position& origin, const Position& a, const Position& b) {
    return (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
}

double twice_area(const WorldRing& ring) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += cross(ring[0], ring[i], ring[i + 1]);
    return sum;
}

double longest_side(const WorldRing& frame) {
    double longest = 0;
    for (std::size_t i = 1; i < frame.size(); ++i)
        longest = std::max(longest, std::hypot(frame[i].x - frame[i - 1].x, frame[i].y - frame[i - 1].y));
    return longest;
}

/// True if the projection turns the frame inside out, as around the antipode of an azimuthal projection: the
/// orientation of small steps at a corner then differs from that of the whole frame.
bool is_inside_out(const WorldRing& frame, const WorldRing& image, RingTransform& transform) {
    constexpr double step = 1e-5;  // small enough for curves to look straight
    constexpr double flattest = 1e-6;
    const auto towards = [&](const Position& to) {
        return Position{frame[0].x + (to.x - frame[0].x) * step, frame[0].y + (to.y - frame[0].y) * step};
    };
    const std::array<Position, 3> steps{frame[0], towards(frame[1]), towards(frame[3])};
    std::array<Position, 3> images = steps;
    if (!transform.apply_to_positions(images))
        return false;
    const double turn = cross(images[0], images[1], images[2]);
    const double sides = std::hypot(images[1].x - images[0].x, images[1].y - images[0].y) *
                         std::hypot(images[2].x - images[0].x, images[2].y - images[0].y);
    const bool kept = (twice_area(frame) > 0) == (twice_area(image) > 0);
    const bool kept_here = (cross(steps[0], steps[1], steps[2]) > 0) == (turn > 0);
    return std::abs(turn) > flattest * sides && kept != kept_here;
}

/// Returns metres; nullopt if a part of the frame is outside of the projection's domain.
std::optional<double> length_on_ground(const WorldRing& frame, const Crs& crs) {
    try {
        return Geodesy(crs).ring(frame).perimeter_m;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

}  // namespace

LatticeBox lattice_frame(const Window& window, TraceMode mode) {
    const std::int32_t less = mode == TraceMode::points ? 1 : 0;
    return {{window.row, window.col}, {window.row + window.rows - less, window.col + window.cols - less}};
}

bool is_overstretched(double length, const Crs& crs, double ground_m) {
    constexpr double most = 1000;
    const auto unit = crs.horizontal_unit();
    return unit && length * unit->metres > most * ground_m;
}

Position require_whole_frame(const DemInfo& info, const RunPlan& plan, const Crs& crs, const Crs& target) {
    const TraceMode mode = plan.trace;
    const Georeference georeference(info.transform, mode);
    const Window& w = info.window;
    Position middle = georeference.position(LatticePoint{w.row + w.rows / 2, w.col + w.cols / 2});
    if (target.kind() == Crs::Kind::none)
        return middle;
    const WorldRing frame = georeference.corners(lattice_frame(w, mode));
    constexpr double pieces = 64;  // initial pieces per side
    const double longest = longest_side(frame) / pieces;
    RingTransform transform(crs, target, frame, longest);
    static_cast<void>(transform.apply_to_positions({&middle, 1}));
    WorldRing image = frame;
    // A single point has no frame, and areas without data do not need an image.
    if (!(longest > 0))
        return middle;
    const RingFate fate = transform.apply(image);
    if (fate == RingFate::without_image)
        return middle;
    const auto ground_m = length_on_ground(frame, crs);
    if (fate == RingFate::torn || is_inside_out(frame, image, transform) ||
        (ground_m && is_overstretched(length_of(image), target, *ground_m)))
        throw torn_apart(info.name, spoken_name(target, plan.asked.outline.target_crs));
    return middle;
}

std::string spoken_name(const Crs& crs, const std::string& given) {
    const std::string name = crs.name();
    return given.empty() || (name != "unknown" && name != "unnamed") ? name : given;
}

InputError torn_apart(const std::string& input, const std::string& target) {
    return InputError(
        "'" + input + "' cannot be converted to '" + target +
        "', which tears its area apart or stretches it beyond use (as across 180 degrees, over a "
        "pole or far from where a projection is made for); choose another -t_srs, such as the "
        "UTM zone of the area, or use a part of the raster (-srcwin, -projwin or -te).");
}

}  // namespace d2b
