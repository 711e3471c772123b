#include "pipeline/measure_stack.hpp"

#include "core/stage_clock.hpp"

namespace d2b {

StackError measure_stack(const DrawnStack& stack, const FixedPoint& fixed, ElevationReader& reader) {
    StackError error;
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::attributes);
            return stack.error(band, fixed);
        },
        [&](const ElevationBand&, const StackError& of_band) { error.merge(of_band); });
    return error;
}

}  // namespace d2b
