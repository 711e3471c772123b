#include "outline/walls/compose_chain.hpp"

#include <algorithm>
#include <cstdint>

namespace d2b {
namespace {

constexpr std::size_t steps_beside = 2;  // steps on either side of a step that is too far from its trace

class Composer {
  public:
    Composer(const WallSamples& samples, const CellShape& shape, LatticePoint origin, const DrawnChain& walls)
        : samples_(samples), shape_(shape), origin_(origin), walls_(walls) {}
    /// Appends a stretch of walls.
    void append(const ChainForm::Stretch& stretch, DrawnChain& chain) const;

  private:
    [[nodiscard]] std::size_t count() const { return walls_.vertices.size(); }
    /// Indices of a closed chain wrap around.
    [[nodiscard]] FinePoint vertex(std::size_t k) const { return walls_.vertices[k % count()]; }
    [[nodiscard]] std::size_t step(std::size_t k) const {
        return walls_.steps[k % count()] + k / count() * samples_.steps();
    }
    [[nodiscard]] FinePoint at(std::size_t edge, std::size_t step) const;

    const WallSamples& samples_;
    const CellShape& shape_;
    LatticePoint origin_;
    const DrawnChain& walls_;
};

/// Point of an edge that corresponds to a step.
FinePoint Composer::at(std::size_t edge, std::size_t step) const {
    const Vec from = shape_.from_fine(vertex(edge), origin_);
    const Vec to = shape_.from_fine(vertex(edge + 1), origin_);
    return shape_.to_fine(from + nearest_share(samples_.at(step), from, to) * (to - from), origin_);
}

void Composer::append(const ChainForm::Stretch& stretch, DrawnChain& chain) const {
    const bool open = !samples_.closed();
    // The walls of a closed chain may begin later than its steps.
    std::size_t first = stretch.first;
    std::size_t last = stretch.last;
    const std::size_t lap = !open && first < step(0) ? samples_.steps() : 0;
    first += lap;
    last += lap;
    std::size_t k = 0;
    while (step(k + 1) <= first && (!open || k + 2 < count()))
        ++k;
    if (!open || stretch.first > 0)
        chain.add(at(k, first), stretch.first);
    for (++k; step(k) < last && (!open || k + 1 < count()); ++k) {
        if (step(k) <= first)
            continue;
        chain.add(vertex(k), step(k) - lap);
        const auto own = std::ranges::find(walls_.arcs, k % count(), &CircularArc::first);
        if (own != walls_.arcs.end() && step(k + own->edges) < last)
            chain.arcs.push_back({0, static_cast<std::uint32_t>(chain.vertices.size() - 1), own->edges});
    }
    if (!open || stretch.last < samples_.steps())
        chain.add(at(k - 1, last), stretch.last);
    else
        chain.add(walls_.vertices.back(), samples_.steps());
}

}  // namespace

DrawnChain compose_chain(const WallSamples& samples, const CellShape& shape, LatticePoint origin,
                         const ChainForm& form, const Middles& middles, const DrawnChain& walls,
                         const std::optional<ChainEnds>& ends) {
    const std::vector<ChainForm::Stretch> stretches = form.stretches();
    if (stretches.size() == 1 && stretches.front().form == Form::walls)
        return walls;
    DrawnChain chain;
    if (ends)
        chain.add(ends->first, 0);
    const Composer composer(samples, shape, origin, walls);
    for (const ChainForm::Stretch& stretch : stretches) {
        const bool at_end = ends && stretch.last == samples.steps();
        if (stretch.form == Form::walls)
            composer.append(stretch, chain);
        else
            middles.append(stretch, at_end ? &ends->last : nullptr, chain);
    }
    // Both ends may have moved to the same point; comparing all chains detects that later.
    if (ends && chain.vertices.size() == 1) {
        chain.vertices.push_back(ends->last);
        chain.steps.push_back(samples.steps());
    }
    if (!ends && chain.vertices.size() > 1 && chain.vertices.front() == chain.vertices.back())
        chain.remove_last();
    chain.deviation = deviation(samples, shape, origin, chain, samples.closed());
    return chain;
}

bool follow_where_far(const WallSamples& samples, const CellShape& shape, LatticePoint origin, double limit,
                      const DrawnChain& drawn, ChainForm& form) {
    bool changed = false;
    // The ends of a chain are excluded, because they follow the chain they end on.
    const auto at_end = [&](std::size_t step) {
        return !samples.closed() && (step <= steps_beside || step + steps_beside >= samples.steps());
    };
    for_distances(samples, shape, origin, drawn, samples.closed(), [&](std::size_t step, double square) {
        if (square > limit * limit && !at_end(step))
            changed = form.raise(step, step + 1, steps_beside, Form::middles) || changed;
    });
    return changed;
}

}  // namespace d2b
