#include "surface/plan_outlines.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "surface/faces.hpp"

namespace d2b::surface {

PlanOutlines plan_outlines(const PlanarPartition& plan, std::span<const PartitionContour> contours,
                           const StopToken& stop) {
    // Edges per contour that have it, or a contour on top of it, on one side alone.
    std::vector<PlanarPartition> parts(contours.size());
    const auto parent = [&](std::int32_t contour) {
        return contours[static_cast<std::size_t>(contour)].parent;
    };
    const auto is_on = [&](std::int32_t contour, std::int32_t below) {
        while (contour != open_ground && contour != below)
            contour = parent(contour);
        return contour == below;
    };
    for (const PartitionEdge& edge : plan.edges)
        for (const auto& [from, to, in, out] : {std::tuple(edge.from, edge.to, edge.left, edge.right),
                                                std::tuple(edge.to, edge.from, edge.right, edge.left)})
            for (std::int32_t c = in; c != open_ground && !is_on(out, c); c = parent(c))
                parts[static_cast<std::size_t>(c)].edges.push_back({from, to, c, open_ground});
    PlanOutlines result;
    for (std::uint32_t c = 0; c < parts.size(); ++c) {
        stop.check();
        PlanarPartition& part = parts[c];
        // Renumbers its own nodes, because copying all nodes per contour would take quadratic time.
        std::vector<std::uint32_t> used;
        for (const PartitionEdge& edge : part.edges)
            used.insert(used.end(), {edge.from, edge.to});
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (const std::uint32_t node : used)
            part.nodes.push_back(plan.nodes[node]);
        const auto number = [&](std::uint32_t node) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(used, node) - used.begin());
        };
        for (PartitionEdge& edge : part.edges) {
            edge.from = number(edge.from);
            edge.to = number(edge.to);
        }
        std::vector<OwnedFace> faces = partition_faces(part);
        std::erase_if(faces, [](const OwnedFace& face) { return face.owner == open_ground; });
        if (faces.size() == 1)
            result.outlines.push_back(polygon_of(faces.front().face, part));
        else
            result.broken.push_back(c);
    }
    return result;
}

}  // namespace d2b::surface
