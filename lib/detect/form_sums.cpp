#include "detect/form_sums.hpp"

#include <cmath>
#include <numbers>

namespace d2b {
namespace {

/// Returns 0^2 + 1^2 + ... + n^2; for negative n, minus the sum of squares from n + 1 to 0.
double squares_to(double n) {
    return n * (n + 1) * (2 * n + 1) / 6;
}

}  // namespace

void FormSums::add(std::int32_t r, const RegionRun& run) {
    if (cells_ == 0) {
        first_row_ = r;
        first_col_ = run.begin;
    }
    const double y = r - first_row_;
    const double first = run.begin - first_col_;
    const double last = run.end - 1 - first_col_;
    const double n = last - first + 1;
    const double across = n * (first + last) / 2;
    cells_ += n;
    down_ += n * y;
    across_ += across;
    down_down_ += n * y * y;
    across_across_ += squares_to(last) - squares_to(first - 1);
    down_across_ += y * across;
}

double FormSums::compactness() const {
    if (cells_ == 0)
        return 1;
    constexpr double within_a_cell = 1.0 / 12;
    const double down = down_ / cells_;
    const double across = across_ / cells_;
    const double down_down = down_down_ / cells_ - down * down + within_a_cell;
    const double across_across = across_across_ / cells_ - across * across + within_a_cell;
    const double down_across = down_across_ / cells_ - down * across;
    const double spread = down_down * across_across - down_across * down_across;
    return cells_ / (4 * std::numbers::pi * std::sqrt(spread));
}

}  // namespace d2b
