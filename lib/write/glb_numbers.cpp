#include "write/glb_numbers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include <nlohmann/json.hpp>

namespace d2b {
namespace {

// Numbers of glTF 2.0.
constexpr int type_float = 5126;
constexpr int type_unsigned_int = 5125;
constexpr int target_vertices = 34962;
constexpr int target_indices = 34963;

}  // namespace

GlbCorners::GlbCorners(const SurfaceBuilding& building) {
    for (const SurfaceTriangle& triangle : building.triangles)
        used.insert(used.end(), triangle.corners.begin(), triangle.corners.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
}

std::uint32_t GlbCorners::number(std::uint32_t corner) const {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(used, corner) - used.begin());
}

void append_number(std::uint32_t number, std::string& bytes) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(number >> shift & 0xFFU);
}

std::uint64_t GlbNumbers::add_positions(const SurfacePart& part, const SurfaceFrame& frame,
                                        const GlbCorners& corners) {
    std::array<float, 3> low{};
    std::array<float, 3> high{};
    const std::uint64_t begin = positions_.size();
    std::string bytes;
    for (const std::uint32_t corner : corners.used) {
        const std::array<double, 3> local = frame.local(part.points[corner]);
        const std::array<float, 3> at{static_cast<float>(local[0]), static_cast<float>(local[2]),
                                      static_cast<float>(0 - local[1])};
        for (std::size_t i = 0; i < at.size(); ++i) {
            low[i] = bytes.empty() ? at[i] : std::min(low[i], at[i]);
            high[i] = bytes.empty() ? at[i] : std::max(high[i], at[i]);
        }
        for (const float number : at)
            append_number(std::bit_cast<std::uint32_t>(number), bytes);
    }
    positions_.add(bytes);
    return accessors_.add({{"bufferView", 0},
                           {"byteOffset", begin},
                           {"componentType", type_float},
                           {"count", corners.used.size()},
                           {"type", "VEC3"},
                           {"min", low},
                           {"max", high}});
}

std::uint64_t GlbNumbers::add_indices(const SurfaceBuilding& building, FaceKind kind,
                                      const GlbCorners& corners) {
    const std::uint64_t begin = indices_.size();
    std::string bytes;
    for (const SurfaceTriangle& triangle : building.triangles)
        if (triangle.kind == kind)
            for (const std::uint32_t corner : triangle.corners)
                append_number(corners.number(corner), bytes);
    indices_.add(bytes);
    return accessors_.add({{"bufferView", 1},
                           {"byteOffset", begin},
                           {"componentType", type_unsigned_int},
                           {"count", bytes.size() / sizeof(std::uint32_t)},
                           {"type", "SCALAR"}});
}

nlohmann::ordered_json GlbNumbers::views() const {
    return nlohmann::ordered_json::array({{{"buffer", 0},
                                           {"byteLength", positions_.size()},
                                           {"byteStride", 3 * sizeof(float)},
                                           {"target", target_vertices}},
                                          {{"buffer", 0},
                                           {"byteOffset", positions_.size()},
                                           {"byteLength", indices_.size()},
                                           {"target", target_indices}}});
}

void GlbNumbers::write_to(SurfaceFile& file) {
    positions_.write_to(file);
    indices_.write_to(file);
}

}  // namespace d2b
