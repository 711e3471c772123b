#pragma once

#include <string>

#include "core/context.hpp"
#include "diagnose/words.hpp"

namespace d2b {

/// Emits a warning for a cause unless it is "".
inline void warn_of(const std::string& cause, Context& context) {
    if (!cause.empty())
        context.warn(as_sentence(cause));
}

}  // namespace d2b
