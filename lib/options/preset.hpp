#pragma once

#include "dem2buildings/options.hpp"

namespace d2b {

/// Whether buildings are detected: the preset "buildings". "thesis" takes everything above its thresholds.
[[nodiscard]] bool detects_buildings(const Options& options);

/// The options with the preset's choice in the place of every `by_preset`.
///
///                 buildings              thesis
///   ground        automatic              none
///   -levels       building               global
///   -trace        cells                  points
///   -regularize   auto, off if simplified   off
///   -min_area     30 m2, of buildings    0, of all contours
///
/// Done again, it changes nothing.
/// @throws OptionError where an option has no effect in the preset, or two exclude each other
[[nodiscard]] Options with_preset(Options options);

}  // namespace d2b
