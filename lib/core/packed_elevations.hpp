#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/byte_record.hpp"

namespace d2b {

/// How many elevations there are, and all of them: as floats where nothing is lost by it.
void put_elevations(std::span<const double> elevations, ByteWriter& writer);
/// @throws BrokenRecord
[[nodiscard]] std::vector<double> take_elevations(ByteReader& reader);
/// Takes them to the front of a place. @return how many there are @throws BrokenRecord also where they are
/// more than it holds
std::size_t take_elevations(ByteReader& reader, std::span<double> to);

}  // namespace d2b
