#pragma once

#include <cstdint>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

enum class FlowProblemKind { wall, angle, gap, neck, touch, crossing };

/// A fault of the outlines, and what became of it.
struct FlowProblem {
    FlowProblemKind kind = FlowProblemKind::wall;
    double before = 0;  ///< m, of angles degrees
    double after = 0;
    bool changed = false;
    FinePoint place;
    std::vector<std::int32_t> contours;  ///< that border on it
};

}  // namespace d2b
