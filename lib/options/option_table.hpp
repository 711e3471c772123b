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

namespace d2b {

/// Options of the command-line tool apart from the run. The library ignores them.
struct ToolOptions {
    bool quiet = false;      ///< no progress, no summary
    bool json = false;       ///< print the report as JSON; implies quiet
    std::string sweep{};     ///< verbatim; "" for a single run
    SweepPlan sweep_plan{};  ///< parsed sweep
    bool help = false;       ///< print the everyday options
    bool help_all = false;   ///< print all options
    bool version = false;
    bool man_page = false;          ///< print the man page
    bool options_markdown = false;  ///< print the reference of the options
    bool options_json = false;      ///< print the option table, for generated dialogs
    bool bash_completion = false;   ///< print a script for Bash

    friend bool operator==(const ToolOptions&, const ToolOptions&) = default;

    /// Returns true if a text was requested instead of a run.
    [[nodiscard]] bool prints_text() const {
        return help || help_all || version || man_page || options_markdown || options_json || bash_completion;
    }
};

/// Everything that options can set.
struct Request {
    Options options;
    ToolOptions tool;
};

enum class Arity {
    none,     ///< a switch
    one,      ///< one value
    several,  ///< OptionRow::count values
    list      ///< one or more numbers, as long as numbers follow
};

enum class OptionGroup { input, buildings, levels, contours, output, report };
inline constexpr std::array<std::string_view, 6> option_group_names{"Input",    "Buildings", "Levels",
                                                                    "Contours", "Output",    "Report"};

/// Section of a dialog: the basics, a topic, or a collapsed group.
enum class DialogSection { basic, ground, trees, detail, output, advanced };
inline constexpr std::array<std::string_view, 6> dialog_section_names{"Basic",  "Ground", "Trees",
                                                                      "Detail", "Output", "Advanced"};

/// Type of a value, which determines the widget of a dialog and the completion of a shell.
enum class OptionKind {
    toggle,    ///< a switch
    choice,    ///< one of OptionRow::choices
    whole,     ///< an integer
    number,    ///< a number
    numbers,   ///< several numbers
    extent,    ///< xmin ymin xmax ymax
    crs,       ///< a coordinate reference system
    raster,    ///< an input raster
    polygons,  ///< an input vector dataset
    dataset,   ///< an input raster or vector dataset
    terrain,   ///< one of OptionRow::choices, or an input raster
    geotiff,   ///< an output GeoTIFF
    picture,   ///< an output PNG, SVG or PDF
    surface,   ///< an output surface
    page,      ///< an output HTML page
    text
};
inline constexpr std::array<std::string_view, 16> option_kind_names{
    "switch",    "choice", "whole",   "number",  "numbers",  "extent",           "crs",
    "raster",    "vector", "dataset", "terrain", "file:tif", "file:png,svg,pdf", "file:city.json,obj,stl,glb",
    "file:html", "text"};

inline constexpr std::array every_preset{Preset::buildings, Preset::thesis};
[[nodiscard]] constexpr std::string_view preset_name(Preset preset) {
    return preset == Preset::buildings ? "buildings" : "thesis";
}

/// Presets in which an option has a meaning.
struct PresetScope {
    std::vector<Preset> presets{every_preset.begin(), every_preset.end()};
    std::string elsewhere{};  ///< value allowed in other presets because it matches their behaviour; "" if
                              ///< there is none
    std::string why{};        ///< reason why it has no meaning elsewhere, with advice; ends a sentence
};

/// Functions of the Python module that take an option as `name`, which is empty if neither does.
struct PythonUse {
    std::string name{};
    bool extract = false;
    bool extract_file = false;
};

using OptionValues = std::span<const std::string>;

/// One option. Parser, checks, help, man page, reference, completion, the QGIS dialog, the Python module and
/// the provenance of a result are all generated from these rows.
struct OptionRow {
    OptionGroup group = OptionGroup::input;
    std::string name{};                  ///< without dash
    std::vector<std::string> aliases{};  ///< without dash
    OptionKind kind = OptionKind::text;
    std::string values{};                      ///< "<xmin> <ymin> <xmax> <ymax>"; "" for a switch
    std::vector<std::string> choices{};        ///< words that it accepts
    std::vector<std::string> choice_titles{};  ///< labels of these words in a dialog; the words if empty
    Arity arity = Arity::none;
    std::size_t count = 0;                 ///< number of values; the minimum for a list
    bool repeatable = false;               ///< may be repeated, which adds values
    bool hidden = false;                   ///< accepted, but not listed in the help
    std::string unit{};                    ///< "" if there is none
    std::optional<NumberRange> numbers{};  ///< range of an option with one number
    std::string range{};                   ///< completes "-name must be ..."; "" if any text is valid
    std::string standard{};  ///< default as text, from a default-constructed Request; "" if there is none
    std::string title{};     ///< label in a dialog
    DialogSection section = DialogSection::advanced;
    bool everyday = false;  ///< one of the few in the short help
    std::string help{};     ///< one line
    std::string details{};  ///< more sentences, or ""
    PresetScope scope{};
    PythonUse python{};
    bool repeats = true;  ///< needed to reproduce a result
    std::string item{};   ///< name in the metadata of a result, without "D2B_"; "" if not recorded

    /// Sets the option's field. Call it through apply_option(). @throws OptionError
    std::function<void(Request&, OptionValues)> apply{};
    /// Returns the current value as on a command line; empty if not set, "yes" for a switch.
    std::function<std::vector<std::string>(const Request&)> texts{};

    /// Returns the same as one text.
    [[nodiscard]] std::string show(const Request& request) const;
    /// Returns true if the option was given by name or its field differs from the default.
    [[nodiscard]] bool is_given(const Request& request) const;
    [[nodiscard]] bool has_meaning(Preset preset) const;
};

/// Returns all options in the order of the help. Immutable.
[[nodiscard]] const std::vector<OptionRow>& option_table();

/// @param name with or without dashes, or an alias @return nullptr if there is no such option
[[nodiscard]] const OptionRow* find_option(std::string_view name);

/// Returns the option with its values: "-te <xmin> <ymin> <xmax> <ymax>".
[[nodiscard]] std::string option_synopsis(const OptionRow& row);

/// Sets an option's field and marks the option as given. @throws OptionError: too few, too many or empty
/// values, or values out of range
void apply_option(const OptionRow& row, Request& request, OptionValues values);

}  // namespace d2b
