#include "features/write_features.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "features/feature_writer.hpp"

namespace d2b {

void write_features(const FeatureInput& input, const RecordMaker& records, FeatureSink& sink,
                    Context& context) {
    constexpr std::size_t piece = 64;  // contours per task
    FeatureWriter writer(input, records, sink, context);
    writer.begin();
    GivenNumbers numbers;
    const std::size_t count = input.contours.size();
    context.threads->in_order(
        (count + piece - 1) / piece,
        [&](std::size_t k, std::size_t thread) {
            std::vector<DrawnContour> drawn;
            for (std::size_t i = k * piece; i < std::min(count, (k + 1) * piece); ++i)
                drawn.push_back(writer.drawer().draw(i, thread));
            return drawn;
        },
        [&](std::size_t k, std::vector<DrawnContour> drawn) {
            for (std::size_t i = 0; i < drawn.size(); ++i)
                writer.add(numbers, k * piece + i, std::move(drawn[i]));
            context.progress(static_cast<double>(k * piece) / static_cast<double>(count));
        });
    writer.finish();
}

}  // namespace d2b
