#include "diagnose/parcel_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "core/row_bands.hpp"
#include "detect/roof_step.hpp"

namespace d2b {
namespace {

constexpr double bin_m = ParcelFit::reach_m / ParcelFit::bins;
/// Half side, in cells, of the neighbourhood that determines the direction of a cut.
constexpr std::int32_t around = 3;
/// Ratio of the length of a line to the number of cell edges it separates, averaged over all angles (Cauchy,
/// Crofton).
constexpr double straight_share = std::numbers::pi / 4;

/// Point or vector in cells.
struct Place {
    double row = 0;
    double col = 0;
};

class FitOfRows {
  public:
    FitOfRows(const Scene& scene, const Detection& detection, ParcelFit& fit)
        : scene_(scene),
          parcels_(*scene.parcels),
          detection_(detection),
          fit_(fit),
          step_(walls_to_steps * roof_step(scene)) {}

    void add_cell(std::int32_t r, std::int32_t c);

  private:
    [[nodiscard]] bool is_building(std::int32_t r, std::int32_t c) const {
        return detection_.labels.holds(r, c) && detection_.is_building(detection_.labels.at(r, c));
    }
    [[nodiscard]] bool is_step(std::int32_t r, std::int32_t c, std::int32_t to_r, std::int32_t to_c) const {
        return std::abs(scene_.surface.at(r, c) - scene_.surface.at(to_r, to_c)) > step_;
    }
    void add_pair(std::int32_t r, std::int32_t c, bool below);
    [[nodiscard]] Place across(std::int32_t r, std::int32_t c, bool below) const;
    [[nodiscard]] std::optional<double> wall_from(Place edge, Place way) const;

