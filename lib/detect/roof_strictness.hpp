#pragma once

#include <optional>

#include "detect/judged_objects.hpp"

namespace d2b {

/// How much stricter the limits of smoothness may be than those for clean data, since roofs here are smoother
/// than elsewhere: then crowns are left outside that the usual limits take in.
///
/// Cells more than 3 m inside objects that are buildings beyond doubt (a confidence above 0.95) are surely
/// roofs. The limits are made stricter step by step for as long as 99.5 % of these cells are still found; the
/// root of the last such factor is taken, which leaves room for roofs that are less smooth than those. It is
/// looked at on up to four squares of 1024 by 1024 cells, those with the most such cells: a stated part of
/// the scene, so that the time does not grow with it. Whole numbers are counted: their order does not matter.
///
/// @param first what was found with `quality`
/// @return 1, 0.9, 0.8, 0.7 or 0.6; nothing where there are fewer than 2000 such cells, and where a blur has
/// smeared walls (a step_sharpness() below 0.6): it has smoothed roofs and crowns alike, and small houses
/// bend
[[nodiscard]] std::optional<double> roof_strictness(const Scene& scene, const DetectOptions& options,
                                                    double smallest_m2, const SurfaceQuality& quality,
                                                    const JudgedObjects& first, Executor& threads);

}  // namespace d2b
