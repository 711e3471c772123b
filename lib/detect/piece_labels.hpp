#pragma once

#include <vector>

#include "detect/detection.hpp"
#include "detect/regions.hpp"

namespace d2b {

/// Turns each piece of a building into an object with the attributes of its building. Doubtful objects follow
/// as before.
/// @param regions regions that cover exactly the buildings' cells, each within one building
/// @param number new numbers of the regions' labels, from 1 on
void write_pieces(const Regions& regions, const std::vector<Label>& number, Detection& detection);

}  // namespace d2b
