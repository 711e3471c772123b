#pragma once

#include <functional>
#include <pybind11/pybind11.h>
#include <string>

namespace d2b {

/// Functions through which a run hears from Python and reports to it.
struct PythonEars {
    std::function<bool()> stop;                    ///< any thread may ask
    std::function<bool(double)> progress;          ///< false where an end is asked for
    std::function<void(const std::string&)> warn;  ///< throws Cancelled where the warning is an error
};

/// Calls `work` on a thread of its own, with the interpreter free. Meanwhile the calling thread, which holds
/// the interpreter's lock before and after, hears signals such as Ctrl-C and passes on the news of the run,
/// several times a second. An exception of Python there, or a false value other than None of the progress
/// function, ends the work.
/// @param listener an object with a method warn(text) and an attribute progress, a callable or None
/// @throws the exception of Python, else that of the work
void run_listening(const pybind11::object& listener, const std::function<void(const PythonEars&)>& work);

}  // namespace d2b
