#include "common/completion_script.hpp"
#include "dem2buildings/help.hpp"

namespace d2b {
namespace {

/// Patterns of a `case`: "-f|-of|--f|--of".
std::string pattern(const OptionRow& row) {
    std::vector<std::string> names = row.aliases;
    names.insert(names.begin(), row.name);
    std::string text;
    for (const char* dash : {"-", "--"})
        for (const std::string& name : names)
            text += (text.empty() ? "" : "|") + std::string(dash) + name;
    return text;
}

bool names_a_file(OptionKind kind) {
    switch (kind) {
        case OptionKind::raster:
        case OptionKind::polygons:
        case OptionKind::dataset:
        case OptionKind::terrain:
        case OptionKind::geotiff:
        case OptionKind::picture:
        case OptionKind::surface:
        case OptionKind::page:
            return true;
        default:
            return false;
    }
}

/// Completion after an option: words, a file, or nothing if the value cannot be guessed.
std::string action(const OptionRow& row) {
    const std::string words = joined(row.choices, " ");
    if (names_a_file(row.kind))
        return "COMPREPLY=($(compgen -W \"" + words + "\" -- \"$word\") $(compgen -f -- \"$word\"))";
    return words.empty() ? "COMPREPLY=()" : "COMPREPLY=($(compgen -W \"" + words + "\" -- \"$word\"))";
}

}  // namespace

std::string bash_completion() {
    std::string cases;
    std::string names;
    for (const OptionRow& row : option_table()) {
        if (row.hidden)
            continue;
        names += (names.empty() ? "-" : " -") + row.name;
        if (row.arity == Arity::one)
            cases += "        " + pattern(row) + ") " + action(row) + "; return ;;\n";
    }
    return completion_script("dem2buildings", cases, names);
}

}  // namespace d2b
