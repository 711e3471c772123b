#pragma once

#include <cstdint>
#include <thread>
#include <vector>

namespace d2b::bench {

/// Divides 0 .. count - 1 into consecutive parts and calls work(begin, end) for each in a thread of its own.
/// Nothing may be thrown.
template <typename Work>
void in_threads(int threads, std::int32_t count, const Work& work) {
    const auto border = [&](int part) {
        return static_cast<std::int32_t>(std::int64_t{count} * part / threads);
    };
    std::vector<std::jthread> running;
    for (int part = 1; part < threads; ++part)
        running.emplace_back([&work, begin = border(part), end = border(part + 1)] { work(begin, end); });
    work(0, border(1));
}

}  // namespace d2b::bench