    const Scene& scene_;
    const ParcelGrid& parcels_;
    const Detection& detection_;
    ParcelFit& fit_;
    float step_;
};

void FitOfRows::add_cell(std::int32_t r, std::int32_t c) {
    if (!is_building(r, c))
        return;
    const ParcelCell& cell = parcels_.at(r, c);
    ++fit_.cells;
    if (cell.parcel != ParcelCell::nobody) {
        ++fit_.inside;
        fit_.several += cell.several ? 1 : 0;
        fit_.invalid += cell.invalid ? 1 : 0;
    }
    for (const bool below : {false, true}) {
        const std::int32_t to_r = r + (below ? 1 : 0);
        const std::int32_t to_c = c + (below ? 0 : 1);
        if (is_building(to_r, to_c) && parted(cell, parcels_.at(to_r, to_c), below))
            add_pair(r, c, below);
    }
}

/// Returns the vector of one metre from one side to the other, between the centroids of their surroundings.
Place FitOfRows::across(std::int32_t r, std::int32_t c, bool below) const {
    const std::int64_t from = parcels_.at(r, c).parcel;
    const std::int64_t to = parcels_.at(r + (below ? 1 : 0), c + (below ? 0 : 1)).parcel;
    std::array<Place, 2> sums{};
    std::array<std::int64_t, 2> counts{};
    for (std::int32_t y = std::max(r - around, 0); y <= std::min(r + around, parcels_.rows - 1); ++y)
        for (std::int32_t x = std::max(c - around, 0); x <= std::min(c + around, parcels_.cols - 1); ++x)
            for (const std::size_t side : {0U, 1U})
                if (from != to && parcels_.at(y, x).parcel == (side == 0 ? from : to)) {
                    sums[side].row += (y - r) * scene_.cell.down;
                    sums[side].col += (x - c) * scene_.cell.across;
                    ++counts[side];
                }
    Place way{below ? 1.0 : 0.0, below ? 0.0 : 1.0};
    if (from != to) {
        const auto middle = [&](std::size_t side, double Place::*axis) {
            return sums[side].*axis / static_cast<double>(counts[side]);
        };
        way = {middle(1, &Place::row) - middle(0, &Place::row),
               middle(1, &Place::col) - middle(0, &Place::col)};
    }
    const double length = std::hypot(way.row, way.col);
    return {way.row / length / scene_.cell.down, way.col / length / scene_.cell.across};
}

/// @param way direction in cells per metre
/// @return distance in m
std::optional<double> FitOfRows::wall_from(Place edge, Place way) const {
    const double stride = scene_.side();
    const auto cell_at = [&](double metres) {
        return std::pair(static_cast<std::int32_t>(std::floor(edge.row + metres * way.row)),
                         static_cast<std::int32_t>(std::floor(edge.col + metres * way.col)));
    };
    std::pair<std::int32_t, std::int32_t> before = cell_at(stride / 2);
    for (int step = 0; step * stride < ParcelFit::reach_m; ++step) {
        const auto [r, c] = cell_at((step + 0.5) * stride);
        if (!scene_.surface.holds(r, c))
            return std::nullopt;
        if (!is_building(r, c) || is_step(before.first, before.second, r, c))
            return step * stride;
        before = {r, c};
    }
    return std::nullopt;
}

void FitOfRows::add_pair(std::int32_t r, std::int32_t c, bool below) {
    ++fit_.cuts;
    const Place way = across(r, c, below);
    const Place edge{r + (below ? 1.0 : 0.5), c + (below ? 0.5 : 1.0)};
    std::optional<double> nearest;
    if (is_step(r, c, r + (below ? 1 : 0), c + (below ? 0 : 1)))
        nearest = 0;
    for (const double sign : {-1.0, 1.0})
        if (const auto wall = wall_from(edge, {sign * way.row, sign * way.col});
            wall && (!nearest || *wall < *nearest))
            nearest = wall;
    if (nearest)
        ++fit_.distances[std::min(static_cast<std::size_t>(*nearest / bin_m), ParcelFit::bins - 1)];
}

}  // namespace

void ParcelFit::merge(const ParcelFit& other) {
    cells += other.cells;
    inside += other.inside;
    several += other.several;
    invalid += other.invalid;
    cuts += other.cuts;
    for (std::size_t i = 0; i < bins; ++i)
        distances[i] += other.distances[i];
    shifts.merge(other.shifts);
}

void add_fit(const Scene& scene, const Detection& detection, const Window& own, ParcelFit& fit,
             Executor& threads) {
    fit.merge(sum_of_row_bands(threads, own.rows, own.cols, ParcelFit(), [&](RowBand band, ParcelFit& sum) {
        FitOfRows rows(scene, detection, sum);
        for (std::int32_t r = own.row + band.begin; r < own.row + band.end; ++r)
            for (std::int32_t c = own.col; c < own.end_col(); ++c)
                rows.add_cell(r, c);
    }));
    count_shifts(scene, detection, own, fit.shifts, threads);
}

ParcelReport parcel_report(const ParcelFit& fit, const CellSize& cell) {
    const double area = cell.area();
    const double length = straight_share * std::sqrt(area);
    const std::int64_t beside = std::accumulate(fit.distances.begin(), fit.distances.end(), std::int64_t{0});
    ParcelReport report;
    report.cut_length_m = length * static_cast<double>(fit.cuts);
    report.beside_length_m = length * static_cast<double>(beside);
    report.median_distance_m = std::numeric_limits<double>::quiet_NaN();
    std::int64_t nearer = 0;
    for (std::size_t i = 0; i < ParcelFit::bins && 2 * nearer < beside; ++i) {
        nearer += fit.distances[i];
        report.median_distance_m = static_cast<double>(i) * bin_m;
    }
    report.fitting_move = fitting_move(fit.shifts, cell);
    report.building_m2 = area * static_cast<double>(fit.cells);
    report.inside_m2 = area * static_cast<double>(fit.inside);
    report.several_m2 = area * static_cast<double>(fit.several);
    report.invalid_m2 = area * static_cast<double>(fit.invalid);
    return report;
}

}  // namespace d2b
