#include "detect/sampling_rules.hpp"

#include <algorithm>
#include <cmath>

namespace d2b::detect {
namespace {

// Shares of cells without a pulse. Every survey has some of them; scans of at least one pulse per m^2 on
// cells of at most a metre have fewer than the second. Seville's cathedral at 1 m has 0.06, the pines of
// docs/research in a sparse scan 0.085.
constexpr double usual = 0.02;
constexpr double filled_by_any = 0.04;
constexpr double no_single_limit = 0.06;
constexpr double sparse = 0.08;
constexpr double very_sparse = 0.1;

// Scenes of 2 pulses per m^2 on cells of 1 m have 0.23 to 0.27, and places and scenes of more pulses whose
// slopes are planes at most 0.17; see docs/research/strict_limits.md.
constexpr double sparse_slopes_m = 0.19;
constexpr double mostly_planes = 0.5;

constexpr double coarse_m = 1.9;  // map cells of 2 m may be slightly smaller on the ground

}  // namespace

double sparseness(double filled) {
    return std::clamp((filled - filled_by_any) / (sparse - filled_by_any), 0.0, 1.0);
}

bool has_sparse_points(double filled) {
    return filled > sparse;
}

double sparse_share() {
    return sparse;
}

bool has_very_sparse_points(double filled) {
    return filled > very_sparse;
}

bool is_coarse(double side) {
    return side > coarse_m;
}

bool needs_multi_threshold(double side, double filled) {
    return filled > no_single_limit || is_coarse(side);
}

double sampling_margin(double side, double filled) {
    constexpr double of_side = 0.17;  // fitted to simulated scans
    return of_side * side * std::sqrt(std::max(0.0, filled - usual));
}

bool has_sparse_slopes(const SlopeSampling& slopes) {
    return slopes.error_m >= sparse_slopes_m && slopes.planar_share >= mostly_planes;
}

std::vector<double> stricter_scales(double side, double filled) {
    if (!is_coarse(side))
        return {0.7, 0.5, 0.35};
    return has_very_sparse_points(filled) ? std::vector<double>{} : std::vector{0.9};
}

double price_of_lost_roofs(double filled) {
    return has_very_sparse_points(filled) ? 2 : 2.5;
}

}  // namespace d2b::detect
