#include "filter/contour_shelf.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace d2b {

void save(const StoredContours::Stored& stored, std::int32_t level, ByteWriter& writer) {
    save(stored.contour, writer);
    if (level == 1)
        writer.put(stored.roof);
}

StoredContours::Stored load_stored(std::int32_t level, ByteReader& reader) {
    StoredContours::Stored stored{load_contour(reader), {}};
    if (level == 1)
        stored.roof = reader.take<RoofElevations>();
    return stored;
}

void ContourShelf::add(const ContourHead& head, const StoredContours::Stored& stored) {
    ByteWriter writer;
    save(stored, head.key.level, writer);
    const std::size_t holes = stored.contour.interiors.size();
    entries_.push_back({head, append(*spool_, writer), holes_, holes});
    holes_ += holes;
}

std::unique_ptr<StoredContours> ContourShelf::finish() {
    std::vector<std::size_t> order(entries_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return entries_[i].head.key; });
    std::vector<std::int64_t> place(entries_.size());
    std::vector<StoredContours::Entry> sorted;
    sorted.reserve(entries_.size());
    std::int64_t buildings = 0;
    // The parent of a contour has a lower level, so it comes first.
    for (const std::size_t i : order) {
        place[i] = static_cast<std::int64_t>(sorted.size());
        ContourHead& head = sorted.emplace_back(entries_[i]).head;
        if (head.parent >= 0)
            head.parent = place[static_cast<std::size_t>(head.parent)];
        head.building = head.key.level == 1 ? buildings++
                        : head.parent >= 0  ? sorted[static_cast<std::size_t>(head.parent)].head.building
                                            : -1;
    }
    entries_.clear();
    return std::make_unique<StoredContours>(std::move(spool_), std::move(sorted),
                                            std::vector<bool>(std::exchange(holes_, 0)),
                                            std::vector<StoredContours::Rejected>());
}

}  // namespace d2b
