#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace d2b {

/// A set of integers below a limit with fast predecessor and successor search. A two-level bitset: the upper
/// level marks the words that are not empty, so that a million indices need at most 250 words to be scanned.
class IndexSet {
  public:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    IndexSet() = default;
    explicit IndexSet(std::size_t limit) : words_(limit / bits + 1), filled_(words_.size() / bits + 1) {}

    void insert(std::size_t i) {
        words_[i / bits] |= bit(i);
        filled_[i / bits / bits] |= bit(i / bits);
    }
    void erase(std::size_t i) {
        if ((words_[i / bits] &= ~bit(i)) == 0)
            filled_[i / bits / bits] &= ~bit(i / bits);
    }
    /// Smallest member >= i.
    [[nodiscard]] std::size_t from(std::size_t i) const {
        const std::size_t here = at_or_after(words_, i, i / bits + 1);
        if (here != none)
            return here;
        const std::size_t word = at_or_after(filled_, i / bits + 1, filled_.size());
        return word == none ? none : word * bits + static_cast<std::size_t>(std::countr_zero(words_[word]));
    }
    /// Largest member < i.
    [[nodiscard]] std::size_t before(std::size_t i) const {
        const std::size_t here = below(words_, i, i / bits);
        if (here != none)
            return here;
        const std::size_t word = below(filled_, i / bits, 0);
        return word == none ? none : word * bits + last_of(words_[word]);
    }

  private:
    using Words = std::vector<std::uint64_t>;
    static constexpr std::size_t bits = 64;

    static std::uint64_t bit(std::size_t i) { return std::uint64_t{1} << (i % bits); }
    static std::size_t last_of(std::uint64_t word) {
        return bits - 1 - static_cast<std::size_t>(std::countl_zero(word));
    }
    /// Searches the words before `end`.
    static std::size_t at_or_after(const Words& words, std::size_t i, std::size_t end) {
        std::uint64_t mask = ~(bit(i) - 1);
        for (std::size_t w = i / bits; w < end && w < words.size(); ++w, mask = ~std::uint64_t{0})
            if (const std::uint64_t found = words[w] & mask; found != 0)
                return w * bits + static_cast<std::size_t>(std::countr_zero(found));
        return none;
    }
    /// Searches the words from `begin`.
    static std::size_t below(const Words& words, std::size_t i, std::size_t begin) {
        std::uint64_t mask = bit(i) - 1;
        for (std::size_t w = i / bits + 1; w-- > begin; mask = ~std::uint64_t{0})
            if (const std::uint64_t found = words[w] & mask; found != 0)
                return w * bits + last_of(found);
        return none;
    }

    Words words_;
    Words filled_;
};

}  // namespace d2b
