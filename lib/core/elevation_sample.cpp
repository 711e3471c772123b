#include "core/elevation_sample.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

constexpr std::size_t largest_list = std::size_t{1} << 18;

}  // namespace

std::uint16_t ElevationRange::bin(double elevation) const {
    // Halves, so that the range of the largest doubles does not overflow.
    const double range = maximum / 2 - minimum / 2;
    if (!(range > 0))
        return 0;
    const double share = (elevation / 2 - minimum / 2) / range;
    return static_cast<std::uint16_t>(std::clamp(share * bins, 0.0, double{bins - 1}));
}

double ElevationRange::elevation(std::uint32_t bin) const {
    const double share = (bin + 0.5) / bins;
    return minimum * (1 - share) + maximum * share;
}

void ElevationSample::add(std::uint16_t bin) {
    ++size_;
    if (!histogram_.empty()) {
        ++histogram_[bin];
        return;
    }
    values_.push_back(bin);
    if (values_.size() > largest_list)
        make_histogram();
}

void ElevationSample::make_histogram() {
    histogram_.assign(ElevationRange::bins, 0);
    for (const std::uint16_t bin : values_)
        ++histogram_[bin];
    values_ = {};
}

void ElevationSample::merge(ElevationSample& other) {
    if (size_ < other.size_)
        std::swap(*this, other);
    size_ += other.size_;
    if (histogram_.empty())
        values_.insert(values_.end(), other.values_.begin(), other.values_.end());
    else
        for (const std::uint16_t bin : other.values_)
            ++histogram_[bin];
    for (std::size_t bin = 0; bin < other.histogram_.size(); ++bin)
        histogram_[bin] += other.histogram_[bin];
    if (histogram_.empty() && values_.size() > largest_list)
        make_histogram();
    other = {};
}

double ElevationSample::percentile(double share, const ElevationRange& range) const {
    return percentiles({share}, range).front();
}

std::vector<double> ElevationSample::percentiles(const std::vector<double>& shares,
                                                 const ElevationRange& range) const {
    std::vector<std::uint16_t> sorted = values_;
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> result;
    std::int64_t below = 0;
    std::uint32_t bin = 0;
    for (const double share : shares) {
        const auto rank = std::max<std::int64_t>(
            1, static_cast<std::int64_t>(std::ceil(share * static_cast<double>(size_))));
        if (histogram_.empty()) {
            bin = sorted[static_cast<std::size_t>(rank - 1)];
        } else {
            while (below + histogram_[bin] < rank)
                below += histogram_[bin++];
        }
        result.push_back(range.elevation(bin));
    }
    return result;
}

}  // namespace d2b
