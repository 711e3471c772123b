#include "trace/simple_rings.hpp"

#include <algorithm>
#include <map>

namespace d2b {

std::vector<std::vector<Corner>> split_at_pinches(std::span<const Corner> outline) {
    std::vector<std::vector<Corner>> rings;
    std::vector<Corner> path;
    std::map<LatticePoint, std::size_t> passed;  // non-manifold vertices on the path and their indices
    for (const Corner& corner : outline) {
        if (corner.pinch) {
            const auto [place, is_new] = passed.try_emplace(corner.at, path.size());
            if (!is_new) {
                const auto loop = path.begin() + static_cast<std::ptrdiff_t>(place->second);
                rings.emplace_back(loop, path.end());
                // The last edge of the loop leads here on the second visit.
                rings.back().front().outside = corner.outside;
                for (auto dropped = loop + 1; dropped != path.end(); ++dropped)
                    if (dropped->pinch)
                        passed.erase(dropped->at);
                path.erase(loop + 1, path.end());
                continue;
            }
        }
        path.push_back(corner);
    }
    rings.push_back(std::move(path));
    return rings;
}

}  // namespace d2b
