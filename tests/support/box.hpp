#pragma once

#include "dem2buildings/sinks.hpp"

namespace d2b::test {

inline WorldPolygon box(double left, double low, double right, double high) {
    return {{{left, low}, {right, low}, {right, high}, {left, high}}, {}};
}

}  // namespace d2b::test
