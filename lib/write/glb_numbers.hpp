#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "dem2buildings/surfaces.hpp"
#include "write/held_bytes.hpp"

namespace d2b {

/// Appends four bytes, little-endian.
void append_number(std::uint32_t number, std::string& bytes);

/// Binary buffers of a glTF: vertex positions of all buildings, the building index per vertex, then the
/// triangles per kind of face.
class GlbNumbers {
  public:
    /// Appends a building in single precision, y up, z to the south. @param place index of the building in
    /// the list of all
    void add(const SurfacePart& part, const SurfaceBuilding& building, const SurfaceFrame& frame,
             std::uint64_t place);

    [[nodiscard]] bool has(FaceKind kind) const { return indices_[index(kind)].size() > 0; }
    /// Total size in bytes.
    [[nodiscard]] std::uint64_t size() const;
    /// Returns the bufferViews of glTF.
    [[nodiscard]] nlohmann::ordered_json views() const;
    /// Returns the accessors of glTF: positions, building indices, then the kinds of faces in use.
    [[nodiscard]] nlohmann::ordered_json accessors() const;
    /// @throws OutputError
    void write_to(SurfaceFile& file);

  private:
    static constexpr std::size_t kinds = 3;
    [[nodiscard]] static std::size_t index(FaceKind kind) { return static_cast<std::size_t>(kind); }

    HeldBytes positions_;
    HeldBytes buildings_;
    std::array<HeldBytes, kinds> indices_;
    std::uint32_t corners_ = 0;
    std::array<float, 3> low_{};
    std::array<float, 3> high_{};
};

}  // namespace d2b
