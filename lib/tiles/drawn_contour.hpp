#pragma once

#include "core/byte_record.hpp"
#include "features/contour_drawer.hpp"

namespace d2b {

/// A contour as it is drawn, without the cells that it is drawn in.
void save(const DrawnContour& drawn, ByteWriter& writer);
/// @throws BrokenRecord
[[nodiscard]] DrawnContour load_drawn_contour(ByteReader& reader);

}  // namespace d2b
