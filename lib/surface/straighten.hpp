#pragma once

#include "surface/plan.hpp"

namespace d2b {

enum class Straighten {
    all,    ///< every node at which two edges go on straight
    inside  ///< those alone that no outside touches: walls stand on the others
};

/// Joins edges that run on straight with nothing else at their node. The nodes stay where they are in the
/// list, also those that no edge needs any more.
void straighten(Plan& plan, Straighten what);

}  // namespace d2b
