#pragma once

#include <string>

#include "dem2buildings/error.hpp"

namespace d2b::test {

/// The message of the error that a call ends with; "(no error)" if it ends well.
template <typename Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "(no error)";
}

}  // namespace d2b::test
