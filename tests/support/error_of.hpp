#pragma once

#include <string>

#include "dem2buildings/error.hpp"

namespace d2b::test {

/// The message of the error of a kind that a call ends with; "(no error)" if it ends well.
template <typename Kind = Error, typename Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const Kind& error) {
        return error.what();
    }
    return "(no error)";
}

}  // namespace d2b::test
