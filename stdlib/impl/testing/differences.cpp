#include "stdlib/impl/testing/differences.h"

#include "runtime/base/text_util.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/support/type_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rt::lib {
namespace {

constexpr double kUnused = 9e9; // additional axes that are not there

double numberAt(const char* data, const TypeDesc& type) {
    if (type.kind == DescKind::Dnum) {
        double value = 0;
        std::memcpy(&value, data, sizeof value);
        return value;
    }
    float value = 0;
    std::memcpy(&value, data, sizeof value);
    return static_cast<double>(value);
}

bool sameDimensions(const TypeDesc& a, const TypeDesc& b) {
    return std::equal(std::begin(a.dims), std::end(a.dims), std::begin(b.dims));
}

/// "{2,3}" of an element that is number `index` from 0 in the order of memory.
std::string subscript(const TypeDesc& array, uint32_t index) {
    std::string text;
    uint32_t rest = index;
    for (int dim = 2; dim >= 0; --dim) {
        const auto size = static_cast<uint32_t>(array.dims[dim]);
        if (size == 0) continue;
        text = std::to_string(rest % size + 1) + (text.empty() ? "" : ",") + text;
        rest /= size;
    }
    return "{" + text + "}";
}

bool differ(const char* a, const char* b, const TypeDesc& type, double tolerance, Difference& out);

bool partsDiffer(const char* a, const char* b, const TypeDesc& type, double tolerance, Difference& out) {
    const std::string outer = out.part;
    for (uint32_t i = 0; i < type.count; ++i) {
        const bool array = type.kind == DescKind::Array;
        const TypeDesc& part = *type.fields[array ? 0 : i];
        const std::size_t at = array ? std::size_t{i} * part.size : type.offsets[i];
        out.part = outer + (array ? subscript(type, i) : std::string(".") + type.fieldNames[i]);
        if (differ(a + at, b + at, part, tolerance, out)) return true;
    }
    out.part = outer;
    return false;
}

bool differ(const char* a, const char* b, const TypeDesc& type, double tolerance, Difference& out) {
    switch (type.kind) {
    case DescKind::Record:
    case DescKind::Array: return partsDiffer(a, b, type, tolerance, out);
    case DescKind::Num:
    case DescKind::Dnum: {
        const double x = numberAt(a, type), y = numberAt(b, type);
        if (x == y || std::fabs(x - y) <= tolerance) return false;
        break;
    }
    case DescKind::String:
        if (reinterpret_cast<const String*>(a)->view() == reinterpret_cast<const String*>(b)->view())
            return false;
        break;
    default:
        if (std::memcmp(a, b, type.size) == 0) return false;
        break;
    }
    out.found = true;
    describeValues(a, type, b, type, out.expected, out.actual);
    return true;
}

// ---- Places ----------------------------------------------------------------------------------------------------------

bool isNamed(const TypeDesc& type, std::string_view name) {
    return type.kind == DescKind::Record && sameName(type.baseName, name);
}

double component(const char* data, const TypeDesc& type, uint32_t i) {
    return numberAt(data + type.offsets[i], *type.fields[i]);
}

double distanceOf(const char* a, const char* b, const TypeDesc& pos) {
    double sum = 0;
    for (uint32_t i = 0; i < pos.count; ++i) {
        const double d = component(a, pos, i) - component(b, pos, i);
        sum += d * d;
    }
    return std::sqrt(sum);
}

/// Degrees between two quaternions; q and -q are the same orientation.
double angleOf(const char* a, const char* b, const TypeDesc& orient) {
    double dot = 0, sizeA = 0, sizeB = 0;
    for (uint32_t i = 0; i < orient.count; ++i) {
        const double x = component(a, orient, i), y = component(b, orient, i);
        dot += x * y;
        sizeA += x * x;
        sizeB += y * y;
    }
    const double size = std::sqrt(sizeA * sizeB);
    if (size == 0) return sizeA == sizeB ? 0 : 180;
    return std::acos(std::min(1.0, std::fabs(dot) / size)) * 360 / 3.14159265358979323846;
}

bool isUnused(double value) {
    return value >= kUnused * 0.999;
}

struct Limits {
    double distance, angle;
};

/// Each component by itself: axes, additional axes.
void compareAxes(const char* a, const char* b, const TypeDesc& type, double limit, const char* unit,
                 Difference& out) {
    const std::string outer = out.part;
    for (uint32_t i = 0; i < type.count && !out.found; ++i) {
        const double x = component(a, type, i), y = component(b, type, i);
        if (isUnused(x) && isUnused(y)) continue;
        if (std::fabs(x - y) <= limit) continue;
        out.found = true;
        out.part = outer + "." + type.fieldNames[i];
        const TypeDesc& number = *type.fields[i];
        describeValues(a + type.offsets[i], number, b + type.offsets[i], number, out.expected, out.actual);
        out.measured = fmt::format("difference {:.4g} {}, at most {:g}", std::fabs(x - y), unit, limit);
    }
    if (!out.found) out.part = outer;
}

bool comparePlace(const char* a, const char* b, const TypeDesc& type, const Limits& limits, Difference& out) {
    const auto measure = [&](double value, double limit, const char* what, const char* unit) {
        if (value <= limit || out.found) return;
        out.found = true;
        describeValues(a, type, b, type, out.expected, out.actual);
        out.measured = fmt::format("{} {:.4g} {}, at most {:g}", what, value, unit, limit);
    };
    if (isNamed(type, "pos")) {
        measure(distanceOf(a, b, type), limits.distance, "distance", "mm");
        return true;
    }
    if (isNamed(type, "orient")) {
        measure(angleOf(a, b, type), limits.angle, "angle", "degrees");
        return true;
    }
    if (isNamed(type, "robjoint")) {
        compareAxes(a, b, type, limits.angle, "degrees", out);
        return true;
    }
    if (isNamed(type, "extjoint")) {
        compareAxes(a, b, type, limits.distance, "mm or degrees", out);
        return true;
    }
    if (isNamed(type, "confdata")) return true; // another way to the same place
    if (!isNamed(type, "pose") && !isNamed(type, "robtarget") && !isNamed(type, "jointtarget")) return false;
    const std::string outer = out.part;
    for (uint32_t i = 0; i < type.count && !out.found; ++i) {
        out.part = outer + "." + type.fieldNames[i];
        const TypeDesc& part = *type.fields[i];
        (void)comparePlace(a + type.offsets[i], b + type.offsets[i], part, limits, out);
    }
    if (!out.found) out.part = outer;
    return true;
}

} // namespace

