#include "surface/straighten.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "outline/fine_geometry.hpp"

namespace d2b {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Degree of a node and its first two edges.
struct Ends {
    std::uint32_t count = 0;
    std::array<std::uint32_t, 2> edges{none, none};
};

class Straightener {
  public:
    explicit Straightener(Plan& plan) : plan_(plan), ends_(plan.nodes.size()), gone_(plan.edges.size()) {
        for (std::uint32_t e = 0; e < plan.edges.size(); ++e)
            for (const std::uint32_t node : {plan.edges[e].from, plan.edges[e].to}) {
                Ends& ends = ends_[node];
                if (ends.count < ends.edges.size())
                    ends.edges[ends.count] = e;
                ++ends.count;
            }
    }

    void run(Straighten what) {
        for (std::uint32_t node = 0; node < ends_.size(); ++node)
            if (ends_[node].count == 2 && goes_straight_on(node, what))
                join(node);
        std::size_t next = 0;
        std::erase_if(plan_.edges, [&](const PlanEdge&) { return gone_[next++]; });
    }

  private:
    [[nodiscard]] std::uint32_t other_end(std::uint32_t e, std::uint32_t node) const {
        const PlanEdge& edge = plan_.edges[e];
        return edge.from == node ? edge.to : edge.from;
    }
    [[nodiscard]] bool goes_straight_on(std::uint32_t node, Straighten what) const {
        const auto [a, b] = ends_[node].edges;
        const PlanEdge& edge = plan_.edges[a];
        if (what == Straighten::inside && (edge.left == open_ground || edge.right == open_ground))
            return false;
        return side(plan_.nodes[other_end(a, node)], plan_.nodes[node], plan_.nodes[other_end(b, node)]) == 0;
    }
    void join(std::uint32_t node) {
        const auto [stays, goes] = ends_[node].edges;
        const std::uint32_t far = other_end(goes, node);
        PlanEdge& edge = plan_.edges[stays];
        (edge.from == node ? edge.from : edge.to) = far;
        for (std::uint32_t& e : ends_[far].edges)
            if (e == goes)
                e = stays;
        gone_[goes] = true;
        ends_[node].count = 0;
    }

    Plan& plan_;
    std::vector<Ends> ends_;
    std::vector<bool> gone_;
};

}  // namespace

void straighten(Plan& plan, Straighten what) {
    Straightener(plan).run(what);
}

}  // namespace d2b
