#pragma once

namespace d2b::bench {

/// The DEM that stages are timed on; whoever runs them writes it first.
inline constexpr const char* city_path = "/vsimem/city.tif";

/// Registers a benchmark a stage and preset. What a stage gets from those before it is made when the first of
/// its preset runs.
void register_stages();

}  // namespace d2b::bench
