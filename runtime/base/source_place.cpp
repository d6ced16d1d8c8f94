#include "runtime/base/source_place.h"

#include <fmt/format.h>

namespace rt {

std::string SourcePlace::reference() const {
    return fmt::format("{}/{}:{}", module, routine, line);
}

} // namespace rt
