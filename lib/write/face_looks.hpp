#pragma once

#include <array>

namespace d2b {

/// How formats with colours show a kind of face.
struct FaceLook {
    const char* name;
    std::array<double, 3> colour;  ///< linear red, green and blue
};
/// By FaceKind.
inline constexpr std::array face_looks{FaceLook{"roof", {0.45, 0.09, 0.05}},
                                       FaceLook{"wall", {0.6, 0.57, 0.5}},
                                       FaceLook{"ground", {0.2, 0.2, 0.2}}};

}  // namespace d2b
