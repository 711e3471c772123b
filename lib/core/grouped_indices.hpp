#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace d2b {

/// Indices by group in one list: those of a group are consecutive, in the order in which they were given.
class GroupedIndices {
  public:
    GroupedIndices() = default;
    /// @param for_each calls add(group, index) for all indices; it is called twice and has to do the same
    template <typename ForEach>
    GroupedIndices(std::size_t groups, const ForEach& for_each) : first_(groups + 1, 0) {
        for_each([&](std::size_t group, std::uint32_t) { ++first_[group + 1]; });
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        indices_.resize(first_.back());
        std::vector<std::size_t> next = first_;
        for_each([&](std::size_t group, std::uint32_t index) { indices_[next[group]++] = index; });
    }

    /// Number of groups.
    [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t group) const {
        return std::span(indices_).subspan(first_[group], first_[group + 1] - first_[group]);
    }

  private:
    std::vector<std::size_t> first_{0};  // per group: its first index, then the number of indices
    std::vector<std::uint32_t> indices_;
};

}  // namespace d2b
