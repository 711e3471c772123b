#include "pipeline/tiles/draw_margin.hpp"

#include "pipeline/feature_input.hpp"

namespace d2b {
namespace {

class NoContours final : public ContourList {
  public:
    [[nodiscard]] std::size_t size() const override { return 0; }
    [[nodiscard]] const ContourHead& head(std::size_t /*contour*/) const override { return none_; }
    [[nodiscard]] Contour fetch(std::size_t /*contour*/) const override { return {}; }

  private:
    ContourHead none_;
};

}  // namespace

LatticePoint draw_reach(const RunSetup& setup, Context& context) {
    // One more cell, because contours run along cell borders or through cell centres depending on the trace
    // mode.
    const LatticePoint cells = reach_of(NoContours(), setup, context).cells;
    return {cells.row + 1, cells.col + 1};
}

LatticePoint draw_margin(const RunSetup& setup, Context& context) {
    const LatticePoint reach = draw_reach(setup, context);
    return {reach.row + 1, reach.col + 1};
}

}  // namespace d2b
