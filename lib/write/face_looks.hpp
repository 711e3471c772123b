#pragma once

#include <array>

namespace d2b {

/// Name and colour of a kind of face in formats with materials.
struct FaceLook {
    const char* name;
    std::array<double, 3> colour;  ///< linear RGB
};
/// Indexed by FaceKind.
inline constexpr std::array face_looks{FaceLook{"roof", {0.45, 0.09, 0.05}},
                                       FaceLook{"wall", {0.6, 0.57, 0.5}},
                                       FaceLook{"ground", {0.2, 0.2, 0.2}}};

}  // namespace d2b
