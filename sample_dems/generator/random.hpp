#pragma once

#include <cmath>
#include <cstdint>

namespace d2b::sample {

/// The finaliser of splitmix64: a bijection of 64 bits in which every bit of the input stirs every bit of the
/// output.
constexpr std::uint64_t mix(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

/// A number for a place: the things at (i, j) do not depend on earlier draws, so that any part of
/// a scene can be made alone.
constexpr std::uint64_t hash(std::uint64_t seed, std::int64_t i, std::int64_t j) {
    return mix(mix(mix(seed) ^ static_cast<std::uint64_t>(i)) ^ static_cast<std::uint64_t>(j));
}

/// The upper 53 bits as a double in [0, 1).
constexpr double unit_interval(std::uint64_t bits) {
    return static_cast<double>(bits >> 11U) * 0x1p-53;
}

/// Uniform in [0, 1) at a place.
constexpr double uniform_at(std::uint64_t seed, std::int64_t i, std::int64_t j) {
    return unit_interval(hash(seed, i, j));
}

/// About normal (the sum of four uniform numbers, within 3.5 standard deviations), mean 0, variance 1. No
/// logarithm or cosine: their last bit differs between C libraries.
constexpr double normal_at(std::uint64_t seed, std::int64_t i, std::int64_t j) {
    std::uint64_t bits = hash(seed, i, j);
    double sum = -2;
    for (int k = 0; k < 4; ++k) {
        sum += unit_interval(bits);
        bits = mix(bits);
    }
    return sum * 1.7320508075688772;
}

/// A stream of numbers (splitmix64) for things that are drawn one after the other, e.g. the houses of a
/// block. The distributions of <random> differ between standard libraries; these do not.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        const std::uint64_t bits = mix(state_);
        state_ += 0x9e3779b97f4a7c15U;
        return bits;
    }
    double uniform() { return unit_interval(next()); }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    bool chance(double probability) { return uniform() < probability; }
    /// 0 to n - 1
    int below(int n) { return static_cast<int>(uniform() * n); }
    /// A multiple of an eighth of a metre. Sums of such numbers are exact, so that walls that are shared have
    /// the same corners on both sides.
    double eighths(double low, double high) { return std::floor(between(low, high) * 8) / 8; }

  private:
    std::uint64_t state_;
};

}  // namespace d2b::sample
