#include "common/completion_script.hpp"

namespace d2b {

std::string completion_script(const std::string& program, const std::string& cases,
                              const std::string& names) {
    return "# Completes command lines of " + program +
           " in Bash.\n"
           "_" +
           program +
           "() {\n"
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
           "complete -o filenames -F _" +
           program + " " + program + "\n";
}

}  // namespace d2b
