#include "preview/map_picture.hpp"

#include <cmath>

namespace d2b {
namespace {

/// Wraps a name in Unicode's first strong isolate, because a right-to-left name would otherwise reorder the
/// text after it.
std::string isolated(const std::string& name) {
    const std::string both_begin_with = "\xE2\x81";
    return both_begin_with + '\xA8' + name + both_begin_with + '\xA9';
}

}  // namespace

std::string source_line(const MapGround& ground) {
    const std::string& name = ground.dem.name;
    const std::string crs = ground.crs.name();
    return "Source: " + isolated(name.substr(name.find_last_of('/') + 1)) + " · " +
           (crs.empty() ? "CRS not known" : crs);
}

std::string counted(std::int64_t number, const std::string& one) {
    std::string digits = std::to_string(number);
    for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits + " " + one + (number == 1 ? "" : "s");
}

std::string found(const PictureCounts& counts) {
    return counted(counts.number, counts.contours_alone ? "contour" : "building");
}

std::string rounded_metres(double metres) {
    const auto tenths = std::llround(metres * 10);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " m";
}

}  // namespace d2b
