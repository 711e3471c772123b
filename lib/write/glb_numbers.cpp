#include "write/glb_numbers.hpp"

#include <algorithm>
#include <bit>

#include <nlohmann/json.hpp>

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

// Constants of glTF 2.0.
constexpr int type_float = 5126;
constexpr int type_unsigned_int = 5125;
constexpr int target_vertices = 34962;
constexpr int target_indices = 34963;
constexpr std::uint64_t number_size = 4;

/// Returns the ascending vertex indices of a building in its part.
std::vector<std::uint32_t> used_corners(const SurfaceBuilding& building) {
    std::vector<std::uint32_t> used;
    for (const SurfaceTriangle& triangle : building.triangles)
        used.insert(used.end(), triangle.corners.begin(), triangle.corners.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
}

}  // namespace

void append_number(std::uint32_t number, std::string& bytes) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(number >> shift & 0xFFU);
}

void GlbNumbers::add(const SurfacePart& part, const SurfaceBuilding& building, const SurfaceFrame& frame,
                     std::uint64_t place) {
    const std::vector<std::uint32_t> used = used_corners(building);
    std::string positions;
    std::string buildings;
    for (const std::uint32_t corner : used) {
        const std::array<double, 3> local = frame.local(part.points[corner]);
        const std::array<float, 3> at{static_cast<float>(local[0]), static_cast<float>(local[2]),
                                      static_cast<float>(0 - local[1])};
        const bool is_first = positions_.size() == 0 && positions.empty();
        for (std::size_t i = 0; i < at.size(); ++i) {
            low_[i] = is_first ? at[i] : std::min(low_[i], at[i]);
            high_[i] = is_first ? at[i] : std::max(high_[i], at[i]);
        }
        for (const float number : at)
            append_number(std::bit_cast<std::uint32_t>(number), positions);
        append_number(std::bit_cast<std::uint32_t>(static_cast<float>(place)), buildings);
    }
    positions_.add(positions);
    buildings_.add(buildings);
    std::array<std::string, kinds> indices;
    for (const SurfaceTriangle& triangle : building.triangles)
        for (const std::uint32_t corner : triangle.corners)
            append_number(
                corners_ + static_cast<std::uint32_t>(std::ranges::lower_bound(used, corner) - used.begin()),
                indices[index(triangle.kind)]);
    for (std::size_t kind = 0; kind < kinds; ++kind)
        indices_[kind].add(indices[kind]);
    corners_ += static_cast<std::uint32_t>(used.size());
}

std::uint64_t GlbNumbers::size() const {
    std::uint64_t size = positions_.size() + buildings_.size();
    for (const HeldBytes& indices : indices_)
        size += indices.size();
    return size;
}

Json GlbNumbers::views() const {
    const std::uint64_t vertices = positions_.size() + buildings_.size();
    return Json::array({{{"buffer", 0},
                         {"byteLength", positions_.size()},
                         {"byteStride", 3 * number_size},
                         {"target", target_vertices}},
                        {{"buffer", 0},
                         {"byteOffset", positions_.size()},
                         {"byteLength", buildings_.size()},
                         {"byteStride", number_size},
                         {"target", target_vertices}},
                        {{"buffer", 0},
                         {"byteOffset", vertices},
                         {"byteLength", size() - vertices},
                         {"target", target_indices}}});
}

Json GlbNumbers::accessors() const {
    Json accessors = Json::array(
        {{{"bufferView", 0},
          {"componentType", type_float},
          {"count", corners_},
          {"type", "VEC3"},
          {"min", low_},
          {"max", high_}},
         {{"bufferView", 1}, {"componentType", type_float}, {"count", corners_}, {"type", "SCALAR"}}});
    std::uint64_t begin = 0;
    for (const HeldBytes& indices : indices_) {
        if (indices.size() > 0)
            accessors.push_back({{"bufferView", 2},
                                 {"byteOffset", begin},
                                 {"componentType", type_unsigned_int},
                                 {"count", indices.size() / number_size},
                                 {"type", "SCALAR"}});
        begin += indices.size();
    }
    return accessors;
}

void GlbNumbers::write_to(SurfaceFile& file) {
    positions_.write_to(file);
    buildings_.write_to(file);
    for (HeldBytes& indices : indices_)
        indices.write_to(file);
}

}  // namespace d2b
