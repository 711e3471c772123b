// Outlines of any small grid stay valid, nested and disjoint where they are simplified or get straight walls.
#include <array>

#include "fuzz/bytes.hpp"
#include "outline/outline.hpp"
#include "support/outline_checks.hpp"

namespace d2b::test {
namespace {

OutlineOptions options_of(Bytes& bytes, bool walls) {
    OutlineOptions options;
    const unsigned size = bytes.next();
    if (walls) {
        options.walls = std::array{Walls::automatic, Walls::free, Walls::right}[bytes.below(3)];
        options.wall_tolerance = 0.5 + size % 4 * 0.5;
    } else {
        options.simplify = 0.5 + size % 8 * 0.5;
    }
    return options;
}

}  // namespace
}  // namespace d2b::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b::test;
    Bytes bytes(data, size);
    const bool walls = bytes.next() % 2 == 0;
    const d2b::OutlineOptions options = options_of(bytes, walls);
    const RandomGridCase c = grid_of(bytes, 20);
    d2b::Context context;
    const ContourSet set = trace_grid(c.grid, c.thresholds, {c.mode}, context);
    const d2b::Drawing drawing = walls ? d2b::Drawing::regularized : d2b::Drawing::simplified;
    const d2b::Outliner outliner(*set.list, drawing, options, unit_grid, 1, context);
    demand_none(nesting_fault(set, outliner));
    return 0;
}
