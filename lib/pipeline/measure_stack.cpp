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

std::vector<StackError> measure_cuts(const DrawnStack& stack, std::int32_t levels, const FixedPoint& fixed,
                                     ElevationReader& reader) {
    std::vector<StackError> errors(static_cast<std::size_t>(levels));
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::attributes);
            return stack.errors_by_level(band, fixed, levels);
        },
        [&](const ElevationBand&, const std::vector<StackError>& of_band) {
            for (std::size_t i = 0; i < errors.size(); ++i)
                errors[i].merge(of_band[i]);
        });
    return errors;
}

}  // namespace d2b
