#pragma once

#include <cstdint>

#include "scene.hpp"
#include "town_plan.hpp"

namespace d2b::bench {

/// A few quarters have streets to the east and the north and large buildings between them: towers whose
/// storeys step back, courts, L, round ones.
[[nodiscard]] bool is_downtown(const sample::TownPlan& plan, std::int32_t col, std::int32_t row);
void build_downtown(const sample::TownPlan& plan, std::int32_t col, std::int32_t row, sample::Scene& scene);

}  // namespace d2b::bench
