#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace d2b {

/// Union-find over the integers from 0, with path halving (Tarjan and van Leeuwen 1984). One element of each
/// set is its root.
class DisjointSets {
  public:
    DisjointSets() = default;
    /// Makes `count` sets of one element each.
    explicit DisjointSets(std::uint32_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    /// Adds a set of one element. @return the element
    std::uint32_t add() {
        parents_.push_back(size());
        return parents_.back();
    }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(parents_.size()); }

    /// Returns the root of an element's set.
    [[nodiscard]] std::uint32_t find(std::uint32_t i) {
        while (parents_[i] != i)
            i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    /// Returns true if the element is the root of its set. Faster than comparing it with find().
    [[nodiscard]] bool is_root(std::uint32_t i) const { return parents_[i] == i; }
    /// Merges two sets. The smaller root becomes the root of both. @return it
    std::uint32_t join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        const auto [low, high] = std::minmax(a, b);
        merge_roots(low, high);
        return low;
    }
    struct Numbers {
        std::vector<std::uint32_t> of;  ///< by element
        std::uint32_t count = 0;        ///< of sets
    };
    /// Numbers the sets from 0, in the order of their smallest elements. @pre only join() has merged sets
    [[nodiscard]] Numbers numbered() {
        Numbers numbers{std::vector<std::uint32_t>(size()), 0};
        for (std::uint32_t i = 0; i < size(); ++i)
            numbers.of[i] = is_root(i) ? numbers.count++ : numbers.of[find(i)];
        return numbers;
    }
    /// Merges two sets given their roots. @param stays root of the merged set @param goes root of the other
    /// set
    void merge_roots(std::uint32_t stays, std::uint32_t goes) { parents_[goes] = stays; }

  private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace d2b
