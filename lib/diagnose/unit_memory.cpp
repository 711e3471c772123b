#include "diagnose/unit_memory.hpp"

#include <cmath>

#include "core/number_text.hpp"
#include "diagnose/words.hpp"

namespace d2b {
namespace {

std::string millions(std::int64_t points) {
    return number_text(std::round(static_cast<double>(points) / 1e6)) + " million points";
}

std::string what_is_seen(const SeenPoints& seen) {
    constexpr double bytes_a_point = 20;  // surface, terrain, and scratch memory for computing them
    constexpr double gib = 1 << 30;
    return millions(seen.points) + " at a time, as parts of the raster are seen with " +
           rounded(seen.around) + " m around them" +
           (seen.max_building_width
                ? " (five times -max_building_width " + number_text(*seen.max_building_width) + ")"
                : "") +
           ", which takes some " + rounded(static_cast<double>(seen.points) * bytes_a_point / gib) +
           " GiB of memory";
}

}  // namespace

std::string unit_memory_notice(const SeenPoints& seen) {
    if (seen.points <= SeenPoints::usual)
        return {};
    return "ground and buildings are looked for in up to " + what_is_seen(seen);
}

std::string unit_memory_refusal(const SeenPoints& seen) {
    if (seen.points <= SeenPoints::most)
        return {};
    return "Ground and buildings would be looked for in " + what_is_seen(seen) + "; more than " +
           millions(SeenPoints::most) + " are not held, so " +
           (seen.max_building_width ? "give a smaller -max_building_width."
                                    : "make the cells larger with gdalwarp -tr.");
}

}  // namespace d2b