double numberOf(const void* data, const TypeDesc& type) {
    return numberAt(static_cast<const char*>(data), type);
}

Difference compareValues(const void* expected, const TypeDesc& expectedType, const void* actual,
                         const TypeDesc& actualType, double tolerance) {
    Difference result;
    const bool arrays = expectedType.kind == DescKind::Array && actualType.kind == DescKind::Array;
    if (!sameType(elementOf(expectedType), elementOf(actualType)) ||
        rankOf(expectedType) != rankOf(actualType) || (arrays && !sameDimensions(expectedType, actualType))) {
        result.found = true;
        describeValues(expected, expectedType, actual, actualType, result.expected, result.actual);
        return result;
    }
    (void)differ(static_cast<const char*>(expected), static_cast<const char*>(actual), expectedType,
                 tolerance, result);
    return result;
}

bool compareNear(const void* expected, const void* actual, const TypeDesc& type, double distance,
                 double angle, Difference& difference) {
    return comparePlace(static_cast<const char*>(expected), static_cast<const char*>(actual), type,
                        {distance, angle}, difference);
}

void describeValues(const void* expected, const TypeDesc& expectedType, const void* actual,
                    const TypeDesc& actualType, std::string& expectedText, std::string& actualText) {
    expectedText = valueToText(expected, expectedType);
    actualText = valueToText(actual, actualType);
    if (expectedText != actualText) return;
    std::string exact, other;
    if (!valueToSource(expected, expectedType, exact) || !valueToSource(actual, actualType, other)) return;
    expectedText = std::move(exact);
    actualText = std::move(other);
}

} // namespace rt::lib
