#pragma once

#include "core/executor.hpp"

namespace d2b::test {

/// Some threads, for work that does not look at their number.
inline Executor& threads() {
    static Executor executor(4);
    return executor;
}

}  // namespace d2b::test
