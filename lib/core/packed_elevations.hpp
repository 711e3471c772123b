#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/byte_record.hpp"

namespace d2b {

/// Writes the number of elevations, then the elevations: as floats if that is lossless.
void put_elevations(std::span<const double> elevations, ByteWriter& writer);
/// @throws BrokenRecord
[[nodiscard]] std::vector<double> take_elevations(ByteReader& reader);
/// Reads elevations into the front of `to`. @return their number @throws BrokenRecord also if there are more
/// than `to` holds
std::size_t take_elevations(ByteReader& reader, std::span<double> to);

}  // namespace d2b
