#pragma once

#include <cstddef>
#include <span>

#include "detect/judged_objects.hpp"

namespace d2b {

/// Puts together what several looks at a scene have found, each with wider limits than the one before, so
/// that its objects lie in those of the next, or nearly so. Of these trees those objects are taken, none of
/// which lies in another, whose log-odds times cells have the largest sum, see best_nested().
/// @param looks the strictest first @param usual an object of this one that touches none of them is kept as
/// it is, since it may still be doubtful
/// @return objects that share no edge. Where chosen ones touch, they are one, which is what the one with the
/// most cells in it is. Left out is what was at the usual look, and is in none.
[[nodiscard]] JudgedObjects best_of_looks(std::span<const JudgedObjects> looks, std::size_t usual,
                                          Executor& threads);

}  // namespace d2b
