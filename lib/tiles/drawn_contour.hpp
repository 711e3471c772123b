#pragma once

#include "core/byte_record.hpp"
#include "features/contour_drawer.hpp"

namespace d2b {

/// Serialises a drawn contour without the cells of the contour.
void save(const DrawnContour& drawn, ByteWriter& writer);
/// Deserialises a contour. @throws BrokenRecord
[[nodiscard]] DrawnContour load_drawn_contour(ByteReader& reader);

}  // namespace d2b
