#pragma once

#include <string>
#include <vector>

#include "options/option_table.hpp"

namespace d2b::test {

using Texts = std::vector<std::string>;

/// An option as it might be given, and the words that must be given with it.
struct OptionCase {
    std::string name;
    Texts values{};
    Texts with{};  ///< words before it that it needs to make sense

    [[nodiscard]] Texts words() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] bool is_given_with(const OptionCase& other) const;
};

/// At least one case for each option of the table that is not hidden, for a choice one a word. Files are
/// those of OptionScene.
[[nodiscard]] std::vector<OptionCase> option_cases();

/// Whether an option changes the result of a town, and not how, where or with which words it is written.
[[nodiscard]] bool shapes_the_result(const std::string& name);

/// "" where the words are a good command line, the message else. Source and destination are added.
[[nodiscard]] std::string refusal_of(const Texts& words);

}  // namespace d2b::test
