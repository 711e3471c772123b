#include "compare/match_buildings.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

#include "core/disjoint_sets.hpp"
#include "geometry/box_tree.hpp"
#include "score/measure.hpp"

namespace d2b::compare {
namespace {

constexpr double matching_share = 0.5;

std::uint32_t set_element(std::size_t i) {
    return static_cast<std::uint32_t>(i);
}

/// Buildings of the other survey in the place of one building.
struct Coverage {
    double share = 0;
    double most = 0;
    std::size_t by = 0;  ///< index of the building that shares most

    void add(double part, std::size_t index) {
        share += part;
        if (part > most) {
            most = part;
            by = index;
        }
    }
};

}  // namespace

std::vector<SharedArea> shared_areas(std::span<const Polygons> old_outlines,
                                     std::span<const Polygons> new_outlines, Overlay& overlay) {
    std::vector<Box> boxes;
    boxes.reserve(new_outlines.size());
    for (const Polygons& outline : new_outlines)
        boxes.push_back(box_of(outline));
    const BoxTree tree(boxes);
    std::vector<SharedArea> all;
    for (std::size_t i = 0; i < old_outlines.size(); ++i) {
        const Polygons& outline = old_outlines[i];
        const double old_area = score::area_of(outline);
        std::vector<std::size_t> near;
        tree.query(box_of(outline), [&](std::size_t k) { near.push_back(k); });
        std::ranges::sort(near);
        for (const std::size_t k : near) {
            const double area = score::area_of(overlay.intersection(outline, new_outlines[k]));
            if (area > 0)
                all.push_back({i, k, score::share(area, old_area),
                               score::share(area, score::area_of(new_outlines[k]))});
        }
    }
    return all;
}

std::vector<MatchedBuildings> match_buildings(std::size_t old_count, std::size_t new_count,
                                              std::span<const SharedArea> shared) {
    // New buildings come first, then the old ones.
    DisjointSets sets(set_element(new_count + old_count));
    std::vector<Coverage> coverage(new_count + old_count);
    std::vector<bool> is_matched(new_count + old_count, false);
    const auto match = [&](std::size_t one, std::size_t other) {
        sets.join(set_element(one), set_element(other));
        is_matched[one] = is_matched[other] = true;
    };
    for (const SharedArea& pair : shared) {
        const std::size_t of_old = new_count + pair.old_index;
        coverage[of_old].add(pair.of_old, pair.new_index);
        coverage[pair.new_index].add(pair.of_new, of_old);
        if (std::max(pair.of_old, pair.of_new) >= matching_share)
            match(pair.new_index, of_old);
    }
    for (std::size_t i = 0; i < coverage.size(); ++i)
        if (!is_matched[i] && coverage[i].share >= matching_share)
            match(i, coverage[i].by);

    std::map<std::uint32_t, MatchedBuildings> by_root;
    for (std::size_t i = 0; i < coverage.size(); ++i) {
        MatchedBuildings& one = by_root[sets.find(set_element(i))];
        if (i < new_count)
            one.new_indices.push_back(i);
        else
            one.old_indices.push_back(i - new_count);
    }
    std::vector<MatchedBuildings> all;
    all.reserve(by_root.size());
    for (auto& [root, one] : by_root)  // the root is the smallest element
        all.push_back(std::move(one));
    return all;
}

}  // namespace d2b::compare
