#pragma once

#include <stdexcept>
#include <string>

namespace d2b {

/// Every error says in one sentence what is wrong and what to do about it.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The caller asked for something that cannot be: exit status 2 in the tools.
class OptionError : public Error {
    using Error::Error;
};

/// The input cannot be read, or not used as a DEM.
class InputError : public Error {
    using Error::Error;
};

/// The result cannot be written; the destination holds what it held before.
class OutputError : public Error {
    using Error::Error;
};

/// GEOS failed on a geometry.
class GeometryError : public Error {
    using Error::Error;
};

/// The caller's progress function asked to stop.
class Cancelled : public Error {
  public:
    Cancelled() : Error("Cancelled; nothing was written.") {}
};

}  // namespace d2b
