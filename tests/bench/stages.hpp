#pragma once

namespace d2b::bench {

/// The DEM that stages are timed on; whoever runs them writes it first.
inline constexpr const char* city_path = "/vsimem/city.tif";

/// Registers a benchmark a stage and preset. Makes a stage's input from those before it when the first of
/// its preset runs.
void register_stages();

}  // namespace d2b::bench
