#include <utility>

#include "dem2buildings/error.hpp"
#include "dem2buildings/options.hpp"
#include "options/option_table.hpp"

namespace d2b {

void set_option(Options& options, std::string_view name, const std::vector<std::string>& values) {
    const OptionRow* const row = find_option(name);
    if (row == nullptr)
        throw OptionError("There is no option '" + std::string(name) + "'; docs/options.md lists all.");
    Request request{options, {}};
    apply_option(*row, request, values);
    if (request.tool != ToolOptions{})
        throw OptionError("-" + row->name + " is of the program alone; leave it out.");
    options = std::move(request.options);
}

}  // namespace d2b
