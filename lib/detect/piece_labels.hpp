#pragma once

#include <vector>

#include "detect/detection.hpp"
#include "detect/regions.hpp"

namespace d2b {

/// Makes an object of each piece that buildings are divided into, with all that is known of its building.
/// Doubtful objects follow as before. @param regions that cover the buildings' cells and no others, each of
/// one building @param number of the regions' labels, from 1 on
void write_pieces(const Regions& regions, const std::vector<Label>& number, Detection& detection);

}  // namespace d2b
