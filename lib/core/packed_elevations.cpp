#include "core/packed_elevations.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

bool is_float(double elevation) {
    return static_cast<double>(static_cast<float>(elevation)) == elevation || std::isnan(elevation);
}

template <typename Number>
std::vector<double> take_all(ByteReader& reader, std::uint64_t count) {
    if (count > reader.left() / sizeof(Number))
        throw BrokenRecord("more is announced than there is");
    std::vector<double> elevations(static_cast<std::size_t>(count));
    for (double& elevation : elevations)
        elevation = static_cast<double>(reader.take<Number>());
    return elevations;
}

}  // namespace

void put_elevations(std::span<const double> elevations, ByteWriter& writer) {
    const bool narrow = std::ranges::all_of(elevations, is_float);
    writer.put_varint(2 * elevations.size() + (narrow ? 1 : 0));
    if (!narrow)
        return writer.put_bytes(std::as_bytes(elevations));
    for (const double elevation : elevations)
        writer.put(static_cast<float>(elevation));
}

std::vector<double> take_elevations(ByteReader& reader) {
    const std::uint64_t size = reader.take_varint();
    return size % 2 == 1 ? take_all<float>(reader, size / 2) : take_all<double>(reader, size / 2);
}

}  // namespace d2b
