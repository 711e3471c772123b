#pragma once

#include "surface/plan.hpp"

namespace d2b {

enum class Straighten {
    all,    ///< every node between two collinear edges
    inside  ///< only nodes that do not touch the outside, because walls stand on the others
};

/// Merges collinear edges at nodes of degree two. Node numbers do not change; unused nodes stay in the list.
void straighten(Plan& plan, Straighten what);

}  // namespace d2b
