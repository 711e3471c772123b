// Outlines of any small grid stay valid, nested and disjoint where they are simplified or get straight walls.
#include <array>

#include "fuzz/bytes.hpp"
#include "outline/outline.hpp"
#include "support/outline_checks.hpp"

namespace d2b::test {
namespace {

outline::OutlineRules rules_of(Bytes& bytes, bool walls) {
    outline::OutlineRules rules;
    const unsigned size = bytes.next();
    if (walls) {
        rules.walls = std::array{Walls::automatic, Walls::free, Walls::right}[bytes.below(3)];
        rules.wall_tolerance = 0.5 + size % 4 * 0.5;
    } else {
        rules.simplify = 0.5 + size % 8 * 0.5;
    }
    return rules;
}

}  // namespace
}  // namespace d2b::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b::test;
    Bytes bytes(data, size);
    const bool walls = bytes.next() % 2 == 0;
    d2b::outline::OutlineRules rules = rules_of(bytes, walls);
    const RandomGridCase c = grid_of(bytes, 20);
    if (size % 2 == 1)
        rules.frame = {{0, 0}, {c.grid.rows, c.grid.cols}};
    d2b::Context context;
    const ContourSet set = trace_grid(c.grid, c.thresholds, {c.mode}, context);
    const d2b::outline::OutlineMethod drawing =
        walls ? d2b::outline::OutlineMethod::regularized : d2b::outline::OutlineMethod::simplified;
    const d2b::outline::Outliner outliner(*set.list, drawing, rules, unit_grid, 1, context);
    demand_none(nesting_fault(set, outliner));
    return 0;
}
