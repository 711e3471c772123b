#include "outline/walls/chain_drawing.hpp"

#include <algorithm>
#include <utility>

#include "outline/walls/compose_chain.hpp"

namespace d2b {
namespace {

constexpr double snapping = 0.002;  // cells that rounding to the fine lattice may move a vertex
// Cells. Walls of tiers, which are many and short, stay closer to their traces than those of footprints
// because beyond half a cell every row of cells on the wrong side costs more than the saved vertices are
// worth.
constexpr double tier_tolerance = 0.85;
constexpr double longest_side =
    2;  // cells; limits the longer side because that of sheared cells says nothing about their staircases
constexpr int most_followings = 4;  // limits the iterations; each one leaves less that is far from the trace

WallStyle style_for(const Chain& chain, const WallOptions& options) {
    const bool tier = chain.rank > WallGraph::highest_low_rank;
    return {.walls = options.walls,
            .tolerance = tier ? std::min(options.tolerance, tier_tolerance) : options.tolerance,
            .inset = options.inset,
            .side = std::min(longest_side, options.shape.longer_side())};
}

/// Factor of the price of a wall for small tolerances. On coarse cells and for tiers, walls of a few cells
/// are frequent and details of one cell are wanted.
double share_of_price(double tolerance) {
    constexpr double usual = 1.25;  // cells
    const double share = std::min(1.0, tolerance / usual);
    return share * share * share * share;
}

}  // namespace

ChainDrawing::ChainDrawing(const Chain& chain, const WallOptions& options)
    : origin_(chain.trace.front()),
      shape_(options.shape),
      style_(style_for(chain, options)),
      limit_(style_.tolerance - snapping),
      walls_(chain, options.shape),
      turning_points_(turning_points(samples())),
      middles_(samples(), shape_, origin_, chain.node_steps, limit_) {}

std::optional<double> ChainDrawing::plan(double price, double direction, const StopRequest& stop) {
    WallStyle style = style_;
    style.price = price * share_of_price(style.tolerance);
    if (!walls_.plan(turning_points_, style, direction, stop))
        return {};
    planned_.reset();
    return direction;
}

const DrawnChain& ChainDrawing::draw_planned(const std::optional<ChainEnds>& ends) {
    if (!planned_ || ends != ends_of_planned_) {
        planned_ = draw_walls(samples(), style_, shape_, origin_, walls_.pieces(), ends);
        ends_of_planned_ = ends;
    }
    return *planned_;
}

bool ChainDrawing::walls_are_near(const std::optional<ChainEnds>& ends) {
    return draw_planned(ends).deviation <= limit_;
}

/// True if this is a line, or a ring with the orientation of its trace.
bool ChainDrawing::is_sound(const DrawnChain& drawn) const {
    if (!samples().closed())
        return drawn.vertices.size() >= 2;
    return drawn.vertices.size() >= 3 &&
           twice_area(drawn.vertices, shape_, origin_) * twice_area(samples()) > 0;
}

DrawnChain ChainDrawing::draw(ChainForm& form, const std::optional<ChainEnds>& ends) {
    DrawnChain planned;
    if (form.has_walls()) {
        draw_planned(ends);
        planned =
            *std::exchange(planned_, {});  // released because few chains are drawn twice and many are pending
    }
    const auto compose = [&] {
        return compose_chain(samples(), shape_, origin_, form, middles_, planned, ends);
    };
    DrawnChain drawn = compose();
    for (int i = 0; i < most_followings && drawn.deviation > limit_; ++i) {
        if (!follow_where_far(samples(), shape_, origin_, limit_, drawn, form))
            break;
        drawn = compose();
    }
    while (!is_sound(drawn) && form.follow_closer(0, samples().steps(), 0))
        drawn = compose();
    return drawn;
}

}  // namespace d2b
