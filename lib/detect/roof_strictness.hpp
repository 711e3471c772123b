#pragma once

#include <optional>

#include "detect/judged_objects.hpp"

namespace d2b {

/// Estimates a scale of the smoothness thresholds below 1 for scenes with roofs smoother than usual, so that
/// crowns are excluded that the usual thresholds include.
///
/// Cells more than 3 m inside objects that are certainly buildings (confidence above 0.95) are roofs. The
/// thresholds are lowered step by step while 99.5 % of these cells are still detected; the square root of the
/// last such factor is used, which leaves a margin for rougher roofs. Only the (up to) four squares of 1024
/// by 1024 cells with most roof cells are processed, so that the time does not grow with the scene. Integer
/// counts, so the order does not matter.
///
/// @param first candidates found with `quality`
/// @return 1, 0.9, 0.8, 0.7 or 0.6; nullopt if there are fewer than 2000 such cells, or if walls are blurred
/// (step_sharpness() below 0.6), because blur smooths roofs and crowns alike, and bends small houses
[[nodiscard]] std::optional<double> roof_strictness(const Scene& scene, const DetectOptions& options,
                                                    double smallest_m2, const SurfaceQuality& quality,
                                                    const JudgedObjects& first, Executor& threads);

}  // namespace d2b
