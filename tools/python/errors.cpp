#include "python/errors.hpp"

#include <exception>
#include <new>
#include <pybind11/pybind11.h>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

namespace py = pybind11;

void raise(const char* type, const std::string& text) {
    const py::object error = py::module_::import("dem2buildings._errors").attr(type);
    // Names in a message may be any bytes, and a text of Python's is UTF-8.
    PyErr_SetString(error.ptr(), utf8_text(text).c_str());
}

void translate(std::exception_ptr failure) {
    constexpr const char* no_memory = "There is not enough memory; use a part of the input.";
    try {
        if (failure)
            std::rethrow_exception(std::move(failure));
    } catch (const OptionError& error) {
        raise("OptionError", error.what());
    } catch (const InputError& error) {
        raise("InputError", error.what());
    } catch (const OutputError& error) {
        raise("OutputError", error.what());
    } catch (const Cancelled& error) {
        raise("Cancelled", error.what());
    } catch (const Error& error) {
        raise("Error", error.what());
    } catch (const std::bad_alloc&) {
        PyErr_SetString(PyExc_MemoryError, no_memory);
    } catch (const std::length_error&) {  // more than a vector can ever hold
        PyErr_SetString(PyExc_MemoryError, no_memory);
    }
}

}  // namespace

void translate_errors() {
    py::register_local_exception_translator(translate);
}

}  // namespace d2b
