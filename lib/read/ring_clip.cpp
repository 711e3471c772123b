#include "read/ring_clip.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace d2b {
namespace {

/// Side of a box.
struct Side {
    double Position::*across;  ///< bounded coordinate
    double Position::*along;
    double limit = 0;
    bool keeps_above = true;

    [[nodiscard]] bool keeps(const Position& p) const {
        return keeps_above ? p.*across >= limit : p.*across <= limit;
    }
    [[nodiscard]] Position crossing(const Position& a, const Position& b) const {
        const double share = (limit - a.*across) / (b.*across - a.*across);
        Position p;
        p.*across = limit;
        p.*along = a.*along + (b.*along - a.*along) * share;
        return p;
    }
};

WorldRing cut(const WorldRing& ring, const Side& side) {
    WorldRing kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& from = ring[i];
        const Position& to = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (side.keeps(from))
            kept.push_back(from);
        if (side.keeps(from) != side.keeps(to))
            kept.push_back(side.crossing(from, to));
    }
    return kept;
}

}  // namespace

bool ClipBox::holds(std::span<const Position> ring) const {
    return std::ranges::all_of(ring, [this](const Position& p) {
        return p.x >= left && p.x <= right && p.y >= bottom && p.y <= top;
    });
}

WorldRing clipped(const WorldRing& ring, const ClipBox& box) {
    if (box.holds(ring))
        return ring;
    const std::array<Side, 4> sides{Side{&Position::x, &Position::y, box.left, true},
                                    {&Position::x, &Position::y, box.right, false},
                                    {&Position::y, &Position::x, box.bottom, true},
                                    {&Position::y, &Position::x, box.top, false}};
    WorldRing kept = ring;
    if (kept.size() > 1 && kept.front() == kept.back())
        kept.pop_back();
    for (const Side& side : sides)
        kept = cut(kept, side);
    if (!kept.empty())
        kept.push_back(Position(kept.front()));
    return kept;
}

}  // namespace d2b
