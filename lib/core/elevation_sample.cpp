#include "core/elevation_sample.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/packed_elevations.hpp"

namespace d2b {

std::uint32_t ElevationRange::bin(double elevation) const {
    // Halve before subtracting, because the range of the largest doubles would overflow.
    const double range = maximum / 2 - minimum / 2;
    if (!(range > 0))
        return 0;
    const double share = (elevation / 2 - minimum / 2) / range;
    return static_cast<std::uint32_t>(std::clamp(share * bins, 0.0, double{bins - 1}));
}

double ElevationRange::elevation(std::uint32_t bin) const {
    const double share = (bin + 0.5) / bins;
    return minimum * (1 - share) + maximum * share;
}

void ElevationSample::add(double elevation, const ElevationRange& range) {
    ++size_;
    if (!histogram_.empty()) {
        count(elevation, range);
        return;
    }
    values_.push_back(elevation);
    if (values_.size() > largest_list)
        make_histogram(range);
}

void ElevationSample::add(std::span<const double> elevations, const ElevationRange& range) {
    const auto known = [](double elevation) { return !std::isnan(elevation); };
    if (!histogram_.empty()) {
        for (const double elevation : elevations)
            if (known(elevation))
                add(elevation, range);
        return;
    }
    const std::size_t before = values_.size();
    std::ranges::copy_if(elevations, std::back_inserter(values_), known);
    size_ += static_cast<std::int64_t>(values_.size() - before);
    if (values_.size() > largest_list)
        make_histogram(range);
}

void ElevationSample::make_histogram(const ElevationRange& range) {
    histogram_.assign(ElevationRange::bins, 0);
    for (const double value : values_)
        count(value, range);
    values_ = std::vector<double>();  // Assigning {} would keep the capacity.
}

void ElevationSample::count(double elevation, const ElevationRange& range) {
    ++histogram_[range.bin(elevation)];
    highest_ = std::max(highest_, elevation);
}

void ElevationSample::merge(ElevationSample& other, const ElevationRange& range) {
    if (size_ < other.size_)
        std::swap(*this, other);
    size_ += other.size_;
    if (histogram_.empty())
        values_.insert(values_.end(), other.values_.begin(), other.values_.end());
    else
        for (const double value : other.values_)
            count(value, range);
    highest_ = std::max(highest_, other.highest_);
    for (std::size_t bin = 0; bin < other.histogram_.size(); ++bin)
        histogram_[bin] += other.histogram_[bin];
    if (values_.size() > largest_list)
        make_histogram(range);
    other = {};
}

void ElevationSample::save(ByteWriter& writer) const {
    put_elevations(values_, writer);
    writer.put_varint(static_cast<std::uint64_t>(size_) - values_.size());
    if (histogram_.empty())
        return;
    writer.put(highest_);
    std::uint64_t empty = 0;  // empty bins before the next counted one
    for (const std::uint32_t counted : histogram_) {
        if (counted == 0) {
            ++empty;
            continue;
        }
        writer.put_varint(std::exchange(empty, 0));
        writer.put_varint(counted);
    }
}

ElevationSample ElevationSample::load(ByteReader& reader) {
    ElevationSample sample;
    sample.values_ = take_elevations(reader);
    const std::uint64_t counted = reader.take_varint();
    if (sample.values_.size() > largest_list || (counted > 0 && !sample.values_.empty()))
        throw BrokenRecord("a sample is no sample");
    sample.size_ = static_cast<std::int64_t>(sample.values_.size() + counted);
    if (counted == 0)
        return sample;
    sample.highest_ = reader.take<double>();
    sample.histogram_.assign(ElevationRange::bins, 0);
    std::uint64_t bin = 0;
    for (std::uint64_t left = counted; left > 0; ++bin) {
        bin += reader.take_varint();
        const std::uint64_t here = reader.take_varint();
        if (bin >= ElevationRange::bins || here > std::min<std::uint64_t>(left, UINT32_MAX))
            throw BrokenRecord("a sample is no sample");
        sample.histogram_[bin] = static_cast<std::uint32_t>(here);
        left -= here;
    }
    return sample;
}

std::vector<double> ElevationSample::percentiles(const std::vector<double>& shares,
                                                 const ElevationRange& range) const {
    std::vector<double> values = values_;
    auto ranked = values.begin();  // everything before it is in sorted position
    std::vector<double> result;
    std::int64_t below = 0;
    std::uint32_t bin = 0;
    for (const double share : shares) {
        const auto rank = std::max<std::int64_t>(
            1, static_cast<std::int64_t>(std::ceil(share * static_cast<double>(size_))));
        if (histogram_.empty()) {
            const auto at = values.begin() + (rank - 1);
            if (at >= ranked) {
                std::nth_element(ranked, at, values.end());
                ranked = at + 1;
            }
            result.push_back(*at);
            continue;
        }
        while (below + histogram_[bin] < rank)
            below += histogram_[bin++];
        result.push_back(rank == size_ ? highest_ : range.elevation(bin));
    }
    return result;
}

}  // namespace d2b
