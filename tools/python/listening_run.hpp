#pragma once

#include <functional>
#include <pybind11/pybind11.h>
#include <string>

namespace d2b {

/// What a run hears from Python and tells it.
struct PythonEars {
    std::function<bool()> stop;                    ///< any thread may ask
    std::function<bool(double)> progress;          ///< false where an end is asked for
    std::function<void(const std::string&)> warn;  ///< throws Cancelled where the warning is an error
};

/// Calls `work` on a thread of its own, with the interpreter free. Meanwhile the calling thread, which holds
/// the interpreter's lock before and after, hears signals such as Ctrl-C and passes on what the run says,
/// some times a second. What Python raises there, and a progress function that returns what is false but not
/// None, ends the work.
/// @param listener an object with a method warn(text) and an attribute progress, a callable or None
/// @throws what Python raised, else what the work threw
void run_listening(const pybind11::object& listener, const std::function<void(const PythonEars&)>& work);

}  // namespace d2b
