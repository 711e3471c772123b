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
            return true;
        default:
            return false;
    }
}

/// What follows the option: words, a file, or something that cannot be guessed.
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
    return "# Completes command lines of dem2buildings in Bash.\n"
           "_dem2buildings() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    case $before in\n" +
           cases +
           "    esac\n"
           "    case $word in\n"
           "        -*) COMPREPLY=($(compgen -W \"" +
           names +
           "\" -- \"$word\")) ;;\n"
           "        *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
           "    esac\n"
           "}\n"
           "complete -o filenames -F _dem2buildings dem2buildings\n";
}

}  // namespace d2b
