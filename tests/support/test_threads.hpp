#pragma once

#include "core/executor.hpp"

namespace d2b::test {

/// For what does not look at the number of threads: some.
inline Executor& threads() {
    static Executor executor(4);
    return executor;
}

}  // namespace d2b::test
