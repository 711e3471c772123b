#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace d2b {

/// Bounding box of a feature in single precision, rounded outwards.
struct IndexedBox {
    std::int64_t id = 0;
    float min_x = 0;
    float max_x = 0;
    float min_y = 0;
    float max_y = 0;
};

/// R-tree in the storage format of SQLite's rtree module, bulk-loaded by sort-tile-recursive packing
/// (Leutenegger, Lopez and Edgington 1997). Takes a tenth of the time of one-by-one insertion and overlaps
/// less.
struct PackedRtree {
    struct Node {
        std::int64_t number = 0;       ///< 1 is the root
        std::int64_t parent = 0;       ///< 0 for the root
        std::vector<std::byte> bytes;  ///< blob of the _node table
    };
    struct Entry {
        std::int64_t id = 0;
        std::int64_t leaf = 0;  ///< number of the leaf that holds it
    };
    std::vector<Node> nodes;
    std::vector<Entry> entries;  ///< ascending ids
};

/// @param node_bytes node size chosen by SQLite; at least two cells fit @pre not empty
[[nodiscard]] PackedRtree pack_rtree(std::vector<IndexedBox> boxes, std::size_t node_bytes);

}  // namespace d2b
