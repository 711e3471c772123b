#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "dem2buildings/surfaces.hpp"
#include "write/json_list.hpp"

namespace d2b {

/// What a building needs of the corners of its part.
struct GlbCorners {
    std::vector<std::uint32_t> used;  ///< ascending places in the part

    explicit GlbCorners(const SurfaceBuilding& building);
    [[nodiscard]] std::uint32_t number(std::uint32_t corner) const;
};

/// Four bytes, the lowest first.
void append_number(std::uint32_t number, std::string& bytes);

/// The numbers of a binary glTF: positions of all buildings, then indices of all.
class GlbNumbers {
  public:
    /// In single precision, y up, z to the south. @return the number of their accessor
    [[nodiscard]] std::uint64_t add_positions(const SurfacePart& part, const SurfaceFrame& frame,
                                              const GlbCorners& corners);
    /// Of the triangles of a kind. @return the number of their accessor
    [[nodiscard]] std::uint64_t add_indices(const SurfaceBuilding& building, FaceKind kind,
                                            const GlbCorners& corners);

    [[nodiscard]] JsonList& accessors() { return accessors_; }
    /// Bytes.
    [[nodiscard]] std::uint64_t size() const { return positions_.size() + indices_.size(); }
    /// Where the two lie among them.
    [[nodiscard]] nlohmann::ordered_json views() const;
    /// @throws OutputError
    void write_to(SurfaceFile& file);

  private:
    JsonList accessors_;
    HeldBytes positions_;
    HeldBytes indices_;
};

}  // namespace d2b
