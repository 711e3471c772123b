#include "write/page_relief.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b {
namespace {

/// Limit that a browser without a graphics card can render, with twice as many triangles, in a fraction of a
/// second.
constexpr std::int32_t most_samples_a_side = 400;

std::int32_t samples(std::int32_t cells, std::int32_t step) {
    return (cells + step - 1) / step;
}

class PageReliefSink final : public RasterSink {
  public:
    explicit PageReliefSink(std::shared_ptr<PageRelief> relief) : relief_(std::move(relief)) {}

    void write(const Window& part, std::span<const float> values) override { relief_->add(part, values); }
    void finish() override {}

  private:
    std::shared_ptr<PageRelief> relief_;
};

}  // namespace

PageRelief::PageRelief(const Window& window, bool lowest)
    : window_(window),
      lowest_(lowest),
      step_(std::max(1, samples(std::max(window.rows, window.cols), most_samples_a_side))),
      rows_(samples(window.rows, step_)),
      cols_(samples(window.cols, step_)),
      values_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_)),
      counts_(values_.size()) {}

void PageRelief::add(const Window& part, std::span<const float> values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto at = static_cast<std::int32_t>(i);
        const std::int32_t row = (part.row - window_.row + at / part.cols) / step_;
        const std::int32_t col = (part.col - window_.col + at % part.cols) / step_;
        const auto sample =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(col);
        const auto value = static_cast<double>(values[i]);
        if (std::isnan(value))
            continue;
        if (!lowest_)
            values_[sample] += value;
        else if (counts_[sample] == 0 || value < values_[sample])
            values_[sample] = value;
        ++counts_[sample];
    }
}

std::optional<std::int64_t> PageRelief::centimetres(std::size_t sample) const {
    if (counts_[sample] == 0)
        return std::nullopt;
    return std::llround(100 * (lowest_ ? values_[sample] : values_[sample] / counts_[sample]));
}

PackedNumbers PageRelief::packed() const {
    PackedNumbers numbers;
    std::int64_t above = 0;
    for (std::int32_t row = 0; row < rows_; ++row) {
        std::int64_t before = above;
        for (std::int32_t col = 0; col < cols_; ++col) {
            const auto sample = static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                                static_cast<std::size_t>(col);
            const auto height = centimetres(sample);
            if (!height) {
                numbers.put(0);
                continue;
            }
            const std::int64_t rise = *height - before;
            numbers.put((rise < 0 ? ~(static_cast<std::uint64_t>(rise) << 1U)
                                  : static_cast<std::uint64_t>(rise) << 1U) +
                        1);
            before = *height;
            if (col == 0)
                above = before;
        }
    }
    return numbers;
}

std::unique_ptr<RasterSink> open_page_relief(std::shared_ptr<PageRelief> relief) {
    return std::make_unique<PageReliefSink>(std::move(relief));
}

}  // namespace d2b
