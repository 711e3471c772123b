#pragma once

#include <array>

#include "core/elevation_sample.hpp"

namespace d2b {

/// Shares of a building's points, and the elevations that they do not exceed.
inline constexpr std::array<double, 4> percentile_shares{0.50, 0.70, 0.90, 0.95};
using Percentiles = std::array<double, percentile_shares.size()>;

/// Taken when a building is finished, so that its sample can go. @pre sample.size() > 0
[[nodiscard]] Percentiles take_percentiles(const ElevationSample& sample, const ElevationRange& range);

}  // namespace d2b
