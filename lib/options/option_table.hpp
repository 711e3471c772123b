#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/options.hpp"
#include "options/option_values.hpp"
#include "options/sweep_plan.hpp"

namespace d2b {

/// What a command-line tool does beside the run; the library itself never looks at it.
struct ToolOptions {
    bool quiet = false;      ///< no progress, no summary
    bool json = false;       ///< the report to stdout as JSON; implies quiet
    std::string sweep{};     ///< as given; "" for one run
    SweepPlan sweep_plan{};  ///< what it stands for
    bool help = false;
    bool version = false;
    bool man_page = false;          ///< the man page to stdout
    bool options_markdown = false;  ///< the reference of the options to stdout
    bool options_json = false;      ///< the table of options to stdout, for dialogs that are made of it
    bool bash_completion = false;   ///< a script for Bash to stdout

    /// Whether a text was asked for in place of a run.
    [[nodiscard]] bool prints_text() const {
        return help || version || man_page || options_markdown || options_json || bash_completion;
    }
};

/// All that options can set.
struct Request {
    Options options;
    ToolOptions tool;
};

enum class Arity {
    none,     ///< a switch
    one,      ///< one value
    several,  ///< OptionRow::count values
    list      ///< numbers, at least one, as long as numbers follow
};

enum class OptionGroup { input, buildings, levels, contours, output, report };
inline constexpr std::array<std::string_view, 6> option_group_names{"Input",    "Buildings", "Levels",
                                                                    "Contours", "Output",    "Report"};

using OptionValues = std::span<const std::string>;

/// One option. Parser, help, man page and reference are all made from these rows.
struct OptionRow {
    OptionGroup group = OptionGroup::input;
    std::string name{};                  ///< without dash
    std::vector<std::string> aliases{};  ///< without dash
    std::string values{};                ///< "<xmin> <ymin> <xmax> <ymax>"; "" for a switch
    Arity arity = Arity::none;
    std::size_t count = 0;                 ///< values that follow the name, the least of a list
    bool repeatable = false;               ///< may be given again and then adds to what was given
    bool hidden = false;                   ///< accepted, but not listed in the help
    std::string unit{};                    ///< "" where there is none
    std::optional<NumberRange> numbers{};  ///< of an option of one number
    std::string range{};                   ///< ends "-name must be ..."; "" where any text will do
    std::string standard{};  ///< the default as text, from a default-constructed Request; "" for none
    std::string help{};      ///< a line
    std::string details{};   ///< more sentences, or ""

    /// Sets what the option stands for. @throws OptionError; call through apply_option
    std::function<void(Request&, OptionValues)> apply{};
    /// What the option is set to, as text; "" where it is not set.
    std::function<std::string(const Request&)> show{};
};

/// All options, in the order in which help lists them. Immutable.
[[nodiscard]] const std::vector<OptionRow>& option_table();

/// @param name with or without dashes, or an alias @return nullptr where there is no such option
[[nodiscard]] const OptionRow* find_option(std::string_view name);

/// The option as it is written: "-te <xmin> <ymin> <xmax> <ymax>".
[[nodiscard]] std::string option_synopsis(const OptionRow& row);

/// Sets what the option stands for. @throws OptionError: too few, too many or empty values, or values out of
/// range
void apply_option(const OptionRow& row, Request& request, OptionValues values);

}  // namespace d2b
