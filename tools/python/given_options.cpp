#include "python/given_options.hpp"

#include "dem2buildings/options.hpp"

namespace d2b {

Options options_of(const GivenOptions& given) {
    Options options;
    for (const auto& [name, values] : given)
        set_option(options, name, values);
    return options;
}

}  // namespace d2b
