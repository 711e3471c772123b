#include "preview/relief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace d2b {
namespace {

/// The points that are looked at: one a pixel, or each one where pixels are finer.
class Samples {
  public:
    Samples(DemSource& dem, const MapFrame& frame)
        : dem_(dem),
          bottom_up_(frame.bottom_up()),
          right_to_left_(frame.right_to_left()),
          window_(dem.info().window),
          cols_(std::min(frame.width(), window_.cols)),
          rows_(std::min(frame.height(), window_.rows)),
          buffer_(static_cast<std::size_t>(window_.cols)) {}

    [[nodiscard]] int cols() const { return cols_; }
    [[nodiscard]] int rows() const { return rows_; }
    /// Points from one to the next, at least one.
    [[nodiscard]] double step() const { return static_cast<double>(window_.cols) / cols_; }
    /// A row of them; beyond the last it is the last.
    [[nodiscard]] std::vector<double> row(int number) {
        number = std::clamp(number, 0, rows_ - 1);
        const std::int64_t at = middle(bottom_up_ ? rows_ - 1 - number : number, window_.rows, rows_);
        dem_.read(window_.row + static_cast<std::int32_t>(at), 1, buffer_);
        std::vector<double> elevations;
        elevations.reserve(static_cast<std::size_t>(cols_));
        for (int col = 0; col < cols_; ++col)
            elevations.push_back(buffer_[static_cast<std::size_t>(
                middle(right_to_left_ ? cols_ - 1 - col : col, window_.cols, cols_))]);
        return elevations;
    }

  private:
    static std::int64_t middle(int sample, std::int64_t points, int samples) {
        return (2 * std::int64_t{sample} + 1) * points / (2 * std::int64_t{samples});
    }

    DemSource& dem_;
    bool bottom_up_;
    bool right_to_left_;
    Window window_;
    int cols_;
    int rows_;
    std::vector<double> buffer_;
};

double rise_between(double from, double to, double here) {
    return (std::isnan(to) ? here : to) - (std::isnan(from) ? here : from);
}

Colour shade_of(double to_east, double to_south) {
    // Light from the upper left, 45 degrees high.
    constexpr double third = 0.57735026918962573;
    const double light =
        (1 + to_east + to_south) * third / std::sqrt(1 + to_east * to_east + to_south * to_south);
    constexpr double dark = 70;
    constexpr double flat = 205;
    const double shade = std::clamp(dark + (flat - dark) * light / third, dark, 250.0);
    const auto grey = static_cast<std::uint8_t>(shade);
    return {grey, grey, grey};
}

/// The first pixel of a sample's.
int pixel(int sample, int pixels, int samples) {
    return static_cast<int>((std::int64_t{sample} * pixels + samples - 1) / samples);
}

}  // namespace

void draw_relief(DemSource& dem, const MapFrame& frame, double rise, Canvas& canvas) {
    constexpr Colour white{255, 255, 255};
    Samples samples(dem, frame);
    const double per_step = rise / (2 * samples.step());
    std::vector<double> above = samples.row(0);
    std::vector<double> here = above;
    for (int row = 0; row < samples.rows(); ++row) {
        std::vector<double> below = samples.row(row + 1);
        const int top = pixel(row, frame.height(), samples.rows());
        const int bottom = pixel(row + 1, frame.height(), samples.rows());
        for (int col = 0; col < samples.cols(); ++col) {
            const auto i = static_cast<std::size_t>(col);
            const double west = here[col > 0 ? i - 1 : i];
            const double east = here[col + 1 < samples.cols() ? i + 1 : i];
            const int left = pixel(col, frame.width(), samples.cols());
            canvas.box(left, top, pixel(col + 1, frame.width(), samples.cols()) - left, bottom - top,
                       std::isnan(here[i]) ? white
                                           : shade_of(rise_between(west, east, here[i]) * per_step,
                                                      rise_between(above[i], below[i], here[i]) * per_step));
        }
        above = std::move(here);
        here = std::move(below);
    }
}

}  // namespace d2b
