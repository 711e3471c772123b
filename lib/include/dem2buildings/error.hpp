#pragma once

#include <stdexcept>

namespace d2b {

/// Base of all errors. The message names the problem and the remedy in one sentence.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Invalid or contradictory options: exit status 2 in the tools.
class OptionError : public Error {
    using Error::Error;
};

/// The input cannot be read, or cannot be used as a DEM.
class InputError : public Error {
    using Error::Error;
};

/// The result cannot be written; the destination is unchanged.
class OutputError : public Error {
    using Error::Error;
};

/// GEOS failed on a geometry.
class GeometryError : public Error {
    using Error::Error;
};

/// The caller cancelled the run.
class Cancelled : public Error {
  public:
    Cancelled() : Error("Cancelled; nothing was written.") {}
};

}  // namespace d2b
