#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace d2b {

/// Numbers from 0 on, in sets that turn out to be one (union-find, with halved paths: Tarjan and van Leeuwen
/// 1984). One number of each set stands for it.
class DisjointSets {
  public:
    DisjointSets() = default;
    /// Each number is a set of its own.
    explicit DisjointSets(std::uint32_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    /// Adds a set of one number. @return it
    std::uint32_t add() {
        parents_.push_back(size());
        return parents_.back();
    }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(parents_.size()); }

    /// The number that stands for the set of another one.
    [[nodiscard]] std::uint32_t find(std::uint32_t i) {
        while (parents_[i] != i)
            i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    /// Whether it stands for its set: sooner than to compare it with find().
    [[nodiscard]] bool stands(std::uint32_t i) const { return parents_[i] == i; }
    /// The smaller of the numbers that stand for two sets stands for both. @return it
    std::uint32_t join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        const auto [low, high] = std::minmax(a, b);
        join_into(low, high);
        return low;
    }
    /// @param stays stands for its set, and then for both @param goes stands for the other
    void join_into(std::uint32_t stays, std::uint32_t goes) { parents_[goes] = stays; }

  private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace d2b
