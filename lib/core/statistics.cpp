#include "core/statistics.hpp"

#include <bit>
#include <iterator>
#include <utility>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

namespace d2b {
namespace {

// Wide enough for the square of any sum with its unit, and never allocates.
constexpr unsigned width = 12288;
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    width, width, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
using Wide = boost::multiprecision::cpp_bin_float_100;

/// value = mantissa * 2^exponent
struct Parts {
    std::int64_t mantissa;
    int exponent;
};

Parts parts(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto biased = static_cast<int>((bits >> 52) & 0x7ff);
    auto mantissa = static_cast<std::int64_t>(bits & 0xfffffffffffffULL);
    if (biased != 0)
        mantissa |= std::int64_t{1} << 52;
    return {(bits >> 63) != 0 ? -mantissa : mantissa, (biased == 0 ? 1 : biased) - 1075};
}

/// Returns the sum in units of 2^lowest_exponent.
Integer as_integer(const ExactSum& sum) {
    Integer total = 0;
    for (std::size_t i = ExactSum::bin_count; i-- > 0;) {
        total <<= 32;
        total += Integer(sum.bins()[i]);
    }
    return total;
}

/// Squares in factors of up to 40 limbs. Boost multiplies longer ones by Karatsuba's method, and in 1.74 the
/// square of some numbers of 51 limbs (sums that no double could hold) comes out wrong.
Integer square_of(const Integer& sum) {
    constexpr unsigned half = 1600;
    const Integer high = abs(sum) >> half;
    const Integer low = abs(sum) - (high << half);
    const Integer upper = ((high * high) << half) + 2 * high * low;
    return (upper << half) + low * low;
}

}  // namespace

void ExactSum::add(std::int64_t mantissa, int exponent) {
    const auto shift = static_cast<unsigned>(exponent - lowest_exponent);
    bins_[shift / 32] += static_cast<Int128>(mantissa) * (Int128{1} << (shift % 32));
}

void ExactSum::add(double value) {
    const Parts p = parts(value);
    add(p.mantissa, p.exponent);
}

void ExactSum::add_square(double value) {
    const Parts p = parts(value);
    const auto magnitude = static_cast<std::uint64_t>(p.mantissa < 0 ? -p.mantissa : p.mantissa);
    const UInt128 square = static_cast<UInt128>(magnitude) * magnitude;
    constexpr std::uint64_t low_53 = (std::uint64_t{1} << 53) - 1;
    add(static_cast<std::int64_t>(static_cast<std::uint64_t>(square) & low_53), 2 * p.exponent);
    add(static_cast<std::int64_t>(square >> 53), 2 * p.exponent + 53);
}

void ExactSum::add_scaled(Int128 value, int exponent) {
    constexpr int digits = 53;
    constexpr Int128 lowest = (Int128{1} << digits) - 1;
    for (; value != 0 && value != -1; value >>= digits, exponent += digits)
        add(static_cast<std::int64_t>(value & lowest), exponent);
    add(static_cast<std::int64_t>(value), exponent);  // 0 or -1: the sign
}

void ExactSum::merge(const ExactSum& other) {
    for (std::size_t i = 0; i < bin_count; ++i)
        bins_[i] += other.bins_[i];
}

double ExactSum::value() const {
    return static_cast<double>(ldexp(Wide(as_integer(*this)), lowest_exponent));
}

void Moments::add_valid(std::span<const double> values) {
    // Float32 elevations between some centimetres and some kilometres are integers in these units.
    constexpr int unit = -30;
    constexpr double in_unit = 0x1p30;
    constexpr double most = 0x1p52;
    constexpr std::size_t piece = 1 << 16;  // sums and squares of this many values stay far below 2^127
    for (std::size_t first = 0; first < values.size(); first += piece) {
        Int128 whole_sum = 0;
        Int128 whole_squares = 0;
        for (const double value : values.subspan(first, std::min(piece, values.size() - first))) {
            const double scaled = value * in_unit;
            if (std::abs(scaled) < most) {
                const auto whole = static_cast<std::int64_t>(scaled);
                if (static_cast<double>(whole) == scaled) {
                    ++n;
                    whole_sum += whole;
                    whole_squares += static_cast<Int128>(whole) * whole;
                    continue;
                }
            }
            if (!std::isnan(value))
                add(value);
        }
        sum.add_scaled(whole_sum, unit);
        squares.add_scaled(whole_squares, 2 * unit);
    }
}

void Moments::merge(const Moments& other) {
    n += other.n;
    sum.merge(other.sum);
    squares.merge(other.squares);
}

double Moments::mean() const {
    if (n == 0)
        return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(ldexp(Wide(as_integer(sum)) / Wide(n), ExactSum::lowest_exponent));
}

double Moments::standard_deviation() const {
    if (n < 2)
        return 0;
    // n times the sum of squares minus the square of the sum. All are integers, so there is no cancellation.
    const Integer total = as_integer(sum);
    constexpr auto unit = static_cast<unsigned>(-ExactSum::lowest_exponent);
    const Integer numerator = ((n * as_integer(squares)) << unit) - square_of(total);
    const Wide variance = Wide(numerator) / (Wide(n) * Wide(n - 1));
    return static_cast<double>(ldexp(sqrt(variance), ExactSum::lowest_exponent));
}

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

Percentiles heights_above(double ground, const RoofElevations& roof, double metres) {
    Percentiles heights{};
    for (std::size_t k = 0; k < heights.size(); ++k)
        heights[k] = (std::min(roof.percentiles[k], roof.highest) - ground) * metres;
    return heights;
}

RoofElevations summarize_roof(const ElevationSample& sample, const ElevationRange& range) {
    RoofElevations roof;
    if (sample.size() == 0)
        return roof;
    std::vector<double> shares(percentile_shares.begin(), percentile_shares.end());
    shares.push_back(1);
    const std::vector<double> elevations = sample.percentiles(shares, range);
    std::copy_n(elevations.begin(), percentile_shares.size(), roof.percentiles.begin());
    roof.highest = elevations.back();
    return roof;
}

}  // namespace d2b
