#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace d2b {

/// The points that a unit of a divided window sees at most, and why they are so many.
struct SeenPoints {
    static constexpr std::int64_t usual = std::int64_t{48} << 20;
    static constexpr std::int64_t most = std::int64_t{1} << 30;  ///< more are not held

    std::int64_t points = 0;
    double around = 0;                         ///< m that are seen beside a unit's own cells
    std::optional<double> max_building_width;  ///< m; of which `around` follows, where that can be changed
};

/// How much memory is needed, where that is more than usual. Without a full stop; "" where it is not.
[[nodiscard]] std::string unit_memory_notice(const SeenPoints& seen);
/// Why it is too much, and what to do about it; "" where it is not.
[[nodiscard]] std::string unit_memory_refusal(const SeenPoints& seen);

}  // namespace d2b
