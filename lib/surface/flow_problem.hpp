#pragma once

#include <cstdint>
#include <vector>

#include "core/lattice.hpp"

namespace d2b::surface {

enum class FlowProblemKind { wall, angle, gap, neck, touch, crossing };

/// A fault of the outlines and its outcome.
struct FlowProblem {
    FlowProblemKind kind = FlowProblemKind::wall;
    double before = 0;  ///< m; degrees for angles
    double after = 0;
    bool changed = false;
    FinePoint place;
    std::vector<std::int32_t> contours;  ///< contours next to it
};

}  // namespace d2b::surface
