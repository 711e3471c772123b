#pragma once

namespace d2b {

/// Exit statuses of the tools.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int failed = 1;
inline constexpr int wrong_usage = 2;
inline constexpr int cancelled = 130;  // what a shell reports of a program that SIGINT ended
}  // namespace exit_code

}  // namespace d2b
