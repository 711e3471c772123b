#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace d2b {

/// Maximum number of points in the extent of a unit of a divided window, and its cause.
struct SeenPoints {
    static constexpr std::int64_t usual = std::int64_t{48} << 20;
    static constexpr std::int64_t most = std::int64_t{1} << 30;  ///< upper limit

    std::int64_t points = 0;
    double around = 0;  ///< width of the halo in m
    std::optional<double>
        max_building_width;  ///< width in m, if `around` depends on it and it can be changed
};

/// Returns a notice with the memory required, if it is more than usual. A clause without a full stop; "" if
/// it is not.
[[nodiscard]] std::string unit_memory_notice(const SeenPoints& seen);
/// Returns the reason why it is too much, and possible remedies; "" if it is not.
[[nodiscard]] std::string unit_memory_refusal(const SeenPoints& seen);

}  // namespace d2b
