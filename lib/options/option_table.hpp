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

    friend bool operator==(const ToolOptions&, const ToolOptions&) = default;

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

/// Where a dialog asks for an option: what is looked at first, what it is about, or behind a fold.
enum class DialogSection { basic, ground, trees, detail, output, advanced };
inline constexpr std::array<std::string_view, 6> dialog_section_names{"Basic",  "Ground", "Trees",
                                                                      "Detail", "Output", "Advanced"};

/// What a value is: the widget of a dialog, what a shell completes.
enum class OptionKind {
    toggle,    ///< a switch
    choice,    ///< one of OptionRow::choices
    whole,     ///< a whole number
    number,    ///< a number
    numbers,   ///< several
    extent,    ///< xmin ymin xmax ymax
    crs,       ///< a coordinate reference system
    raster,    ///< a raster that is read
    polygons,  ///< a vector dataset that is read
    dataset,   ///< either of them
    terrain,   ///< one of OptionRow::choices, or a raster that is read
    geotiff,   ///< a file that is written
    picture,   ///< a PNG, SVG or PDF that is written
    surface,   ///< a surface that is written
    page,      ///< an HTML page that is written
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

/// The presets in which an option has a meaning.
struct PresetScope {
    std::vector<Preset> presets{every_preset.begin(), every_preset.end()};
    std::string elsewhere{};  ///< the value that says again what other presets do anyway; "" for none
    std::string why{};        ///< why it has no meaning in others, and what to do; ends a sentence
};

/// Which functions of the Python module take an option, by `name`. Where neither does there is no name.
struct PythonUse {
    std::string name{};
    bool extract = false;
    bool extract_file = false;
};

using OptionValues = std::span<const std::string>;

/// One option. Parser, checks, help, man page, reference, completion, the dialog of QGIS, the Python module
/// and the provenance of a result are all made from these rows.
struct OptionRow {
    OptionGroup group = OptionGroup::input;
    std::string name{};                  ///< without dash
    std::vector<std::string> aliases{};  ///< without dash
    OptionKind kind = OptionKind::text;
    std::string values{};                ///< "<xmin> <ymin> <xmax> <ymax>"; "" for a switch
    std::vector<std::string> choices{};  ///< the words that it takes
    Arity arity = Arity::none;
    std::size_t count = 0;                 ///< values that follow the name, the least of a list
    bool repeatable = false;               ///< may be given again and then adds to what was given
    bool hidden = false;                   ///< accepted, but not listed in the help
    std::string unit{};                    ///< "" where there is none
    std::optional<NumberRange> numbers{};  ///< of an option of one number
    std::string range{};                   ///< ends "-name must be ..."; "" where any text will do
    std::string standard{};  ///< the default as text, from a default-constructed Request; "" for none
    std::string title{};     ///< what a dialog calls it
    DialogSection section = DialogSection::advanced;
    std::string help{};     ///< a line
    std::string details{};  ///< more sentences, or ""
    PresetScope scope{};
    PythonUse python{};
    bool repeats = true;  ///< a result cannot be made again without it
    std::string item{};   ///< what the metadata of a result call its value, after "D2B_"; "": they do not

    /// Sets what the option stands for. @throws OptionError; call through apply_option
    std::function<void(Request&, OptionValues)> apply{};
    /// What the option is set to, as the values of a command line; none where it is not set, "yes" of a
    /// switch.
    std::function<std::vector<std::string>(const Request&)> texts{};

    /// The same as one text.
    [[nodiscard]] std::string show(const Request& request) const;
    /// Whether it was given by its name, or the field that it sets has another value than the default.
    [[nodiscard]] bool is_given(const Request& request) const;
    [[nodiscard]] bool has_meaning(Preset preset) const;
};

/// All options, in the order in which help lists them. Immutable.
[[nodiscard]] const std::vector<OptionRow>& option_table();

/// @param name with or without dashes, or an alias @return nullptr where there is no such option
[[nodiscard]] const OptionRow* find_option(std::string_view name);

/// The option as it is written: "-te <xmin> <ymin> <xmax> <ymax>".
[[nodiscard]] std::string option_synopsis(const OptionRow& row);

/// Sets what the option stands for and puts it down as given. @throws OptionError: too few, too many or empty
/// values, or values out of range
void apply_option(const OptionRow& row, Request& request, OptionValues values);

}  // namespace d2b
