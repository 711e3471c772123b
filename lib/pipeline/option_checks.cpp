#include "pipeline/option_checks.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <vector>

#include "core/error.hpp"

namespace d2b {
namespace {

struct Conflict {
    std::string_view one;
    std::string_view other;
    std::string_view advice;
};

constexpr std::string_view one_window = "give one of -srcwin, -projwin and -te";
constexpr std::array conflicts{
    Conflict{"fl", "i", "list the levels or give an interval"},
    Conflict{"lod", "fl", "the listed levels take the place of those of -lod"},
    Conflict{"lod", "i", "the interval takes the place of -lod"},
    Conflict{"sweep", "fl", "the levels of a sweep are those of its lod"},
    Conflict{"sweep", "i", "the levels of a sweep are those of its lod"},
    Conflict{"srcwin", "projwin", one_window},
    Conflict{"srcwin", "te", one_window},
    Conflict{"projwin", "te", one_window},
    Conflict{"snodata", "inodata", "set a NoData value or ignore it"},
    Conflict{"overwrite", "append", "replace the layers or add to them"},
};

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& letter : result)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return result;
}

/// Letters to insert, remove, replace or swap with their neighbour to get from one to the other.
std::size_t edit_distance(std::string_view one, std::string_view other) {
    std::vector<std::vector<std::size_t>> cost(one.size() + 1, std::vector<std::size_t>(other.size() + 1));
    for (std::size_t i = 0; i <= one.size(); ++i) {
        for (std::size_t j = 0; j <= other.size(); ++j) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            const std::size_t replaced = cost[i - 1][j - 1] + (one[i - 1] == other[j - 1] ? 0 : 1);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
            if (i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost.back().back();
}

}  // namespace

void check_conflicts(const OptionNames& given) {
    for (const auto& [one, other, advice] : conflicts)
        if (given.contains(one) && given.contains(other))
            throw OptionError("-" + std::string(one) + " cannot be used together with -" +
                              std::string(other) + "; " + std::string(advice) + ".");
    if (given.contains("off") && !given.contains("i"))
        throw OptionError("-off needs -i <interval>; it is the elevation that the intervals count from.");
}

std::string nearest_name(std::string_view typed, std::span<const std::string> candidates) {
    const std::string wanted = lower(typed);
    // A third of the letters may be wrong, so that short names are not taken for just any other.
    std::size_t best = wanted.size() / 3 + 1;
    std::string nearest;
    for (const std::string& candidate : candidates) {
        const std::string name = lower(candidate);
        const bool begins = wanted.size() >= 3 && name.starts_with(wanted);
        const std::size_t distance = std::min(edit_distance(wanted, name), begins ? std::size_t{1} : best);
        if (distance < best) {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

}  // namespace d2b
