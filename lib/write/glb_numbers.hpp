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

/// Four bytes, the lowest first.
void append_number(std::uint32_t number, std::string& bytes);

/// The numbers of a binary glTF: positions of the corners of all buildings, which building each belongs to,
/// then the triangles of each kind of face.
class GlbNumbers {
  public:
    /// In single precision, y up, z to the south. @param place of the building in the list of all
    void add(const SurfacePart& part, const SurfaceBuilding& building, const SurfaceFrame& frame,
             std::uint64_t place);

    [[nodiscard]] bool has(FaceKind kind) const { return indices_[index(kind)].size() > 0; }
    /// Bytes.
    [[nodiscard]] std::uint64_t size() const;
    /// Where the lists lie among the bytes.
    [[nodiscard]] nlohmann::ordered_json views() const;
    /// What the lists hold: positions, buildings, then the kinds that there are.
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
