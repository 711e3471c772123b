#include <algorithm>
#include <cmath>
#include <limits>

// The C library of Windows rounds hypot() in the extended precision of the x87, so that lengths would differ
// from those of Linux in the last bit. This is the algorithm of the GNU C library: C. F. Borges, "An improved
// algorithm for hypot(a,b)", 2019, with one step of Newton's method without fused multiply-add. The linker
// puts it in the place of hypot() in all libraries (--wrap).

namespace {

constexpr double scale = 0x1p-600;
constexpr double largest = 0x1p+511;    ///< beyond it squares overflow
constexpr double smallest = 0x1p-459;   ///< below it squares lose bits
constexpr double negligible = 0x1p-54;  ///< ratio below which the shorter side changes nothing

double hypotenuse(double longer, double shorter) {
    const double root = std::sqrt(longer * longer + shorter * shorter);
    double error = 0;
    if (root <= 2 * shorter) {
        const double rest = root - shorter;
        error = longer * (2 * rest - longer) + (rest - 2 * (longer - shorter)) * rest;
    } else {
        const double rest = root - longer;
        error = 2 * rest * (longer - 2 * shorter) + ((4 * rest - shorter) * shorter + rest * rest);
    }
    return root - error / (2 * root);
}

}  // namespace

// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): the linker makes the name
extern "C" double __wrap_hypot(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y))
        return std::isinf(x) || std::isinf(y) ? std::numeric_limits<double>::infinity() : x + y;
    const double longer = std::max(std::fabs(x), std::fabs(y));
    const double shorter = std::min(std::fabs(x), std::fabs(y));
    if (shorter <= longer * negligible)
        return longer + shorter;
    if (longer > largest)
        return hypotenuse(longer * scale, shorter * scale) / scale;
    if (shorter < smallest)
        return hypotenuse(longer / scale, shorter / scale) * scale;
    return hypotenuse(longer, shorter);
}
