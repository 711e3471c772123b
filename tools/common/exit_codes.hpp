#pragma once

/// Exit statuses of the tools.
namespace d2b::exit_code {

inline constexpr int done = 0;
inline constexpr int failed = 1;
inline constexpr int wrong_usage = 2;

}  // namespace d2b::exit_code
