#include "python/array_argument.hpp"

#include <limits>
#include <utility>

namespace d2b {
namespace {

namespace py = pybind11;

[[noreturn]] void refuse_type(const py::array& values) {
    throw py::type_error("The values of an array must be float32, float64 or integers, not " +
                         py::str(values.dtype()).cast<std::string>() + "; convert them with astype().");
}

ValueType type_of(const py::array& values) {
    const char kind = values.dtype().kind();
    const py::ssize_t bytes = values.itemsize();
    if (kind == 'f' && bytes == 4)
        return ValueType::float32;
    if (kind == 'f' && bytes == 8)
        return ValueType::float64;
    if (kind != 'i' && kind != 'u')
        refuse_type(values);
    const bool is_signed = kind == 'i';
    switch (bytes) {
        case 1:
            return is_signed ? ValueType::int8 : ValueType::uint8;
        case 2:
            return is_signed ? ValueType::int16 : ValueType::uint16;
        case 4:
            return is_signed ? ValueType::int32 : ValueType::uint32;
        case 8:
            return is_signed ? ValueType::int64 : ValueType::uint64;
        default:
            refuse_type(values);
    }
}

std::int32_t side(const py::array& values, py::ssize_t axis) {
    if (values.shape(axis) > std::numeric_limits<std::int32_t>::max())
        throw py::value_error("An array has at most 2147483647 rows and columns; use a part of it.");
    return static_cast<std::int32_t>(values.shape(axis));
}

StridedValues strided(const py::array& values) {
    return {values.data(), values.strides(0), values.strides(1)};
}

}  // namespace

ElevationArray elevation_array(std::string name, const py::array& values,
                               const std::optional<py::array>& mask,
                               const std::optional<std::array<double, 6>>& transform) {
    ElevationArray array;
    array.name = std::move(name);
    array.rows = side(values, 0);
    array.cols = side(values, 1);
    array.type = type_of(values);
    array.values = strided(values);
    if (mask)
        array.masked = strided(*mask);
    array.transform = transform;
    return array;
}

}  // namespace d2b
