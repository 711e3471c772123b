#include "write/packed_rtree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace d2b {
namespace {

// https://www.sqlite.org/rtree.html, section 6: a node has its depth (only set in the root) and number of
// cells, two bytes each, then cells of an id and four coordinates; all big-endian.
constexpr std::size_t head_bytes = 4;
constexpr std::size_t cell_bytes = 24;
constexpr int byte_bits = 8;

/// Writes an integer, big-endian, and advances.
template <typename Unsigned>
void put(std::span<std::byte>& left, Unsigned value) {
    for (std::size_t i = sizeof value; i > 0; --i) {
        left[i - 1] = static_cast<std::byte>(value);
        value = static_cast<Unsigned>(value >> byte_bits);
    }
    left = left.subspan(sizeof value);
}

std::vector<std::byte> node_of(std::span<const IndexedBox> cells, std::size_t depth, std::size_t node_bytes) {
    std::vector<std::byte> bytes(node_bytes);
    std::span<std::byte> left(bytes);
    put(left, static_cast<std::uint16_t>(depth));
    put(left, static_cast<std::uint16_t>(cells.size()));
    for (const IndexedBox& cell : cells) {
        put(left, static_cast<std::uint64_t>(cell.id));
        for (const float value : {cell.min_x, cell.max_x, cell.min_y, cell.max_y})
            put(left, std::bit_cast<std::uint32_t>(value));
    }
    return bytes;
}

IndexedBox around(std::span<const IndexedBox> boxes, std::int64_t id) {
    IndexedBox all = boxes.front();
    all.id = id;
    for (const IndexedBox& box : boxes) {
        all.min_x = std::min(all.min_x, box.min_x);
        all.max_x = std::max(all.max_x, box.max_x);
        all.min_y = std::min(all.min_y, box.min_y);
        all.max_y = std::max(all.max_y, box.max_y);
    }
    return all;
}

std::size_t pieces(std::size_t count, std::size_t most) {
    return (count + most - 1) / most;
}

/// Returns the begin of part i of n parts of nearly equal size.
std::size_t part_begin(std::size_t count, std::size_t n, std::size_t i) {
    return count * i / n;
}

/// Sorts into vertical slices by x, each by y, so that neighbours in the list are neighbours on the map.
void sort_into_tiles(std::span<IndexedBox> boxes, std::size_t cells_a_node) {
    const auto by_x = [](const IndexedBox& a, const IndexedBox& b) {
        return std::pair(a.min_x + a.max_x, a.id) < std::pair(b.min_x + b.max_x, b.id);
    };
    const auto by_y = [](const IndexedBox& a, const IndexedBox& b) {
        return std::pair(a.min_y + a.max_y, a.id) < std::pair(b.min_y + b.max_y, b.id);
    };
    std::ranges::sort(boxes, by_x);
    const auto leaves = static_cast<double>(pieces(boxes.size(), cells_a_node));
    const auto slices = static_cast<std::size_t>(std::ceil(std::sqrt(leaves)));
    for (std::size_t i = 0; i < slices; ++i) {
        const std::size_t begin = part_begin(boxes.size(), slices, i);
        std::ranges::sort(boxes.subspan(begin, part_begin(boxes.size(), slices, i + 1) - begin), by_y);
    }
}

}  // namespace

PackedRtree pack_rtree(std::vector<IndexedBox> boxes, std::size_t node_bytes) {
    const std::size_t most = (node_bytes - head_bytes) / cell_bytes;
    sort_into_tiles(boxes, most);
    PackedRtree tree;
    std::int64_t next_number = 2;
    for (std::size_t depth = 0;; ++depth) {
        const std::size_t count = pieces(boxes.size(), most);
        std::vector<IndexedBox> above;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t begin = part_begin(boxes.size(), count, i);
            const auto cells =
                std::span(boxes).subspan(begin, part_begin(boxes.size(), count, i + 1) - begin);
            const std::int64_t number = count == 1 ? 1 : next_number++;
            tree.nodes.push_back({number, 0, node_of(cells, count == 1 ? depth : 0, node_bytes)});
            above.push_back(around(cells, number));
            for (const IndexedBox& cell : cells)
                if (depth == 0)
                    tree.entries.push_back({cell.id, number});
                else
                    tree.nodes[static_cast<std::size_t>(cell.id) - 2].parent = number;
        }
        if (count == 1)
            break;
        boxes = std::move(above);
    }
    std::ranges::sort(tree.entries, {}, &PackedRtree::Entry::id);
    return tree;
}

}  // namespace d2b
