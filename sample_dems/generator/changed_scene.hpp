#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scene.hpp"

namespace d2b::sample {

/// Change of a building between two moments.
enum class TrueChange { same, built, gone, raised, lowered };
[[nodiscard]] std::string_view change_name(TrueChange change);

/// Height of a floor that is added or taken off, in metres.
inline constexpr double floor_m = 3;

/// Building of either moment and its change.
struct TruthOfChange {
    Building building;  ///< as it is afterwards, and as it was if it is gone
    TrueChange change = TrueChange::same;
};

/// A place at two moments.
struct ChangedScene {
    Scene before;
    Scene after;
    std::vector<TruthOfChange> truth;  ///< all buildings, in the order of their numbers
};

/// Changes a place: of the single buildings of 50 m2 and more, a tenth each is built, pulled down, raised and
/// lowered by a floor. All trees grow by a tenth to two fifths, a tenth are felled, a tenth are new. The
/// second moment has other noise. Buildings are numbered from 1.
[[nodiscard]] ChangedScene change_scene(Scene scene, std::uint64_t seed);

}  // namespace d2b::sample
