#include "python/given_options.hpp"

#include "dem2buildings/error.hpp"
#include "options/option_checks.hpp"

namespace d2b {

Request request_of(const GivenOptions& given) {
    Request request;
    for (const auto& [name, values] : given) {
        const OptionRow* const row = find_option(name);
        if (row == nullptr)
            throw OptionError("There is no option " + name + ".");
        apply_option(*row, request, values);
    }
    check_options(request);
    return request;
}

}  // namespace d2b
