#include "features/building_records.hpp"

#include <algorithm>
#include <cstddef>

#include "core/byte_record.hpp"

namespace d2b {

void BuildingRecords::put(std::int64_t building, const BuildingRecord& record) {
    const auto place = static_cast<std::size_t>(building);
    ByteWriter writer;
    writer.put(record);
    places_.resize(std::max(places_.size(), place + 1));
    places_[place] = append(*spool_, writer);
}

std::optional<BuildingRecord> BuildingRecords::of(std::int64_t building) const {
    const auto place = static_cast<std::size_t>(building);
    if (place >= places_.size() || places_[place].size == 0)
        return std::nullopt;
    return ByteReader(*spool_, places_[place]).take<BuildingRecord>();
}

}  // namespace d2b
