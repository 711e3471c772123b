#include "core/lattice.hpp"

#include <algorithm>
#include <cstdlib>

namespace d2b {
FineRing fine(const LatticeRing& ring) {
    FineRing result;
    result.reserve(ring.size());
    for (const LatticePoint point : ring)
        result.push_back(fine(point));
    return result;
}

FinePolygon fine(const LatticePolygon& polygon) {
    FinePolygon result{fine(polygon.exterior), {}};
    result.interiors.reserve(polygon.interiors.size());
    for (const LatticeRing& ring : polygon.interiors)
        result.interiors.push_back(fine(ring));
    return result;
}

PackedRing::PackedRing(const LatticeRing& corners) {
    const auto first =
        static_cast<std::size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
    const std::size_t n = corners.size();
    start_ = corners[first];
    corner_count_ = static_cast<std::uint32_t>(n);
    box_ = {start_, start_};
    ByteWriter steps;
    for (std::size_t i = 0; i < n; ++i) {
        const LatticePoint from = corners[(first + i) % n];
        const LatticePoint to = corners[(first + i + 1) % n];
        const std::int32_t rows = to.row - from.row;
        const std::int32_t cols = to.col - from.col;
        points_ += std::abs(rows) + std::abs(cols);
        area_ -= static_cast<std::int64_t>(from.col) * rows;
        box_.low.col = std::min(box_.low.col, from.col);
        box_.high.row = std::max(box_.high.row, from.row);
        box_.high.col = std::max(box_.high.col, from.col);
        if (i + 1 < n)
            steps.put_zigzag(rows + cols);
    }
    steps_.assign(steps.bytes().begin(), steps.bytes().end());
}

LatticeRing PackedRing::corners() const {
    LatticeRing ring;
    ring.reserve(corner_count_);
    LatticePoint at = start_;
    // At its first corner in scan order an exterior ring leaves downwards, an interior one along the row.
    bool along_column = area_ > 0;
    ByteReader steps(steps_);
    for (std::uint32_t i = 0; i < corner_count_; ++i) {
        ring.push_back(at);
        if (i + 1 == corner_count_)
            break;
        (along_column ? at.row : at.col) += static_cast<std::int32_t>(steps.take_zigzag());
        along_column = !along_column;
    }
    return ring;
}

void PackedRing::save(ByteWriter& writer) const {
    writer.put(start_);
    writer.put(corner_count_);
    writer.put(points_);
    writer.put(area_);
    writer.put(box_);
    writer.put_list(steps_);
}

PackedRing PackedRing::load(ByteReader& reader) {
    PackedRing ring;
    ring.start_ = reader.take<LatticePoint>();
    ring.corner_count_ = reader.take<std::uint32_t>();
    ring.points_ = reader.take<std::int64_t>();
    ring.area_ = reader.take<std::int64_t>();
    ring.box_ = reader.take<LatticeBox>();
    ring.steps_ = reader.take_list<std::byte>();
    return ring;
}

bool contains(const LatticeRing& ring, LatticePoint square) {
    bool inside = false;
    LatticePoint from = ring.back();
    for (const LatticePoint to : ring) {
        // A ray from the centre of the square along its row crosses only vertical edges.
        if (from.row != to.row && (from.row <= square.row) != (to.row <= square.row)) {
            // both ends of a vertical edge have the same column
            if (from.col > square.col)
                inside = !inside;
        }
        from = to;
    }
    return inside;
}

}  // namespace d2b
