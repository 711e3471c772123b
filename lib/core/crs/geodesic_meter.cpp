#include "core/crs/geodesic_meter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/crs/position_math.hpp"
#include "core/crs/text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {

/// Returns the vector to the next corner. If it exceeds half a turn of longitude, the ring crosses the
/// antimeridian.
Position GeodesicMeter::edge(std::size_t corner) const {
    const Position& a = corners_[corner];
    const Position& b = corners_[corner + 1 == corners_.size() ? 0 : corner + 1];
    Position along{b.x - a.x, b.y - a.y};
    if (turn_ > 0 && std::abs(along.x) > turn_ / 2)
        along.x = std::remainder(along.x, turn_);
    return along;
}

double GeodesicMeter::longest_squared() const {
    double longest = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i)
        longest = std::max(longest, squared_length(edge(i)));
    return longest;
}

/// Converts to longitude and latitude.
void GeodesicMeter::locate(std::span<const Position> positions, std::span<Position> places) const {
    const double farthest = 20000 * step_;  // some projections wrap around repeatedly
    std::copy(positions.begin(), positions.end(), places.begin());
    lon_lat_->apply(places);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!is_finite(positions[i]) || !is_finite(places[i]) || std::abs(positions[i].x) > farthest)
            throw InputError("Position " + position_text(positions[i]) + " of " + quoted(name_) +
                             " has no longitude and latitude; check which coordinate reference system the "
                             "coordinates are in.");
}

Position GeodesicMeter::locate(const Position& position) const {
    Position place;
    locate({&position, 1}, {&place, 1});
    return place;
}

/// Divides edges longer than step_, because the midpoint of an edge across half the globe is not
/// representative.
void GeodesicMeter::cut_long_edges() {
    std::vector<Position> cut_corners;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Position along = edge(i);
        const double pieces = std::max(1.0, std::ceil(std::sqrt(squared_length(along)) / step_));
        for (std::int64_t piece = 0; piece < static_cast<std::int64_t>(pieces); ++piece)
            cut_corners.push_back(point_along(corners_[i], along, static_cast<double>(piece) / pieces));
    }
    corners_ = std::move(cut_corners);
    places_.resize(corners_.size());
    locate(corners_, places_);
}

/// Measures with edges divided if they are longer than harmless and sag by more than largest_sag_.
Geodesy::Measure GeodesicMeter::measure_cut() {
    constexpr int most_halvings = 30;
    constexpr std::size_t most_cuts = std::size_t{1} << 18;  // a second or so
    most_places_ = corners_.size() + most_cuts;
    outline_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        stop_.check();
        const Position& place = places_[i];
        outline_.push_back(place);
        cut(corners_[i], edge(i), place, places_[i + 1 == corners_.size() ? 0 : i + 1], most_halvings);
    }
    return polygon_.measure(outline_);
}

/// Adds the points that an edge needs between its ends. @param along vector from start to end in the CRS
/// @param a, b longitude and latitude of its ends
// NOLINTNEXTLINE(misc-no-recursion): it ends with the halvings
void GeodesicMeter::cut(const Position& start, const Position& along, const Position& a, const Position& b,
                        int halvings) {
    const double squared = squared_length(along);
    if (halvings == 0 || squared <= harmless_squared_)
        return;
    const auto room = static_cast<double>(most_places_ - std::min(most_places_, outline_.size()));
    if (room < 1)
        return;
    const Position middle = point_along(start, along, 0.5);
    const Position place = locate(middle);
    const double sag = polygon_.sag(a, place, b);
    if (sag <= largest_sag_)
        return;
    const double pieces = std::min(room, std::ceil(std::sqrt(sag / largest_sag_)));
    if (pieces <= 2) {
        outline_.push_back(place);
    } else if (squared <= bends_.tile() * bends_.tile()) {  // the bend is constant along the edge
        for (std::int64_t piece = 1; piece < static_cast<std::int64_t>(pieces); ++piece)
            outline_.push_back(locate(point_along(start, along, static_cast<double>(piece) / pieces)));
    } else {
        const Position half{along.x / 2, along.y / 2};
        cut(start, half, a, place, halvings - 1);
        outline_.push_back(place);
        cut(middle, half, place, b, halvings - 1);
    }
}

Geodesy::Measure GeodesicMeter::ring(std::span<const Position> ring) {
    constexpr double share = 0.8e-7;                     // below the promised 1e-7
    const double finest_sag = 3e-15 * lon_lat_->radius;  // metres; smaller sags are only rounding errors
    if (!ring.empty())
        if (const LocalMetric* metric = metrics_.around(ring, *lon_lat_))
            return metric->ring(ring);
    corners_.assign(ring.begin(), ring.end());
    places_.resize(ring.size());
    locate(corners_, places_);
    if (ring.size() < 2)
        return {};
    if (longest_squared() > step_ * step_)
        cut_long_edges();
    Geodesy::Measure measure = polygon_.measure(places_);
    if (!(measure.perimeter_m > 0))
        return measure;
    // The tolerance depends on the area, which is unknown at first. Repeat, because a narrow ring may turn
    // out smaller than it seemed.
    const double longest = longest_squared();
    const double bend_here = bends_.around(corners_, *lon_lat_, polygon_);
    for (double believed = std::numeric_limits<double>::infinity(); measure.area_m2 < believed / 2;) {
        believed = measure.area_m2;
        largest_sag_ = std::max(1.5 * share * measure.area_m2 / measure.perimeter_m, finest_sag);
        harmless_squared_ = largest_sag_ / bend_here;
        if (longest <= harmless_squared_)
            break;
        measure = measure_cut();
    }
    return measure;
}

}  // namespace d2b
