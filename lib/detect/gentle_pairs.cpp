#include "detect/gentle_pairs.hpp"

#include <cmath>
#include <cstddef>
#include <span>

namespace d2b {
namespace {

constexpr double steepest = 0.55;

}  // namespace

void GentlePairs::add(const Scene& scene, const Mask& objects, std::int32_t r, const RegionRun& run) {
    const std::span<const float> here = scene.surface.row(r);
    const auto begin = static_cast<std::size_t>(run.begin);
    const auto end = static_cast<std::size_t>(run.end);
    // Comparisons with NaN are false, so unknown heights do not count as gentle.
    const auto across = static_cast<float>(steepest * scene.cell.across);
    int gentle = 0;
    for (std::size_t c = begin; c + 1 < end; ++c)
        gentle += std::abs(here[c] - here[c + 1]) < across ? 1 : 0;
    auto pairs = run.end - run.begin - 1;
    if (r + 1 < objects.rows) {
        const std::span<const float> below = scene.surface.row(r + 1);
        const std::span<const std::uint8_t> object_below = objects.row(r + 1);
        const auto down = static_cast<float>(steepest * scene.cell.down);
        for (std::size_t c = begin; c < end; ++c) {
            pairs += object_below[c];
            gentle += object_below[c] != 0 && std::abs(here[c] - below[c]) < down ? 1 : 0;
        }
    }
    pairs_ += pairs;
    gentle_ += gentle;
}

double GentlePairs::share() const {
    return pairs_ > 0 ? static_cast<double>(gentle_) / static_cast<double>(pairs_) : 1;
}

}  // namespace d2b
