#include "features/surface_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "surface/roof_heights.hpp"

namespace d2b::features {
namespace {

constexpr double millimetre = 0.001;

/// Returns the largest power of two up to a value.
double power_of_two_below(double value) {
    return std::exp2(std::floor(std::log2(value)));
}

/// Returns the number of parts of a step that leaves at most 0.6 mm.
std::int64_t divisions_of(double step) {
    constexpr double longest = 0.00062;
    std::int64_t divisions = 1;
    while (step / static_cast<double>(divisions) > longest)
        divisions *= 2;
    return divisions;
}

/// Returns the distance from the origin up to which adjacent floats are at most half a step apart.
double single_precision_reach(double step) {
    constexpr double numbers = 0x1p24;  // 2^23 floats between powers of two, times two
    return power_of_two_below(step / 2) * numbers;
}

double metres_of(const Crs& crs) {
    const auto unit = crs.horizontal_unit();
    return unit ? unit->metres : 1;
}

void require_lengths(const Crs& crs, std::string_view option_name) {
    if (crs.turn() > 0)
        throw OptionError(
            std::string(option_name) + " needs coordinates in a unit of length, and those of '" + crs.name() +
            "' are angles; convert them to a projected CRS with -t_srs, such as the UTM zone of the area.");
}

/// Returns the size of a lattice cell at a place; nullopt if the place is outside of the CRS's domain.
std::optional<CellSize> cell_at(const Crs& crs, const SurfaceFrame& frame, const Position& place) {
    const AffineTransform cell{place.x, frame.scale[0] * FinePoint::steps, 0, place.y,
                               0,       frame.scale[1] * FinePoint::steps};
    try {
        return cell_steps({0, 0, 1, 1}, Georeference(cell, TraceMode::cells), crs);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

/// Returns the largest gaps over the centre and corners of a box, because the length of a CRS unit varies.
surface::GapTolerances gaps_in(const Crs& crs, const SurfaceFrame& frame, const Position& low,
                               const Position& high) {
    surface::GapTolerances gaps;
    for (const Position& place : {Position{(low.x + high.x) / 2, (low.y + high.y) / 2}, low, high,
                                  Position{low.x, high.y}, Position{high.x, low.y}})
        if (const auto cell = cell_at(crs, frame, place)) {
            const surface::GapTolerances here = surface::gap_tolerances(*cell);
            gaps.pinch = surface::componentwise_max(gaps.pinch, here.pinch);
            gaps.corners = surface::componentwise_max(gaps.corners, here.corners);
            gaps.heights = here.heights;
        }
    return gaps;
}

}  // namespace

SurfaceLattice::SurfaceLattice(const SurfaceLatticeParameters& terms)
    : terms_(terms),
      is_exact_(terms.georeference.axis_parallel() && terms.target_crs.kind() == Crs::Kind::none),
      east_(terms.georeference.step(0, 1).x > 0),
      south_(terms.georeference.step(1, 0).y < 0),
      corner_(fine(LatticePoint{south_ ? terms.frame.high.row : terms.frame.low.row,
                                east_ ? terms.frame.low.col : terms.frame.high.col})) {
    require_lengths(terms.written(), terms.option_name);
    frame_.horizontal_metres = metres_of(terms.written());
    frame_.vertical_metres = terms.vertical_metres;
    frame_.scale[2] = millimetre / terms.vertical_metres;
    WorldRing corners = terms.georeference.corners(terms.frame);
    auto transform = output_transform(terms.crs, terms.target_crs, terms.georeference, terms.window, {});
    if (transform)
        static_cast<void>(transform->apply_to_positions(corners));
    std::ranges::copy_n(corners.begin(), 4, corners_.begin());
    std::erase_if(corners, [](const Position& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
    const auto [west, east] = std::ranges::minmax(corners, {}, &Position::x);
    const auto [south, north] = std::ranges::minmax(corners, {}, &Position::y);
    if (terms.slanted)
        divisions_ = divisions_of(terms.cell_size_m / FinePoint::steps);
    const std::int64_t steps = FinePoint::steps * divisions_;
    if (is_exact_) {
        const Position corner = terms.georeference.position(corner_);
        frame_.scale[0] = std::abs(terms.georeference.step(0, 1).x) / static_cast<double>(steps);
        frame_.scale[1] = std::abs(terms.georeference.step(1, 0).y) / static_cast<double>(steps);
        frame_.translate = {corner.x, corner.y, 0};
    } else {
        frame_.scale[0] = frame_.scale[1] =
            power_of_two_below(terms.cell_size_m / frame_.horizontal_metres / static_cast<double>(steps));
        frame_.translate = {std::floor(west.x), std::floor(south.y), 0};
    }
    gaps_ = gaps_in(terms.written(), frame_, {west.x, south.y}, {east.x, north.y});
    const double metres = frame_.horizontal_metres;
    const Position middle{(west.x + east.x) / 2, (south.y + north.y) / 2};
    if (const auto cell = cell_at(terms.written(), frame_, middle))
        area_scale_ =
            frame_.scale[0] * frame_.scale[1] * std::pow(FinePoint::steps * metres, 2) / cell->area();
    frame_.origin = terms.origin.value_or(
        std::array<double, 3>{std::round(middle.x * metres), std::round(middle.y * metres), 0});
    for (const double x : {west.x, east.x})
        reach_ = std::max(reach_, std::abs(x * metres - frame_.origin[0]));
    for (const double y : {south.y, north.y})
        reach_ = std::max(reach_, std::abs(y * metres - frame_.origin[1]));
}

std::int64_t SurfaceLattice::height(double elevation) const {
    return std::llround(elevation * frame_.vertical_metres / millimetre);
}

void SurfaceLattice::set_lowest(double lowest) {
    if (!terms_.origin)
        frame_.origin[2] = std::floor(lowest * frame_.vertical_metres);
}

FineRing SurfaceLattice::exact_ring(const FineRing& ring) const {
    FineRing placed;
    placed.reserve(ring.size());
    for (const FinePoint& point : ring)
        placed.push_back({divisions_ * (south_ ? point.row - corner_.row : corner_.row - point.row),
                          divisions_ * (east_ ? point.col - corner_.col : corner_.col - point.col)});
    if (east_ != south_)  // a single mirrored axis reverses the orientation
        std::ranges::reverse(placed);
    return placed;
}

std::optional<FinePolygon> SurfaceLattice::place(const FinePolygon& outline,
                                                 std::optional<RingTransform>& transform,
                                                 std::int64_t divisor) const {
    if (is_exact_ && divisor == 1) {
        FinePolygon placed{exact_ring(outline.exterior), {}};
        for (const FineRing& ring : outline.interiors)
            placed.interiors.push_back(exact_ring(ring));
        return placed;
    }
    WorldPolygon world =
        terms_.georeference.polygon(FinePolygon{outline.exterior, outline.interiors}, divisor);
    const auto round_to = [&](FineRing& placed, WorldRing& ring) {
        if (transform && transform->apply(ring) != RingProjection::whole)
            return false;
        for (const Position& p : ring) {
            const auto [row, col] = steps_to(p);
            placed.push_back({std::llround(row), std::llround(col)});
        }
        return true;
    };
    FinePolygon placed;
    bool is_whole = round_to(placed.exterior, world.exterior);
    for (WorldRing& ring : world.interiors)
        is_whole = is_whole && round_to(placed.interiors.emplace_back(), ring);
    return is_whole ? std::optional(std::move(placed)) : std::nullopt;
}

std::optional<surface::RoofPlane> SurfaceLattice::place_plane(const FinePolygon& outline,
                                                              std::span<const double> elevations,
                                                              std::int64_t divisor,
                                                              std::optional<RingTransform>& transform) const {
    std::vector<Position> places;
    for (const FinePoint& point : outline.exterior)
        places.push_back(terms_.georeference.position(point, divisor));
    for (const FineRing& ring : outline.interiors)
        for (const FinePoint& point : ring)
            places.push_back(terms_.georeference.position(point, divisor));
    if (transform && !transform->apply_to_positions(places))
        return std::nullopt;
    std::vector<std::array<double, 3>> corners;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [row, col] = steps_to(places[i]);
        corners.push_back({row, col, elevations[i] / millimetre});
    }
    surface::RoofPlane plane = surface::fit_plane(corners);
    plane.row_step = frame_.scale[1] * frame_.horizontal_metres / millimetre;
    plane.col_step = frame_.scale[0] * frame_.horizontal_metres / millimetre;
    plane.cosine = 1 / std::hypot(1, plane.per_row / plane.row_step, plane.per_col / plane.col_step);
    return plane;
}

void SurfaceLattice::require_single_precision() const {
    const double step = std::min(frame_.scale[0], frame_.scale[1]) * frame_.horizontal_metres;
    const double reach = single_precision_reach(step);
    if (reach_ <= reach)
        return;
    const double cell =
        is_exact_ ? std::max(frame_.scale[0], frame_.scale[1]) * frame_.horizontal_metres * FinePoint::steps
                  : terms_.cell_size_m;
    // Measured from the origin, which is in whole metres, up to half a metre from the window's centre.
    const auto cells = static_cast<std::int64_t>(2 * (reach - 1) / cell);
    const std::string size = std::to_string(cells);
    throw OptionError("-surface has coordinates up to " + number_text(std::ceil(reach_)) +
                      " m from their origin, where single precision, in which OBJ, STL and glTF are read, "
                      "cannot resolve steps of " +
                      number_text(step) + " m apart; use a window of at most " + size + " x " + size +
                      " cells (-srcwin, -projwin or -te)" +
                      (terms_.origin ? " with an origin in its middle (-surface_origin)." : "."));
}

void SurfaceLattice::require_single_precision(double lowest, double highest) const {
    const double reach = single_precision_reach(millimetre);
    for (const double elevation : {lowest, highest})
        if (const double z = elevation * frame_.vertical_metres - frame_.origin[2]; !(std::abs(z) <= reach))
            throw OptionError("-surface has heights " + number_text(std::ceil(std::abs(z))) +
                              " m from their origin, where single precision, in which OBJ, STL and glTF are "
                              "read, cannot resolve millimetres; give an origin within " +
                              number_text(reach) + " m of them with -surface_origin.");
}

}  // namespace d2b::features
