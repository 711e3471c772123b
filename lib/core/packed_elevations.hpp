#pragma once

#include <span>
#include <vector>

#include "core/byte_record.hpp"

namespace d2b {

/// How many elevations there are, and all of them: as floats where nothing is lost by it.
void put_elevations(std::span<const double> elevations, ByteWriter& writer);
/// @throws BrokenRecord
[[nodiscard]] std::vector<double> take_elevations(ByteReader& reader);

}  // namespace d2b
