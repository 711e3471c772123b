#include "contours/natural_breaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace d2b::contours {
namespace {

// Multiplied or divided by 10, because 0.1 is not a binary number.
constexpr double bins_a_metre = 10;
// Limit that lets bin indices fit into 64 bits for any elevation.
constexpr double farthest = 1e15;

/// Merges pairs of bins into bins of twice the width.
std::vector<HistogramBin> paired(const std::vector<HistogramBin>& bins) {
    std::vector<HistogramBin> pairs;
    for (const HistogramBin& bin : bins) {
        const std::int64_t pair = bin.bin >> 1;
        if (pairs.empty() || pairs.back().bin != pair)
            pairs.push_back({pair, 0});
        pairs.back().points += bin.points;
    }
    return pairs;
}

constexpr double impossible = std::numeric_limits<double>::infinity();

/// Squared errors of classes of bins, in squared bins, from prefix sums.
class ClassError {
  public:
    explicit ClassError(std::span<const HistogramBin> bins) : sums_(bins.size() + 1) {
        for (std::size_t i = 0; i < bins.size(); ++i) {
            const auto n = static_cast<double>(bins[i].points);
            // Relative to the lowest bin, because small numbers keep their digits when they are squared.
            const auto x = static_cast<double>(bins[i].bin - bins[0].bin);
            sums_[i + 1] = {sums_[i].n + n, sums_[i].x + n * x, sums_[i].xx + n * x * x};
        }
    }
    /// Returns the error of bins [begin, end), which are not empty.
    [[nodiscard]] double operator()(std::size_t begin, std::size_t end) const {
        const double n = sums_[end].n - sums_[begin].n;
        const double x = sums_[end].x - sums_[begin].x;
        return std::max(0.0, sums_[end].xx - sums_[begin].xx - x * x / n);
    }

  private:
    struct Sums {
        double n = 0;
        double x = 0;
        double xx = 0;
    };
    std::vector<Sums> sums_;
};

/// Row of the dynamic programme. By break (index of the first bin of a class): the least error of all
/// classes below it, and the previous break.
struct BreakRow {
    std::vector<double> error;
    std::vector<std::uint32_t> before;
};

/// Breaks whose best previous break lies within a range.
struct Task {
    std::size_t first;
    std::size_t last;
    std::size_t lowest;
    std::size_t highest;
};

/// Adds a class below each of the breaks first ... size.
/// @param room room(a, b): true if break b may follow break a
template <typename Room>
BreakRow with_one_more(const BreakRow& below, const ClassError& error, std::size_t first, const Room& room) {
    const std::size_t size = below.error.size() - 1;
    BreakRow row{std::vector<double>(size + 1, impossible), std::vector<std::uint32_t>(size + 1, 0)};
    std::vector<Task> tasks{{first, size, 1, size}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        const std::size_t at = task.first + (task.last - task.first) / 2;
        std::size_t best = task.lowest;
        for (std::size_t before = task.lowest; before <= task.highest && before < at; ++before) {
            if (!room(before, at))
                break;
            const double e = below.error[before] + error(before, at);
            if (e < row.error[at]) {
                row.error[at] = e;
                best = before;
            }
        }
        row.before[at] = static_cast<std::uint32_t>(best);
        if (task.first < at)
            tasks.push_back({task.first, at - 1, task.lowest, best});
        if (at < task.last)
            tasks.push_back({at + 1, task.last, best, task.highest});
    }
    return row;
}

std::vector<std::int64_t> followed_back(const std::vector<BreakRow>& rows, std::size_t highest,
                                        std::span<const HistogramBin> bins) {
    std::vector<std::int64_t> breaks{bins[highest].bin};
    for (std::size_t k = rows.size() - 1; k > 0; --k) {
        highest = rows[k].before[highest];
        breaks.push_back(bins[highest].bin);
    }
    std::ranges::reverse(breaks);
    return breaks;
}

}  // namespace

void ElevationHistogram::add(double elevation_m, std::int64_t points) {
    const double end = std::clamp(std::ceil(elevation_m * bins_a_metre), -farthest, farthest);
    points_[static_cast<std::int64_t>(end) - 1] += points;
}

ElevationHistogram::Bins ElevationHistogram::bins(std::size_t most) const {
    Bins result{1 / bins_a_metre, {}};
    for (const auto& [bin, points] : points_)
        result.bins.push_back({bin, points});
    double width = 1;
    while (result.bins.size() > std::max<std::size_t>(most, 2)) {
        result.bins = paired(result.bins);
        width *= 2;
    }
    result.width_m = width / bins_a_metre;
    return result;
}

std::vector<std::int64_t> natural_breaks(std::span<const HistogramBin> bins, int most,
                                         std::int64_t least_bins, const BreakPenalty& price) {
    if (bins.size() < 2)
        return {};
    const ClassError error(bins);
    // The highest class has no break above it and may be narrow, so that two peaks are separated.
    const auto room = [&](std::size_t before, std::size_t at) {
        return at == bins.size() || bins[at].bin - bins[before].bin >= least_bins;
    };
    std::vector<BreakRow> rows(1);  // rows[k]: k breaks below a break
    rows[0].error.assign(bins.size() + 1, impossible);
    for (std::size_t end = 1; end <= bins.size(); ++end)
        if (room(0, end))
            rows[0].error[end] = error(0, end);
    double last_error = rows[0].error.back();
    const double price_of_break = price.fixed + price.share * last_error;
    double least_cost = last_error;
    std::vector<std::int64_t> breaks;
    for (int k = 1; k <= most; ++k) {
        const BreakRow whole =
            with_one_more(rows.back(), error, bins.size(), [](std::size_t, std::size_t) { return true; });
        if (!(whole.error.back() < last_error))
            break;
        last_error = whole.error.back();
        if (const double cost = last_error + k * price_of_break; cost < least_cost) {
            least_cost = cost;
            breaks = followed_back(rows, whole.before.back(), bins);
        }
        rows.push_back(with_one_more(rows.back(), error, 1, room));
        rows[rows.size() - 2].error = {};  // only the back pointers are needed
    }
    return breaks;
}

}  // namespace d2b::contours
