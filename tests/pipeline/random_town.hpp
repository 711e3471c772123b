#pragma once

#include "pipeline/pipeline_case.hpp"

namespace d2b::test {

/// Parameters of a random town.
struct TownKind {
    int rows = 330;
    int cols = 410;
    int blocks = 90;
    bool with_holes = false;   ///< points that are not valid, and single cells far above all others
    bool with_streets = true;  ///< rows of houses with party walls
};

/// Blocks of random sizes with roofs on several levels, courtyards, rows of houses wall to wall, rough places
/// and trees, on ground that rises.
[[nodiscard]] MemorySource random_town(unsigned seed, const TownKind& kind = {});

}  // namespace d2b::test
